//! Parts that bump into each other: what that costs, and what a search has learned of it.

use super::PartId;
use smallvec::SmallVec;
use std::collections::{BTreeMap, BTreeSet};

/// A pair that bumps costs this much, mm of error: with 25 a hand and a plane of 7 and 10 parts bump, with 50 the right
/// arm of a bear bumps by 0.3 mm for outlines that are 0.007 more alike. Not bounded from above by a case yet.
const BUMP_PRICE_MM: f64 = 80.0;
/// And this for each mm that it bumps deeper; bounded from below by the same hand and plane, with 6.
const DEPTH_PRICE: f64 = 12.0;

/// What two parts do to each other: their ids, and how deep they bump, mm.
pub type Bump = ([PartId; 2], f64);

/// Whether these bumps are enough to rule a model out.
pub type Enough<'a> = dyn Fn(&[Bump]) -> bool + Sync + 'a;

/// What parts that bump cost, mm of error.
pub fn harm_mm(bumps: &[Bump]) -> f64 {
    bumps.iter().map(|bump| BUMP_PRICE_MM + DEPTH_PRICE * bump.1).sum()
}

/// Two parts and those between them, by the parent of each part.
pub(super) fn way(parents: &[Option<PartId>], [a, b]: [PartId; 2]) -> Vec<PartId> {
    let line = |p| std::iter::successors(Some(p), |p: &PartId| parents[p.0]).collect::<Vec<_>>();
    let (a, b) = (line(a), line(b));
    let shared = a.iter().rev().zip(b.iter().rev()).take_while(|(x, y)| x == y).count();
    // The last shared one is between them.
    let keep = shared.saturating_sub(1);
    a[..a.len() - keep].iter().chain(&b[..b.len() - shared]).copied().collect()
}

/// How pairs of parts bumped in the combinations that were tried.
///
/// It depends on the candidates of the two and of the parts between them, and on the order of folding, which depends
/// on all. So the least harm seen with the same candidates there is a guess, and most often the truth.
pub(super) struct Harms {
    /// All pairs, each with the parts between its two, both ends included.
    ways: Vec<([PartId; 2], Vec<PartId>)>,
    /// For each the candidates on its way that were seen, and the harm, mm of error.
    least_mm: Vec<BTreeMap<Vec<usize>, f64>>,
    /// The numbers of those with harm.
    harmful: BTreeSet<usize>,
}

impl Harms {
    /// Of nothing yet, for parts with these parents.
    pub(super) fn new(parents: &[Option<PartId>]) -> Self {
        let pairs = (0..parents.len()).flat_map(|b| (0..=b).map(move |a| [PartId(a), PartId(b)]));
        let ways: Vec<_> = pairs.map(|pair| (pair, way(parents, pair))).collect();
        Self { least_mm: vec![BTreeMap::new(); ways.len()], ways, harmful: BTreeSet::new() }
    }

    /// Records how the parts of a combination bump; `is_whole` if these are all of its bumps.
    pub(super) fn learn(&mut self, of: &[usize], bumps: &[Bump], is_whole: bool) {
        for (k, (pair, way)) in self.ways.iter().enumerate() {
            let bumps: Vec<Bump> = bumps.iter().filter(|bump| bump.0 == *pair).copied().collect();
            if bumps.is_empty() && !is_whole {
                continue;
            }
            let mm = harm_mm(&bumps);
            let least_mm = self.least_mm[k].entry(on_way(of, way).collect()).or_insert(mm);
            *least_mm = least_mm.min(mm);
            if mm > 0.0 {
                self.harmful.insert(k);
            }
        }
    }

    /// What a combination is expected to cost by its bumps: those that are known.
    pub(super) fn expected_mm(&self, of: &[usize]) -> f64 {
        self.of_pairs(of).iter().sum()
    }

    /// The share of each pair with harm in that.
    pub(super) fn of_pairs(&self, of: &[usize]) -> Vec<f64> {
        self.harmful.iter().map(|&k| self.of_pair(k, of)).collect()
    }

    /// What a combination is expected to cost that has other candidates than one before for some parts; `before_mm` are
    /// the shares of that one.
    pub(super) fn changed_mm(
        &self,
        before_mm: &[f64],
        of: &[usize],
        is_other: impl Fn(PartId) -> bool,
    ) -> f64 {
        let pairs = self.harmful.iter().zip(before_mm);
        let share_mm = |(&k, &before_mm): (&usize, &f64)| {
            if self.ways[k].1.iter().any(|part| is_other(*part)) { self.of_pair(k, of) } else { before_mm }
        };
        pairs.map(share_mm).sum()
    }

    fn of_pair(&self, k: usize, of: &[usize]) -> f64 {
        let key: SmallVec<[usize; 16]> = on_way(of, &self.ways[k].1).collect();
        self.least_mm[k].get(&key[..]).copied().unwrap_or(0.0)
    }
}

/// The candidates of the parts on a way.
fn on_way<'a>(of: &'a [usize], way: &'a [PartId]) -> impl Iterator<Item = usize> + 'a {
    way.iter().map(|part| of[part.0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_has_the_parts_between() {
        // 0 carries 1 and 2, 1 carries 3; 4 stands by itself.
        let parents = [None, Some(0), Some(0), Some(1), None].map(|parent| parent.map(PartId));
        let way = |a, b| way(&parents, [a, b].map(PartId)).iter().map(|p| p.0).collect::<BTreeSet<usize>>();
        assert_eq!(way(3, 2), BTreeSet::from([0, 1, 2, 3]));
        assert_eq!(way(0, 3), BTreeSet::from([0, 1, 3]));
        assert_eq!(way(1, 3), BTreeSet::from([1, 3]));
        assert_eq!(way(2, 2), BTreeSet::from([2]));
        assert!(way(3, 4).is_superset(&BTreeSet::from([3, 4])));
    }

    /// Of three parts in a row, the bump of two depends on these two, that of the ends on all three.
    #[test]
    fn harm_is_expected_with_the_same_candidates_on_the_way() {
        let mut harms = Harms::new(&[None, Some(PartId(0)), Some(PartId(1))]);
        let [near, far] = [([0, 1], 1.0), ([0, 2], 2.0)].map(|(pair, mm)| (pair.map(PartId), mm));
        harms.learn(&[0, 0, 0], &[near, far], true);
        let (near_mm, far_mm) = (harm_mm(&[near]), harm_mm(&[far]));
        assert_eq!(harms.expected_mm(&[0, 0, 0]), near_mm + far_mm);
        assert_eq!(harms.expected_mm(&[0, 0, 1]), near_mm);
        assert_eq!(harms.expected_mm(&[0, 1, 0]), 0.0);
        // A look that ended early says nothing of the pairs that it does not name; a whole one does.
        harms.learn(&[0, 0, 1], &[], false);
        assert_eq!(harms.expected_mm(&[0, 0, 1]), near_mm);
        harms.learn(&[0, 0, 1], &[], true);
        assert_eq!(harms.expected_mm(&[0, 0, 1]), 0.0);
        let before_mm = harms.of_pairs(&[0, 0, 0]);
        for (part, of) in [[1, 0, 0], [0, 1, 0], [0, 0, 1]].into_iter().enumerate() {
            assert_eq!(harms.changed_mm(&before_mm, &of, |p| p.0 == part), harms.expected_mm(&of));
        }
    }
}
