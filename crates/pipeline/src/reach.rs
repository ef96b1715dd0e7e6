//! What of a mesh its model does not reach.

use glam::DVec3;
use tatamu_core::geom::Hull;
use tatamu_core::geom::nearest::Tree;
use tatamu_core::mesh::Mesh;
use tatamu_core::model::{Model, ModelPart};

/// Most vertices of the mesh that are measured, evenly by their numbers.
const POINTS: usize = 3000;

/// How far a mesh reaches at least beyond the components of its model, as a share of its diagonal: by the length of a leg
/// that is lost. Outlines hardly show a thin one.
pub(super) fn beyond(mesh: &Mesh, model: &Model) -> f64 {
    let hulls: Vec<Hull> = model.parts().iter().filter_map(hull).collect();
    beyond_mm(mesh.positions(), &hulls) / mesh.diagonal_mm()
}

/// The hull of a component in its place; components are convex as long as models are compared.
fn hull(part: &ModelPart) -> Option<Hull> {
    let place = part.deployed();
    let corners = part.component.panels().panels().iter().flat_map(|panel| panel.deployed_outline());
    Hull::of_points(&corners.map(|p| place.transform_point3(p)).collect::<Vec<_>>()).ok()
}

/// The largest distance of points from hulls; 0 where all are inside.
fn beyond_mm(points: &[DVec3], hulls: &[Hull]) -> f64 {
    let triangles: Vec<[DVec3; 3]> = hulls.iter().flat_map(Hull::corners).collect();
    if triangles.is_empty() {
        return f64::INFINITY;
    }
    let surface = Tree::new(triangles);
    let is_in = |p: DVec3, hull: &Hull| hull.facets().iter().all(|facet| facet.plane().distance(p) <= 0.0);
    let step = points.len().div_ceil(POINTS).max(1);
    let outside = points.iter().step_by(step).filter(|p| !hulls.iter().any(|hull| is_in(**p, hull)));
    outside.map(|p| surface.nearest(*p, 0).distance_squared).fold(0.0, f64::max).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cuboid(low: DVec3, size: DVec3) -> Vec<DVec3> {
        let corner =
            |k: u32| low + size * DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        (0..8).map(corner).collect()
    }

    #[test]
    fn a_leg_that_is_lost_is_missed_by_its_length() {
        let seat = cuboid(DVec3::ZERO, DVec3::new(50.0, 50.0, 4.0));
        let leg = cuboid(DVec3::new(1.0, 1.0, -40.0), DVec3::new(2.0, 2.0, 40.0));
        let points = [seat.clone(), leg.clone()].concat();
        let [seat, leg] = [seat, leg].map(|corners| Hull::of_points(&corners).unwrap());
        assert!((beyond_mm(&points, std::slice::from_ref(&seat)) - 40.0).abs() < 1e-9);
        assert!(beyond_mm(&points, &[seat, leg]) < 1e-9);
    }
}
