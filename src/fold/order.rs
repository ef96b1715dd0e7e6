//! The order in which components fold, one at a time: outer ones first where that works, else any
//! order in which nothing bumps into anything, found by a search that turns back at dead ends.

use super::check::{Checker, Clash, Overlap, overlaps};
use super::pose::{ModelMotion, ancestors, root_of};
use super::stack::{Stack, stacks};
use crate::model::Model;
use crate::progress::{Cancelled, Progress};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// The search gives up after so many motions were worked out for each component of a model.
const SWEEPS_FOR_EACH: usize = 1;
/// And after so many states of the model.
const MOST_STATES: usize = 20_000;
/// Where no order is free of clashes, components are compared at every step until so many motions
/// were worked out for each, and at least this number in all; the rest follows as listed.
const COMPARED_FOR_EACH: usize = 3;
const COMPARED: usize = 150;
/// An order is changed for another one that does less harm by more than this.
const LEAST_GAIN_MM: f64 = 0.01;

/// How a model folds.
#[derive(Debug, Clone, PartialEq)]
pub struct FoldPlan {
    thickness_mm: f64,
    order: Vec<usize>,
    clashes: Vec<Clash>,
    overlaps: Vec<Overlap>,
    stacks: Vec<Stack>,
}

impl FoldPlan {
    /// The order of folding before anything is checked: children before those that carry them.
    pub fn unchecked(model: &Model, thickness_mm: f64) -> Self {
        let mut order: Vec<usize> = (0..model.parts().len()).collect();
        outermost_first(model, &mut order);
        Self { thickness_mm, order, clashes: Vec::new(), overlaps: Vec::new(), stacks: Vec::new() }
    }

    /// Looks for an order for a model of paper of a thickness.
    ///
    /// # Errors
    /// [`Cancelled`] at the user's wish.
    pub fn new(
        motion: &ModelMotion<'_>,
        thickness_mm: f64,
        progress: &dyn Progress,
    ) -> Result<Self, Cancelled> {
        let overlaps = overlaps(motion, thickness_mm / 2.0);
        let parts = motion.model().parts().len();
        let checker = Checker::new(motion, thickness_mm, &overlaps);
        let own: Vec<Option<Clash>> = (0..parts).into_par_iter().map(|p| checker.own_clash(p)).collect();
        let mut clashes: Vec<Clash> = own.into_iter().flatten().collect();
        progress.check()?;
        let mut search = Search { motion, checker, progress, dead_ends: BTreeSet::new(), most_sweeps: 0 };
        let mut order = Vec::new();
        for root in (0..parts).filter(|&p| root_of(motion.model(), p) == p) {
            let (found, left) = search.tree(root)?;
            order.extend(found);
            clashes.extend(left);
        }
        Ok(Self { thickness_mm, order, clashes, overlaps, stacks: stacks(motion, thickness_mm) })
    }

    /// Thickness of the paper, mm.
    pub fn thickness_mm(&self) -> f64 {
        self.thickness_mm
    }

    /// All components, in the order in which they fold; deploying is the reverse.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// What bumps into what in that order.
    pub fn clashes(&self) -> &[Clash] {
        &self.clashes
    }

    /// What stands in each other before anything folds.
    pub fn overlaps(&self) -> &[Overlap] {
        &self.overlaps
    }

    /// The flat model: one stack for each group of joined components.
    pub fn stacks(&self) -> &[Stack] {
        &self.stacks
    }
}

/// Sorts components, which come in the order of their numbers, so that children come before those that
/// carry them.
fn outermost_first(model: &Model, parts: &mut [usize]) {
    parts.sort_by_key(|&part| std::cmp::Reverse(ancestors(model, part).len()));
}

struct Search<'a> {
    motion: &'a ModelMotion<'a>,
    checker: Checker<'a>,
    progress: &'a dyn Progress,
    dead_ends: BTreeSet<Vec<bool>>,
    most_sweeps: usize,
}

