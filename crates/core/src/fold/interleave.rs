//! Steps of several components in turn, where no order of whole ones is free of bumps.
//!
//! A plan is a path from "all deployed" to "all flat" in a lattice, on which no component ever turns
//! back. Of a pair that bumps, the two and those between them go by levels, in any turn; the others
//! keep the steps that they have and their order, so that they make one more axis of the lattice. On
//! it the cheapest path is found exactly (Dijkstra 1959). What does not help is not taken, so that a
//! plan only gets better; bumps are looked at one after another, the deepest first.

use super::clashes::{Clash, ClashFinder, LEAST_GAIN_MM};
use super::order::replay;
use super::step::{FLAT, Level, Move};
use crate::model::PartId;
use crate::progress::{Cancelled, Progress};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

/// Most components that fold in turn, and their levels: first halves for all that are involved in a bump,
/// then finer levels for fewer. Two that must move together do so by eighths.
const LATTICES: [(usize, Level); 3] = [(5, 2), (3, 4), (2, 8)];
/// Bumps of up to this many times the paper's thickness, half a mm, are left to the hand: a second step is
/// more trouble than to bend a panel aside.
const WORTH_TURNS: f64 = 2.0;
/// Most places of a lattice: enough for 5 components by halves in a model of 18 parts.
const MOST_PLACES: usize = 4_500;
/// A lattice is given up if it takes more sweeps than this.
const MOST_SWEEPS: usize = 120;
/// Most bumps that are tried. A model of usual size has fewer; a bear in 100 parts has 300, and nobody folds it anyway.
const MOST_BUMPS: usize = 16;
/// A plan is changed for another one that does less harm by more than this for each step that it has
/// more, or for one without bumps: ten steps that still bump by 4 instead of 6 mm help nobody.
const GAIN_FOR_STEP_MM: f64 = 0.3;
/// What gets less deep than the paper is thick counts by this share of its depth.
const RUB_PRICE: f64 = 0.1;

/// Makes moves of a tree better where they bump by more than the paper's thickness.
pub(super) fn interleaved(
    finder: &mut ClashFinder<'_>,
    mut moves: Vec<Move>,
    parts: usize,
    thickness_mm: f64,
    progress: &dyn Progress,
) -> Result<Vec<Move>, Cancelled> {
    let mut looked_at = BTreeSet::new();
    while looked_at.len() < MOST_BUMPS {
        let clashes = replay(finder, &moves, parts);
        let Some(worst) = worst_bump(&clashes, thickness_mm, &looked_at) else { break };
        looked_at.insert(worst.parts);
        let involved = finder.involved(&worst);
        for (most, levels) in LATTICES {
            let turns = &involved[..involved.len().min(most)];
            let Some(lattice) = Lattice::new(&moves, turns, levels, parts) else { continue };
            let Some(path) = lattice.cheapest(finder, thickness_mm, progress)? else { continue };
            let left = replay(finder, &path, parts);
            let gain_mm =
                harm_mm(&replay(finder, &moves, parts), thickness_mm) - harm_mm(&left, thickness_mm);
            let more = path.len().saturating_sub(moves.len());
            let is_free = left.iter().all(|clash| clash.depth_mm <= thickness_mm);
            let price_mm = if is_free { 0.0 } else { GAIN_FOR_STEP_MM * more as f64 };
            if gain_mm <= LEAST_GAIN_MM + price_mm {
                continue;
            }
            moves = path;
            if !left.iter().any(|clash| clash.parts == worst.parts && clash.depth_mm > thickness_mm) {
                break;
            }
        }
    }
    Ok(moves)
}

fn worst_bump(clashes: &[Clash], thickness_mm: f64, looked_at: &BTreeSet<[PartId; 2]>) -> Option<Clash> {
    let least_mm = WORTH_TURNS * thickness_mm;
    let bumps = clashes.iter().filter(|c| c.depth_mm > least_mm && !looked_at.contains(&c.parts));
    bumps.copied().max_by(|a, b| a.depth_mm.total_cmp(&b.depth_mm).then(b.parts.cmp(&a.parts)))
}

fn price_mm(clash: &Clash, thickness_mm: f64) -> f64 {
    (clash.depth_mm - thickness_mm).max(0.0) + RUB_PRICE * clash.depth_mm
}

/// Sum over pairs of what their deepest clash costs.
fn harm_mm(clashes: &[Clash], thickness_mm: f64) -> f64 {
    let mut of_pair: BTreeMap<[PartId; 2], f64> = BTreeMap::new();
    for clash in clashes {
        let worst_mm = of_pair.entry(clash.parts).or_insert(0.0);
        *worst_mm = worst_mm.max(price_mm(clash, thickness_mm));
    }
    of_pair.values().sum()
}

/// What a path costs: harm in nm, then the number of steps.
type Cost = (u64, u32);

/// A place on the lattice: how many of the others' moves are done, at which level the ones in turn
/// are, and which of these moved last; their number where another one did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    done: usize,
    levels: [Level; LATTICES[0].0],
    last: usize,
}

struct Lattice {
    /// Components that move in turn.
    turns: Vec<PartId>,
    /// Number of levels above 0, and how far it is from one to the next.
    count: usize,
    stride: Level,
    /// Moves of the others.
    others: Vec<Move>,
    /// Levels of all components after each number of these moves.
    others_at: Vec<Vec<Level>>,
}

