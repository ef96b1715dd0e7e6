//! Rigid motions.

use glam::DAffine3;

/// The same motion of something whose lengths are `factor` times as long.
pub fn resized(motion: &DAffine3, factor: f64) -> DAffine3 {
    DAffine3 { translation: factor * motion.translation, ..*motion }
}
