//! The order in which components fold, one at a time: outer ones first where that works, else any
//! order in which nothing bumps into anything, found by a search that turns back at dead ends.

use super::check::{Checker, Clash};
use super::pose::{ModelMotion, ancestors, root_of};
use super::step::{FLAT, Level, Move};
use crate::model::Model;
use crate::progress::{Cancelled, Progress};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Computed motions for each component of a model after which the search gives up.
const SWEEPS_FOR_EACH: usize = 1;
/// States of the model after which it gives up.
const MOST_STATES: usize = 20_000;
/// If no order is free of clashes, components are compared at every step until this many motions are
/// computed for each, and at least this many in all; the rest follows as listed.
const COMPARED_FOR_EACH: usize = 3;
const COMPARED: usize = 150;
/// Another order replaces the current one if it does less harm by more than this.
const LEAST_GAIN_MM: f64 = 0.01;

/// Sorts components, which come in the order of their numbers, so that children come before those that
/// carry them.
pub(super) fn outermost_first(model: &Model, parts: &mut [usize]) {
    parts.sort_by_key(|&part| std::cmp::Reverse(ancestors(model, part).len()));
}

/// All clashes of moves, one after another, in a model of `parts` parts.
pub(super) fn replay(checker: &mut Checker<'_>, moves: &[Move], parts: usize) -> Vec<Clash> {
    let mut levels = vec![0; parts];
    let mut clashes = Vec::new();
    for step in moves {
        clashes.extend_from_slice(&checker.all_clashes(*step, &levels));
        levels[step.part] = step.to;
    }
    clashes
}

/// The search for an order of whole moves.
pub(super) struct Search<'s, 'a> {
    motion: &'s ModelMotion<'a>,
    checker: &'s mut Checker<'a>,
    progress: &'s dyn Progress,
    /// Whether a long search for the least harm is worth its time.
    is_thorough: bool,
    dead_ends: BTreeSet<Vec<Level>>,
    most_sweeps: usize,
}

impl<'s, 'a> Search<'s, 'a> {
    pub(super) fn new(
        motion: &'s ModelMotion<'a>,
        checker: &'s mut Checker<'a>,
        progress: &'s dyn Progress,
        is_thorough: bool,
    ) -> Self {
        Self { motion, checker, progress, is_thorough, dead_ends: BTreeSet::new(), most_sweeps: 0 }
    }

    /// An order for the tree of a root.
    pub(super) fn tree(mut self, root: usize) -> Result<Vec<usize>, Cancelled> {
        let model = self.motion.model();
        let mut parts: Vec<usize> = (0..model.parts().len()).filter(|&p| root_of(model, p) == root).collect();
        outermost_first(model, &mut parts);
        self.look_ahead(&parts)?;
        self.most_sweeps = self.checker.sweeps() + SWEEPS_FOR_EACH * parts.len();
        let (mut order, mut levels) = (Vec::new(), self.deployed());
        if !self.extend(&parts, &mut order, &mut levels)? {
            order = self.fallback(&parts)?;
        }
        Ok(order)
    }

    fn deployed(&self) -> Vec<Level> {
        vec![0; self.motion.model().parts().len()]
    }

    /// An order that does little harm where all do some.
    fn fallback(&mut self, parts: &[usize]) -> Result<Vec<usize>, Cancelled> {
        let greedy = self.least_bad(parts)?;
        let (as_listed_mm, greedy_mm) = (self.harm_mm(parts), self.harm_mm(&greedy));
        let better = if as_listed_mm <= greedy_mm { parts.to_vec() } else { greedy };
        if self.is_thorough { self.improved(better) } else { Ok(better) }
    }

    fn replay(&mut self, order: &[usize]) -> Vec<Clash> {
        let moves: Vec<Move> = order.iter().map(|&part| Move::whole(part)).collect();
        replay(self.checker, &moves, self.motion.model().parts().len())
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
        let (checker, progress) = (&*self.checker, self.progress);
        let count = self.motion.model().parts().len();
        let answers: Vec<_> = (0..parts.len())
            .into_par_iter()
            .map(|k| {
                progress.check()?;
                let mut levels = vec![0; count];
                parts[..k].iter().for_each(|&p| levels[p] = FLAT);
                Ok(checker.answers(parts[k], &levels))
            })
            .collect::<Result<_, Cancelled>>()?;
        answers.into_iter().for_each(|a| self.checker.learn(a));
        let mut levels = vec![0; count];
        for &part in parts {
            for clash in self.checker.all_clashes(Move::whole(part), &levels).iter() {
                progress.check()?;
                self.checker.accept_if_unavoidable(clash, &levels);
            }
            levels[part] = FLAT;
        }
        Ok(())
    }

    /// Folds what is left, depth first; false where there is no way.
    fn extend(
        &mut self,
        parts: &[usize],
        order: &mut Vec<usize>,
        levels: &mut [Level],
    ) -> Result<bool, Cancelled> {
        if order.len() == parts.len() {
            return Ok(true);
        }
        if self.dead_ends.contains(levels as &[Level]) || self.dead_ends.len() > MOST_STATES {
            return Ok(false);
        }
        for &part in parts {
            if levels[part] == FLAT || self.checker.sweeps() > self.most_sweeps {
                continue;
            }
            self.progress.check()?;
            if !self.checker.clashes(Move::whole(part), levels).is_empty() {
                continue;
            }
            order.push(part);
            levels[part] = FLAT;
            if self.extend(parts, order, levels)? {
                return Ok(true);
            }
            order.pop();
            levels[part] = 0;
        }
        self.dead_ends.insert(levels.to_vec());
        Ok(false)
    }

    /// Folds at every step what clashes least, while that takes not too long.
    fn least_bad(&mut self, parts: &[usize]) -> Result<Vec<usize>, Cancelled> {
        let mut levels = self.deployed();
        let mut order = Vec::new();
        let compared =
            if self.is_thorough { COMPARED.max(COMPARED_FOR_EACH * parts.len()) } else { parts.len() };
        let most_sweeps = self.checker.sweeps() + compared;
        while order.len() < parts.len() {
            if self.checker.sweeps() > most_sweeps {
                order.extend(parts.iter().filter(|&&p| levels[p] == 0));
                break;
            }
            let mut best: Option<(f64, usize)> = None;
            for &part in parts.iter().filter(|&&p| levels[p] == 0) {
                self.progress.check()?;
                let harm: f64 =
                    self.checker.clashes(Move::whole(part), &levels).iter().map(|c| c.depth_mm).sum();
                if best.is_none_or(|b| harm < b.0) {
                    best = Some((harm, part));
                }
                if harm == 0.0 {
                    break;
                }
            }
            let Some((_, part)) = best else { break };
            order.push(part);
            levels[part] = FLAT;
        }
        Ok(order)
    }
}
