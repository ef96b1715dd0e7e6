//! The search for the best component: several starts, of which the promising ones are gone on with;
//! simpler shapes where the limits leave no room.

use super::assemble::{Assembled, assemble};
use super::assemble_error::AssembleError;
use super::convert_error::ConvertError;
use super::fit::{Aim, Fit, Fitted};
use super::grow::grown;
use super::profile::{balance, imbalance};
use super::seated::support;
use super::solid::Solid;
use super::start::{boxed, circumscribe, fold_spots, lens, simplify, without_chain, without_plane};
use super::straight::Straight;
use super::symmetry::Symmetry;
use super::target::{FoldSpot, Target};
use crate::geom::{self, Hull, HullError, polygon};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::OnceLock;

/// Hulls with more corners are fitted through their extreme points in this many directions.
const FIT_DIRECTIONS: usize = 320;
/// The same while directions are compared.
const ROUGH_DIRECTIONS: usize = 140;
/// Joints that carry this share are well supported.
const GOOD_SUPPORT: f64 = 0.85;
/// In the choice between finished shapes, what a joint lacks of that costs this share of the hull's
/// height. With 0.2, and a higher price on such joints in another fit, it outweighs likeness: silhouettes
/// of the cat 0.870 against 0.886; not bounded from below by a case yet.
const SUPPORT_PRICE: f64 = 0.02;
/// Fit steps of each direction before the first ranking, and directions kept.
const FIRST_STEPS: usize = 4;
const LEFT: usize = 6;
/// Kept directions that also start with fewer top edges, or with this share of the profile vertices:
/// that may lead to a better place, and the rest is added where it is worth most.
const RETRIED: usize = 1;
const FEWER_EDGES: [usize; 2] = [1, 2];
const FEWER_VERTICES: f64 = 0.6;
/// Where a panel must add less than this to the likeness, every direction starts a second time with few panels, to which
/// those are added that are worth most: models of the level `fine` have 20 panels less and outlines more alike by 0.002
/// (16 meshes), in 1.5 to 1.9 times the time. With the worth of the level `normal` there are fewer panels as well, but outlines of
/// 38 meshes are less alike by 0.001, in 1.7 times the time.
const CHEAP_PANELS: f64 = 0.001;
/// Shares of top edges and profile vertices that it starts with, and the least counts. With 0.7 and 0.6 outlines are less
/// alike by 0.002, with 0.4 and 0.4 by 0.001.
const FEW_EDGES: (f64, usize) = (0.6, 4);
const FEW_VERTICES: (f64, usize) = (0.5, 3);
/// Fit steps before the second ranking. Candidates kept with the full edge count, and with fewer edges.
const MORE_STEPS: usize = 6;
const LEFT_FULL: usize = 5;
const LEFT_FEWER: usize = 2;
/// Fit steps before the last ranking, and candidates finished.
const LAST_STEPS: usize = 6;
const FINISHED: usize = 3;
/// Candidates finished for a direction that the user turns by hand: the answer must come at once.
const FINISHED_OF_ONE: usize = 2;
/// A plane is added at one of so many corners that stand out most. With 1 the hull of a bunny has outlines alike by
/// 0.954, with 4 by 0.973; with 8 it takes half as long again for nothing.
const CORNERS: usize = 4;
/// Fit steps after each added plane.
const GROWN_STEPS: usize = 8;
/// A plane is given up if the cost is then this many times the cost without it.
const HOPELESS: f64 = 1.1;
/// Most steps of a fit.
const STEPS: usize = 24;
/// Most panels that are dropped for want of room.
const REPAIRS: usize = 40;
/// Steps after a panel was dropped.
const REPAIR_STEPS: usize = 8;
/// A shape that misses a limit by less is as good as one that keeps it.
const NEAR_ENOUGH_MM: f64 = 1e-3;
/// Steps after one was left out.
const PRUNE_STEPS: usize = 8;
/// Finished shapes that are searched for needless panels. The others are hardly ever taken, and panels
/// count in the comparison.
const PRUNED: usize = 2;
/// Price of a mm of spread when flat, against a mm of error: directions that fold smaller win
/// where the error is alike (Figure 8).
const SPREAD_PRICE: f64 = 0.03;
/// Price of an opening in a finished shape, against a mm of error, for each mm that a square of its
/// area measures.
const TRIM_PRICE: f64 = 0.5;
/// Openings of more than this look like holes. Each mm² above it costs this many mm, so that any other shape
/// is better, even one that bumps: with 0.5 a slice of pizza folds freely with a hole of 296 mm², with 5 a human with one of
/// 17 mm². Not bounded from above by a case yet.
const MOST_TRIMMED_MM2: f64 = 10.0;
/// So do smaller ones in small shapes, of more than this share of the surface: without it, a leg of an animal has one
/// of 0.3 %.
const MOST_TRIMMED: f64 = 0.002;
const OVER_PRICE: f64 = 10.0;
/// A shape that is closed by leaving out panels may be so many times as unlike. Not bounded by a case yet.
const CLOSED_AT_MOST: f64 = 1.5;
/// Price of a mm that a shape lacks to be valid, while directions are compared.
const LACK_PRICE: f64 = 2.0;

