//! Making a way to fold exact: the gap of Eq. (2) becomes 0.
//!
//! A creased way closes by the place of its crease, which moves no vertex: Σ δ_i l_i falls by 2x
//! when x of a segment turns over. Any other way closes by the least movement of the inner
//! vertices, the sum of squares being measured: with the constraints c linear about the last
//! iterate x_k, the nearest point to the drawn x_0 on their zero is x_0 + Jᵀλ, where
//! J Jᵀ λ = J (x_k − x_0) − c(x_k). This is Newton's iteration on the Lagrangian with its Hessian
//! taken as the identity; the last steps go straight back along the gradients. The constraints are
//! the gap and, where the nearest shape breaks it, Eq. (1): the hinge that breaks it most is held
//! to u'_i = u_i, and so on until none does.
//!
//! Boards are shorter at their hinges than the drawn segments; by how much more their chain then
//! leads outwards is their *excess*, and the gap that is closed is that of the boards.

use super::assignment::FoldAssignment;
use crate::component::Profile;
use glam::DVec2;

/// What is left of constraints, as a share of the chain's length: rounding.
const EXACT: f64 = 1e-13;
const MOST_STEPS: usize = 40;
/// Steps that only close the gap.
const LAST_STEPS: usize = 4;
/// Squares of gradients, less what other constraints have in common with them, below this hold
/// nothing: a straight chain cannot be closed.
const LEAST_PIVOT: f64 = 1e-6;

/// A profile that folds flat exactly.
#[derive(Debug, Clone)]
pub(super) struct Closed {
    pub(super) profile: Profile,
    /// The drawn segment that each of its segments is, or is a part of.
    pub(super) source: Vec<usize>,
    /// How far a vertex was moved, at most.
    pub(super) moved_mm: f64,
}

/// Closes a way to fold a drawn profile; nothing where it cannot be done.
pub(super) fn close(points: &[DVec2], way: &FoldAssignment, excess_mm: f64) -> Option<Closed> {
    let faces_up = way.faces_up();
    let Some(creased) = way.creased() else {
        let moved = least_movement(points, &faces_up, excess_mm)?;
        let moved_mm = points.iter().zip(&moved).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        let source = (0..faces_up.len()).collect();
        return Some(Closed { profile: Profile::folded(moved, faces_up).ok()?, source, moved_mm });
    };
    let share = crease_share(points, way, creased, excess_mm);
    if !(share > 0.0 && share < 1.0) {
        return None;
    }
    let mut with_crease = points.to_vec();
    with_crease.insert(creased + 1, points[creased].lerp(points[creased + 1], share));
    let source = (0..faces_up.len()).map(|i| if i > creased { i - 1 } else { i }).collect();
    Some(Closed { profile: Profile::folded(with_crease, faces_up).ok()?, source, moved_mm: 0.0 })
}

/// Where the crease divides its segment, from 0, its upper end, to 1; outside of that range where
/// the other segments leave too much for it.
fn crease_share(points: &[DVec2], way: &FoldAssignment, creased: usize, excess_mm: f64) -> f64 {
    let length = |i: usize| points[i].distance(points[i + 1]);
    let others = (0..points.len() - 1).filter(|&i| i != creased);
    let advance: f64 =
        others.map(|i| if way.segments()[i].begins_up() { length(i) } else { -length(i) }).sum();
    let wanted = points[points.len() - 1].x - points[0].x - advance - excess_mm;
    let sign = if way.segments()[creased].begins_up() { 1.0 } else { -1.0 };
    0.5 * (1.0 + sign * wanted / length(creased))
}

/// A flat chain: how far out u' of each vertex is, from the top panel down, and its gradient.
struct Flat<'a> {
    points: &'a [DVec2],
    faces_up: &'a [bool],
    excess_mm: f64,
}

impl Flat<'_> {
    fn last(&self) -> usize {
        self.points.len() - 1
    }

    fn advance(&self, i: usize) -> f64 {
        let length = self.points[i].distance(self.points[i + 1]);
        if self.faces_up[i] { length } else { -length }
    }

    /// u'_k − u_k: Eq. (1) for an inner vertex; for the last one −ε of Eq. (2).
    fn beyond(&self, k: usize) -> f64 {
        let excess_mm = if k == self.last() { self.excess_mm } else { 0.0 };
        self.points[0].x + (0..k).map(|i| self.advance(i)).sum::<f64>() - self.points[k].x + excess_mm
    }

    /// The gradient of [`Flat::beyond`] in all inner vertices; 0 for the ends, which stay.
    fn gradient(&self, k: usize) -> Vec<DVec2> {
        let along = |i: usize| {
            let unit = (self.points[i + 1] - self.points[i]).normalize_or_zero();
            if self.faces_up[i] { unit } else { -unit }
        };
        let of_vertex = |m: usize| match m {
            0 => DVec2::ZERO,
            m if m == self.last() || m > k => DVec2::ZERO,
            m if m == k => along(m - 1) - DVec2::X,
            m => along(m - 1) - along(m),
        };
        (0..=self.last()).map(of_vertex).collect()
    }

    /// The inner vertex that breaks Eq. (1) most, if one does.
    fn innermost(&self) -> Option<usize> {
        let broken = (1..self.last()).map(|k| (self.beyond(k), k)).filter(|b| b.0 < -INWARD_MM);
        broken.min_by(|a, b| a.0.total_cmp(&b.0)).map(|b| b.1)
    }
}

