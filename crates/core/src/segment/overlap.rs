//! How well convex hulls stand for the solid.

use super::choose::Cover;
use super::grid::Interior;
use crate::geom::Hull;
use crate::mesh::Mesh;

/// About as many cells fill the bounding box: 74 on a side of a cube. A flat side parallel to an
/// axis may be half a cell off, 0.7% of the size.
const CELLS: f64 = 400_000.0;

/// The union of hulls against the solid, as shares of volumes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// Intersection over union.
    pub iou: f64,
    /// Share of the solid that no hull covers.
    pub missing: f64,
    /// Volume of the hulls outside of the solid over that of the solid.
    pub outside: f64,
}

/// Compares the union of hulls with the solid that a mesh bounds; `None` where it encloses
/// nothing.
pub fn overlap<'a>(mesh: &Mesh, hulls: impl IntoIterator<Item = &'a Hull>) -> Option<Overlap> {
    let solid = Interior::of_mesh(mesh.positions(), mesh.faces(), CELLS);
    let mut cover = Cover::new(&solid);
    hulls.into_iter().for_each(|hull| cover.add(&solid.runs(hull.corners())));
    let [all, inside, outside] = [solid.inside(), cover.inside(), cover.outside()].map(|n| n as f64);
    (all > 0.0).then(|| Overlap { iou: cover.iou(), missing: 1.0 - inside / all, outside: outside / all })
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{balls_in_a_row, mesh};
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_box_round_a_ball_has_what_the_ball_lacks() {
        let ball = mesh(&balls_in_a_row(&[(0.0, 1.0)], 60, 60));
        let corner = |k: i32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let cube = |scale: f64, shift: f64| {
            let points: Vec<DVec3> = (0..8).map(|k| corner(k) * scale - DVec3::splat(shift)).collect();
            Hull::of_points(&points).unwrap()
        };
        let solid = 4.0 / 3.0 * std::f64::consts::PI;
        let whole = overlap(&ball, [&cube(2.0, 1.0)]).unwrap();
        assert!((whole.iou - solid / 8.0).abs() < 0.015, "{whole:?}");
        assert!(whole.missing < 0.01 && (whole.outside - (8.0 / solid - 1.0)).abs() < 0.04, "{whole:?}");
        // One octant of eight, given twice: what overlaps counts once.
        let octant = cube(1.0, 0.0);
        let part = overlap(&ball, [&octant, &octant]).unwrap();
        assert!((part.missing - 0.875).abs() < 0.01, "{part:?}");
        assert!((part.outside - (1.0 - solid / 8.0) / solid).abs() < 0.01, "{part:?}");
    }
}
