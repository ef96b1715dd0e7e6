//! Exact distances between points and convex polyhedra, and the Hausdorff distance of two.
//!
//! Both bodies are convex, so their Hausdorff distance is reached at a vertex of one of them.

use crate::geom::Hull;
use glam::DVec3;

/// A convex polyhedron as its faces: outward unit normal, offset, outline.
#[derive(Debug, Clone)]
pub struct Polytope {
    faces: Vec<Face>,
}

#[derive(Debug, Clone)]
struct Face {
    normal: DVec3,
    offset: f64,
    outline: Vec<DVec3>,
}

impl Polytope {
    /// A polytope from faces `(outward unit normal, offset, outline)`.
    pub fn new(faces: impl IntoIterator<Item = (DVec3, f64, Vec<DVec3>)>) -> Self {
        let faces = faces.into_iter().map(|(normal, offset, outline)| Face { normal, offset, outline });
        Self { faces: faces.collect() }
    }

    /// The faces of a hull.
    pub fn of_hull(hull: &Hull) -> Self {
        let face = |f| hull.facet_points(f).collect();
        Self::new(hull.facets().iter().map(|f| (f.plane().normal(), f.plane().offset(), face(f))))
    }

    /// Signed distance to the face plane that is farthest below the point, with that face's
    /// index: for points inside, minus the distance to the surface.
    pub fn deepest_plane(&self, point: DVec3) -> (f64, usize) {
        let mut best = (f64::NEG_INFINITY, 0);
        for (k, face) in self.faces.iter().enumerate() {
            let d = face.normal.dot(point) - face.offset;
            if d > best.0 {
                best = (d, k);
            }
        }
        best
    }

    /// Outward normal of face `k`.
    pub fn normal(&self, k: usize) -> DVec3 {
        self.faces[k].normal
    }

    /// The nearest point of the polytope, which is the point itself when inside.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        let visible = self.faces.iter().filter(|f| f.normal.dot(point) > f.offset);
        visible
            .map(|f| f.nearest(point))
            .min_by(|a, b| a.distance_squared(point).total_cmp(&b.distance_squared(point)))
            .unwrap_or(point)
    }

    /// Distance from a point, 0 inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.nearest(point).distance(point)
    }

    /// Corners of all faces (each as often as faces meet there).
    pub fn corners(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.faces.iter().flat_map(|f| f.outline.iter().copied())
    }
}

impl Face {
    fn nearest(&self, point: DVec3) -> DVec3 {
        let foot = point - self.normal * (self.normal.dot(point) - self.offset);
        let mut best = (f64::INFINITY, foot);
        let mut is_inside = true;
        for (k, &a) in self.outline.iter().enumerate() {
            let b = self.outline[(k + 1) % self.outline.len()];
            let edge = b - a;
            if edge.cross(foot - a).dot(self.normal) < 0.0 {
                is_inside = false;
                let t = (edge.dot(foot - a) / edge.length_squared()).clamp(0.0, 1.0);
                let on_edge = if t.is_finite() { a + edge * t } else { a };
                let d = on_edge.distance_squared(foot);
                if d < best.0 {
                    best = (d, on_edge);
                }
            }
        }
        if is_inside { foot } else { best.1 }
    }
}

/// Hausdorff distance of two convex polyhedra.
pub fn hausdorff(a: &Polytope, b: &Polytope) -> f64 {
    let one_way = |from: &Polytope, to: &Polytope| from.corners().map(|p| to.distance(p)).fold(0.0, f64::max);
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

    /// The formula against support functions sampled in many directions, from below, and against
    /// points sampled on the surfaces.
    #[test]
    fn agrees_with_sampled_support_functions() {
        let a = Hull::of_points(&cube(1.0)).unwrap();
        let points: Vec<DVec3> = (0..40)
            .map(|k| {
                let t = k as f64 * 0.7;
                DVec3::new(0.4 + 0.8 * t.cos(), 0.6 + 0.7 * t.sin(), 0.5 + 0.9 * (t * 1.3).sin())
            })
            .collect();
        let b = Hull::of_points(&points).unwrap();
        let exact = hausdorff(&Polytope::of_hull(&a), &Polytope::of_hull(&b));
        let mut sampled = 0.0f64;
        for i in 0..200 {
            for j in 0..400 {
                let (z, t) = ((i as f64 + 0.5) / 100.0 - 1.0, j as f64 / 400.0 * std::f64::consts::TAU);
                let r = (1.0 - z * z).sqrt();
                let d = DVec3::new(r * t.cos(), r * t.sin(), z);
                sampled = sampled.max((a.support(d) - b.support(d)).abs());
            }
        }
        assert!(sampled <= exact + 1e-9 && sampled > exact - 1e-3, "{sampled} {exact}");
    }
}
