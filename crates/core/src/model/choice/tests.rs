use super::super::harms::{Bump, Enough, harm_mm};
use super::*;
use crate::progress::Cancelled;
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
                Some(below) => ends.extend((0..1 + usize::from(is_pair)).map(|s| [below[s], sides[v][s]])),
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
        let Best { of: found, .. } = choice.best(None, Effort::Long, &|_, _| Ok(Vec::new()), &looks).unwrap();
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

/// Looks at a bear in 30 parts, of which each took the cube of that, went on for minutes.
#[test]
fn more_parts_than_many_make_no_more_work() {
    for effort in [Effort::Short, Effort::Long] {
        let work = |parts: usize| effort.looks(parts) * parts.pow(3);
        assert!((1..MANY_PARTS).all(|parts| work(parts) < work(parts + 1)));
        assert!((MANY_PARTS..=200).all(|parts| work(parts) <= work(MANY_PARTS)));
        assert!((MANY_PARTS..200).all(|parts| effort.looks(parts) >= effort.looks(parts + 1)));
    }
}
