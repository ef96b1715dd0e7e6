//! The box round points.

use glam::DVec3;

/// The least and the largest coordinates of points; infinite, the least above the largest, where there are none.
pub fn bounds(points: impl IntoIterator<Item = DVec3>) -> (DVec3, DVec3) {
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points.into_iter().fold(none, |(low, high), p| (low.min(p), high.max(p)))
}
