//! Enumeration of the ways to fold a profile.
//!
//! Every segment faces up or down when flat (2^(M−1) ways), and one of them may be creased besides.
//! Walking down from the top panel, u'_i is known as soon as the segments above are chosen, so that
//! a branch ends where Eq. (1), u'_i >= u_i, is broken by more than closing the gap could mend, or
//! where the rest of the chain cannot reach the bottom panel any more. A creased way has gap 0
//! whatever its crease's place has to be, so the part below the crease is walked from the bottom
//! panel up, and every upper part is tried with every lower part. Only the ways with the least
//! price so far are kept; a branch also ends where its folds alone cost more.

use super::assignment::{FoldAssignment, Segment};
use super::weights::WEIGHTS;
use glam::DVec2;
use std::collections::BTreeSet;

/// Number of ways that are kept, to be closed and ranked.
const KEPT: usize = 96;
/// A gap larger than this share of the chain's length is not closed by moving vertices.
const MOST_GAP: f64 = 0.2;

/// What limits the search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limits<'a> {
    /// Segments that may not be creased: joint panels.
    pub(super) whole: &'a [bool],
    /// Least length of the two parts of a creased segment.
    pub(super) min_panel_mm: f64,
}

/// The most promising ways, in the order of their letters.
pub(super) fn promising(points: &[DVec2], limits: Limits<'_>) -> Vec<FoldAssignment> {
    let lengths: Vec<f64> = points.windows(2).map(|w| w[0].distance(w[1])).collect();
    let total_mm = lengths.iter().sum();
    let mut search = Search { points, lengths, total_mm, limits, kept: BTreeSet::new() };
    search.plain(&mut Vec::new(), points[0].x);
    for creased in 0..points.len() - 1 {
        if !limits.whole[creased] {
            search.creased_at(creased);
        }
    }
    let mut ways: Vec<FoldAssignment> = search.kept.into_iter().map(|kept| kept.way).collect();
    ways.sort();
    ways
}

/// A way with its price, cheapest first.
#[derive(Debug, Clone, PartialEq)]
struct Kept {
    price: f64,
    way: FoldAssignment,
}

impl Eq for Kept {}

impl Ord for Kept {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.price.total_cmp(&other.price).then_with(|| self.way.cmp(&other.way))
    }
}

impl PartialOrd for Kept {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// Part of a chain: what its segments do, and u' at its inner end.
struct Part {
    segments: Vec<Segment>,
    end_mm: f64,
}

struct Search<'a> {
    points: &'a [DVec2],
    lengths: Vec<f64>,
    total_mm: f64,
    limits: Limits<'a>,
    kept: BTreeSet<Kept>,
}

