//! The search among whole models, one look after another.

use super::{Choice, Combination, Looks, Pair};
use crate::model::PartId;
use crate::model::harms::{Bump, Enough, Harms, harm_mm, way};
use crate::model::pair::WEAK_PRICE_MM;
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
/// Number of the most promising exchanges of one candidate that are completed with exchanges of others.
const STARTS: usize = 8;
/// Models that are computed together.
const AT_ONCE: usize = 2;

/// Tells what the parts of a combination do to each other: all, or enough to rule it out.
type Bumping<'a> = dyn Fn(&[usize], &Enough<'_>) -> Result<Vec<Bump>, Cancelled> + Sync + 'a;

/// The parts that could do with more candidates; of two that are images the first.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(in crate::model) struct Trouble {
    /// Those that bump, or are between two that do.
    pub(in crate::model) bumping: BTreeSet<PartId>,
    /// Those with a weak joint.
    pub(in crate::model) weak: BTreeSet<PartId>,
}

/// The best combination found.
pub(in crate::model) struct Best {
    pub(in crate::model) of: Combination,
    /// What it costs by its parts, joints, looks and folding, mm of error.
    pub(in crate::model) cost_mm: f64,
    /// What is wrong with it.
    pub(in crate::model) trouble: Trouble,
    /// Which parts bump.
    pub(in crate::model) bumps: Vec<Bump>,
}

/// How many models a search looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::model) enum Effort {
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
    pub(super) fn looks(self, parts: usize) -> usize {
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

    /// Number of models in a row that are no better, after which a search for which `looks` may be tried ends.
    fn patience(self, looks: usize) -> usize {
        match self {
            Self::Brief => BRIEF_PATIENCE,
            Self::Short | Self::Long => PATIENCE + looks / PATIENCE_SHARE,
        }
    }
}

impl Choice {
    /// The best combination found. `bumps` tells what parts of one do to each other while they fold, `looks_mm` what the looks
    /// of some cost. The search starts from the best of the tree, or from `start` where that is better: the result is never
    /// worse than either.
    pub(in crate::model) fn best(
        &self,
        start: Option<Combination>,
        effort: Effort,
        bumps: &Bumping<'_>,
        looks_mm: &Looks<'_>,
    ) -> Result<Best, Cancelled> {
        let mut search = Search::new(Judge { choice: self, bumps, looks_mm })?;
        if let Some(start) = start.filter(|of| *of != search.best.of) {
            search.look_at(vec![start])?;
        }
        search.run(effort)?;
        Ok(search.found())
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

/// What whole models cost.
struct Judge<'a> {
    choice: &'a Choice,
    bumps: &'a Bumping<'a>,
    looks_mm: &'a Looks<'a>,
}

impl Judge<'_> {
    /// A look, which ends where the combination is known to cost more than `most_mm`.
    fn look(&self, of: Combination, most_mm: f64) -> Result<Look, Cancelled> {
        let looks_mm: f64 = (self.looks_mm)(std::slice::from_ref(&of)).iter().sum();
        let free_mm = self.choice.cost_mm(&of) + looks_mm;
        let is_enough = |bumps: &[Bump]| free_mm + harm_mm(bumps) >= most_mm;
        let bumps = (self.bumps)(&of, &is_enough)?;
        Ok(Look { cost_mm: free_mm + harm_mm(&bumps), is_whole: !is_enough(&bumps), of, bumps })
    }
}

/// Combinations that differ in one variable, each with that.
type Neighbours = BTreeSet<(usize, Combination)>;

/// What was looked at so far.
struct Search<'a> {
    judge: Judge<'a>,
    /// The choice with what candidates change about the looks near the best of the tree.
    near: Choice,
    /// What would be best if nothing bumped.
    unhindered: Combination,
    harms: Harms,
    seen: BTreeSet<Combination>,
    best: Look,
}

impl<'a> Search<'a> {
    fn new(judge: Judge<'a>) -> Result<Self, Cancelled> {
        let (unhindered, near) = judge.choice.best_looking(judge.looks_mm);
        let best = judge.look(unhindered.clone(), f64::INFINITY)?;
        let mut harms = Harms::new(&near.parents);
        harms.learn(&best.of, &best.bumps, best.is_whole);
        let seen = BTreeSet::from([unhindered.clone()]);
        Ok(Self { judge, near, unhindered, harms, seen, best })
    }

