//! Hulls that are turned, as on a lathe: vases, bottles, the balls of a snowman.

use crate::geom::{Hull, Mirror};
use glam::{DQuat, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How far a hull may be from one that is turned, as a share of its width. Scans of a tumbler and of a mug are 0.014 and 0.03
/// off; the body of a teapot, 0.05 off, bulges where its spout and handle are.
const ROUGH: f64 = 0.04;
/// Axes that differ by less are as good: the first one counts, as it is that of a joint or the vertical.
const AS_GOOD: f64 = 0.003;
/// An axis leans by steps of this angle in the mirror plane as long as that makes it better, and so often at most: what is
/// left of a handle bends the principal axis of a mug by up to 10 degrees.
const LEAN_RAD: f64 = PI / 120.0;
const LEANS: usize = 10;
/// Directions about the axis, and how many heights of directions on either side of the equator, in which it is measured.
const AROUND: usize = 24;
const HEIGHTS: i32 = 2;
/// Directions this near to that of a joint at the side do not count: a mug bulges where its handle begins.
const BESIDE_RAD: f64 = PI / 4.0 + 1e-6;

/// An axis about which a hull is turned, nearly.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TurningAxis {
    /// A point of the axis.
    pub(super) centre: DVec3,
    /// Its direction.
    pub(super) axis: DVec3,
    /// Two directions at right angles to it and to each other.
    across: [DVec3; 2],
    /// Directions along these two of the joints at the hull's sides.
    sides: Vec<DVec2>,
}

impl TurningAxis {
    /// The one of these directions in a mirror plane about which the hull is turned the most nearly, if it is. Each has
    /// the normals of the joints at its sides, which are in that plane, too.
    pub(super) fn of_hull(
        hull: &Hull,
        mirror: &Mirror,
        axes: impl Iterator<Item = (DVec3, Vec<DVec3>)>,
    ) -> Option<Self> {
        let mut best: Option<(f64, Self, Vec<DVec3>)> = None;
        for (axis, sides) in axes {
            let (roughness, own) = Self::about(hull, mirror, axis, &sides);
            if best.as_ref().is_none_or(|best| roughness < best.0 - AS_GOOD) {
                best = Some((roughness, own, sides));
            }
        }
        let (mut least, mut best, sides) = best?;
        for lean_rad in [LEAN_RAD, -LEAN_RAD] {
            let leaning = DQuat::from_axis_angle(mirror.plane().normal(), lean_rad);
            for _ in 0..LEANS {
                let (roughness, own) = Self::about(hull, mirror, leaning * best.axis, &sides);
                if roughness >= least - AS_GOOD {
                    break;
                }
                (least, best) = (roughness, own);
            }
        }
        (least < ROUGH).then_some(best)
    }

    /// The axis in this direction about which the hull is turned the most nearly, and how much the hull's reach
    /// differs around it at most, as a share of its width.
    fn about(hull: &Hull, mirror: &Mirror, axis: DVec3, sides: &[DVec3]) -> (f64, Self) {
        let centroid = hull.centroid();
        let normal = mirror.plane().normal();
        let across = [axis.cross(normal), normal];
        let sides = sides.iter().map(|n| flat(across, *n).normalize_or_zero()).collect();
        let mut own = Self { centre: centroid.midpoint(mirror.point(centroid)), axis, across, sides };
        let around = (0..AROUND).map(|k| DVec2::from_angle(TAU * k as f64 / AROUND as f64));
        let around: Vec<DVec2> = around.filter(|d| !own.is_beside(*d)).collect();
        // A circle of radius r that is moved by m along x reaches r + m cos a: here m is that of the least squares.
        let mean = around.iter().map(|d| d.x).sum::<f64>() / around.len() as f64;
        let [moved, spread] = around.iter().fold([0.0; 2], |[moved, spread], d| {
            let x = d.x - mean;
            [moved + x * own.reach_mm(hull, *d, 0.0), spread + x * x]
        });
        own.centre += across[0] * (moved / spread);
        let mut widest: f64 = 0.0;
        let mut roughest: f64 = 0.0;
        for height in -HEIGHTS..=HEIGHTS {
            let slope_rad = f64::from(height) * PI / f64::from(2 * (HEIGHTS + 1));
            let reach = around.iter().map(|d| own.reach_mm(hull, *d, slope_rad));
            let (least, most) =
                reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), mm| (low.min(mm), high.max(mm)));
            roughest = roughest.max(most - least);
            if height == 0 {
                widest = 2.0 * most;
            }
        }
        (roughest / widest, own)
    }

    /// How far a hull reaches from the centre in a direction about the axis, at a slope towards it.
    fn reach_mm(&self, hull: &Hull, around: DVec2, slope_rad: f64) -> f64 {
        let (sin, cos) = libm::sincos(slope_rad);
        let [x, y] = self.across;
        let direction = (x * around.x + y * around.y) * cos + self.axis * sin;
        hull.support(direction) - direction.dot(self.centre)
    }

    fn is_beside(&self, around: DVec2) -> bool {
        self.sides.iter().any(|side| around.dot(*side) > libm::cos(BESIDE_RAD))
    }

    /// The hull as it would be without joints at its sides: there it gets what it has a quarter or a half of a turn
    /// farther. `None` where it has no such joints.
    pub(super) fn round(&self, hull: &Hull) -> Option<Hull> {
        if self.sides.is_empty() {
            return None;
        }
        let around = |p: DVec3| flat(self.across, p - self.centre).normalize_or_zero();
        let mut points: Vec<DVec3> =
            hull.vertices().iter().copied().filter(|p| !self.is_beside(around(*p))).collect();
        let own = points.len();
        for quarters in 1..4 {
            let turn = DQuat::from_axis_angle(self.axis, FRAC_PI_2 * f64::from(quarters));
            let turned = (0..own).map(|k| self.centre + turn * (points[k] - self.centre));
            let turned: Vec<DVec3> = turned.filter(|p| self.is_beside(around(*p))).collect();
            points.extend(turned);
        }
        Hull::of_points(&points).ok()
    }
}