/// A finished component.
pub(super) struct Found {
    /// Index of its target.
    pub(super) target: usize,
    pub(super) fitted: Fitted,
    pub(super) made: Assembled,
    /// What finished shapes are compared by, mm.
    cost_mm: f64,
}

/// Fits start with no more top edges and profile vertices than this, and add the others where they are
/// worth most: the search is more reliable with few. If the user asks for the most that is possible, the
/// search also starts with all, so that more edges and vertices never make the error larger.
const SURE: usize = 6;

/// What leaves out a plane or a chain; `None` where none can be spared.
type Spare = fn(&Fitted, &Target) -> Option<(Solid, Vec<FoldSpot>)>;

impl Found {
    /// What it is compared by, mm.
    pub(super) fn cost_mm(&self) -> f64 {
        self.cost_mm
    }

    /// With a plane or a chain less, where that leaves a valid shape.
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
    fn or_box(self, targets: &[(Target, f64)]) -> Self {
        let target = self.target;
        match as_box(&targets[target].0) {
            Some((fitted, made)) if fitted.unlike_mm < self.fitted.unlike_mm => {
                Found { target, cost_mm: finished_cost(&fitted, &made, &targets[target]), fitted, made }
            }
            _ => self,
        }
    }
}

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

/// Targets whose mirror planes, if any, go through the origin, and where they come from. Those whose
/// joints have no images are left out.
struct Straightened<'t> {
    own: &'t [(Target<'t>, f64)],
    kept: Vec<(usize, Option<Straight>)>,
}

impl<'t> Straightened<'t> {
    fn of(own: &'t [(Target<'t>, f64)]) -> Result<Self, ConvertError> {
        let kept = own.iter().enumerate().filter_map(|(k, (target, _))| match target.symmetry {
            None => Some((k, None)),
            Some(symmetry) => Some((k, Some(Straight::of(target, symmetry)?))),
        });
        let kept: Vec<_> = kept.collect();
        if kept.is_empty() && !own.is_empty() {
            return Err(ConvertError::Lopsided);
        }
        Ok(Self { own, kept })
    }

    fn targets(&self) -> Vec<(Target<'_>, f64)> {
        let kept = self.kept.iter().map(|(k, straight)| {
            let (own, cost_mm) = &self.own[*k];
            (straight.as_ref().map_or_else(|| own.clone(), |straight| straight.target(own)), *cost_mm)
        });
        kept.collect()
    }

    /// What was found, in the axes of its own target.
    fn back(&self, found: Found) -> Result<Found, ConvertError> {
        let (target, straight) = &self.kept[found.target];
        let Some(straight) = straight else { return Ok(Found { target: *target, ..found }) };
        let own = &self.own[*target].0;
        let solid = straight.back(found.fitted.shape.solid, own);
        let fitted = Fit::new(own.clone(), Aim::LIKENESS, solid, found.fitted.spots).into_best();
        let made = assemble_unbroken(&fitted, own.symmetry)?;
        Ok(Found { target: *target, fitted, made, cost_mm: found.cost_mm })
    }
}

