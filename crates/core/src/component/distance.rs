//! Exact distances between points and convex polyhedra, and the Hausdorff distance of two.
//!
//! Both bodies are convex, so their Hausdorff distance is reached at a vertex of one of them.

use crate::geom::Hull;
use glam::DVec3;

/// Shorter edges have no direction but that of rounding: where two chains with the same bends meet, each corner is there
/// twice. A point beside the middle of a face was 30 mm from it, as far as from such a corner.
const SHORTEST_MM: f64 = 1e-6;

/// A convex polyhedron: corners, and faces as outward planes with outlines.
#[derive(Debug, Clone)]
pub struct Polytope {
    corners: Vec<DVec3>,
    faces: Vec<Face>,
    /// The planes of the faces again, for [`Polytope::position`].
    fours: Vec<Four>,
    outlines: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Face {
    normal: DVec3,
    offset: f64,
    /// Where its outline begins and ends in the list of all outlines.
    start: u32,
    end: u32,
}

impl Face {
    /// Signed distance of a point to its plane, positive outside.
    fn signed_mm(&self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

/// Four planes beside one another, so that processors measure a point against two or more at once.
#[derive(Debug, Clone, Copy)]
struct Four {
    normals: [[f64; 4]; 3],
    offsets: [f64; 4],
}

impl Four {
    /// The planes of up to four faces; others are infinitely far.
    fn of(faces: &[Face]) -> Self {
        let mut four = Self { normals: [[0.0; 4]; 3], offsets: [f64::INFINITY; 4] };
        for (k, face) in faces.iter().enumerate() {
            let normal = face.normal.to_array();
            (0..3).for_each(|axis| four.normals[axis][k] = normal[axis]);
            four.offsets[k] = face.offset;
        }
        four
    }

    fn signed_mm(&self, point: DVec3) -> [f64; 4] {
        let [x, y, z] = &self.normals;
        std::array::from_fn(|k| x[k] * point.x + y[k] * point.y + z[k] * point.z - self.offsets[k])
    }
}

/// The part of a polytope that a point outside is nearest to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// The inside of a face.
    Face(usize),
    /// The edge between two corners.
    Edge(usize, usize),
    /// A corner.
    Corner(usize),
}

/// Where a point stands to a polytope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Position {
    /// Signed distance to the face plane that is farthest below the point, positive outside: inside, minus the
    /// distance to the surface.
    pub signed_mm: f64,
    /// That face.
    pub face: usize,
    /// For points outside, the nearest point and where it lies.
    pub nearest: Option<(DVec3, Feature)>,
}

impl Polytope {
    /// A polytope from its corners and faces `(outward unit normal, offset, outline)`; outlines
    /// are counter-clockwise indices of corners.
    pub fn new<O: IntoIterator<Item = u32>>(
        corners: Vec<DVec3>,
        faces: impl IntoIterator<Item = (DVec3, f64, O)>,
    ) -> Self {
        let mut outlines: Vec<u32> = Vec::new();
        let faces = faces.into_iter().map(|(normal, offset, outline)| {
            let start = outlines.len() as u32;
            outlines.extend(outline);
            Face { normal, offset, start, end: outlines.len() as u32 }
        });
        let faces: Vec<Face> = faces.collect();
        let fours = faces.chunks(4).map(Four::of).collect();
        Self { corners, faces, fours, outlines }
    }

    /// The faces of a hull.
    pub fn of_hull(hull: &Hull) -> Self {
        let faces = hull.facets().iter();
        let faces = faces.map(|f| (f.plane().normal(), f.plane().offset(), f.outline().iter().copied()));
        Self::new(hull.vertices().to_vec(), faces)
    }

    /// Corners.
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// Corners of face `k`, counter-clockwise.
    pub fn outline(&self, k: usize) -> impl Iterator<Item = DVec3> + '_ {
        self.outline_corners(k).iter().map(|&c| self.corners[c as usize])
    }

    /// Indices of the corners of face `k`, counter-clockwise.
    pub fn outline_corners(&self, k: usize) -> &[u32] {
        let face = &self.faces[k];
        &self.outlines[face.start as usize..face.end as usize]
    }

    /// Outward normal and offset of face `k`.
    pub fn plane(&self, k: usize) -> (DVec3, f64) {
        (self.faces[k].normal, self.faces[k].offset)
    }

    /// Outward normal of face `k`.
    pub fn normal(&self, k: usize) -> DVec3 {
        self.faces[k].normal
    }

    /// Where a point stands.
    pub fn position(&self, point: DVec3) -> Position {
        let (mut signed_mm, mut face) = (f64::NEG_INFINITY, 0);
        for (chunk, four) in self.fours.iter().enumerate() {
            let distances = four.signed_mm(point);
            // There is no NaN, for which `f64::max` would look.
            let larger = |a: f64, b: f64| if a > b { a } else { b };
            let largest = larger(larger(distances[0], distances[1]), larger(distances[2], distances[3]));
            if largest > signed_mm {
                let first = distances.iter().position(|d| *d == largest).unwrap_or(0);
                (signed_mm, face) = (largest, 4 * chunk + first);
            }
        }
        let nearest = (signed_mm > 0.0).then(|| self.nearest(point, face));
        Position { signed_mm, face, nearest }
    }

