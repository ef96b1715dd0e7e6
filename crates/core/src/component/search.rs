//! The search for the best component: several starts, of which the promising ones continue; simpler
//! shapes where the limits leave no room.

mod counts;
mod finish;
mod found;
mod price;
mod schedule;
mod simpler;
mod straightened;

pub(super) use found::Found;

use super::assemble_error::AssembleError;
use super::convert_error::ConvertError;
use super::fit::{Aim, Fit};
use super::solid::Solid;
use super::start::{circumscribe, fold_spots, lens};
use super::target::Target;
use crate::geom::HullError;
use counts::{fewer, first_counts, goal, with_sure_counts};
use finish::{as_box, finish};
use found::{closed, pruned};
use price::{cost, finished_cost, panel_worth_mm};
use rayon::prelude::*;
use schedule::{
    CHEAP_PANELS, FEW_EDGES, FEW_VERTICES, FINISHED, FINISHED_OF_ONE, FIRST_STEPS, LAST_STEPS, LEFT,
    LEFT_FEWER, LEFT_FULL, MORE_STEPS, PRUNED, RETRIED,
};
use simpler::Simpler;
use straightened::Straightened;

/// The best component.
pub(super) fn best(targets: &[(Target, f64)]) -> Result<Found, ConvertError> {
    let straightened = Straightened::of(targets)?;
    let targets = &straightened.targets();
    let hulls: Vec<Simpler> = targets.par_iter().map(|t| Simpler::of(&t.0)).collect();
    let mut best = best_of(targets, &hulls);
    if let Some(fewer) = with_sure_counts(targets)
        && let Ok(other) = best_of(&fewer, &hulls)
        && best.as_ref().map_or(true, |best| other.cost_mm < best.cost_mm)
    {
        best = Ok(other);
    }
    let best = match best {
        Ok(best) => Ok(closed(pruned(best, targets, &hulls), targets, &hulls).or_box(targets)),
        Err(error) => as_box(&targets[0].0)
            .map(|(fitted, made)| Found {
                target: 0,
                cost_mm: finished_cost(&fitted, &made, &targets[0]),
                fitted,
                made,
            })
            .ok_or(error),
    };
    straightened.back(best?)
}

/// The best component for each target, those of the least cost first.
pub(super) fn each(targets: &[(Target, f64)]) -> Vec<Found> {
    let Ok(straightened) = Straightened::of(targets) else { return Vec::new() };
    let targets = &straightened.targets();
    let hulls: Vec<Simpler> = targets.par_iter().map(|t| Simpler::of(&t.0)).collect();
    let mut all = most_promising(targets, &hulls, Wanted::Each);
    all.extend(with_sure_counts(targets).into_iter().flat_map(|t| most_promising(&t, &hulls, Wanted::Each)));
    if targets.iter().any(|t| t.0.panel_worth > 0.0 && t.0.panel_worth < CHEAP_PANELS) {
        all.extend(most_promising(targets, &hulls, Wanted::EachFromFew));
    }
    let mut found: Vec<Found> = all.into_iter().filter_map(Result::ok).collect();
    found.sort_by(|a, b| a.cost_mm.total_cmp(&b.cost_mm));
    let mut is_taken = vec![false; targets.len()];
    found.retain(|found| !std::mem::replace(&mut is_taken[found.target], true));
    let finish = |(place, found): (usize, Found)| {
        let found = if place < PRUNED { pruned(found, targets, &hulls) } else { found };
        let mut found = closed(found, targets, &hulls).or_box(targets);
        let (target, panels) = (&targets[found.target].0, found.made.panels.panels().len());
        found.cost_mm += panel_worth_mm(target) * panels as f64;
        found
    };
    let mut found: Vec<Found> = found.into_par_iter().enumerate().map(finish).collect();
    found.sort_by(|a, b| a.cost_mm.total_cmp(&b.cost_mm));
    found.into_par_iter().filter_map(|found| straightened.back(found).ok()).collect()
}

/// The best component found.
fn best_of(targets: &[(Target, f64)], hulls: &[Simpler]) -> Result<Found, ConvertError> {
    let mut best = Err(ConvertError::Hull(HullError::Flat));
    for result in most_promising(targets, hulls, Wanted::Best) {
        match result {
            Ok(found) if best.as_ref().map_or(true, |b: &Found| found.cost_mm < b.cost_mm) => {
                best = Ok(found);
            }
            Err(error) if best.is_err() => best = Err(ConvertError::Assemble(error)),
            _ => {}
        }
    }
    best
}

