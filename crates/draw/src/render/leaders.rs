//! To which side of a picture each name goes, and to which place of its part its line leads: lines run over
//! no other part and do not cross, where that can be.

use super::part_map::{PartMap, Place};
use glam::DVec2;
use tatamu_core::geom::polygon;
use tatamu_core::model::PartId;

/// Height of capitals against the distance of lines of text.
const CAP_SHARE: f64 = 0.5;
/// What a crossing of two lines costs, and a line so near to the dot of another that it is taken for its own,
/// as mm over parts of others. Chosen by eye on a man, a teddy, a plane and an animal; no case bounds them.
const CROSSING: f64 = 30.0;
const NEAR_DOT: f64 = 15.0;
/// What a place at the border of its part costs, a mm that a line rises or falls, a mm of its length, and a
/// name more in one column than in the other.
const SHALLOW: f64 = 8.0;
const SLOPE: f64 = 0.3;
const LENGTH: f64 = 0.05;
const UNEVEN: f64 = 0.5;
/// What letters cost that are smaller than they might be: more than all the rest.
const SMALLER: f64 = 1000.0;
/// Rounds of changes, and the most names that are changed: the work grows with the cube of their number.
const ROUNDS: usize = 4;
const MOST: usize = 60;

/// A name and the part that it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Callout<'a> {
    /// What is written.
    pub name: &'a str,
    /// The part, as the map of the picture has it.
    pub part: PartId,
    /// Places in the picture that the line may lead to, the best first.
    pub places: Vec<Place>,
}

/// A name with its line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leader {
    /// Index of the name.
    pub(super) item: usize,
    pub(super) is_left: bool,
    /// Where the line begins, beside the name, and where it ends.
    pub(super) from: DVec2,
    pub(super) to: DVec2,
}

/// Names to be put into two columns beside a picture.
pub(super) struct Leaders<'a> {
    pub(super) items: &'a [Callout<'a>],
    pub(super) map: &'a PartMap<'a>,
    pub(super) column_mm: f64,
    /// Height of capitals, at most.
    pub(super) cap_mm: f64,
    /// Widths of the names, against the height of capitals, with the gap before the line.
    pub(super) widths: &'a [f64],
}

/// A side and a place, for one name.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Choice {
    is_left: bool,
    place: usize,
}