impl Search<'_> {
    /// An order for the tree of a root, and the clashes in it.
    fn tree(&mut self, root: usize) -> Result<(Vec<usize>, Vec<Clash>), Cancelled> {
        let model = self.motion.model();
        let mut parts: Vec<usize> = (0..model.parts().len()).filter(|&p| root_of(model, p) == root).collect();
        outermost_first(model, &mut parts);
        self.look_ahead(&parts)?;
        self.most_sweeps = self.checker.sweeps() + SWEEPS_FOR_EACH * parts.len();
        let (mut order, mut is_flat) = (Vec::new(), vec![false; model.parts().len()]);
        if !self.extend(&parts, &mut order, &mut is_flat)? {
            order = self.fallback(&parts)?;
        }
        let clashes = self.replay(&order);
        Ok((order, clashes))
    }

    /// All clashes in an order.
    fn replay(&mut self, order: &[usize]) -> Vec<Clash> {
        let mut is_flat = vec![false; self.motion.model().parts().len()];
        let mut clashes = Vec::new();
        for &part in order {
            clashes.extend(self.checker.all_clashes(part, &is_flat));
            is_flat[part] = true;
        }
        clashes
    }

    /// An order that does little harm where all do some.
    fn fallback(&mut self, parts: &[usize]) -> Result<Vec<usize>, Cancelled> {
        let greedy = self.least_bad(parts)?;
        let (as_listed_mm, greedy_mm) = (self.harm_mm(parts), self.harm_mm(&greedy));
        self.improved(if as_listed_mm <= greedy_mm { parts.to_vec() } else { greedy })
    }

    fn harm_mm(&mut self, order: &[usize]) -> f64 {
        self.replay(order).iter().map(|clash| clash.depth_mm).sum()
    }

    /// Moves single components of an order to other places while that does less harm.
    fn improved(&mut self, mut order: Vec<usize>) -> Result<Vec<usize>, Cancelled> {
        let most_sweeps = self.checker.sweeps() + SWEEPS_FOR_EACH * order.len();
        let mut harm_mm = self.harm_mm(&order);
        'better: loop {
            let movers: BTreeSet<usize> = self.replay(&order).iter().map(|clash| clash.mover).collect();
            for mover in movers {
                for place in 0..order.len() {
                    self.progress.check()?;
                    if self.checker.sweeps() > most_sweeps {
                        return Ok(order);
                    }
                    let mut other = order.clone();
                    other.retain(|&part| part != mover);
                    other.insert(place, mover);
                    let other_mm = self.harm_mm(&other);
                    if other_mm < harm_mm - LEAST_GAIN_MM {
                        (order, harm_mm) = (other, other_mm);
                        continue 'better;
                    }
                }
            }
            return Ok(order);
        }
    }

    /// Answers, in parallel, what the order "as listed" asks, and accepts what no order avoids.
    fn look_ahead(&mut self, parts: &[usize]) -> Result<(), Cancelled> {
        let (checker, progress) = (&self.checker, self.progress);
        let count = self.motion.model().parts().len();
        let answers: Vec<_> = (0..parts.len())
            .into_par_iter()
            .map(|k| {
                progress.check()?;
                let mut is_flat = vec![false; count];
                parts[..k].iter().for_each(|&p| is_flat[p] = true);
                Ok(checker.answers(parts[k], &is_flat))
            })
            .collect::<Result<_, Cancelled>>()?;
        answers.into_iter().for_each(|a| self.checker.learn(a));
        let mut is_flat = vec![false; count];
        for &part in parts {
            for clash in self.checker.all_clashes(part, &is_flat) {
                progress.check()?;
                self.checker.accept_if_unavoidable(&clash, &is_flat);
            }
            is_flat[part] = true;
        }
        Ok(())
    }

    /// Folds what is left, depth first; false where there is no way.
    fn extend(
        &mut self,
        parts: &[usize],
        order: &mut Vec<usize>,
        is_flat: &mut [bool],
    ) -> Result<bool, Cancelled> {
        if order.len() == parts.len() {
            return Ok(true);
        }
        if self.dead_ends.contains(is_flat as &[bool]) || self.dead_ends.len() > MOST_STATES {
            return Ok(false);
        }
        for &part in parts {
            if is_flat[part] || self.checker.sweeps() > self.most_sweeps {
                continue;
            }
            self.progress.check()?;
            if !self.checker.clashes(part, is_flat).is_empty() {
                continue;
            }
            order.push(part);
            is_flat[part] = true;
            if self.extend(parts, order, is_flat)? {
                return Ok(true);
            }
            order.pop();
            is_flat[part] = false;
        }
        self.dead_ends.insert(is_flat.to_vec());
        Ok(false)
    }

    /// Folds at every step what clashes least, while that takes not too long.
    fn least_bad(&mut self, parts: &[usize]) -> Result<Vec<usize>, Cancelled> {
        let mut is_flat = vec![false; self.motion.model().parts().len()];
        let mut order = Vec::new();
        let most_sweeps = self.checker.sweeps() + COMPARED.max(COMPARED_FOR_EACH * parts.len());
        while order.len() < parts.len() {
            if self.checker.sweeps() > most_sweeps {
                order.extend(parts.iter().filter(|&&p| !is_flat[p]));
                break;
            }
            let mut best: Option<(f64, usize)> = None;
            for &part in parts.iter().filter(|&&p| !is_flat[p]) {
                self.progress.check()?;
                let harm: f64 = self.checker.clashes(part, &is_flat).iter().map(|c| c.depth_mm).sum();
                if best.is_none_or(|b| harm < b.0) {
                    best = Some((harm, part));
                }
                if harm == 0.0 {
                    break;
                }
            }
            let Some((_, part)) = best else { break };
            order.push(part);
            is_flat[part] = true;
        }
        Ok(order)
    }
}
