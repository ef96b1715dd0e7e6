//! One candidate for every part, so that the whole model is best.
//!
//! The costs of single candidates and of pairs along joints make a tree: the best combination of these
//! is found exactly, by dynamic programming from the leaves (n·K² pair costs). Clashes depend on all parts
//! between two parts, and on the order of folding, so only whole models are checked for them. A search
//! starts from the best of the tree and learns from each model that it looks at: two parts that bump with some
//! candidates, and with the same ones between them, are expected to bump so again. What is cheapest as far as is
//! known is looked at next; then a part that bumps gets another candidate, the others the best that goes with it.
//! The result is never worse than the tree's best, but not necessarily the best of all.
//!
//! How the whole model looks depends on all parts at once, too. Near one combination it is nearly a sum: each
//! candidate changes the outlines where its own part is seen. So these changes count as costs of single
//! candidates, and are measured again at the best that follows, as long as that is better.

use super::PartId;
use super::bond::Bond;
use super::candidate::Candidate;
use super::harms::{Bump, Enough, Harms, harm_mm, way};
use super::link::Link;
use super::pair::{Pairs, WEAK_PRICE_MM};
use crate::progress::Cancelled;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Models that are tried, besides those for each part.
const LOOKS: usize = 24;
/// With more parts than this, joints are kept as they are, and fewer models are tried. Of 400 meshes that nobody prepared, the
/// one with the most parts has 24; a bear in 30 parts took five minutes.
pub const MANY_PARTS: usize = 24;
/// How many of them are tried then: a share that is this number over that of the parts, to the power. A bear in 25 parts takes
/// 33 s of a processor instead of 77 with 24 for this number, one in 48 parts 13 instead of 30, for outlines that are 0.002 and
/// 0.004 worse; a scorpion of 21, where all are tried, loses 0.026 by it.
const FEW_PARTS: usize = 18;
const MANY_POWER: usize = 6;
/// With more parts than this, the first model is kept. A bear of 48 has 46 pairs that clash after four attempts, and 109 after
/// one; an armadillo of 100 has 380 after eight, and 377 after two, which take a third of the time.
pub const MOST_ATTEMPTED: usize = 64;
/// A search ends after this many models in a row that are no better, plus one for each `PATIENCE_SHARE` models that it
/// may still try. Most searches end sooner, because nothing better is expected.
const PATIENCE: usize = 64;
const PATIENCE_SHARE: usize = 16;
/// A brief search ends after this many.
const BRIEF_PATIENCE: usize = 24;
/// Most steps towards better looks; hardly any choice changes after the fifth.
const ROUNDS: usize = 8;
/// Number of the most promising exchanges of one candidate that are completed with exchanges of others.
const STARTS: usize = 8;
/// Models that are computed together.
const AT_ONCE: usize = 2;

/// Tells what the parts of a combination do to each other: all, or enough to rule it out.
type Bumping<'a> = dyn Fn(&[usize], &Enough<'_>) -> Result<Vec<Bump>, Cancelled> + Sync + 'a;

/// Tells what the looks of combinations cost, mm.
type Looks<'a> = dyn Fn(&[Combination]) -> Vec<f64> + Sync + 'a;

/// Candidates of all parts and what they cost.
///
/// Parts that are images of each other share a variable, as candidate k of one is the image of
/// candidate k of the other; costs of a part and of a joint with its own image are those of the variable.
#[derive(Clone)]
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
    parents: Vec<Option<PartId>>,
}

/// What joints between the parts of two variables cost.
#[derive(Clone)]
struct Pair {
    parent: usize,
    child: usize,
    costs: Vec<Vec<f64>>,
}

/// A candidate for each part, of which images have the same.
pub(super) type Combination = Vec<usize>;

/// The parts that could do with more candidates; of two that are images the first.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Trouble {
    /// Those that bump, or are between two that do.
    pub(super) bumping: BTreeSet<PartId>,
    /// Those with a weak joint.
    pub(super) weak: BTreeSet<PartId>,
}

