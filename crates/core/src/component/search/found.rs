//! Finished components, and simpler ones made of them.

use super::super::assemble::Assembled;
use super::super::fit::{Aim, Fit, Fitted};
use super::super::solid::Solid;
use super::super::start::{without_chain, without_plane};
use super::super::target::{FoldSpot, Target};
use super::counts::goal;
use super::finish::{NEAR_ENOUGH_MM, as_box, assemble_unbroken};
use super::price::{finished_cost, over_mm2, panel_worth_mm};
use super::schedule::PRUNE_STEPS;
use super::simpler::Simpler;

/// A shape that is closed by leaving out panels may have at most this many times the error. No case bounds it yet.
const CLOSED_AT_MOST: f64 = 1.5;

/// A finished component.
pub(in crate::component) struct Found {
    /// Index of its target.
    pub(in crate::component) target: usize,
    pub(in crate::component) fitted: Fitted,
    pub(in crate::component) made: Assembled,
    /// What finished shapes are compared by, mm.
    pub(super) cost_mm: f64,
}

/// What leaves out a plane or a chain; `None` where none can be spared.
type Spare = fn(&Fitted, &Target) -> Option<(Solid, Vec<FoldSpot>)>;

impl Found {
    /// What it is compared by, mm.
    pub(in crate::component) fn cost_mm(&self) -> f64 {
        self.cost_mm
    }

    /// The same with one plane or one chain fewer, where that leaves a valid shape.
    fn simpler(&self, way: Spare, targets: &[(Target, f64)], hulls: &[Simpler]) -> Option<Self> {
        let (target, fine) = (&targets[self.target], hulls[self.target].fine());
        let goal = Target { hull: fine, ..goal(&target.0, fine) };
        let (solid, spots) = way(&self.fitted, &goal)?;
        let fit = Fit::new(goal, Aim::LIKENESS, solid, spots).run(PRUNE_STEPS);
        let made = assemble_unbroken(fit.best(), fit.target().symmetry).ok()?;
        let is_valid = fit.best().lack_mm < NEAR_ENOUGH_MM;
        let cost_mm = finished_cost(fit.best(), &made, target);
        is_valid.then(|| Self { target: self.target, fitted: fit.into_best(), made, cost_mm })
    }

    /// It, or the box round its target's hull where that comes closer.
    pub(super) fn or_box(self, targets: &[(Target, f64)]) -> Self {
        let target = self.target;
        match as_box(&targets[target].0) {
            Some((fitted, made)) if fitted.unlike_mm < self.fitted.unlike_mm => {
                Found { target, cost_mm: finished_cost(&fitted, &made, &targets[target]), fitted, made }
            }
            _ => self,
        }
    }
}

/// The same with the planes and chains left out that add little to the likeness, one by one.
pub(super) fn pruned(mut found: Found, targets: &[(Target, f64)], hulls: &[Simpler]) -> Found {
    let (target, _) = &targets[found.target];
    if target.panel_worth == 0.0 {
        return found;
    }
    let worth_mm = panel_worth_mm(target);
    let panels = |found: &Found| found.made.panels.panels().len();
    for way in [without_plane, without_chain] {
        while let Some(simpler) = found.simpler(way, targets, hulls) {
            let saved = panels(&found).saturating_sub(panels(&simpler));
            if saved == 0 || simpler.cost_mm > found.cost_mm + saved as f64 * worth_mm {
                break;
            }
            found = simpler;
        }
    }
    found
}

/// The same shape without the planes and chains that leave openings which look like holes; unchanged where its error
/// would grow beyond [`CLOSED_AT_MOST`].
pub(super) fn closed(found: Found, targets: &[(Target, f64)], hulls: &[Simpler]) -> Found {
    let most_mm = CLOSED_AT_MOST * found.fitted.unlike_mm;
    let mut closed: Option<Found> = None;
    loop {
        let now = closed.as_ref().unwrap_or(&found);
        if over_mm2(&now.made) == 0.0 {
            return closed.unwrap_or(found);
        }
        let simpler = [without_plane, without_chain].map(|way| now.simpler(way, targets, hulls));
        let alike = simpler.into_iter().flatten().filter(|simpler| simpler.fitted.unlike_mm <= most_mm);
        match alike.min_by(|a, b| a.cost_mm.total_cmp(&b.cost_mm)) {
            Some(simpler) => closed = Some(simpler),
            None => return found,
        }
    }
}