    /// The nearest point to one outside, which is at least as far as from the plane of `farthest`.
    fn nearest(&self, point: DVec3, farthest: usize) -> (DVec3, Feature) {
        let (foot, feature) = self.nearest_on(farthest, point);
        if feature == Feature::Face(farthest) {
            return (foot, feature);
        }
        let mut best = (foot.distance_squared(point), foot, feature);
        for (k, f) in self.faces.iter().enumerate() {
            let d = f.signed_mm(point);
            if d > 0.0 && d * d < best.0 && k != farthest {
                let (foot, feature) = self.nearest_on(k, point);
                let distance = foot.distance_squared(point);
                if distance < best.0 {
                    best = (distance, foot, feature);
                }
            }
        }
        (best.1, best.2)
    }

    fn nearest_on(&self, k: usize, point: DVec3) -> (DVec3, Feature) {
        let face = &self.faces[k];
        let outline = self.outline_corners(k);
        let foot = point - face.normal * face.signed_mm(point);
        let mut best = (f64::INFINITY, foot, Feature::Face(k));
        let mut is_inside = true;
        let mut from = outline.last().map_or(0, |&v| v as usize);
        for &to in outline {
            let (a, b) = (self.corners[from], self.corners[to as usize]);
            let edge = b - a;
            if edge.length_squared() < SHORTEST_MM * SHORTEST_MM {
                continue;
            }
            if edge.cross(foot - a).dot(face.normal) < 0.0 {
                is_inside = false;
                let t = edge.dot(foot - a) / edge.length_squared();
                let (on_edge, feature) = if t >= 1.0 {
                    (b, Feature::Corner(to as usize))
                } else if t > 0.0 {
                    (a + edge * t, Feature::Edge(from, to as usize))
                } else {
                    (a, Feature::Corner(from))
                };
                let d = on_edge.distance_squared(foot);
                if d < best.0 {
                    best = (d, on_edge, feature);
                }
            }
            from = to as usize;
        }
        if is_inside { (foot, Feature::Face(k)) } else { (best.1, best.2) }
    }

    /// Distance from a point, 0 inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.position(point).nearest.map_or(0.0, |n| n.0.distance(point))
    }
}

/// Hausdorff distance of two convex polyhedra.
pub fn hausdorff(a: &Polytope, b: &Polytope) -> f64 {
    let one_way =
        |from: &Polytope, to: &Polytope| from.corners.iter().map(|p| to.distance(*p)).fold(0.0, f64::max);
    one_way(a, b).max(one_way(b, a))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hull(points: &[DVec3]) -> Polytope {
        Polytope::of_hull(&Hull::of_points(points).unwrap())
    }

    fn cube(side: f64) -> Vec<DVec3> {
        (0..8).map(|k| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64) * side).collect()
    }

    #[test]
    fn nested_cubes() {
        let d = hausdorff(&hull(&cube(1.0)), &hull(&cube(3.0)));
        assert!((d - 2.0 * 3f64.sqrt()).abs() < 1e-8);
    }

    #[test]
    fn nearest_point_on_face_edge_and_corner() {
        let c = hull(&cube(1.0));
        for (p, d) in [
            ((0.5, 0.5, 3.0), 2.0),
            ((0.5, 2.0, 2.0), 2f64.sqrt()),
            ((2.0, 2.0, 2.0), 3f64.sqrt()),
            ((0.5, 0.5, 0.5), 0.0),
        ] {
            assert!((c.distance(DVec3::new(p.0, p.1, p.2)) - d).abs() < 1e-8);
        }
    }

    /// Where two chains of a solid bend at one height, they have a corner there each, a rounding apart.
    #[test]
    fn corners_that_are_there_twice_do_not_matter() {
        let by_rounding = 1.0 + f64::EPSILON;
        let mut corners: Vec<DVec3> = cube(1.0);
        corners.push(DVec3::new(by_rounding, 1.0, 1.0));
        let top = [4, 5, 7, 8, 6];
        let faces = [(DVec3::Z, 1.0, top.to_vec()), (-DVec3::Z, 0.0, vec![0, 2, 3, 1])];
        let above = DVec3::new(0.5, 0.4, 3.0);
        let nearest = Polytope::new(corners, faces).position(above).nearest;
        assert_eq!(nearest, Some((DVec3::new(0.5, 0.4, 1.0), Feature::Face(0))));
    }

    /// The formula against support functions sampled in many directions, from below, and against
    /// points sampled on the surfaces.
    #[test]
    fn agrees_with_sampled_support_functions() {
        let a = Hull::of_points(&cube(1.0)).unwrap();
        let points: Vec<DVec3> = (0..40)
            .map(|k| {
                let t = k as f64 * 0.7;
                DVec3::new(0.4 + 0.8 * libm::cos(t), 0.6 + 0.7 * libm::sin(t), 0.5 + 0.9 * libm::sin(t * 1.3))
            })
            .collect();
        let b = Hull::of_points(&points).unwrap();
        let exact = hausdorff(&Polytope::of_hull(&a), &Polytope::of_hull(&b));
        let mut sampled = 0.0f64;
        for i in 0..200 {
            for j in 0..400 {
                let (z, t) = ((i as f64 + 0.5) / 100.0 - 1.0, j as f64 / 400.0 * std::f64::consts::TAU);
                let r = (1.0 - z * z).sqrt();
                let d = DVec3::new(r * libm::cos(t), r * libm::sin(t), z);
                sampled = sampled.max((a.support(d) - b.support(d)).abs());
            }
        }
        assert!(sampled <= exact + 1e-9 && sampled > exact - 1e-3, "{sampled} {exact}");
    }
}
