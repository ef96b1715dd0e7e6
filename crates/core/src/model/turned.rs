//! Hulls that are turned, as on a lathe: vases, bottles, the balls of a snowman.

use crate::geom::{Hull, Mirror};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// How far a hull may be from one that is turned, as a share of its width. Scans of a tumbler and of a mug are 0.014 and 0.03
/// off; the body of a teapot, 0.05 off, bulges where its spout and handle are.
const ROUGH: f64 = 0.04;
/// Directions about the axis, and how many heights of directions on either side of the equator, in which it is measured.
const AROUND: usize = 24;
const HEIGHTS: i32 = 2;

/// An axis about which a hull is turned, nearly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TurningAxis {
    /// A point of the axis.
    pub(super) centre: DVec3,
    /// Its direction.
    pub(super) axis: DVec3,
}

impl TurningAxis {
    /// The one of these directions in a mirror plane about which the hull is turned the most nearly, if it is.
    pub(super) fn of_hull(hull: &Hull, mirror: &Mirror, axes: impl Iterator<Item = DVec3>) -> Option<Self> {
        let centroid = hull.centroid();
        let centre = centroid.midpoint(mirror.point(centroid));
        let turned = axes.map(|axis| (roughness(hull, centre, axis), Self { centre, axis }));
        turned
            .filter(|(roughness, _)| *roughness < ROUGH)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|best| best.1)
    }
}

/// How much the reach of a hull from an axis differs around it at most, as a share of its width.
fn roughness(hull: &Hull, centre: DVec3, axis: DVec3) -> f64 {
    let x = axis.any_orthonormal_vector();
    let y = axis.cross(x);
    let mut widest: f64 = 0.0;
    let mut roughest: f64 = 0.0;
    for height in -HEIGHTS..=HEIGHTS {
        let slope_rad = f64::from(height) * PI / f64::from(2 * (HEIGHTS + 1));
        let (sin, cos) = libm::sincos(slope_rad);
        let reach = (0..AROUND).map(|k| {
            let around = DVec2::from_angle(TAU * k as f64 / AROUND as f64) * cos;
            let direction = x * around.x + y * around.y + axis * sin;
            hull.support(direction) - direction.dot(centre)
        });
        let (least, most) =
            reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), mm| (low.min(mm), high.max(mm)));
        roughest = roughest.max(most - least);
        if height == 0 {
            widest = 2.0 * most;
        }
    }
    roughest / widest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Plane;

    /// Rings round the z axis, which are `share` as wide across x as along it.
    fn rings(share: f64) -> Hull {
        let at = |k: usize, r: f64, z: f64| {
            let around = DVec2::from_angle(TAU * k as f64 / 40.0) * r;
            DVec3::new(around.x, around.y * share, z)
        };
        let points = [(20.0, 0.0), (34.0, 30.0), (22.0, 80.0)];
        Hull::of_points(
            &points.iter().flat_map(|&(r, z)| (0..40).map(move |k| at(k, r, z))).collect::<Vec<_>>(),
        )
        .unwrap()
    }

    #[test]
    fn a_vase_is_turned_about_its_axis_and_a_flask_is_not() {
        let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
        let axes = [DVec3::Y, DVec3::new(0.0, 0.3, 1.0).normalize(), DVec3::Z];
        let found = TurningAxis::of_hull(&rings(1.0), &mirror, axes.into_iter()).unwrap();
        assert_eq!(found.axis, DVec3::Z);
        assert!(found.centre.truncate().length() < 1e-9);
        assert!(
            TurningAxis::of_hull(&rings(0.98), &mirror, axes.into_iter()).is_some(),
            "scans are not exact"
        );
        assert_eq!(TurningAxis::of_hull(&rings(0.85), &mirror, axes.into_iter()), None);
    }
}
