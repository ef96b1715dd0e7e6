//! One candidate for every part, so that the whole model is best.
//!
//! The costs of single candidates and of pairs along joints make a tree: the best combination of these
//! is found exactly, by dynamic programming from the leaves (n·K² pair costs). What parts do to each
//! other while they fold depends on all that lies between them, and on the order of folding; it is
//! asked for whole models only, and brought in by a search: from the best of the tree, a part that
//! bumps gets another candidate, the others the best that goes with it, while that makes the whole
//! cheaper. So the result is exact where nothing bumps, and never worse than the tree's best; it need
//! not be the best of all where something does.

use super::candidate::Made;
use super::link::Link;
use super::pair::Seated;
use crate::progress::Cancelled;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// A pair that bumps costs this much, mm of error,
const BUMP_PRICE_MM: f64 = 3.0;
/// and this for each mm that it bumps deeper.
const DEPTH_PRICE: f64 = 1.0;
/// Models that are looked at for each part, and for all.
const LOOKS_FOR_EACH: usize = 8;
const LOOKS: usize = 24;
/// Models that are looked at together.
const AT_ONCE: usize = 4;

/// What two parts do to each other: their numbers, and how deep they bump, mm.
pub type Bump = ([usize; 2], f64);

/// Candidates of all parts and what they cost.
pub(super) struct Choice<'a> {
    candidates: &'a [Vec<Made>],
    /// Cost of the candidates of each part.
    own: Vec<Vec<f64>>,
    /// Cost of each link: by the parent's candidate and the child's.
    pairs: Vec<(usize, usize, Vec<Vec<f64>>)>,
    /// Parents before their children.
    downwards: Vec<usize>,
}

/// A candidate for each part.
pub(super) type Combination = Vec<usize>;

impl<'a> Choice<'a> {
    /// `weights` say how much each part counts; `links` have a parent's own link before its children's.
    pub(super) fn new(candidates: &'a [Vec<Made>], weights: &[f64], links: &[Link]) -> Self {
        let own = candidates.iter().zip(weights);
        let own = own.map(|(made, weight)| made.iter().map(|m| weight * m.cost_mm).collect()).collect();
        let pair = |link: &Link| {
            let cost = |parent: &Made, child: &Made| {
                Seated::new(link, parent, child).map_or(f64::INFINITY, |seated| seated.cost_mm())
            };
            let of_parent =
                |parent: &Made| candidates[link.child].iter().map(|child| cost(parent, child)).collect();
            (link.parent, link.child, candidates[link.parent].iter().map(of_parent).collect())
        };
        let roots = (0..candidates.len()).filter(|p| links.iter().all(|l| l.child != *p));
        let downwards = roots.chain(links.iter().map(|l| l.child)).collect();
        Self { candidates, own, pairs: links.par_iter().map(pair).collect(), downwards }
    }

    /// What a combination costs by its parts and joints alone.
    pub(super) fn cost_mm(&self, of: &[usize]) -> f64 {
        let own: f64 = self.own.iter().zip(of).map(|(costs, &k)| costs[k]).sum();
        own + self.pairs.iter().map(|(parent, child, costs)| costs[of[*parent]][of[*child]]).sum::<f64>()
    }

    /// The combination that costs least by its parts and joints, with some candidates given.
    fn cheapest(&self, given: &[(usize, usize)]) -> Combination {
        let mut below = self.own.clone();
        for &(part, only) in given {
            let others = below[part].iter_mut().enumerate().filter(|(k, _)| *k != only);
            others.for_each(|(_, cost)| *cost = f64::INFINITY);
        }
        for &child in self.downwards.iter().rev() {
            let Some((parent, _, costs)) = self.pairs.iter().find(|pair| pair.1 == child) else { continue };
            for (k, row) in costs.iter().enumerate() {
                let best = row.iter().zip(&below[child]).map(|(pair, own)| pair + own);
                let best = best.fold(f64::INFINITY, f64::min);
                below[*parent][k] += best;
            }
        }
        let mut of = vec![0; self.own.len()];
        for &part in &self.downwards {
            let above = self.pairs.iter().find(|pair| pair.1 == part);
            let cost = |k: usize| below[part][k] + above.map_or(0.0, |(p, _, costs)| costs[of[*p]][k]);
            let least = (0..below[part].len()).min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
            of[part] = least.unwrap_or(0);
        }
        of
    }

