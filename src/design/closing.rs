//! Making a way to fold exact: the gap of Eq. (2) becomes 0.
//!
//! A creased way closes by the place of its crease, which moves no vertex: Σ δ_i l_i falls by 2x
//! when x of a segment turns over. Any other way closes by the least movement of the inner
//! vertices, the sum of squares being measured: with the gap linear about the last iterate x_k,
//! the nearest point to the drawn x_0 on its zero is x_0 + λ ∇ε(x_k), where
//! λ = (∇ε·(x_k − x_0) − ε(x_k)) / |∇ε|². This is Newton's iteration on the Lagrangian with its
//! Hessian taken as the identity; the last steps go straight back along the gradient.

use super::way::Way;
use crate::component::Profile;
use glam::DVec2;

/// The gap that is left, as a share of the chain's length: rounding.
const EXACT: f64 = 1e-13;
const MOST_STEPS: usize = 60;
/// Steps that only close the gap.
const LAST_STEPS: usize = 4;
/// A gradient shorter than this cannot close a gap: the chain is straight.
const LEAST_GRADIENT: f64 = 1e-3;

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
pub(super) fn close(points: &[DVec2], way: &Way) -> Option<Closed> {
    let faces_up = way.faces_up();
    let Some(creased) = way.creased() else {
        let moved = least_movement(points, &faces_up)?;
        let moved_mm = points.iter().zip(&moved).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        let source = (0..faces_up.len()).collect();
        return Some(Closed { profile: Profile::folded(moved, faces_up).ok()?, source, moved_mm });
    };
    let share = crease_share(points, way, creased);
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
fn crease_share(points: &[DVec2], way: &Way, creased: usize) -> f64 {
    let length = |i: usize| points[i].distance(points[i + 1]);
    let others = (0..points.len() - 1).filter(|&i| i != creased);
    let advance: f64 =
        others.map(|i| if way.segments()[i].begins_up() { length(i) } else { -length(i) }).sum();
    let wanted = points[points.len() - 1].x - points[0].x - advance;
    let sign = if way.segments()[creased].begins_up() { 1.0 } else { -1.0 };
    0.5 * (1.0 + sign * wanted / length(creased))
}

/// ε of Eq. (2).
fn gap(points: &[DVec2], faces_up: &[bool]) -> f64 {
    let advance = |(w, up): (&[DVec2], &bool)| if *up { w[0].distance(w[1]) } else { -w[0].distance(w[1]) };
    let advances: f64 = points.windows(2).zip(faces_up).map(advance).sum();
    points[points.len() - 1].x - points[0].x - advances
}

/// ∂ε/∂p of all inner vertices; 0 for the ends, which stay.
fn gradient(points: &[DVec2], faces_up: &[bool]) -> Vec<DVec2> {
    let along = |i: usize| {
        let unit = (points[i + 1] - points[i]).normalize_or_zero();
        if faces_up[i] { unit } else { -unit }
    };
    let last = points.len() - 1;
    (0..=last).map(|k| if k == 0 || k == last { DVec2::ZERO } else { along(k) - along(k - 1) }).collect()
}

fn dot(a: &[DVec2], b: &[DVec2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

/// The nearest points, in the sum of squares, with gap 0.
fn least_movement(drawn: &[DVec2], faces_up: &[bool]) -> Option<Vec<DVec2>> {
    let length: f64 = drawn.windows(2).map(|w| w[0].distance(w[1])).sum();
    let mut points = drawn.to_vec();
    for step in 0..MOST_STEPS + LAST_STEPS {
        let epsilon = gap(&points, faces_up);
        if epsilon.abs() <= EXACT * length && (step == 0 || step >= MOST_STEPS) {
            break;
        }
        let slope = gradient(&points, faces_up);
        let square = dot(&slope, &slope);
        if square < LEAST_GRADIENT * LEAST_GRADIENT {
            return None;
        }
        let (base, factor) = if step < MOST_STEPS {
            let way: Vec<DVec2> = points.iter().zip(drawn).map(|(p, q)| *p - *q).collect();
            (drawn, (dot(&slope, &way) - epsilon) / square)
        } else {
            (&points[..], -epsilon / square)
        };
        points = base.iter().zip(&slope).map(|(p, s)| *p + *s * factor).collect();
    }
    (gap(&points, faces_up).abs() <= 1e-12 * length).then_some(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<DVec2> {
        list.iter().map(|&p| p.into()).collect()
    }

    #[test]
    fn a_straight_wall_is_creased_in_its_middle() {
        let closed = close(&points(&[(0.0, 60.0), (0.0, 0.0)]), &"^".parse().unwrap()).unwrap();
        assert_eq!(closed.profile.points()[1], DVec2::new(0.0, 30.0));
        assert_eq!(closed.source, [0, 0]);
    }

    #[test]
    fn a_vertex_moves_onto_its_hyperbola_the_shortest_way() {
        // One inner vertex; any other point of its hyperbola is farther from where it was drawn.
        let drawn = points(&[(0.0, 50.0), (25.0, 20.0), (5.0, 0.0)]);
        let closed = close(&drawn, &"ud".parse().unwrap()).unwrap();
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
