//! How a model folds.

use super::cache::SweepCache;
use super::clashes::{Clash, ClashFinder};
use super::interleave::interleaved;
use super::order::{Search, outermost_first, replay};
use super::overlap::{Overlap, overlaps};
use super::pose::{ModelMotion, root_of};
use super::pull;
use super::sequence::{Motion, Sequence};
use super::stack::{Stack, stacks};
use super::step::{Move, Pull, Step};
use super::sweep::Care;
use crate::model::{Alike, Bump, Enough, Model, PartId};
use crate::progress::{Cancelled, Progress};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// How a model folds: steps that take every component from deployed to flat.
#[derive(Debug, Clone, PartialEq)]
pub struct FoldPlan {
    thickness_mm: f64,
    pulls: Vec<Pull>,
    steps: Vec<Step>,
    order: Vec<PartId>,
    clashes: Vec<Clash>,
    overlaps: Vec<Overlap>,
    stacks: Vec<Stack>,
}

/// How bumps are found: by discrete or continuous collision detection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detection {
    /// In samples of the motion, as a person would step through them: a corner that passes between two may slip through.
    Discrete,
    /// All along the motion: nothing deeper than half the paper's thickness slips through.
    Continuous,
}

/// How far the search goes.
#[derive(Clone, Copy)]
enum Effort<'a> {
    /// A good order, one component after another; none where the bumps that no order avoids are enough.
    Order(Detection, &'a Enough<'a>),
    /// Steps of several components in turn, where no order is free; and the flat stacks.
    Whole,
}

impl FoldPlan {
    /// The order of folding before anything is checked: children before those that carry them.
    pub fn unchecked(model: &Model, thickness_mm: f64) -> Self {
        let mut order: Vec<PartId> = model.ids().collect();
        outermost_first(model, &mut order);
        let steps = order.iter().map(|&part| Step::whole(part)).collect();
        let (pulls, clashes, overlaps, stacks) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { thickness_mm, pulls, steps, order, clashes, overlaps, stacks }
    }

    /// Looks for a plan for a model of paper of a thickness.
    ///
    /// # Errors
    /// [`Cancelled`] at the user's wish.
    pub fn new(
        motion: &ModelMotion<'_>,
        thickness_mm: f64,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let alike = Alike::unknown(motion.model().parts().len());
        Self::with_cache(motion, thickness_mm, &alike, &SweepCache::default(), progress)
    }

    /// The same with a cache of what was found out about other models, and about twins.
    ///
    /// # Errors
    /// [`Cancelled`] at the user's wish.
    pub fn with_cache(
        motion: &ModelMotion<'_>,
        thickness_mm: f64,
        alike: &Alike,
        cache: &SweepCache,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        Self::searched(motion, thickness_mm, alike, cache, progress, Effort::Whole)
    }