    /// The best combination found; `bumps` tells what parts of one do to each other while they fold.
    pub(super) fn best(
        &self,
        bumps: &(dyn Fn(&[usize]) -> Result<Vec<Bump>, Cancelled> + Sync),
    ) -> Result<Combination, Cancelled> {
        let look = |of: Combination| {
            let bumps = bumps(&of)?;
            let harm: f64 = bumps.iter().map(|b| BUMP_PRICE_MM + DEPTH_PRICE * b.1).sum();
            Ok(Look { cost_mm: self.cost_mm(&of) + harm, of, bumps })
        };
        let mut best = look(self.cheapest(&[]))?;
        let mut seen = BTreeSet::from([best.of.clone()]);
        let mut left = LOOKS + LOOKS_FOR_EACH * self.own.len();
        'better: loop {
            for group in self.proposals(&best).chunks(AT_ONCE) {
                let worth = |of: &&Combination| self.cost_mm(of) < best.cost_mm && !seen.contains(*of);
                let group: Vec<Combination> = group.iter().filter(worth).cloned().collect();
                if left < group.len() || group.is_empty() {
                    continue;
                }
                left -= group.len();
                seen.extend(group.iter().cloned());
                let looks: Vec<Result<Look, Cancelled>> = group.into_par_iter().map(look).collect();
                let looks = looks.into_iter().collect::<Result<Vec<Look>, Cancelled>>()?;
                let cheapest = looks.into_iter().min_by(|a, b| a.cost_mm.total_cmp(&b.cost_mm));
                if let Some(better) = cheapest.filter(|other| other.cost_mm < best.cost_mm) {
                    best = better;
                    continue 'better;
                }
            }
            return Ok(best.of);
        }
    }

    /// Combinations in which a part that bumps, or one between two that do, has another candidate: the
    /// cheapest first.
    fn proposals(&self, from: &Look) -> Vec<Combination> {
        let involved: BTreeSet<usize> = from.bumps.iter().flat_map(|b| self.way(b.0)).collect();
        let mut proposals: BTreeSet<Combination> = BTreeSet::new();
        for part in involved {
            for k in (0..self.candidates[part].len()).filter(|k| *k != from.of[part]) {
                let mut only = from.of.clone();
                only[part] = k;
                proposals.insert(only);
                proposals.insert(self.cheapest(&[(part, k)]));
            }
        }
        let mut proposals: Vec<Combination> = proposals.into_iter().collect();
        proposals.sort_by(|a, b| self.cost_mm(a).total_cmp(&self.cost_mm(b)));
        proposals
    }

    /// Two parts and those between them.
    fn way(&self, [a, b]: [usize; 2]) -> Vec<usize> {
        let parent = |p: &usize| self.pairs.iter().find(|pair| pair.1 == *p).map(|pair| pair.0);
        let line = |p: usize| std::iter::successors(Some(p), parent).collect::<Vec<_>>();
        let (a, b) = (line(a), line(b));
        let shared = a.iter().rev().zip(b.iter().rev()).take_while(|(x, y)| x == y).count();
        // The last shared one is between them.
        let keep = shared.saturating_sub(1);
        a[..a.len() - keep].iter().chain(&b[..b.len() - shared]).copied().collect()
    }
}

/// A combination that was looked at.
struct Look {
    of: Combination,
    bumps: Vec<Bump>,
    cost_mm: f64,
}