/// The targets with no more top edges and profile vertices than the search is sure among; `None` where
/// it starts with no more than that anyway.
fn with_sure_counts<'h>(targets: &[(Target<'h>, f64)]) -> Option<Vec<(Target<'h>, f64)>> {
    let sure = |(target, cost_mm): &(Target<'h>, f64)| {
        let top_edges = target.top_edges.min(SURE);
        let profile_vertices = target.profile_vertices.min(SURE);
        (Target { top_edges, profile_vertices, ..target.clone() }, *cost_mm)
    };
    let starts_with_more = |target: &Target| {
        let (edges, vertices) = first_counts(target);
        edges.max(vertices) > SURE
    };
    targets.iter().any(|t| starts_with_more(&t.0)).then(|| targets.iter().map(sure).collect())
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

/// The same with the planes and chains left out that add little to the likeness, one by one.
fn pruned(mut found: Found, targets: &[(Target, f64)], hulls: &[Simpler]) -> Found {
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

/// The same without those planes and chains for which panels are trimmed so much that it looks like a hole; as it is
/// where it would be far less alike.
fn closed(found: Found, targets: &[(Target, f64)], hulls: &[Simpler]) -> Found {
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

/// What a panel less may cost, mm.
fn panel_worth_mm(target: &Target) -> f64 {
    target.panel_worth * libm::cbrt(target.hull.volume())
}

/// What finished shapes are compared by: the error first, then good joints, a small spread, and small
/// openings where slits were widened so that the flat layers do not overlap.
fn finished_cost(fitted: &Fitted, made: &Assembled, (target, own_mm): &(Target, f64)) -> f64 {
    fitted.unlike_mm
        + LACK_PRICE * fitted.lack_mm
        + SPREAD_PRICE * spread_mm(fitted)
        + SUPPORT_PRICE * height_mm(target.hull) * short_of_support(fitted, target)
        + own_mm
        + opening_cost(made)
}

/// What the openings of a finished shape cost, mm.
fn opening_cost(made: &Assembled) -> f64 {
    TRIM_PRICE * made.trimmed_mm2.sqrt() + OVER_PRICE * over_mm2(made)
}

/// By how much the openings of a finished shape are larger than what is hardly seen, mm².
fn over_mm2(made: &Assembled) -> f64 {
    let surface_mm2: f64 = made.panels.panels().iter().map(|p| polygon::area(&p.outline).abs()).sum();
    (made.trimmed_mm2 - MOST_TRIMMED_MM2.min(MOST_TRIMMED * surface_mm2)).max(0.0)
}

/// Goes on with fits, each with the index of its target, and keeps the best.
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

/// The box round the hull, for bodies that nothing else comes as close to; `None` where it has no
/// room either, or joints at its sides.
fn as_box(target: &Target) -> Option<(Fitted, Assembled)> {
    let mut solid = boxed(target)?;
    let spots = fold_spots(&mut solid, target);
    let fitted = Fit::new(target.clone(), Aim::LIKENESS, solid, spots).into_best();
    let made = assemble_unbroken(&fitted, target.symmetry).ok()?;
    (fitted.lack_mm < NEAR_ENOUGH_MM).then_some((fitted, made))
}

/// What directions are compared by, while they are fitted.
fn cost(fitted: &Fitted) -> f64 {
    fitted.unlike_mm + LACK_PRICE * fitted.lack_mm + fitted.miss_mm + SPREAD_PRICE * spread_mm(fitted)
}

/// How far the longest chain reaches from the axis when flat.
fn spread_mm(fitted: &Fitted) -> f64 {
    let reach = fitted.shape.chains.iter().map(|chain| {
        let profile = &chain.profile;
        let at = balance(profile);
        profile[0].x + profile.windows(2).take(at.segment).map(|w| w[0].distance(w[1])).sum::<f64>()
    });
    reach.fold(0.0, f64::max)
}

/// What all joints together lack of being well supported.
fn short_of_support(fitted: &Fitted, target: &Target) -> f64 {
    let supports = target.joints.iter().map(|joint| support(&fitted.shape, target, joint));
    supports.map(|s| (GOOD_SUPPORT - s).max(0.0)).sum()
}

/// Height of a hull along the fold axis.
fn height_mm(hull: &Hull) -> f64 {
    hull.support(DVec3::Z) + hull.support(-DVec3::Z)
}

/// The target for a simplified hull, with no more panels than can be handled comfortably at the
/// hull's size.
fn goal<'h>(target: &Target<'h>, hull: &'h Hull) -> Target<'h> {
    let (girth, height) = girth_and_height(hull);
    let at_most = |length: f64| (length / target.comfortable_mm.max(1e-9)) as usize;
    let least_edges = target.symmetry.map_or(3, Symmetry::least_edges);
    Target {
        hull,
        filling: target.filling,
        joints: target.joints.clone(),
        borders: target.borders.clone(),
        symmetry: target.symmetry,
        top_edges: target
            .top_edges
            .min(at_most(0.5 * girth))
            .max(target.locked_angles().len().max(least_edges)),
        profile_vertices: target.profile_vertices.min(1 + at_most(0.7 * height)).max(3),
        min_panel_mm: target.comfortable_mm,
        panel_worth: target.panel_worth,
        comfortable_mm: target.comfortable_mm,
    }
}

/// Top edges and profile vertices to start with: all, where none is to be left out.
fn first_counts(goal: &Target) -> (usize, usize) {
    let most = if goal.panel_worth == 0.0 { usize::MAX } else { SURE };
    (goal.top_edges.min(most), goal.profile_vertices.min(most))
}

/// The same, but fewer.
fn fewer(goal: &Target) -> Vec<(usize, usize)> {
    let (edges, vertices) = first_counts(goal);
    let least = goal.locked_angles().len().max(3);
    let fewer_edges = FEWER_EDGES.into_iter().filter(|less| edges >= least + less);
    let fewer_vertices = (vertices as f64 * FEWER_VERTICES).ceil() as usize;
    let other = (3..vertices).contains(&fewer_vertices).then_some((edges, fewer_vertices));
    fewer_edges.map(|less| (edges - less, vertices)).chain(other).collect()
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

/// Fits to the end, and adds planes where there may be more. `hull` is the target's, simplified.
fn finish<'h>(
    target: &Target<'h>,
    hull: &'h Hull,
    fit: Fit<'h>,
) -> Result<(Fitted, Assembled), AssembleError> {
    let goal = Target { hull, ..fit.target().clone() };
    let Fitted { shape, spots, .. } = fit.into_best();
    let mut best = settle(target, Fit::new(goal.clone(), Aim::LIKENESS, shape.solid, spots))?;
    let mut rank = 0;
    while rank < CORNERS {
        let more = grown(&best.0, &goal, rank);
        rank += 1;
        let Some((solid, spots)) = more else { continue };
        let next = Fit::new(goal.clone(), Aim::LIKENESS, solid, spots).run(GROWN_STEPS);
        if cost(next.best()) > HOPELESS * cost(&best.0) {
            continue;
        }
        if let Ok(next) = settle(target, next)
            && cost(&next.0) + opening_cost(&next.1) < cost(&best.0) + opening_cost(&best.1)
        {
            (best, rank) = (next, 0);
        }
    }
    Ok(best)
}

/// Fits to the end; drops panels that have no room, one by one; at last accepts smaller ones.
fn settle(target: &Target, fit: Fit) -> Result<(Fitted, Assembled), AssembleError> {
    let mut fit = fit.run(STEPS);
    let mut is_least = false;
    let mut best: Option<(f64, Fitted, Assembled)> = None;
    let mut failure = AssembleError::NoRoom;
    for _ in 0..REPAIRS {
        let is_valid = fit.best().lack_mm < NEAR_ENOUGH_MM;
        match assemble_unbroken(fit.best(), fit.target().symmetry) {
            Ok(made) => {
                let merit = fit.best().unlike_mm + 10.0 * fit.best().lack_mm;
                if best.as_ref().is_none_or(|b| merit < b.0) {
                    best = Some((merit, fit.best().clone(), made));
                }
                if is_valid {
                    break;
                }
            }
            Err(error) => failure = error,
        }
        fit = match simplify(fit.best(), fit.target()) {
            Some((solid, spots)) => {
                Fit::new(fit.target().clone(), Aim::LIKENESS, solid, spots).run(REPAIR_STEPS)
            }
            None if !is_least => {
                is_least = true;
                let goal = Target { min_panel_mm: target.min_panel_mm, ..fit.target().clone() };
                let Fitted { shape, spots, .. } = fit.into_best();
                Fit::new(goal, Aim::LIKENESS, shape.solid, spots).run(STEPS)
            }
            None => break,
        };
    }
    best.map(|b| (b.1, b.2)).ok_or(failure)
}

/// Length round the hull, seen along the fold axis, and the height along it.
fn girth_and_height(hull: &Hull) -> (f64, f64) {
    let flat: Vec<glam::DVec2> = hull.vertices().iter().map(|v| v.truncate()).collect();
    let outline = polygon::convex_hull(&flat);
    let girth = polygon::edges(&outline).map(|(a, b)| a.distance(b)).sum();
    (girth, height_mm(hull))
}

/// Imbalance up to which a fold vertex at a bend is exact, as a share of the height.
const EXACT: f64 = 1e-11;

/// Panels narrower or lower than this are none.
const SLIVER_MM: f64 = 0.1;

/// Panels of a fitted solid, folded at the balance points, whose joint panels are uncreased.
fn assemble_unbroken(fitted: &Fitted, symmetry: Option<Symmetry>) -> Result<Assembled, AssembleError> {
    let solid = &fitted.shape.solid;
    let size = solid.top_mm - solid.bottom_mm;
    let clearance = solid.clearance();
    if clearance.width_mm.min(clearance.length_mm) <= SLIVER_MM {
        return Err(AssembleError::NoRoom);
    }
    let spots = solid.chain_ids().zip(&fitted.spots).map(|(chain, &spot)| {
        let profile = solid.profile(chain);
        let at = balance(&profile);
        match spot {
            FoldSpot::Bend(i) if imbalance(&profile, i + 1).abs() <= EXACT * size => Ok(spot),
            FoldSpot::Bend(_) => Err(AssembleError::OutOfBalance(chain)),
            _ if solid.chains[chain.0].facets[at.segment].is_joint => Err(AssembleError::CreasedJoint(chain)),
            _ => Ok(FoldSpot::Inside(at.segment)),
        }
    });
    let spots = spots.collect::<Result<Vec<_>, _>>()?;
    assemble(solid, &spots, symmetry)
}

/// A hull with few corners, and one with more that is made when it is needed.
struct Simpler<'h> {
    hull: &'h Hull,
    symmetry: Option<Symmetry>,
    rough: Hull,
    fine: OnceLock<Hull>,
}

impl<'h> Simpler<'h> {
    fn of(target: &Target<'h>) -> Self {
        let (hull, symmetry) = (target.hull, target.symmetry);
        Self { hull, symmetry, rough: simplified(hull, symmetry, ROUGH_DIRECTIONS), fine: OnceLock::new() }
    }

    fn fine(&self) -> &Hull {
        self.fine.get_or_init(|| simplified(self.hull, self.symmetry, FIT_DIRECTIONS))
    }
}

/// Hull of the extreme points in evenly spread directions, and their images in straight planes.
fn simplified(hull: &Hull, symmetry: Option<Symmetry>, directions: usize) -> Hull {
    if hull.vertices().len() <= directions {
        return hull.clone();
    }
    let across: &[DVec3] = match symmetry {
        None => &[],
        Some(Symmetry::Level { .. }) => &[DVec3::Z],
        Some(Symmetry::Upright { crossing_mm: None, .. }) => &[DVec3::Y],
        Some(Symmetry::Upright { .. }) => &[DVec3::Y, DVec3::X],
    };
    let one_side = geom::directions(directions).filter(|d| across.iter().all(|n| n.dot(*d) >= 0.0));
    let mut points: Vec<DVec3> = one_side.map(|d| hull.farthest(d)).collect();
    for &n in across {
        points.extend(points.clone().into_iter().map(|p| p - n * (2.0 * n.dot(p))));
    }
    Hull::of_points(&points).unwrap_or_else(|_| hull.clone())
}