/// The best combination found.
pub(super) struct Best {
    pub(super) of: Combination,
    /// What it costs by its parts, joints, looks and folding, mm of error.
    pub(super) cost_mm: f64,
    /// What is wrong with it.
    pub(super) trouble: Trouble,
    /// Which parts bump.
    pub(super) bumps: Vec<Bump>,
}

/// How many models a search looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Effort {
    /// Next to none, where the search starts from a good model: with as many as in a short one, a scorpion takes 70 s of a
    /// processor instead of 31, for outlines that are no better, and eleven other models are the same.
    Brief,
    /// Few: there will be more candidates where they bump.
    Short,
    /// Many.
    Long,
}

impl Effort {
    /// Number of models to try for this number of parts. With 8 for each part, an ant of 16 parts has nine bumps; with
    /// 32, five; with 128, three, in half as much time again.
    fn looks(self, parts: usize) -> usize {
        let of_each = match self {
            Self::Brief => 2,
            Self::Short => 8,
            Self::Long => 32,
        };
        let looks = LOOKS + parts * of_each;
        match parts {
            ..=MANY_PARTS => looks,
            _ => (0..MANY_POWER).fold(looks, |looks, _| looks * FEW_PARTS / parts),
        }
    }
}

impl Choice {
    /// `weights` say how much each part counts; `links` have a parent's own link before its children's.
    pub(super) fn new(
        candidates: &[Vec<Candidate>],
        weights: &[f64],
        (links, pairs): (&[Link], &Pairs),
        bonds: &[Bond],
    ) -> Self {
        let variable: Vec<usize> = bonds
            .iter()
            .enumerate()
            .map(|(part, bond)| if let Bond::ImageOf(first) = bond { first.0 } else { part })
            .collect();
        let mut own: Vec<Vec<f64>> = candidates.iter().map(|made| vec![0.0; made.len()]).collect();
        for (part, made) in candidates.iter().enumerate() {
            for (cost, m) in own[variable[part]].iter_mut().zip(made) {
                *cost += weights[part] * m.cost_mm;
            }
        }
        let costs = links.iter().enumerate().map(|(k, link)| ([link.parent, link.child], pairs.costs_mm(k)));
        let joints = costs.collect();
        Self::of_costs(variable, own, joints)
    }

