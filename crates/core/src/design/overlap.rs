//! Whether two boards are in one place.

use super::board::board;
use glam::{DAffine3, DVec2, DVec3};

/// A convex prism in space.
#[derive(Debug, Clone)]
pub(super) struct Prism {
    corners: Vec<DVec3>,
    /// Normals of its faces.
    normals: Vec<DVec3>,
    /// Directions of its edges.
    edges: Vec<DVec3>,
}

impl Prism {
    /// A board with its inner face in a plane and its outside along the plane's z.
    pub(super) fn new(outline: &[DVec2], place: DAffine3, thickness_mm: f64) -> Self {
        let outward = place.matrix3.z_axis;
        let inner: Vec<DVec3> = outline.iter().map(|p| place.transform_point3(p.extend(0.0))).collect();
        let next = inner.iter().cycle().skip(1);
        let along: Vec<DVec3> = inner.iter().zip(next).map(|(a, b)| (*b - *a).normalize_or_zero()).collect();
        let normals = along.iter().map(|e| e.cross(outward)).chain([outward]).collect();
        let edges = along.into_iter().chain([outward]).collect();
        Self { corners: board(&inner, outward, thickness_mm), normals, edges }
    }

    /// Whether the two come into each other by more than `touch_mm`, by the theorem of the separating
    /// axis: convex solids that do not meet have a plane between them that is parallel to a face of
    /// one, or to an edge of each.
    pub(super) fn overlaps(&self, other: &Self, touch_mm: f64) -> bool {
        let crossed = self.edges.iter().flat_map(|a| other.edges.iter().map(|b| a.cross(*b)));
        let axes = self.normals.iter().chain(&other.normals).copied().chain(crossed);
        let mut axes = axes.filter(|axis| axis.length() > PARALLEL).map(|axis| axis.normalize());
        axes.all(|axis| {
            let ((a, b), (c, d)) = (self.reach(axis), other.reach(axis));
            b.min(d) - a.max(c) > touch_mm
        })
    }

    fn reach(&self, axis: DVec3) -> (f64, f64) {
        let along = self.corners.iter().map(|p| axis.dot(*p));
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    }
}

/// Edges at a smaller angle have no axis of their own.
const PARALLEL: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boards_meet_where_they_are_pushed_into_each_other() {
        let square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(DVec2::from);
        let at = |place| Prism::new(&square, place, 2.0);
        let lying = at(DAffine3::IDENTITY);
        let upright = |by: DVec3| at(DAffine3::from_translation(by) * DAffine3::from_rotation_x(1.2));
        assert!(!lying.overlaps(&at(DAffine3::from_translation(DVec3::Z * 2.0)), 1e-9), "one on the other");
        assert!(lying.overlaps(&at(DAffine3::from_translation(DVec3::Z * 1.9)), 1e-9));
        assert!(!lying.overlaps(&upright(DVec3::new(0.0, 10.0 + 2.0 * libm::sin(1.2), 0.0)), 1e-9));
        assert!(lying.overlaps(&upright(DVec3::new(0.0, 9.9 + 2.0 * libm::sin(1.2) - 2.0, 0.0)), 1e-9));
        // Edge against edge: no face parts them, only the cross product of two edges.
        let turned = DAffine3::from_rotation_x(0.7) * DAffine3::from_rotation_z(0.8);
        assert!(lying.overlaps(&at(DAffine3::from_translation(DVec3::new(5.0, 3.0, 1.0)) * turned), 1e-9));
    }
}
