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

/// Models that are looked at, besides those for each part.
const LOOKS: usize = 24;
/// A search is given up after so many models in a row that are no better, and this share of all that it may look at. Most
/// end sooner, as nothing better is expected.
const PATIENCE: usize = 64;
const PATIENCE_SHARE: usize = 16;
/// Steps towards a better look at most; hardly any choice moves after the fifth.
const ROUNDS: usize = 8;
/// The most promising exchanges of one candidate for which those of others are sought that go with it.
const STARTS: usize = 8;
/// Models that are looked at together.
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
    /// Few: there will be more candidates where they bump.
    Short,
    /// Many.
    Long,
}

impl Effort {
    /// For a combination of so many parts. With 8 for each an ant of 16 parts has nine bumps, with 32 five; with 128
    /// three, for half as much time again.
    fn looks(self, parts: usize) -> usize {
        LOOKS + parts * if self == Self::Short { 8 } else { 32 }
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
        let patience = PATIENCE + left / PATIENCE_SHARE;
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
                let of = self.descended(of.clone(), held, &expected_mm);
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
    /// makes it cheaper.
    fn descended(
        &self,
        mut of: Combination,
        held: Option<usize>,
        cost_mm: &(dyn Fn(&[usize]) -> f64 + Sync),
    ) -> Combination {
        let mut least_mm = cost_mm(&of);
        for _ in 0..ROUNDS {
            let before_mm = least_mm;
            for &v in self.downwards.iter().filter(|v| held != Some(**v)) {
                for k in 0..self.own[v].len() {
                    let mut other = of.clone();
                    other[v] = k;
                    let other = self.spread(other);
                    let other_mm = cost_mm(&other);
                    if other_mm < least_mm {
                        (of, least_mm) = (other, other_mm);
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
mod tests {
    use super::*;
    use fastrand::Rng;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// A random tree, partly symmetric, with what its candidates cost.
    struct Tree {
        variable: Vec<usize>,
        /// Of each part's candidates; images have the same number of them.
        own: Vec<Vec<f64>>,
        joints: Vec<([PartId; 2], Vec<Vec<f64>>)>,
    }

    impl Tree {
        fn random(rng: &mut Rng) -> Self {
            // Parts, or pairs of them, above which others stand: their numbers on both sides.
            let mut sides: Vec<[usize; 2]> = Vec::new();
            let mut ends: Vec<[usize; 2]> = Vec::new();
            let mut count = 0;
            for v in 0..rng.usize(1..8) {
                let below = (v > 0 && rng.f64() < 0.9).then(|| sides[rng.usize(..v)]);
                let is_pair = below.is_some_and(|b| b[0] != b[1]) || rng.f64() < 0.3;
                sides.push(if is_pair { [count, count + 1] } else { [count; 2] });
                count += 1 + usize::from(is_pair);
                match below {
                    Some(below) => {
                        ends.extend((0..1 + usize::from(is_pair)).map(|s| [below[s], sides[v][s]]))
                    }
                    // A pair whose parts are joined to each other.
                    None => ends.extend((is_pair && rng.bool()).then_some(sides[v])),
                }
            }
            let mut numbers: Vec<usize> = (0..count).collect();
            rng.shuffle(&mut numbers);
            let mut variable = vec![0; count];
            let mut own: Vec<Vec<f64>> = vec![Vec::new(); count];
            for both in sides {
                let both = both.map(|p| numbers[p]);
                let candidates = rng.usize(1..6);
                for part in both {
                    variable[part] = both[0].min(both[1]);
                    own[part] = (0..candidates).map(|_| 5.0 * rng.f64()).collect();
                }
            }
            let mut cost = || if rng.f64() < 0.05 { f64::INFINITY } else { 5.0 * rng.f64() };
            let joints = ends.into_iter().map(|ends| {
                let ends = ends.map(|p| numbers[p]);
                let mut row = |_| (0..own[ends[1]].len()).map(|_| cost()).collect();
                (ends.map(PartId), (0..own[ends[0]].len()).map(&mut row).collect())
            });
            let joints = joints.collect();
            Self { variable, own, joints }
        }

        fn choice(&self) -> Choice {
            let mut own: Vec<Vec<f64>> = self.own.iter().map(|own| vec![0.0; own.len()]).collect();
            for (part, costs) in self.own.iter().enumerate() {
                own[self.variable[part]].iter_mut().zip(costs).for_each(|(sum, cost)| *sum += cost);
            }
            Choice::of_costs(self.variable.clone(), own, self.joints.clone())
        }

        /// What a combination costs, by all parts and joints.
        fn cost_mm(&self, of: &[usize]) -> f64 {
            let own: f64 = of.iter().zip(&self.own).map(|(&k, own)| own[k]).sum();
            own + self.joints.iter().map(|([a, b], costs)| costs[of[a.0]][of[b.0]]).sum::<f64>()
        }

        fn are_alike(&self, of: &[usize]) -> bool {
            (0..of.len()).all(|part| of[part] == of[self.variable[part]])
        }

        /// All combinations, or a thousand random ones where they are many.
        fn combinations(&self, rng: &mut Rng) -> Vec<Combination> {
            let counts: Vec<usize> = self.own.iter().map(Vec::len).collect();
            let is_own = |part: &usize| self.variable[*part] == *part;
            let all: usize = (0..counts.len()).filter(is_own).map(|part| counts[part]).product();
            let pick = |mut digit: Box<dyn FnMut(usize) -> usize + '_>| {
                let mut of: Combination =
                    (0..counts.len()).map(|p| if is_own(&p) { digit(counts[p]) } else { 0 }).collect();
                (0..of.len()).for_each(|part| of[part] = of[self.variable[part]]);
                of
            };
            if all > 1000 {
                return (0..1000).map(|_| pick(Box::new(|count| rng.usize(..count)))).collect();
            }
            let of_number = |mut number: usize| {
                pick(Box::new(move |count| {
                    let digit = number % count;
                    number /= count;
                    digit
                }))
            };
            (0..all).map(of_number).collect()
        }
    }

    #[test]
    fn no_combination_is_cheaper_than_that_of_the_tree() {
        let mut rng = Rng::with_seed(1);
        for _ in 0..300 {
            let tree = Tree::random(&mut rng);
            let choice = tree.choice();
            let best = choice.cheapest(&[]);
            assert!(tree.are_alike(&best), "images have the same candidate");
            let (part, k) = (rng.usize(..best.len()), 0);
            let given = choice.cheapest(&[(part, k)]);
            assert!(given[part] == k && tree.are_alike(&given));
            let [best_mm, given_mm] = [&best, &given].map(|of| tree.cost_mm(of));
            for of in tree.combinations(&mut rng) {
                let cost_mm = tree.cost_mm(&of);
                assert!(cost_mm == choice.cost_mm(&of) || (cost_mm - choice.cost_mm(&of)).abs() < 1e-9);
                assert!(best_mm <= cost_mm + 1e-9, "{best_mm} {cost_mm}");
                assert!(of[part] != k || given_mm <= cost_mm + 1e-9, "{given_mm} {cost_mm}");
            }
        }
    }

    /// Bumps make things worse, but never so that the best without regard to them would be better.
    #[test]
    fn with_bumps_the_search_is_never_worse_than_the_tree() {
        let mut rng = Rng::with_seed(2);
        let (mut worse, mut best_of_all) = (0, 0);
        for seed in 0..300 {
            let tree = Tree::random(&mut rng);
            let choice = tree.choice();
            let is_bumping = seed % 3 > 0;
            let looks = AtomicUsize::new(0);
            // Any two parts bump or not by their own candidates and by that of the first part.
            let bumps = |of: &[usize]| -> Vec<Bump> {
                let pairs = (0..of.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
                let bump = |[a, b]: [usize; 2]| {
                    let key = [seed, a, b, of[a], of[b], of[0]];
                    let mut rng = Rng::with_seed(key.iter().fold(7, |h, k| h * 31 + *k as u64));
                    (rng.f64() < 0.3).then(|| ([a, b].map(PartId), 4.0 * rng.f64()))
                };
                pairs.filter(|_| is_bumping).filter_map(bump).collect()
            };
            let total_mm = |of: &[usize]| tree.cost_mm(of) + harm_mm(&bumps(of));
            let anywhere = rng.bool().then(|| tree.combinations(&mut rng).swap_remove(0));
            let found = choice.best(
                anywhere.clone(),
                Effort::Long,
                &|of, _| {
                    looks.fetch_add(1, Ordering::Relaxed);
                    assert!(tree.are_alike(of), "images have the same candidate");
                    Ok(bumps(of))
                },
                &no_looks,
            );
            let Best { of: found, trouble, cost_mm, .. } = found.unwrap();
            let own_mm = total_mm(&found);
            assert!(cost_mm == own_mm || (cost_mm - own_mm).abs() < 1e-9, "{cost_mm} {own_mm}");
            assert!(bumps(&found).is_empty() || !trouble.bumping.is_empty(), "parts that bump are named");
            let (found_mm, tree_mm) = (total_mm(&found), total_mm(&choice.cheapest(&[])));
            assert!(tree.are_alike(&found));
            assert!(found_mm <= tree_mm, "{found_mm} {tree_mm}");
            assert!(is_bumping || found == choice.cheapest(&[]));
            assert!(anywhere.is_none_or(|of| found_mm <= total_mm(&of)), "never worse than a start");
            assert!(looks.into_inner() <= 2 + Effort::Long.looks(found.len()));
            worse += usize::from(found_mm < tree_mm);
            let least_mm =
                tree.combinations(&mut rng).iter().map(|of| total_mm(of)).fold(f64::INFINITY, f64::min);
            best_of_all += usize::from(found_mm <= least_mm + 1e-9);
        }
        // Bumps are many here, and of any kind: it helps, and most often nothing better was to be found.
        assert!(worse > 100 && best_of_all > 200, "{worse} {best_of_all}");
    }

    fn no_looks(all: &[Combination]) -> Vec<f64> {
        vec![0.0; all.len()]
    }

    /// Looks that are no sum: what two parts do against the mesh may be done by either.
    #[test]
    fn a_better_look_is_found_and_nothing_is_worse_than_the_tree() {
        let mut rng = Rng::with_seed(4);
        let (mut better, mut best_of_all) = (0, 0);
        for _ in 0..300 {
            let tree = Tree::random(&mut rng);
            let choice = tree.choice();
            let worth: Vec<Vec<f64>> =
                tree.own.iter().map(|own| own.iter().map(|_| 3.0 * rng.f64()).collect()).collect();
            let look_mm = |of: &Combination| {
                let each = of.iter().zip(&worth).map(|(&k, worth)| worth[k]);
                20.0 / (1.0 + each.sum::<f64>())
            };
            let looks = |all: &[Combination]| all.iter().map(look_mm).collect::<Vec<f64>>();
            let whole_mm = |of: &Combination| tree.cost_mm(of) + look_mm(of);
            let Best { of: found, .. } =
                choice.best(None, Effort::Long, &|_, _| Ok(Vec::new()), &looks).unwrap();
            assert!(tree.are_alike(&found));
            let (found_mm, tree_mm) = (whole_mm(&found), whole_mm(&choice.cheapest(&[])));
            assert!(found_mm <= tree_mm, "{found_mm} {tree_mm}");
            better += usize::from(found_mm < tree_mm);
            let all = tree.combinations(&mut rng);
            let least_mm = all.iter().map(whole_mm).fold(f64::INFINITY, f64::min);
            best_of_all += usize::from(found_mm <= least_mm + 1e-9);
        }
        assert!(better > 50 && best_of_all > 250, "{better} {best_of_all}");
    }

    /// A start in which both of two parts avoid each other, where one would do.
    #[test]
    fn a_part_that_avoids_nothing_goes_back_to_its_best() {
        let choice = Choice::of_costs(vec![0, 1], vec![vec![0.0, 5.0]; 2], Vec::new());
        let bumps = |of: &[usize], _: &Enough<'_>| {
            Ok(if of == [0, 0] { vec![([0, 1].map(PartId), 1.0)] } else { Vec::<Bump>::new() })
        };
        let Best { of: found, .. } = choice.best(Some(vec![1, 1]), Effort::Long, &bumps, &no_looks).unwrap();
        assert_eq!(choice.cost_mm(&found), 5.0);
    }

    /// Of a row of parts each bumps into the next in three of four combinations of the two: of all combinations one in
    /// four million is free. Each pair has to be seen to bump only once.
    #[test]
    fn what_bumped_is_not_looked_at_again() {
        let (parts, candidates) = (12, 8);
        let own: Vec<f64> = (0..candidates).map(|k| k as f64 / 100.0).collect();
        let choice = Choice::of_costs((0..parts).collect(), vec![own; parts], Vec::new());
        let looks = AtomicUsize::new(0);
        let bumps = |of: &[usize], _: &Enough<'_>| {
            looks.fetch_add(1, Ordering::Relaxed);
            let is_free = |a: usize, b: usize| (3 * of[a] + 5 * of[b] + a).is_multiple_of(4);
            let pairs = (1..parts).filter(|&b| !is_free(b - 1, b));
            Ok(pairs.map(|b| ([b - 1, b].map(PartId), 1.0)).collect())
        };
        let Best { bumps: left, .. } = choice.best(None, Effort::Long, &bumps, &no_looks).unwrap();
        assert_eq!(left, []);
        let looks = looks.into_inner();
        assert!(looks < parts * candidates, "{looks}");
    }

    #[test]
    fn the_search_can_be_stopped() {
        let tree = Tree::random(&mut Rng::with_seed(3));
        assert!(tree.choice().best(None, Effort::Long, &|_, _| Err(Cancelled), &no_looks).is_err());
    }
}