impl Leaders<'_> {
    /// Size of the picture with its columns, mm.
    pub(super) fn size_mm(&self) -> DVec2 {
        self.map.size_mm() + DVec2::X * (2.0 * self.column_mm)
    }

    /// All lines, and the height of capitals.
    pub(super) fn arranged(&self) -> (Vec<Leader>, f64) {
        let mut choices = self.by_side();
        if self.items.len() <= MOST {
            let mut least = self.cost(&choices);
            for _ in 0..ROUNDS {
                let before = least;
                for item in 0..self.items.len() {
                    self.improve(&mut choices, item, &mut least);
                }
                if least >= before {
                    break;
                }
            }
        }
        self.lines(&choices)
    }

    /// The best place of each part, the left half of them to the left.
    fn by_side(&self) -> Vec<Choice> {
        let x_of = |k: usize| self.items[k].places[0].at_mm.x;
        let mut by_x: Vec<usize> = (0..self.items.len()).collect();
        by_x.sort_by(|&a, &b| x_of(a).total_cmp(&x_of(b)).then(self.items[a].name.cmp(self.items[b].name)));
        let in_left_half = by_x.iter().filter(|&&k| x_of(k) < self.map.size_mm().x / 2.0).count();
        let half = by_x.len() / 2;
        let left = in_left_half.clamp(half.saturating_sub(2), half + 2).min(by_x.len());
        let mut choices = vec![Choice { is_left: false, place: 0 }; by_x.len()];
        for &k in &by_x[..left] {
            choices[k].is_left = true;
        }
        choices
    }

    /// Changes one name to what costs least.
    fn improve(&self, choices: &mut [Choice], item: usize, least: &mut f64) {
        let mut best = choices[item];
        for place in 0..self.items[item].places.len() {
            for is_left in [true, false] {
                choices[item] = Choice { is_left, place };
                let cost = self.cost(choices);
                if cost < *least - 1e-6 {
                    *least = cost;
                    best = choices[item];
                }
            }
        }
        choices[item] = best;
    }

    fn cost(&self, choices: &[Choice]) -> f64 {
        let (lines, cap_mm) = self.lines(choices);
        let left = choices.iter().filter(|choice| choice.is_left).count();
        let uneven = choices.len().abs_diff(2 * left) as f64;
        let mut cost = UNEVEN * uneven + SMALLER * (1.0 - cap_mm / self.cap_mm);
        for (k, line) in lines.iter().enumerate() {
            let callout = &self.items[line.item];
            let shift = DVec2::X * self.column_mm;
            cost += self.map.foreign_mm(line.from - shift, line.to - shift, callout.part);
            cost += SHALLOW * (1.0 - callout.places[choices[line.item].place].worth);
            cost += SLOPE * (line.to.y - line.from.y).abs() + LENGTH * line.from.distance(line.to);
            for (j, other) in lines.iter().enumerate().filter(|&(j, _)| j != k) {
                if j > k && are_crossing(line, other) {
                    cost += CROSSING;
                }
                if polygon::distance_to_segment(other.to, line.from, line.to) < self.cap_mm {
                    cost += NEAR_DOT;
                }
            }
        }
        cost
    }

    /// The lines of a choice, each name level with its place as far as the others leave room.
    fn lines(&self, choices: &[Choice]) -> (Vec<Leader>, f64) {
        let size = self.size_mm();
        let to = |item: usize| self.items[item].places[choices[item].place].at_mm + DVec2::X * self.column_mm;
        let columns = [true, false].map(|is_left| {
            let mut column: Vec<usize> =
                (0..choices.len()).filter(|&k| choices[k].is_left == is_left).collect();
            column.sort_by(|&a, &b| {
                to(b).y.total_cmp(&to(a).y).then(self.items[a].name.cmp(self.items[b].name))
            });
            column
        });
        let most = columns[0].len().max(columns[1].len()).max(1);
        let step = (self.cap_mm / CAP_SHARE).min(size.y / most as f64);
        let cap_mm = step * CAP_SHARE;
        let mut lines = Vec::with_capacity(choices.len());
        for (column, is_left) in columns.into_iter().zip([true, false]) {
            let wanted: Vec<f64> = column.iter().map(|&item| to(item).y).collect();
            for (item, y) in column.into_iter().zip(heights(&wanted, size.y, step)) {
                let gap_mm = (self.widths[item] * cap_mm).min(self.column_mm);
                let x = if is_left { gap_mm } else { size.x - gap_mm };
                lines.push(Leader { item, is_left, from: DVec2::new(x, y), to: to(item) });
            }
        }
        (lines, cap_mm)
    }
}

/// Heights of names, the highest first: as near to those that are wanted as a distance of `step` allows.
fn heights(wanted: &[f64], height: f64, step: f64) -> Vec<f64> {
    let mut heights: Vec<f64> = Vec::with_capacity(wanted.len());
    for y in wanted {
        let top = heights.last().map_or(height - step / 2.0, |above| above - step);
        heights.push(y.min(top));
    }
    let mut bottom = step / 2.0;
    for h in heights.iter_mut().rev() {
        *h = h.max(bottom);
        bottom = *h + step;
    }
    heights
}

fn are_crossing(a: &Leader, b: &Leader) -> bool {
    let side = |line: &Leader, p: DVec2| (line.to - line.from).perp_dot(p - line.from);
    side(a, b.from) * side(a, b.to) < 0.0 && side(b, a.from) * side(b, a.to) < 0.0
}
