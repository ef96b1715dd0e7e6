//! Pieces of any panel graph: panels are joined, hinge by hinge, while the piece is good.
//!
//! This is Kruskal's spanning forest with a test: slower and less exact than the search over
//! chains, but it needs no chains, so it serves where panels had to be split.

use super::divide::badness;
use super::layout;
use super::split::is_seam;
use glam::DVec2;
use tatamu_core::component::{HingeId, PanelSet};

/// The hinges to cut. Pieces leave room for tabs of `tab_width_mm` all round on the sheet; hinges
/// that cost most to cut are joined first, seams never.
pub(super) fn grow(set: &PanelSet, cut_cost: &[f64], sheet_mm: DVec2, tab_width_mm: f64) -> Vec<bool> {
    let room_mm = sheet_mm - DVec2::splat(2.0 * tab_width_mm);
    let mut order: Vec<HingeId> =
        (0..set.hinges().len()).map(HingeId).filter(|&h| !is_seam(set, h)).collect();
    order.sort_by(|a, b| cut_cost[b.0].total_cmp(&cut_cost[a.0]));
    let mut is_cut = vec![true; set.hinges().len()];
    for hinge in order {
        let [a, b] = set.hinges()[hinge.0].sides.map(|s| s.panel);
        let pieces = layout::pieces(set, &is_cut);
        let is_joined = pieces.iter().any(|p| p.place(a).is_some() && p.place(b).is_some());
        if is_joined {
            continue;
        }
        is_cut[hinge.0] = false;
        let joined = layout::pieces(set, &is_cut).into_iter().find(|p| p.place(a).is_some());
        is_cut[hinge.0] = joined.is_none_or(|piece| badness(set, room_mm, &piece) > 0.0);
    }
    is_cut
}
