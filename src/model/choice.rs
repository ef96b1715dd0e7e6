//! One candidate for every part, so that the whole model is best.
//!
//! The costs of single candidates and of pairs along joints make a tree: the best combination of these
//! is found exactly, by dynamic programming from the leaves (n·K² pair costs). What parts do to each
//! other while they fold depends on all that lies between them, and on the order of folding; it is
//! asked for whole models only, and brought in by a search: from the best of the tree, a part that
//! bumps gets another candidate, the others the best that goes with it, while that makes the whole
//! cheaper. So the result is exact where nothing bumps, and never worse than the tree's best; it need
//! not be the best of all where something does.

use super::bond::Bond;
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
///
/// Parts that are images of each other share a variable, as candidate k of one is the image of
/// candidate k of the other; costs of a part and of a joint with its own image are those of the variable.
pub(super) struct Choice {
    /// The variable of each part: the part of which it is the image, or itself.
    variable: Vec<usize>,
    /// Cost of the candidates of each variable.
    own: Vec<Vec<f64>>,
    /// Joints of two variables: by the parent's candidate and the child's.
    pairs: Vec<Pair>,
    /// Variables, parents before their children.
    downwards: Vec<usize>,
    /// The parent of each part.
    parents: Vec<Option<usize>>,
}

/// What joints between the parts of two variables cost.
struct Pair {
    parent: usize,
    child: usize,
    costs: Vec<Vec<f64>>,
}

/// A candidate for each part, of which images have the same.
pub(super) type Combination = Vec<usize>;

impl Choice {
    /// `weights` say how much each part counts; `links` have a parent's own link before its children's.
    pub(super) fn new(candidates: &[Vec<Made>], weights: &[f64], links: &[Link], bonds: &[Bond]) -> Self {
        let variable: Vec<usize> = bonds
            .iter()
            .enumerate()
            .map(|(part, bond)| if let Bond::ImageOf(first) = bond { *first } else { part })
            .collect();
        let mut own: Vec<Vec<f64>> = candidates.iter().map(|made| vec![0.0; made.len()]).collect();
        for (part, made) in candidates.iter().enumerate() {
            for (cost, m) in own[variable[part]].iter_mut().zip(made) {
                *cost += weights[part] * m.cost_mm;
            }
        }
        let cost = |link: &Link, parent: &Made, child: &Made| {
            Seated::new(link, parent, child).map_or(f64::INFINITY, |seated| seated.cost_mm())
        };
        let of_link = |link: &Link| -> Vec<Vec<f64>> {
            let [parents, children] = [&candidates[link.parent], &candidates[link.child]];
            let of_parent = |parent: &Made| children.iter().map(|child| cost(link, parent, child)).collect();
            parents.iter().map(of_parent).collect()
        };
        let costs: Vec<Vec<Vec<f64>>> = links.par_iter().map(of_link).collect();
        let mut pairs: Vec<Pair> = Vec::new();
        for (link, costs) in links.iter().zip(costs) {
            let (parent, child) = (variable[link.parent], variable[link.child]);
            if parent == child {
                own[parent].iter_mut().enumerate().for_each(|(k, own)| *own += costs[k][k]);
                continue;
            }
            match pairs.iter_mut().find(|pair| (pair.parent, pair.child) == (parent, child)) {
                Some(pair) => {
                    let sums = pair.costs.iter_mut().flatten();
                    sums.zip(costs.iter().flatten()).for_each(|(sum, cost)| *sum += cost);
                }
                None => pairs.push(Pair { parent, child, costs }),
            }
        }
        let parents: Vec<Option<usize>> = (0..candidates.len())
            .map(|part| links.iter().find(|l| l.child == part).map(|l| l.parent))
            .collect();
        let is_own = |part: &usize| variable[*part] == *part;
        let roots = (0..candidates.len()).filter(|p| pairs.iter().all(|pair| pair.child != *p));
        let downwards = roots.filter(is_own).chain(pairs.iter().map(|pair| pair.child)).collect();
        Self { variable, own, pairs, downwards, parents }
    }

    /// What a combination costs by its parts and joints alone.
    pub(super) fn cost_mm(&self, of: &[usize]) -> f64 {
        let own: f64 = self.downwards.iter().map(|&v| self.own[v][of[v]]).sum();
        own + self.pairs.iter().map(|pair| pair.costs[of[pair.parent]][of[pair.child]]).sum::<f64>()
    }

    /// The combination that costs least by its parts and joints, with some candidates given.
    fn cheapest(&self, given: &[(usize, usize)]) -> Combination {
        let mut below = self.own.clone();
        for &(part, only) in given {
            let others = below[self.variable[part]].iter_mut().enumerate().filter(|(k, _)| *k != only);
            others.for_each(|(_, cost)| *cost = f64::INFINITY);
        }
        for &child in self.downwards.iter().rev() {
            let Some(pair) = self.pairs.iter().find(|pair| pair.child == child) else { continue };
            for (k, row) in pair.costs.iter().enumerate() {
                let best = row.iter().zip(&below[child]).map(|(pair, own)| pair + own);
                let best = best.fold(f64::INFINITY, f64::min);
                below[pair.parent][k] += best;
            }
        }
        let mut of = vec![0; self.own.len()];
        for &part in &self.downwards {
            let above = self.pairs.iter().find(|pair| pair.child == part);
            let cost = |k: usize| below[part][k] + above.map_or(0.0, |pair| pair.costs[of[pair.parent]][k]);
            let least = (0..below[part].len()).min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
            of[part] = least.unwrap_or(0);
        }
        self.spread(of)
    }

    /// The same with the candidates of variables given to all their parts.
    fn spread(&self, mut of: Combination) -> Combination {
        for part in 0..of.len() {
            of[part] = of[self.variable[part]];
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
        let involved = from.bumps.iter().flat_map(|b| self.way(b.0)).map(|part| self.variable[part]);
        let involved: BTreeSet<usize> = involved.collect();
        let mut proposals: BTreeSet<Combination> = BTreeSet::new();
        for part in involved {
            for k in (0..self.own[part].len()).filter(|k| *k != from.of[part]) {
                let mut only = from.of.clone();
                only[part] = k;
                proposals.insert(self.spread(only));
                proposals.insert(self.cheapest(&[(part, k)]));
            }
        }
        let mut proposals: Vec<Combination> = proposals.into_iter().collect();
        proposals.sort_by(|a, b| self.cost_mm(a).total_cmp(&self.cost_mm(b)));
        proposals
    }

    /// Two parts and those between them.
    fn way(&self, [a, b]: [usize; 2]) -> Vec<usize> {
        let line = |p: usize| std::iter::successors(Some(p), |p| self.parents[*p]).collect::<Vec<_>>();
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