    /// `own` has what variables cost, in the places of their parts; `joints` have parent and child, a
    /// parent's own joint before its children's, and their costs by the parent's candidate and the child's.
    fn of_costs(
        variable: Vec<usize>,
        mut own: Vec<Vec<f64>>,
        joints: Vec<([PartId; 2], Vec<Vec<f64>>)>,
    ) -> Self {
        let mut parents: Vec<Option<PartId>> = vec![None; variable.len()];
        let mut pairs: Vec<Pair> = Vec::new();
        for ([parent, child], costs) in joints {
            parents[child.0] = Some(parent);
            let (parent, child) = (variable[parent.0], variable[child.0]);
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
        let is_own = |part: &usize| variable[*part] == *part;
        let roots = (0..variable.len()).filter(|p| pairs.iter().all(|pair| pair.child != *p));
        let downwards = roots.filter(is_own).chain(pairs.iter().map(|pair| pair.child)).collect();
        Self { variable, own, pairs, downwards, parents }
    }

    /// What a combination costs by its parts and joints alone.
    pub(super) fn cost_mm(&self, of: &[usize]) -> f64 {
        let own: f64 = self.downwards.iter().map(|&v| self.own[v][of[v]]).sum();
        own + self.pairs.iter().map(|pair| pair.costs[of[pair.parent]][of[pair.child]]).sum::<f64>()
    }

    /// The best combination found by parts, joints and looks; and the same choice with what each candidate
    /// changes about its look among its costs.
    fn best_looking(&self, looks_mm: &Looks<'_>) -> (Combination, Self) {
        let places = self.downwards.iter().flat_map(|&v| (0..self.own[v].len()).map(move |k| (v, k)));
        let places: Vec<(usize, usize)> = places.collect();
        let whole_mm = |of: &Combination, look_mm: f64| self.cost_mm(of) + look_mm;
        let (mut of, mut near) = (self.cheapest(&[]), self.clone());
        for _ in 0..ROUNDS {
            let other = |&(v, k): &(usize, usize)| {
                let mut other = of.clone();
                other[v] = k;
                self.spread(other)
            };
            let mut all = vec![of.clone()];
            all.extend(places.iter().map(other));
            let mut looks = looks_mm(&all);
            let look_mm = looks[0];
            near.own.clone_from(&self.own);
            for (&(v, k), other_mm) in places.iter().zip(&looks[1..]) {
                near.own[v][k] += other_mm - look_mm;
            }
            // All that goes well by itself, where that does not undo each other.
            let together = near.cheapest(&[]);
            looks.extend(looks_mm(std::slice::from_ref(&together)));
            all.push(together);
            if let Some(&root) = self.downwards.first() {
                near.own[root].iter_mut().for_each(|own| *own += look_mm);
            }
            let costs = all.iter().zip(&looks).map(|(of, look_mm)| whole_mm(of, *look_mm));
            let best = costs.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
            match best.filter(|best| best.1 < whole_mm(&of, look_mm)) {
                Some((best, _)) => of = all.swap_remove(best),
                None => break,
            }
        }
        (of, near)
    }

    /// The combination that costs least by its parts and joints, with some candidates given.
    pub(super) fn cheapest(&self, given: &[(usize, usize)]) -> Combination {
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

    /// The best combination found. `bumps` tells what parts of one do to each
    /// other while they fold, `looks_mm` what the looks of some cost. The search starts from the best of the tree, or from `start` where that is better: the
    /// result is never worse than either.
    pub(super) fn best(
        &self,
        start: Option<Combination>,
        effort: Effort,
        bumps: &Bumping<'_>,
        looks_mm: &Looks<'_>,
    ) -> Result<Best, Cancelled> {
        let (unhindered, near) = self.best_looking(looks_mm);
        // A look ends where the combination is known to cost more than `most_mm`.
        let look = |of: Combination, most_mm: f64| {
            let looks_mm: f64 = looks_mm(std::slice::from_ref(&of)).iter().sum();
            let free_mm = self.cost_mm(&of) + looks_mm;
            let is_enough = |bumps: &[Bump]| free_mm + harm_mm(bumps) >= most_mm;
            let bumps = bumps(&of, &is_enough)?;
            Ok(Look { cost_mm: free_mm + harm_mm(&bumps), is_whole: !is_enough(&bumps), of, bumps })
        };
        let mut harms = Harms::new(&self.parents);
        let mut best = look(unhindered.clone(), f64::INFINITY)?;
        harms.learn(&best.of, &best.bumps, best.is_whole);
        let mut seen = BTreeSet::from([best.of.clone()]);
        if let Some(other) = start.filter(|of| *of != best.of) {
            seen.insert(other.clone());
            let other = look(other, best.cost_mm)?;
            harms.learn(&other.of, &other.bumps, other.is_whole);
            if other.cost_mm < best.cost_mm {
                best = other;
            }
        }
        let mut left = effort.looks(self.own.len());
        let patience =
            if effort == Effort::Brief { BRIEF_PATIENCE } else { PATIENCE + left / PATIENCE_SHARE };
        let mut idle = 0;
        let mut neighbours = near.neighbours(&best, &unhindered);
        while idle < patience {
            let expected_mm = |of: &[usize]| near.cost_mm(of) + harms.expected_mm(of);
            // What differs from the best in one choice, and what is best as far as is known: from there, too.
            let mut next: Vec<(f64, Combination)> =
                neighbours.iter().map(|(_, of)| (expected_mm(of), of.clone())).collect();
            let starts = neighbours.iter().zip(&next).map(|((held, _), (mm, of))| (*mm, Some(*held), of));
            let mut starts: Vec<(f64, Option<usize>, &Combination)> = starts.collect();
            starts.sort_by(|a, b| a.0.total_cmp(&b.0));
            starts.truncate(STARTS);
            starts.extend([&best.of, &unhindered].map(|of| (0.0, None, of)));
            let descended = |&(_, held, of): &(f64, Option<usize>, &Combination)| {
                let of = near.descended(of.clone(), held, &harms);
                (expected_mm(&of), of)
            };
            let known: Vec<(f64, Combination)> = starts.par_iter().map(descended).collect();
            next.extend(known);
            next.retain(|(mm, of)| *mm < best.cost_mm && !seen.contains(of));
            next.sort_by(|a, b| a.0.total_cmp(&b.0));
            next.dedup_by(|a, b| a.1 == b.1);
            let group: Vec<Combination> = next.into_iter().take(AT_ONCE).map(|(_, of)| of).collect();
            if group.is_empty() || left < group.len() {
                break;
            }
            left -= group.len();
            idle += group.len();
            seen.extend(group.iter().cloned());
            let looks: Vec<Result<Look, Cancelled>> =
                group.into_par_iter().map(|of| look(of, best.cost_mm)).collect();
            let looks = looks.into_iter().collect::<Result<Vec<Look>, Cancelled>>()?;
            looks.iter().for_each(|look| harms.learn(&look.of, &look.bumps, look.is_whole));
            let cheapest = looks.into_iter().min_by(|a, b| a.cost_mm.total_cmp(&b.cost_mm));
            if let Some(better) = cheapest.filter(|other| other.cost_mm < best.cost_mm) {
                best = better;
                idle = 0;
                neighbours = near.neighbours(&best, &unhindered);
            }
        }
        let bumping = self.involved(&best).into_iter().map(PartId).collect();
        let is_weak = |pair: &&Pair| pair.costs[best.of[pair.parent]][best.of[pair.child]] > WEAK_PRICE_MM;
        let ends = |pair: &Pair| [pair.parent, pair.child].map(PartId);
        let weak = self.pairs.iter().filter(is_weak).flat_map(ends).collect();
        let Look { of, bumps, cost_mm, .. } = best;
        Ok(Best { of, cost_mm, trouble: Trouble { bumping, weak }, bumps })
    }

    /// The combination with the candidates exchanged, variable by variable but for the one that is held, as long as that
    /// makes it cheaper as far as harms are known.
    fn descended(&self, mut of: Combination, held: Option<usize>, harms: &Harms) -> Combination {
        let mut harms_mm = harms.of_pairs(&of);
        let mut least_mm = self.cost_mm(&of) + harms_mm.iter().sum::<f64>();
        for _ in 0..ROUNDS {
            let before_mm = least_mm;
            for &v in self.downwards.iter().filter(|v| held != Some(**v)) {
                for k in 0..self.own[v].len() {
                    let mut other = of.clone();
                    other[v] = k;
                    let other = self.spread(other);
                    let is_other = |part: PartId| self.variable[part.0] == v;
                    let other_mm = self.cost_mm(&other) + harms.changed_mm(&harms_mm, &other, is_other);
                    if other_mm < least_mm {
                        (of, least_mm) = (other, other_mm);
                        harms_mm = harms.of_pairs(&of);
                    }
                }
            }
            if least_mm == before_mm {
                break;
            }
        }
        of
    }

    /// Variables of the parts that bump, and of those between them.
    fn involved(&self, look: &Look) -> BTreeSet<usize> {
        look.bumps.iter().flat_map(|b| way(&self.parents, b.0)).map(|part| self.variable[part.0]).collect()
    }

    /// Combinations in which a part that bumps, or one between two that do, has another candidate, or one
    /// that differs from what would be best if nothing bumped; each with the part.
    fn neighbours(&self, from: &Look, unhindered: &[usize]) -> BTreeSet<(usize, Combination)> {
        let mut neighbours = BTreeSet::new();
        let mut parts = self.involved(from);
        parts.extend((0..from.of.len()).filter(|&p| self.variable[p] == p && from.of[p] != unhindered[p]));
        for part in parts {
            for k in (0..self.own[part].len()).filter(|k| *k != from.of[part]) {
                let mut only = from.of.clone();
                only[part] = k;
                neighbours.insert((part, self.spread(only)));
                neighbours.insert((part, self.cheapest(&[(part, k)])));
            }
        }
        neighbours
    }
}

/// A combination that was looked at.
struct Look {
    of: Combination,
    bumps: Vec<Bump>,
    /// Whether these are all.
    is_whole: bool,
    cost_mm: f64,
}

#[cfg(test)]
mod tests;