/// Eq. (1) is kept within this.
const INWARD_MM: f64 = 1e-10;

fn dot(a: &[DVec2], b: &[DVec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

/// The nearest points, in the sum of squares, with gap 0 and no vertex inside of where it stands.
fn least_movement(drawn: &[DVec2], faces_up: &[bool], excess_mm: f64) -> Option<Vec<DVec2>> {
    let mut held = vec![drawn.len() - 1];
    loop {
        let points = nearest(drawn, faces_up, excess_mm, &held)?;
        match (Flat { points: &points, faces_up, excess_mm }).innermost() {
            None => return Some(points),
            Some(k) if held.contains(&k) => return None,
            Some(k) => held.push(k),
        }
    }
}

/// The nearest points at which u' = u for the vertices `held`.
fn nearest(drawn: &[DVec2], faces_up: &[bool], excess_mm: f64, held: &[usize]) -> Option<Vec<DVec2>> {
    let length: f64 = drawn.windows(2).map(|w| w[0].distance(w[1])).sum();
    let mut points = drawn.to_vec();
    for step in 0..MOST_STEPS + LAST_STEPS {
        let flat = Flat { points: &points, faces_up, excess_mm };
        let values: Vec<f64> = held.iter().map(|&k| flat.beyond(k)).collect();
        let is_met = values.iter().all(|c| c.abs() <= EXACT * length);
        if is_met && (step == 0 || step >= MOST_STEPS) {
            break;
        }
        let slopes: Vec<Vec<DVec2>> = held.iter().map(|&k| flat.gradient(k)).collect();
        let is_last = step >= MOST_STEPS;
        let way: Vec<DVec2> = points.iter().zip(drawn).map(|(p, q)| *p - *q).collect();
        let wanted = slopes.iter().zip(&values).map(|(s, c)| if is_last { -c } else { dot(s, &way) - c });
        let squares = slopes.iter().map(|a| slopes.iter().map(|b| dot(a, b)).collect()).collect();
        let factors = solved(squares, wanted.collect())?;
        let base = if is_last { points.clone() } else { drawn.to_vec() };
        points = base;
        for (slope, factor) in slopes.iter().zip(factors) {
            points.iter_mut().zip(slope).for_each(|(p, s)| *p += *s * factor);
        }
    }
    let flat = Flat { points: &points, faces_up, excess_mm };
    held.iter().all(|&k| flat.beyond(k).abs() <= 1e-12 * length).then_some(points)
}

/// Solves a symmetric, positive definite system by Gauss's elimination, which needs no pivots then;
/// nothing where it is singular.
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    for k in 0..n {
        if matrix[k][k] < LEAST_PIVOT {
            return None;
        }
        let pivot = matrix[k].clone();
        for (row, value) in matrix[k + 1..].iter_mut().zip(k + 1..) {
            let factor = row[k] / pivot[k];
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= factor * p);
            right[value] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|column| matrix[k][column] * right[column]).sum();
        right[k] = (right[k] - known) / matrix[k][k];
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<DVec2> {
        list.iter().map(|&p| p.into()).collect()
    }

    #[test]
    fn a_straight_wall_is_creased_in_its_middle() {
        let closed = close(&points(&[(0.0, 60.0), (0.0, 0.0)]), &"^".parse().unwrap(), 0.0).unwrap();
        assert_eq!(closed.profile.points()[1], DVec2::new(0.0, 30.0));
        assert_eq!(closed.source, [0, 0]);
    }

    /// The valleys of this bellows would come to lie a little farther in than they stand.
    #[test]
    fn hinges_are_held_out_where_they_stand() {
        let drawn = points(&[
            (0.0, 66.0),
            (16.0, 54.0),
            (6.0, 44.0),
            (22.0, 32.0),
            (12.0, 22.0),
            (28.0, 10.0),
            (18.0, 0.0),
        ]);
        let closed = close(&drawn, &"ududud".parse().unwrap(), 0.0).unwrap();
        assert!(closed.moved_mm > 0.01 && closed.moved_mm < 0.5, "{}", closed.moved_mm);
        let flat = closed.profile.flat_mm();
        for (flat, p) in flat.iter().zip(closed.profile.points()) {
            assert!(*flat >= p.x - 1e-9, "{flat} {p}");
        }
        assert!(closed.profile.gap_mm().abs() < 1e-10);
    }

    #[test]
    fn a_vertex_moves_onto_its_hyperbola_the_shortest_way() {
        // One inner vertex; any other point of its hyperbola is farther from where it was drawn.
        let drawn = points(&[(0.0, 50.0), (25.0, 20.0), (5.0, 0.0)]);
        let closed = close(&drawn, &"ud".parse().unwrap(), 0.0).unwrap();
        let found = closed.profile.points()[1];
        assert!(closed.profile.gap_mm().abs() < 1e-10);
        assert!((found.distance(drawn[1]) - closed.moved_mm).abs() < 1e-12);
        let gap_at = |p: DVec2| p.distance(drawn[0]) - p.distance(drawn[2]) - 5.0;
        for k in 0..1000 {
            let direction = DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 1000.0);
            let nearer = drawn[1] + direction * (0.999 * closed.moved_mm);
            assert!(gap_at(nearer) * gap_at(drawn[1]) > 0.0, "reached at {nearer}");
        }
    }
}
