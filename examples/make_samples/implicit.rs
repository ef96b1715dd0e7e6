//! Solids as smooth unions of simple distance fields. Only sums, products, quotients and square
//! roots are used at evaluation, so that every platform computes the same numbers.
//!
//! The distance formulas are those of Inigo Quilez, <https://iquilezles.org/articles/distfunctions/>.

use glam::{DMat3, DVec2, DVec3};

/// A simple solid about its own origin.
pub enum Shape {
    /// Half axes. Its field is a first-order estimate of the distance.
    Ellipsoid(DVec3),
    /// A frustum along y, centred, with rounded edges.
    Drum {
        /// Height over all.
        height: f64,
        /// Radius at the lower end.
        bottom: f64,
        /// Radius at the upper end.
        top: f64,
        /// Radius of the edges' rounding.
        rounding: f64,
    },
    /// Balls of given centres and radii, each joined to the next by a cone.
    Tube(Vec<(DVec3, f64)>),
}

/// A shape in its place.
pub struct Part {
    shape: Shape,
    place: DVec3,
    to_local: DMat3,
    flatness: f64,
    is_mirrored: bool,
    blend: f64,
}

impl Part {
    /// The shape at the origin, joined to the parts before it without blending.
    pub fn new(shape: Shape) -> Self {
        Self {
            shape,
            place: DVec3::ZERO,
            to_local: DMat3::IDENTITY,
            flatness: 1.0,
            is_mirrored: false,
            blend: 0.0,
        }
    }

    /// An ellipsoid of the given half axes.
    pub fn ellipsoid(x: f64, y: f64, z: f64) -> Self {
        Self::new(Shape::Ellipsoid(DVec3::new(x, y, z)))
    }

    /// A ball.
    pub fn ball(radius: f64) -> Self {
        Self::ellipsoid(radius, radius, radius)
    }

    /// A tube through points with radii, each given as [x, y, z, radius].
    pub fn tube(points: &[[f64; 4]]) -> Self {
        Self::new(Shape::Tube(points.iter().map(|&[x, y, z, r]| (DVec3::new(x, y, z), r)).collect()))
    }

    /// Makes the part thinner along its own z axis; its field is then no distance any more, but
    /// has the same surface.
    pub fn flattened(mut self, factor: f64) -> Self {
        self.flatness = factor;
        self
    }

    /// Moves the part's origin there.
    pub fn at(mut self, x: f64, y: f64, z: f64) -> Self {
        self.place = DVec3::new(x, y, z);
        self
    }

    /// Turns the part about an axis of the world through its origin.
    pub fn turned(mut self, axis: DVec3, degrees: f64) -> Self {
        self.to_local *= DMat3::from_axis_angle(axis, -degrees.to_radians());
        self
    }

    /// Adds the mirror image on the other side of x = 0.
    pub fn mirrored(mut self) -> Self {
        self.is_mirrored = true;
        self
    }

    /// Joins the part to those before it with a fillet of about this size.
    pub fn blended(mut self, size: f64) -> Self {
        self.blend = size;
        self
    }

    fn distance(&self, point: DVec3) -> f64 {
        let side = if self.is_mirrored { DVec3::new(point.x.abs(), point.y, point.z) } else { point };
        let mut local = self.to_local * (side - self.place);
        local.z /= self.flatness;
        match &self.shape {
            Shape::Ellipsoid(radii) => ellipsoid(local, *radii),
            Shape::Drum { height, bottom, top, rounding } => {
                let half = 0.5 * height - rounding;
                frustum(local, half, bottom - rounding, top - rounding) - rounding
            }
            Shape::Tube(balls) => {
                balls.windows(2).map(|pair| round_cone(local, pair[0], pair[1])).fold(f64::MAX, f64::min)
            }
        }
    }
}

/// The smooth union of parts, in order.
pub struct Solid(pub Vec<Part>);

impl Solid {
    /// About the distance to the surface, negative inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.0.iter().fold(f64::MAX, |whole, part| smooth_min(whole, part.distance(point), part.blend))
    }

    /// Gradient of [`Solid::distance`], from differences at the corners of a small tetrahedron.
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        const STEP_MM: f64 = 1e-4;
        let corners = [
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(1.0, 1.0, 1.0),
        ];
        let sum: DVec3 =
            corners.into_iter().map(|corner| corner * self.distance(point + corner * STEP_MM)).sum();
        sum / (4.0 * STEP_MM)
    }
}

fn smooth_min(a: f64, b: f64, size: f64) -> f64 {
    let overlap = size - (a - b).abs();
    if overlap <= 0.0 {
        return a.min(b);
    }
    a.min(b) - 0.25 * overlap * overlap / size
}

fn ellipsoid(point: DVec3, radii: DVec3) -> f64 {
    let scaled = (point / radii).length();
    let slope = (point / (radii * radii)).length();
    if slope == 0.0 {
        return -radii.min_element();
    }
    scaled * (scaled - 1.0) / slope
}

fn frustum(point: DVec3, half: f64, bottom: f64, top: f64) -> f64 {
    let q = DVec2::new(DVec2::new(point.x, point.z).length(), point.y);
    let end = if q.y < 0.0 { bottom } else { top };
    let to_cap = DVec2::new(q.x - q.x.min(end), q.y.abs() - half);
    let upper = DVec2::new(top, half);
    let side = DVec2::new(top - bottom, 2.0 * half);
    let along = ((upper - q).dot(side) / side.length_squared()).clamp(0.0, 1.0);
    let to_side = q - upper + side * along;
    let is_inside = to_side.x < 0.0 && to_cap.y < 0.0;
    let distance = to_cap.length_squared().min(to_side.length_squared()).sqrt();
    if is_inside { -distance } else { distance }
}

/// Distance to the hull of two balls, none of which contains the other.
fn round_cone(point: DVec3, (a, r_a): (DVec3, f64), (b, r_b): (DVec3, f64)) -> f64 {
    let axis = b - a;
    let squared = axis.length_squared();
    let shrink = r_a - r_b;
    let side = squared - shrink * shrink;
    let from_a = point - a;
    let along = from_a.dot(axis);
    let beyond = along - squared;
    let across = (from_a * squared - axis * along).length_squared();
    let along_scaled = along * along * squared;
    let beyond_scaled = beyond * beyond * squared;
    let cone = shrink * shrink.abs() * across;
    if beyond * beyond.abs() * side * squared > cone {
        (across + beyond_scaled).sqrt() / squared - r_b
    } else if along * along.abs() * side * squared < cone {
        (across + along_scaled).sqrt() / squared - r_a
    } else {
        ((across * side / squared).sqrt() + along * shrink) / squared - r_a
    }
}
