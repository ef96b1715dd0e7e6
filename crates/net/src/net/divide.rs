//! The last way to pieces that fit: cutting what is no good, one hinge at a time.

use super::cuts::{PANEL_GAP_MM, Problem};
use super::layout::{self, best_turn, clash};
use glam::DVec2;
use tatamu_core::component::{HingeId, PanelId, PanelSet};

/// Pieces that result from cutting where a piece is no good: starting with `is_cut`, cuts one
/// more hinge of each bad piece, the one whose halves are best, until every piece is good or a
/// single panel.
pub(crate) fn divide(problem: &Problem<'_>, mut is_cut: Vec<bool>) -> Vec<bool> {
    while let Some(bad) = layout::pieces(problem.set, &is_cut)
        .into_iter()
        .find(|piece| piece.panels.len() > 1 && badness(problem.set, problem.sheet_mm, piece) > 0.0)
    {
        let ids: Vec<PanelId> = bad.panels.iter().map(|p| p.0).collect();
        let cost_of = |hinge: HingeId| {
            let mut trial = is_cut.clone();
            trial[hinge.0] = true;
            let halves = layout::pieces(problem.set, &trial);
            let halves = halves.iter().filter(|l| l.panels.iter().any(|p| ids.contains(&p.0)));
            1e3 * halves.map(|l| badness(problem.set, problem.sheet_mm, l)).sum::<f64>()
                + problem.cut_cost[hinge.0]
        };
        let costs: Vec<(f64, HingeId)> = bad.creases.iter().map(|&h| (cost_of(h), h)).collect();
        let Some((_, hinge)) = costs.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)) else {
            break;
        };
        is_cut[hinge.0] = true;
    }
    is_cut
}

/// 0 for a piece without overlap that fits; else the number of overlapping pairs and how much
/// it is too large.
pub(super) fn badness(set: &PanelSet, sheet_mm: DVec2, piece: &layout::Layout) -> f64 {
    let outlines = piece.outlines(set);
    let pairs = outlines
        .iter()
        .enumerate()
        .flat_map(|(k, a)| outlines[..k].iter().map(move |b| f64::from(u8::from(clash(a, b, PANEL_GAP_MM)))));
    let points: Vec<DVec2> = outlines.iter().flatten().copied().collect();
    let scale = best_turn(&points, sheet_mm).scale;
    pairs.sum::<f64>() + (1.0 / scale - 1.0).max(0.0)
}