/// The parts of a vector along two others.
fn flat(across: [DVec3; 2], vector: DVec3) -> DVec2 {
    DVec2::from(across.map(|along| along.dot(vector)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{self, Plane};

    fn mirror() -> Mirror {
        Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap())
    }

    /// Rings round the z axis, which are `share` as wide across x as along it.
    fn rings(share: f64) -> Vec<DVec3> {
        let at = |k: usize, r: f64, z: f64| {
            let around = DVec2::from_angle(TAU * k as f64 / 40.0) * r;
            DVec3::new(around.x, around.y * share, z)
        };
        let points = [(20.0, 0.0), (34.0, 30.0), (22.0, 80.0)];
        points.iter().flat_map(|&(r, z)| (0..40).map(move |k| at(k, r, z))).collect()
    }

    fn found(points: &[DVec3], sides: &[DVec3]) -> Option<TurningAxis> {
        let axes = [DVec3::Y, DVec3::new(0.0, 0.3, 1.0).normalize(), DVec3::Z];
        let hull = Hull::of_points(points).unwrap();
        TurningAxis::of_hull(&hull, &mirror(), axes.into_iter().map(|axis| (axis, sides.to_vec())))
    }

    #[test]
    fn a_vase_is_turned_about_its_axis_and_a_flask_is_not() {
        let axis = found(&rings(1.0), &[]).unwrap();
        assert_eq!(axis.axis, DVec3::Z);
        assert!(axis.centre.truncate().length() < 1e-9);
        assert!(found(&rings(0.98), &[]).is_some(), "scans are not exact");
        assert_eq!(found(&rings(0.85), &[]), None);
    }

    #[test]
    fn an_axis_leans_to_where_it_should_be() {
        let lean = DQuat::from_rotation_x(0.15);
        let leaning: Vec<DVec3> = rings(1.0).into_iter().map(|p| lean * p).collect();
        let axis = found(&leaning, &[]).unwrap().axis;
        assert!(axis.angle_between(lean * DVec3::Z) < 0.7 * LEAN_RAD, "{axis}");
    }

    /// What is left of its handle moves neither the axis nor counts as rough; without a joint there, it is a beak.
    #[test]
    fn a_mug_is_turned_about_its_axis() {
        let mut mug = rings(1.0);
        mug.extend([20.0, 60.0].map(|z| DVec3::new(0.0, 40.0, z)));
        let axis = found(&mug, &[DVec3::Y]).unwrap();
        assert_eq!(axis.axis, DVec3::Z);
        // A ring of 40 corners is up to 0.1 mm off a circle.
        assert!(axis.centre.truncate().length() < 0.1, "{}", axis.centre);
        assert_eq!(found(&mug, &[]), None);
        let [own, round] = [mug, rings(1.0)].map(|points| Hull::of_points(&points).unwrap());
        let without = axis.round(&own).unwrap();
        assert!(geom::directions(100).all(|d| (without.support(d) - round.support(d)).abs() < 0.1));
    }
}