    /// A plan for the comparison of many models: a good order, without steps of several components in turn, and without
    /// stacks. Where the bumps that no order avoids are enough, no order is looked for. The cache as for [`FoldPlan::with_cache`].
    /// The panels of a clash may be those of its mirror image.
    ///
    /// # Errors
    /// [`Cancelled`] at the user's wish.
    pub fn quick(
        motion: &ModelMotion<'_>,
        thickness_mm: f64,
        alike: &Alike,
        cache: &SweepCache,
        (detection, is_enough): (Detection, &Enough<'_>),
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        Self::searched(motion, thickness_mm, alike, cache, progress, Effort::Order(detection, is_enough))
    }

    /// A plan in which some components are unplugged, outer ones after those that carry them, fold
    /// beside the rest, and are plugged in again in the same order. None where something is in their
    /// way out or back. Ids and cache as for [`FoldPlan::with_cache`].
    ///
    /// # Errors
    /// [`Cancelled`] at the user's wish.
    pub fn unplugged(
        motion: &ModelMotion<'_>,
        parts: &[PartId],
        thickness_mm: f64,
        ids: &[u64],
        cache: &SweepCache,
        progress: &dyn Progress,
    ) -> Result<Option<Self>, Cancelled> {
        let apart = motion.model().clone().taken_apart(parts);
        let beside = ModelMotion::new(&apart);
        let alike = Alike { ids: ids.to_vec(), twins: None };
        let mut plan = Self::with_cache(&beside, thickness_mm, &alike, cache, progress)?;
        // What was pulled off is folded first.
        let group = |part: PartId| parts.iter().position(|&p| p == root_of(&apart, part));
        let rank = |part: PartId| group(part).map_or(0, |at| at as isize - parts.len() as isize);
        plan.steps.sort_by_key(|step| rank(step.part));
        plan.order.sort_by_key(|&part| rank(part));
        plan.pulls = pull::pulls(motion, parts, &plan.steps);
        plan.overlaps = overlaps(motion, thickness_mm / 2.0, &alike, cache);
        let is_free = pull::are_free(motion, &plan.pulls, thickness_mm, &plan.overlaps);
        plan.stacks = stacks(motion, thickness_mm);
        Ok(is_free.then_some(plan))
    }

    fn searched(
        motion: &ModelMotion<'_>,
        thickness_mm: f64,
        alike: &Alike,
        cache: &SweepCache,
        progress: &dyn Progress,
        effort: Effort<'_>,
    ) -> Result<Self, Cancelled> {
        let overlaps = overlaps(motion, thickness_mm / 2.0, alike, cache);
        let is_whole = matches!(effort, Effort::Whole);
        let is_enough = |bumps: &[Bump]| matches!(effort, Effort::Order(_, is_enough) if is_enough(bumps));
        if is_enough(&bumps(&[], &overlaps, thickness_mm)) {
            return Ok(Self { overlaps, ..Self::unchecked(motion.model(), thickness_mm) });
        }
        let parts = motion.model().parts().len();
        let care = match effort {
            Effort::Order(Detection::Discrete, _) => Care::rough(thickness_mm),
            Effort::Order(Detection::Continuous, _) | Effort::Whole => Care::exact(thickness_mm),
        };
        let mut finder = ClashFinder::new(motion, care, &overlaps, alike, cache);
        let mut moves = Vec::new();
        for root in motion.model().ids().filter(|&p| root_of(motion.model(), p) == p) {
            let order = Search::new(motion, &mut finder, thickness_mm, is_whole, progress).tree(root)?;
            let mut tree: Vec<Move> = order.into_iter().map(Move::whole).collect();
            if is_whole {
                tree = interleaved(&mut finder, tree, parts, thickness_mm, progress)?;
            }
            moves.extend(tree);
        }
        // What is reported names the panels that meet, not those of their images.
        let alone;
        if is_whole && alike.twins.is_some() {
            alone = Alike { twins: None, ..alike.clone() };
            finder = ClashFinder::new(motion, care, &overlaps, &alone, cache);
        }
        let own: Vec<Option<Clash>> =
            (0..parts).into_par_iter().map(|p| finder.own_clash(PartId(p))).collect();
        progress.check()?;
        let mut clashes: Vec<Clash> = own.into_iter().flatten().collect();
        clashes.extend(replay(&mut finder, &moves, parts));
        let steps: Vec<Step> = moves.iter().map(Move::step).collect();
        let order = steps.iter().filter(|step| step.ends_flat()).map(|step| step.part).collect();
        let stacks = if is_whole { stacks(motion, thickness_mm) } else { Vec::new() };
        Ok(Self { thickness_mm, pulls: Vec::new(), steps, order, clashes, overlaps, stacks })
    }

    /// Thickness of the paper, mm.
    pub fn thickness_mm(&self) -> f64 {
        self.thickness_mm
    }

    /// What is unplugged before the first step, in this order, and plugged in again after the last
    /// one in the same order.
    pub fn pulls(&self) -> &[Pull] {
        &self.pulls
    }

    /// All that moves, one after another: what is unplugged, the steps, and what is plugged in again.
    pub fn motions(&self) -> Vec<Motion> {
        let folds = self.steps.iter().map(|&step| Motion::Fold(step));
        let off = self.pulls.iter().map(|&pull| Motion::Unplug(pull));
        let on = self.pulls.iter().map(|&pull| Motion::Plug(pull));
        off.chain(folds).chain(on).collect()
    }

    /// How components fold, one after another; deploying is the reverse.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// All components, in the order in which they become flat.
    pub fn order(&self) -> &[PartId] {
        &self.order
    }

    /// Whether every component folds in one step.
    pub fn is_order(&self) -> bool {
        self.steps.len() == self.order.len()
    }

    /// What bumps into what in these steps.
    pub fn clashes(&self) -> &[Clash] {
        &self.clashes
    }

    /// Components that overlap before anything folds.
    pub fn overlaps(&self) -> &[Overlap] {
        &self.overlaps
    }

    /// The flat model: one stack for each group of joined components.
    pub fn stacks(&self) -> &[Stack] {
        &self.stacks
    }

    /// Pairs that overlap by more than the paper's thickness, unfolded or while they fold, and by how much
    /// more, mm. The two ids are equal for chains of one component.
    pub fn bumps(&self) -> Vec<Bump> {
        bumps(&self.clashes, &self.overlaps, self.thickness_mm)
    }

    /// Pairs of components that bump by more than the paper is thick while they fold.
    pub fn bumping_pairs(&self) -> impl Iterator<Item = [PartId; 2]> + '_ {
        let is_bump = |clash: &&Clash| clash.parts[0] != clash.parts[1] && clash.depth_mm > self.thickness_mm;
        self.clashes.iter().filter(is_bump).map(|clash| clash.parts)
    }

    /// Whether there are none of these.
    pub fn is_free(&self) -> bool {
        self.bumping_pairs().next().is_none()
    }

    /// Sum of [`FoldPlan::bumps`], mm.
    pub fn harm_mm(&self) -> f64 {
        self.bumps().iter().fold(0.0, |sum, (_, excess_mm)| sum + excess_mm)
    }
}

/// Pairs that are deeper in each other than paper is thick, and by how much more, mm.
fn bumps(clashes: &[Clash], overlaps: &[Overlap], thickness_mm: f64) -> Vec<Bump> {
    let mut bumps: BTreeMap<[PartId; 2], f64> = BTreeMap::new();
    let clashes = clashes.iter().map(|clash| (clash.parts, clash.depth_mm));
    for (parts, depth_mm) in clashes.chain(overlaps.iter().map(|o| (o.parts, o.depth_mm))) {
        let excess_mm = depth_mm - thickness_mm;
        if excess_mm > 0.0 {
            let worst_mm = bumps.entry(parts).or_insert(0.0);
            *worst_mm = worst_mm.max(excess_mm);
        }
    }
    bumps.into_iter().collect()
}

impl Sequence {
    /// A plan: its steps, and before and after them what is unplugged meanwhile.
    pub fn of_plan(plan: &FoldPlan) -> Self {
        Self::of_motions(plan.motions())
    }
}
