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

mod search;

use super::PartId;
use super::bond::Bond;
use super::candidate::Candidate;
use super::harms::Harms;
use super::link::Link;
use super::pair::Pairs;

pub(super) use search::{Best, Effort, Trouble};
pub use search::{MANY_PARTS, MOST_ATTEMPTED};

/// Most steps towards better looks; hardly any choice changes after the fifth.
const ROUNDS: usize = 8;

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
}

#[cfg(test)]
mod tests;