impl Search<'_> {
    fn count(&self) -> usize {
        self.lengths.len()
    }

    fn is_hopeless(&self, price: f64) -> bool {
        self.kept.len() == KEPT && self.kept.last().is_some_and(|worst| price > worst.price)
    }

    fn keep(&mut self, segments: Vec<Segment>, moved_mm: f64, is_creased: bool) {
        let Ok(way) = FoldAssignment::new(segments) else { return };
        let price = self.price(&way, moved_mm, is_creased);
        self.kept.insert(Kept { price, way });
        if self.kept.len() > KEPT {
            self.kept.pop_last();
        }
    }

    /// The part of the score that needs no closing, and a guess of the movement.
    fn price(&self, way: &FoldAssignment, moved_mm: f64, is_creased: bool) -> f64 {
        let turn = |(i, s): (usize, &Segment)| {
            let step = self.points[i + 1] - self.points[i];
            let alpha = libm::atan2(-step.y, step.x);
            let (up, down) = (alpha, std::f64::consts::PI - alpha);
            let angle = match (s.begins_up(), s.ends_up()) {
                (true, true) => up,
                (false, false) => down,
                _ => 0.5 * (up + down),
            };
            angle * self.lengths[i]
        };
        let turned: f64 = way.segments().iter().enumerate().map(turn).sum();
        WEIGHTS.fold * way.folds() as f64
            + WEIGHTS.crease * f64::from(u8::from(is_creased))
            + WEIGHTS.moved * moved_mm / self.total_mm
            + WEIGHTS.turn * turned / self.total_mm
    }

    /// Extends a way without a crease, segment by segment.
    fn plain(&mut self, chosen: &mut Vec<Segment>, u_mm: f64) {
        let i = chosen.len();
        let folds = chosen.windows(2).filter(|w| w[0] != w[1]).count();
        if self.is_hopeless(WEIGHTS.fold * folds as f64) {
            return;
        }
        let last_mm = self.points[self.count()].x;
        if i == self.count() {
            // The gap's gradient has a length of at most 2 for each inner vertex.
            let steepest = 2.0 * (self.count() as f64 - 1.0).max(1.0).sqrt();
            self.keep(chosen.clone(), (last_mm - u_mm).abs() / steepest, false);
            return;
        }
        let slack_mm = MOST_GAP * self.total_mm;
        let rest_mm: f64 = self.lengths[i..].iter().sum();
        if u_mm + rest_mm < last_mm - slack_mm || u_mm - rest_mm > last_mm + slack_mm {
            return;
        }
        for segment in [Segment::Up, Segment::Down] {
            let is_end =
                (i == 0 && segment == Segment::Down) || (i + 1 == self.count() && segment == Segment::Up);
            let next_mm = u_mm + if segment == Segment::Up { self.lengths[i] } else { -self.lengths[i] };
            if is_end || next_mm < self.points[i + 1].x - slack_mm {
                continue;
            }
            chosen.push(segment);
            self.plain(chosen, next_mm);
            chosen.pop();
        }
    }

    /// All ways with a crease in one segment.
    fn creased_at(&mut self, creased: usize) {
        let upper = self.parts(&(0..creased).collect::<Vec<_>>(), true);
        let lower = self.parts(&(creased + 1..self.count()).rev().collect::<Vec<_>>(), false);
        let length = self.lengths[creased];
        let (from, to) = (self.points[creased], self.points[creased + 1]);
        for (above, below) in upper.iter().flat_map(|a| lower.iter().map(move |b| (a, b))) {
            for segment in [Segment::UpDown, Segment::DownUp] {
                let sign = if segment.begins_up() { 1.0 } else { -1.0 };
                let first_mm = 0.5 * (length + sign * (below.end_mm - above.end_mm));
                let least_mm = first_mm.min(length - first_mm);
                let drawn = from.lerp(to, first_mm / length).x;
                if least_mm < self.limits.min_panel_mm || above.end_mm + sign * first_mm < drawn - ROUNDING_MM
                {
                    continue;
                }
                let mut segments = above.segments.clone();
                segments.push(segment);
                segments.extend(below.segments.iter().rev());
                self.keep(segments, 0.0, true);
            }
        }
    }

    /// All choices for the segments from one end of the chain, in the order `along`, that keep
    /// Eq. (1).
    fn parts(&self, along: &[usize], is_from_top: bool) -> Vec<Part> {
        let start = if is_from_top { self.points[0].x } else { self.points[self.count()].x };
        let mut parts = vec![Part { segments: Vec::new(), end_mm: start }];
        for (k, &i) in along.iter().enumerate() {
            let vertex = if is_from_top { i + 1 } else { i };
            let extended = parts.iter().flat_map(|part| {
                [Segment::Up, Segment::Down].into_iter().filter_map(move |segment| {
                    // The first segment faces up, the last one down.
                    let is_bad_end = k == 0 && (segment == Segment::Up) != is_from_top;
                    let outwards = (segment == Segment::Up) == is_from_top;
                    let end_mm = part.end_mm + if outwards { self.lengths[i] } else { -self.lengths[i] };
                    let is_inward = end_mm < self.points[vertex].x - ROUNDING_MM;
                    let segments = [&part.segments[..], &[segment]].concat();
                    (!is_bad_end && !is_inward).then_some(Part { segments, end_mm })
                })
            });
            parts = extended.collect();
        }
        parts
    }
}

/// Eq. (1) within rounding.
pub(super) const ROUNDING_MM: f64 = 1e-9;
