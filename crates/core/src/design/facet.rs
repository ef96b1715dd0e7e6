//! The walls of a profile: segments that only a crease divides are one.

use crate::component::Profile;
use glam::DVec2;

/// Turns with a smaller sine are creases in a straight wall.
pub(super) const STRAIGHT: f64 = 1e-9;

/// Sine of the turn at b; positive where it is inwards.
pub(super) fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).normalize_or_zero().perp_dot((c - b).normalize_or_zero())
}

fn is_corner(points: &[DVec2], i: usize) -> bool {
    i == 0 || i + 1 == points.len() || turn(points[i - 1], points[i], points[i + 1]).abs() > STRAIGHT
}

/// The vertices of a profile without creases in straight walls.
pub(super) fn corners(profile: &Profile) -> Vec<DVec2> {
    let points = profile.points();
    (0..points.len()).filter(|&i| is_corner(points, i)).map(|i| points[i]).collect()
}

/// For each segment of a profile the segment between corners that it belongs to.
pub(super) fn facets(profile: &Profile) -> Vec<usize> {
    let points = profile.points();
    (0..points.len() - 1).map(|i| (1..=i).filter(|&k| is_corner(points, k)).count()).collect()
}
