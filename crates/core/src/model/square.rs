//! Fold axes of parts that are like boxes.

use crate::component::PrincipalAxis;
use crate::geom::{Hull, Mirror};
use glam::DVec3;

/// A hull is like a box where this share of its surface looks along three axes at right angles to each other; a box that
/// leans as a towel does over its rail has 0.9. Not bounded by cases yet.
const LEAST_SHARE: f64 = 0.7;
/// Normals look along an axis within this angle, and across it: the back of that towel is 0.1 off. Not bounded from above by
/// a case yet.
const ROUGH_RAD: f64 = 0.2;

/// The axes along which the sides of a hull look that is like a box, but for that of its length; in the mirror plane, where
/// there is one. The principal axis of a square towel runs from corner to corner, and no direction about it is along an
/// edge: such a towel had 21 panels, and was a skewed quadrilateral.
pub(super) fn square_axes(hull: &Hull, principal: &PrincipalAxis, mirror: Option<&Mirror>) -> Vec<DVec3> {
    let is_along = |a: DVec3, b: DVec3| a.dot(b).abs() > libm::cos(ROUGH_RAD);
    let is_across = |a: DVec3, b: DVec3| a.dot(b).abs() < libm::sin(ROUGH_RAD);
    let mut sides: Vec<(DVec3, f64)> =
        hull.facets().iter().map(|facet| (facet.plane().normal(), hull.facet_area(facet))).collect();
    sides.sort_by(|a, b| b.1.total_cmp(&a.1));
    let Some(&(first, _)) = sides.first() else { return Vec::new() };
    let second = sides.iter().find(|(normal, _)| is_across(*normal, first));
    let Some(second) = second.and_then(|(normal, _)| normal.reject_from(first).try_normalize()) else {
        return Vec::new();
    };
    let axes = [first, second, first.cross(second)];
    let is_side = |normal: DVec3| axes.iter().any(|axis| is_along(normal, *axis));
    let square_mm2: f64 = sides.iter().filter(|(normal, _)| is_side(*normal)).map(|(_, mm2)| mm2).sum();
    if square_mm2 < LEAST_SHARE * hull.area() {
        return Vec::new();
    }
    let axes = axes.into_iter().filter(|axis| !is_along(*axis, principal.axis()));
    match mirror {
        None => axes.collect(),
        Some(mirror) => {
            let in_plane = axes.filter(|axis| is_across(*axis, mirror.plane().normal()));
            in_plane.map(|axis| mirror.along(axis).normalize()).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Plane, directions};
    use glam::DQuat;

    fn turned() -> DQuat {
        DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -0.9, 1.7)
    }

    /// A box with some corners moved along x, turned.
    fn leaning(size: DVec3, lean: f64) -> Hull {
        let corner = |k: u32| {
            let at = DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
            turned() * (size * at + DVec3::X * lean * at.x * at.z)
        };
        Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    fn axes(hull: &Hull, mirror: Option<&Mirror>) -> Vec<DVec3> {
        square_axes(hull, &PrincipalAxis::of_hull(hull), mirror)
    }

    #[test]
    fn a_square_towel_has_the_axes_of_its_edges() {
        // One corner is cut off, so that the longest way is between the others.
        let towel = leaning(DVec3::new(20.0, 150.0, 150.0), -8.0);
        let corner = turned() * DVec3::new(20.0, 150.0, 0.0);
        let cut = Plane::through(corner, turned() * DVec3::new(0.0, 1.0, -1.0)).unwrap().shifted(-30.0);
        let towel = towel.clip(&cut).unwrap();
        let diagonal = PrincipalAxis::of_hull(&towel).axis();
        let found = axes(&towel, None);
        for edge in [DVec3::Y, DVec3::Z].map(|edge| turned() * edge) {
            assert!(diagonal.dot(edge).abs() < libm::cos(0.6), "{diagonal}");
            assert!(found.iter().any(|axis| axis.dot(edge).abs() > libm::cos(0.06)), "{found:?}");
        }
        // A bar is not folded along its length, and a ball is no box.
        let bar = axes(&leaning(DVec3::new(20.0, 30.0, 200.0), 0.0), None);
        let length = turned() * DVec3::Z;
        assert!(bar.len() == 2 && bar.iter().all(|axis| axis.dot(length).abs() < 1e-9), "{bar:?}");
        let ball = Hull::of_points(&directions(300).map(|d| 40.0 * d).collect::<Vec<_>>()).unwrap();
        assert_eq!(axes(&ball, None), []);
    }

    #[test]
    fn axes_are_in_the_mirror_plane_or_are_none() {
        let hull = leaning(DVec3::new(20.0, 145.0, 150.0), -8.0);
        let mirror = Mirror::new(Plane::through(hull.centroid(), turned() * DVec3::Y).unwrap());
        let found = axes(&hull, Some(&mirror));
        assert!(!found.is_empty());
        assert!(found.iter().all(|axis| axis.dot(mirror.plane().normal()).abs() < 1e-9), "{found:?}");
    }
}