/// What is searched for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Wanted {
    /// The best component, whatever its target.
    Best,
    /// One of each target.
    Each,
    /// One of each target, from a start with few panels.
    EachFromFew,
}

impl Wanted {
    /// Top edges and profile vertices that fits start with.
    fn first_counts(self, goal: &Target) -> (usize, usize) {
        let (edges, vertices) = first_counts(goal);
        let few = |count: usize, (share, least): (f64, usize)| {
            ((count as f64 * share) as usize).max(least).min(count)
        };
        match self {
            Self::Best | Self::Each => (edges, vertices),
            Self::EachFromFew => (few(edges, FEW_EDGES), few(vertices, FEW_VERTICES)),
        }
    }
}

/// Components finished from the most promising starts.
fn most_promising(
    targets: &[(Target, f64)],
    hulls: &[Simpler],
    wanted: Wanted,
) -> Vec<Result<Found, AssembleError>> {
    let is_each = wanted != Wanted::Best;
    let at_least = if is_each { targets.len() } else { 0 };
    let goals: Vec<Target> = targets.iter().zip(hulls).map(|(t, hull)| goal(&t.0, &hull.rough)).collect();
    let starts = || {
        let runs = goals.par_iter().enumerate();
        let runs =
            runs.flat_map_iter(|(k, goal)| starts(goal, wanted.first_counts(goal)).map(move |fit| (k, fit)));
        ranked(runs.collect(), targets, FIRST_STEPS, LEFT.max(at_least))
    };
    // A single start leaves other threads idle, and its hull is certain to be needed.
    let ahead = || if let [only] = hulls { Some(only.fine()) } else { None };
    let (runs, _) = rayon::join(starts, ahead);
    let with_fewer = |&(k, _): &(usize, Fit)| {
        let goal = &goals[k];
        fewer(goal).into_iter().map(move |counts| (k, start(goal, counts)))
    };
    let retried = if wanted == Wanted::EachFromFew { 0 } else { RETRIED };
    let fewer: Vec<(usize, Fit)> = runs.par_iter().take(retried).flat_map_iter(with_fewer).collect();
    let (mut runs, fewer) = rayon::join(
        || ranked(runs, targets, MORE_STEPS, LEFT_FULL.max(at_least)),
        || ranked(fewer, targets, FIRST_STEPS + MORE_STEPS, LEFT_FEWER),
    );
    runs.extend(fewer);
    let finished = if targets.len() == 1 { FINISHED_OF_ONE } else { FINISHED };
    let left = if is_each { runs.len() } else { finished };
    let mut runs = ranked(runs, targets, LAST_STEPS, left);
    if is_each {
        let mut is_taken = vec![false; targets.len()];
        runs.retain(|(k, _)| !std::mem::replace(&mut is_taken[*k], true));
    }
    let finished = runs.into_par_iter().map(|(k, fit)| {
        let (fitted, made) = finish(&targets[k].0, hulls[k].fine(), fit)?;
        let cost_mm = finished_cost(&fitted, &made, &targets[k]);
        Ok(Found { target: k, fitted, made, cost_mm })
    });
    finished.collect()
}

/// Continues fits, each with the index of its target, and keeps the best.
fn ranked<'h>(
    runs: Vec<(usize, Fit<'h>)>,
    targets: &[(Target, f64)],
    steps: usize,
    left: usize,
) -> Vec<(usize, Fit<'h>)> {
    let gone_on: Vec<(usize, Fit)> = runs.into_par_iter().map(|(k, fit)| (k, fit.run(steps))).collect();
    let mut ranked: Vec<(f64, (usize, Fit))> =
        gone_on.into_iter().map(|run| (cost(run.1.best()) + targets[run.0].1, run)).collect();
    // The sort is stable: equal ones stay in the order of their targets.
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.truncate(left);
    ranked.into_iter().map(|r| r.1).collect()
}

/// With planes all round the hull, and as a lens where it is flat.
fn starts<'h>(goal: &Target<'h>, counts: (usize, usize)) -> impl Iterator<Item = Fit<'h>> {
    let lens = lens(goal, counts.0).map(|solid| fit(goal, solid));
    std::iter::once(start(goal, counts)).chain(lens)
}

fn start<'h>(goal: &Target<'h>, (edges, vertices): (usize, usize)) -> Fit<'h> {
    fit(goal, circumscribe(&Target { profile_vertices: vertices, ..goal.clone() }, edges))
}

fn fit<'h>(goal: &Target<'h>, mut solid: Solid) -> Fit<'h> {
    let spots = fold_spots(&mut solid, goal);
    Fit::new(goal.clone(), Aim::REACH, solid, spots)
}