    /// Looks at what is promising, as long as that is worth it.
    fn run(&mut self, effort: Effort) -> Result<(), Cancelled> {
        let mut left = effort.looks(self.near.own.len());
        let patience = effort.patience(left);
        let mut idle = 0;
        let mut neighbours = self.neighbours();
        while idle < patience {
            let group = self.promising(&neighbours);
            if group.is_empty() || left < group.len() {
                break;
            }
            left -= group.len();
            idle += group.len();
            if self.look_at(group)? {
                idle = 0;
                neighbours = self.neighbours();
            }
        }
        Ok(())
    }

    /// Learns from combinations, and whether one of them is better than the best so far.
    fn look_at(&mut self, group: Vec<Combination>) -> Result<bool, Cancelled> {
        self.seen.extend(group.iter().cloned());
        let looks: Vec<Result<Look, Cancelled>> =
            group.into_par_iter().map(|of| self.judge.look(of, self.best.cost_mm)).collect();
        let looks = looks.into_iter().collect::<Result<Vec<Look>, Cancelled>>()?;
        looks.iter().for_each(|look| self.harms.learn(&look.of, &look.bumps, look.is_whole));
        let cheapest = looks.into_iter().min_by(|a, b| a.cost_mm.total_cmp(&b.cost_mm));
        let Some(better) = cheapest.filter(|other| other.cost_mm < self.best.cost_mm) else {
            return Ok(false);
        };
        self.best = better;
        Ok(true)
    }

    /// What a combination costs as far as is known.
    fn expected_mm(&self, of: &[usize]) -> f64 {
        self.near.cost_mm(of) + self.harms.expected_mm(of)
    }

    /// The cheapest combinations as far as is known: what differs from the best in one choice, and what is best from there.
    fn promising(&self, neighbours: &Neighbours) -> Vec<Combination> {
        let mut next: Vec<(f64, Combination)> =
            neighbours.iter().map(|(_, of)| (self.expected_mm(of), of.clone())).collect();
        let starts = neighbours.iter().zip(&next).map(|((held, _), (mm, of))| (*mm, Some(*held), of));
        let mut starts: Vec<(f64, Option<usize>, &Combination)> = starts.collect();
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        starts.truncate(STARTS);
        starts.extend([&self.best.of, &self.unhindered].map(|of| (0.0, None, of)));
        let descended = |&(_, held, of): &(f64, Option<usize>, &Combination)| {
            let of = self.near.descended(of.clone(), held, &self.harms);
            (self.expected_mm(&of), of)
        };
        let known: Vec<(f64, Combination)> = starts.par_iter().map(descended).collect();
        next.extend(known);
        next.retain(|(mm, of)| *mm < self.best.cost_mm && !self.seen.contains(of));
        next.sort_by(|a, b| a.0.total_cmp(&b.0));
        next.dedup_by(|a, b| a.1 == b.1);
        next.into_iter().take(AT_ONCE).map(|(_, of)| of).collect()
    }

    /// Variables of the parts that bump, and of those between them.
    fn involved(&self) -> BTreeSet<usize> {
        let Choice { parents, variable, .. } = &self.near;
        self.best.bumps.iter().flat_map(|bump| way(parents, bump.0)).map(|part| variable[part.0]).collect()
    }

    /// Combinations in which a part that bumps, or one between two that do, has another candidate, or one
    /// that differs from what would be best if nothing bumped.
    fn neighbours(&self) -> Neighbours {
        let (near, best) = (&self.near, &self.best.of);
        let mut neighbours = BTreeSet::new();
        let mut parts = self.involved();
        let is_hindered = |&part: &usize| near.variable[part] == part && best[part] != self.unhindered[part];
        parts.extend((0..best.len()).filter(is_hindered));
        for part in parts {
            for k in (0..near.own[part].len()).filter(|k| *k != best[part]) {
                let mut only = best.clone();
                only[part] = k;
                neighbours.insert((part, near.spread(only)));
                neighbours.insert((part, near.cheapest(&[(part, k)])));
            }
        }
        neighbours
    }

    fn found(self) -> Best {
        let bumping = self.involved().into_iter().map(PartId).collect();
        let Look { of, bumps, cost_mm, .. } = self.best;
        let is_weak = |pair: &&Pair| pair.costs[of[pair.parent]][of[pair.child]] > WEAK_PRICE_MM;
        let ends = |pair: &Pair| [pair.parent, pair.child].map(PartId);
        let weak = self.near.pairs.iter().filter(is_weak).flat_map(ends).collect();
        Best { of, cost_mm, trouble: Trouble { bumping, weak }, bumps }
    }
}