impl Lattice {
    /// None where it would be too large.
    fn new(moves: &[Move], turns: &[PartId], count: Level, parts: usize) -> Option<Self> {
        let others: Vec<Move> = moves.iter().filter(|step| !turns.contains(&step.part)).copied().collect();
        let places = (usize::from(count) + 1).pow(turns.len() as u32) * (others.len() + 1);
        if places > MOST_PLACES {
            return None;
        }
        let mut levels = vec![0; parts];
        let mut others_at = vec![levels.clone()];
        for step in &others {
            levels[step.part.0] = step.to;
            others_at.push(levels.clone());
        }
        let (count, stride) = (usize::from(count), FLAT / count);
        Some(Self { turns: turns.to_vec(), count, stride, others, others_at })
    }

    /// The path that does the least harm, and of these one of few steps; none where that takes too
    /// many sweeps.
    fn cheapest(
        &self,
        finder: &mut ClashFinder<'_>,
        thickness_mm: f64,
        progress: &dyn Progress,
    ) -> Result<Option<Vec<Move>>, Cancelled> {
        let most_sweeps = finder.sweeps() + MOST_SWEEPS;
        let start = Place { done: 0, levels: Default::default(), last: self.turns.len() };
        let mut best: Vec<Option<(Cost, Option<usize>)>> = vec![None; self.place_count()];
        let mut settled = vec![false; best.len()];
        let mut open = BinaryHeap::new();
        best[self.index(&start)] = Some(((0, 0), None));
        open.push(Reverse(((0, 0), self.index(&start))));
        while let Some(Reverse((cost, index))) = open.pop() {
            if std::mem::replace(&mut settled[index], true) {
                continue;
            }
            let place = self.place(index);
            if self.is_end(&place) {
                return Ok(Some(self.path(&best, index)));
            }
            progress.check()?;
            for (next, step) in self.next(&place) {
                if finder.sweeps() > most_sweeps {
                    return Ok(None);
                }
                let clashes = finder.all_clashes(step, &self.levels(&place));
                let harm_mm: f64 = clashes.iter().map(|clash| price_mm(clash, thickness_mm)).sum();
                let is_new = next.last != place.last || next.last == self.turns.len();
                let reached: Cost = (cost.0 + (harm_mm * 1e6).round() as u64, cost.1 + u32::from(is_new));
                let to = self.index(&next);
                if best[to].is_none_or(|(known, _)| reached < known) {
                    best[to] = Some((reached, Some(index)));
                    open.push(Reverse((reached, to)));
                }
            }
        }
        Ok(None)
    }

    fn is_end(&self, place: &Place) -> bool {
        place.done == self.others.len() && self.turns.iter().zip(place.levels).all(|(_, level)| level == FLAT)
    }

    /// The next places, each with the move that leads to it.
    fn next<'p>(&'p self, place: &'p Place) -> impl Iterator<Item = (Place, Move)> + 'p {
        let other = self.others.get(place.done);
        let other =
            other.map(|&step| (Place { done: place.done + 1, last: self.turns.len(), ..*place }, step));
        let in_turn = self.turns.iter().enumerate().filter_map(move |(k, &part)| {
            let from = place.levels[k];
            let to = from + self.stride;
            let mut next = Place { last: k, ..*place };
            next.levels[k] = to;
            (to <= FLAT).then_some((next, Move { part, from, to }))
        });
        other.into_iter().chain(in_turn)
    }

    fn levels(&self, place: &Place) -> Vec<Level> {
        let mut levels = self.others_at[place.done].clone();
        self.turns.iter().zip(place.levels).for_each(|(part, level)| levels[part.0] = level);
        levels
    }

    fn place_count(&self) -> usize {
        (self.turns.len() + 1) * (self.others.len() + 1) * (self.count + 1).pow(self.turns.len() as u32)
    }

    fn index(&self, place: &Place) -> usize {
        let first = place.last * (self.others.len() + 1) + place.done;
        let levels = place.levels[..self.turns.len()].iter();
        levels.fold(first, |index, level| index * (self.count + 1) + usize::from(level / self.stride))
    }

    fn place(&self, mut index: usize) -> Place {
        let mut place = Place { done: 0, levels: Default::default(), last: 0 };
        for k in (0..self.turns.len()).rev() {
            place.levels[k] = (index % (self.count + 1)) as Level * self.stride;
            index /= self.count + 1;
        }
        (place.last, place.done) = (index / (self.others.len() + 1), index % (self.others.len() + 1));
        place
    }

    /// The moves to a place, those of one component after another put together.
    fn path(&self, best: &[Option<(Cost, Option<usize>)>], end: usize) -> Vec<Move> {
        let before = |index: &usize| best[*index].and_then(|(_, from)| from);
        let mut places: Vec<Place> =
            std::iter::successors(Some(end), before).map(|k| self.place(k)).collect();
        places.reverse();
        let mut moves: Vec<Move> = Vec::new();
        for pair in places.windows(2) {
            let (from, to) = (&pair[0], &pair[1]);
            let step = match self.turns.get(to.last) {
                None => self.others[from.done],
                Some(&part) => Move { part, from: from.levels[to.last], to: to.levels[to.last] },
            };
            match moves.last_mut() {
                Some(last) if last.part == step.part => last.to = step.to,
                _ => moves.push(step),
            }
        }
        moves
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_numbers_of_their_own() {
        let moves: Vec<Move> = [3, 0, 2, 1].map(|part| Move::whole(PartId(part))).to_vec();
        let lattice = Lattice::new(&moves, &[PartId(0), PartId(1)], 4, 4).unwrap();
        let mut seen = 0;
        for index in 0..lattice.place_count() {
            let place = lattice.place(index);
            assert_eq!(lattice.index(&place), index);
            seen += usize::from(lattice.is_end(&place));
        }
        assert_eq!(seen, 3, "the end is reached by either of the two, or by another");
        assert!(Lattice::new(&moves, &[0, 1, 2, 3].map(PartId), 8, 4).is_none(), "too large");
    }
}
