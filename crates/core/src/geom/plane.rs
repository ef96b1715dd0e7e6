use glam::{DVec2, DVec3};

/// The plane `{ x : normal · x = offset }`, with the half-space behind it `normal · x <= offset`.
///
/// # Guarantees
/// `normal` has length 1 within rounding, and both fields are finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    normal: DVec3,
    offset: f64,
}

impl Plane {
    /// The plane through `point` with the direction `normal`, which need not have length 1.
    /// `None` where the normal is (nearly) zero or anything is not finite.
    pub fn through(point: DVec3, normal: DVec3) -> Option<Self> {
        let normal = normal.try_normalize()?;
        let offset = normal.dot(point);
        offset.is_finite().then_some(Self { normal, offset })
    }

    /// The plane z = `height`, facing up.
    pub fn horizontal(height: f64) -> Self {
        Self { normal: DVec3::Z, offset: height }
    }

    /// The plane after a rigid motion, or one scale of all lengths.
    pub fn moved(&self, motion: &glam::DAffine3) -> Self {
        let normal = motion.transform_vector3(self.normal).normalize();
        let point = motion.transform_point3(self.normal * self.offset);
        Self { normal, offset: normal.dot(point) }
    }

    /// Least-squares plane of points: the one that minimises the sum of squared distances (§4.2.1),
    /// together with the root mean square distance. `None` for fewer than three distinct points
    /// or points on one line. The sign of the normal is arbitrary but deterministic.
    pub fn fit(points: &[DVec3]) -> Option<(Self, f64)> {
        let n = points.len() as f64;
        if points.len() < 3 {
            return None;
        }
        let centre = points.iter().sum::<DVec3>() / n;
        let (values, vectors) = crate::geom::eigen::symmetric(crate::geom::eigen::covariance(points));
        if values[1] <= 1e-14 * values[2].max(f64::MIN_POSITIVE) {
            return None;
        }
        let plane = Self::through(centre, vectors[0])?;
        Some((plane, values[0].max(0.0).sqrt()))
    }

    /// Unit normal.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Signed distance of the plane from the origin along the normal.
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// Signed distance of a point, positive on the side that the normal points to.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// The same plane facing the other way.
    pub(crate) fn flipped(&self) -> Self {
        Self { normal: -self.normal, offset: -self.offset }
    }

    /// The same plane moved along its normal.
    pub fn shifted(&self, distance: f64) -> Self {
        Self { offset: self.offset + distance, ..*self }
    }

    /// The nearest point of the plane.
    pub fn project(&self, point: DVec3) -> DVec3 {
        point - self.normal * self.distance(point)
    }

    /// Two unit vectors `(a, b)` that span the plane with `a × b = normal`.
    pub(crate) fn basis(&self) -> (DVec3, DVec3) {
        let a = self.normal.any_orthonormal_vector();
        (a, self.normal.cross(a))
    }

    /// Coordinates of a point's foot in the plane, along the two axes of its basis.
    pub fn flat(&self, point: DVec3) -> DVec2 {
        let (x, y) = self.basis();
        DVec2::new(x.dot(point), y.dot(point))
    }

    /// The point of the plane with these coordinates.
    pub fn lifted(&self, point: DVec2) -> DVec3 {
        let (x, y) = self.basis();
        x * point.x + y * point.y + self.normal * self.offset
    }
}
