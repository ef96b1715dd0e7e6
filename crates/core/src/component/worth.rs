//! Candidates for edges and planes, and what one is worth.

use super::shape::{ProfileLine, section_corner};
use glam::DVec2;

/// A top edge whose loss adds less than this share of the area is not worth a chain: a box has four.
pub(super) const WORTH_SHARE: f64 = 0.002;
/// A plane that keeps the profile from bulging by less than this on average is not worth a crease.
pub(super) const WORTH_MM: f64 = 0.05;

/// A candidate for an edge of the top polygon.
pub(super) struct Edge {
    pub(super) angle_rad: f64,
    pub(super) normal: DVec2,
    pub(super) support: f64,
    pub(super) is_locked: bool,
}

/// Where the lines of two edges meet.
pub(super) fn meet(a: &Edge, b: &Edge) -> DVec2 {
    section_corner((a.normal, a.support), (b.normal, b.support))
}

/// Area by which the profile would grow without plane k, mm², and its mean width, mm.
pub(super) fn bulge(lines: &[ProfileLine], k: usize, (top, bottom): (f64, f64)) -> (f64, f64) {
    let bend = |k: usize| lines[k].meets(&lines[k + 1]);
    let upper = if k == 0 { top } else { bend(k - 1).min(top) };
    let lower = if k + 1 == lines.len() { bottom } else { bend(k).max(bottom) };
    if upper <= lower {
        return (0.0, 0.0);
    }
    let steps = 12;
    let gaps = (0..steps).map(|s| {
        let v = lower + (upper - lower) * (f64::from(s) + 0.5) / f64::from(steps);
        let above = if k > 0 { lines[k - 1].u_at(v) } else { f64::INFINITY };
        let below = lines.get(k + 1).map_or(f64::INFINITY, |f| f.u_at(v));
        (above.min(below) - lines[k].u_at(v)).clamp(0.0, 1e6)
    });
    let mean_mm = gaps.sum::<f64>() / f64::from(steps);
    (mean_mm * (upper - lower), mean_mm)
}
