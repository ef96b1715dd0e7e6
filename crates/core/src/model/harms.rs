//! Parts that bump into each other: what that costs, and what a search has learned of it.

use super::PartId;
use std::collections::BTreeMap;

/// A pair that bumps costs this much, mm of error: with 25 a hand and a plane of 7 and 10 parts bump, with 50 the right
/// arm of a bear bumps by 0.3 mm for outlines that are 0.007 more alike. Not bounded from above by a case yet.
const BUMP_PRICE_MM: f64 = 80.0;
/// And this for each mm that it bumps deeper; bounded from below by the same hand and plane, with 6.
const DEPTH_PRICE: f64 = 12.0;

/// What two parts do to each other: their ids, and how deep they bump, mm.
pub type Bump = ([PartId; 2], f64);

/// Tells whether so many bumps are enough to rule a model out.
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

/// What pairs of parts did to each other in the combinations that were looked at.
///
/// It depends on the candidates of the two and of the parts between them, and on the order of folding, which depends
/// on all. So the least harm seen with the same candidates there is a guess, and most often the truth.
pub(super) struct Harms {
    /// All pairs, each with the parts between its two, both ends included.
    ways: Vec<([PartId; 2], Vec<PartId>)>,
    /// For each the candidates on its way that were seen, and the harm, mm of error.
    least_mm: Vec<BTreeMap<Vec<usize>, f64>>,
    /// Those with harm: the number of the pair and the candidates.
    harmful: BTreeMap<(usize, Vec<usize>), f64>,
}

impl Harms {
    /// Of nothing yet, for parts with these parents.
    pub(super) fn new(parents: &[Option<PartId>]) -> Self {
        let pairs = (0..parents.len()).flat_map(|b| (0..=b).map(move |a| [PartId(a), PartId(b)]));
        let ways: Vec<_> = pairs.map(|pair| (pair, way(parents, pair))).collect();
        Self { least_mm: vec![BTreeMap::new(); ways.len()], ways, harmful: BTreeMap::new() }
    }

    /// Takes in what the parts of a combination do to each other; `is_whole` where these are all of its bumps.
    pub(super) fn learn(&mut self, of: &[usize], bumps: &[Bump], is_whole: bool) {
        for (k, (pair, way)) in self.ways.iter().enumerate() {
            let bumps: Vec<Bump> = bumps.iter().filter(|bump| bump.0 == *pair).copied().collect();
            if bumps.is_empty() && !is_whole {
                continue;
            }
            let on_way: Vec<usize> = way.iter().map(|part| of[part.0]).collect();
            let mm = harm_mm(&bumps);
            let least_mm = self.least_mm[k].entry(on_way.clone()).or_insert(mm);
            *least_mm = least_mm.min(mm);
            if *least_mm > 0.0 {
                self.harmful.insert((k, on_way), *least_mm);
            } else {
                self.harmful.remove(&(k, on_way));
            }
        }
    }

    /// What a combination is expected to cost by its bumps: those that are known.
    pub(super) fn expected_mm(&self, of: &[usize]) -> f64 {
        let is_here = |(k, on_way): &(usize, Vec<usize>)| {
            self.ways[*k].1.iter().zip(on_way).all(|(part, &candidate)| of[part.0] == candidate)
        };
        self.harmful.iter().filter(|(key, _)| is_here(key)).map(|(_, mm)| mm).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

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
    }
}
