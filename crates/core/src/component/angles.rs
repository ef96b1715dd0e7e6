//! Angles between candidates for edges and planes, and between those that are taken.

use std::f64::consts::{PI, TAU};

/// Angle between neighbouring candidates for top edges and for slopes.
pub(super) const STEP_RAD: f64 = PI / 36.0;
/// Free top edges keep this far from fixed ones and from each other.
pub(super) const MIN_TURN_RAD: f64 = PI / 10.0;
/// Neighbouring top edges turn by at most this, so that corners stay well defined.
pub(super) const MAX_TURN_RAD: f64 = PI * 0.85;
/// Steepest slope of a side panel: beyond it the panel would be a second top or bottom.
pub(super) const MAX_SLOPE_RAD: f64 = PI * 80.0 / 180.0;
/// Neighbouring planes of a profile differ by at least this.
pub(super) const MIN_BEND_RAD: f64 = PI / 60.0;

/// Signed difference of two directions, in (−π, π].
pub(super) fn turn(a: f64, b: f64) -> f64 {
    let d = (a - b).rem_euclid(TAU);
    if d > PI { d - TAU } else { d }
}
