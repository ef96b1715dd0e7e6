//! The part in the middle, which the others hang on.

use super::Segmentation;
use super::contact::near_contacts;
use crate::mesh::Mesh;
use std::collections::{BTreeSet, VecDeque};

/// The part in the middle has at least this share of the area of the biggest that it could be: a neck
/// between a head and a trunk is not what they hang on.
const LEAST_SHARE: f64 = 0.25;

/// The part from which it is the fewest joints to the others, where each counts by the root of its
/// area; the biggest of those with the same sum. With a mirror plane it is one across it, if any is:
/// what hangs on it is symmetric then.
pub(super) fn middle(mesh: &Mesh, segmentation: &Segmentation, areas: &[f64]) -> usize {
    let twins = segmentation.twins(mesh);
    let is_across = |&k: &usize| twins.as_ref().is_some_and(|twins| twins[k].0 as usize == k);
    let all = 0..areas.len();
    let mut candidates: Vec<usize> = all.clone().filter(is_across).collect();
    if candidates.is_empty() {
        candidates = all.collect();
    }
    let largest = candidates.iter().map(|&k| areas[k]).fold(0.0, f64::max);
    candidates.retain(|&k| areas[k] >= LEAST_SHARE * largest);
    let neighbours = neighbours(mesh, segmentation);
    let weights: Vec<f64> = areas.iter().map(|area| area.sqrt()).collect();
    let far = |&k: &usize| -> f64 {
        let steps = steps(&neighbours, k);
        // What does not hang together counts as farther than anything.
        weights.iter().zip(steps).map(|(weight, s)| weight * s.unwrap_or(areas.len()) as f64).sum()
    };
    let nearest = candidates.iter().map(|k| (far(k), *k));
    let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0).then(areas[b.1].total_cmp(&areas[a.1])));
    nearest.map_or(0, |(_, k)| k)
}

/// The parts that each one touches.
fn neighbours(mesh: &Mesh, segmentation: &Segmentation) -> Vec<BTreeSet<usize>> {
    let mut neighbours = vec![BTreeSet::new(); segmentation.count()];
    let touching = near_contacts(mesh, segmentation).into_keys();
    for (a, b) in segmentation.borders(mesh).into_keys().chain(touching) {
        neighbours[a.0 as usize].insert(b.0 as usize);
        neighbours[b.0 as usize].insert(a.0 as usize);
    }
    neighbours
}

/// How many joints each part is away; `None` for those that do not hang together with the first.
fn steps(neighbours: &[BTreeSet<usize>], first: usize) -> Vec<Option<usize>> {
    let mut steps = vec![None; neighbours.len()];
    steps[first] = Some(0);
    let mut queue = VecDeque::from([(first, 0)]);
    while let Some((part, step)) = queue.pop_front() {
        for &next in &neighbours[part] {
            if steps[next].is_none() {
                steps[next] = Some(step + 1);
                queue.push_back((next, step + 1));
            }
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::super::SegmentId;
    use super::super::shapes::{balls_in_a_row, mesh};
    use super::*;

    /// Balls along z with a radius of each, a ball apart from the next by less than they measure.
    fn row(radii: &[f64]) -> (Mesh, Segmentation) {
        let mut balls: Vec<(f64, f64)> = Vec::new();
        for &radius in radii {
            let z = balls.last().map_or(0.0, |last| last.0 + 0.85 * (last.1 + radius));
            balls.push((z, radius));
        }
        let row = mesh(&balls_in_a_row(&balls, 60, 24));
        let ball = |f: usize| {
            let z = row.corners(f).iter().map(|c| c.z).sum::<f64>() / 3.0;
            let nearest = |a: &usize, b: &usize| {
                let gap = |k: usize| (z - balls[k].0).abs() - balls[k].1;
                gap(*a).total_cmp(&gap(*b))
            };
            SegmentId((0..balls.len()).min_by(nearest).unwrap() as u32)
        };
        let face_segment = (0..row.faces().len()).map(ball).collect();
        (row, Segmentation { face_segment, count: radii.len(), mirror: None })
    }

    #[test]
    fn the_middle_is_not_the_biggest_nor_a_neck() {
        for (radii, expected) in
            [(&[1.0, 1.4, 1.0][..], 1), (&[1.5, 1.0, 0.9, 0.7], 1), (&[1.0, 0.4, 1.2], 2), (&[0.6, 1.0], 1)]
        {
            let (mesh, segmentation) = row(radii);
            let areas: Vec<f64> = radii.iter().map(|r| r * r).collect();
            assert_eq!(middle(&mesh, &segmentation, &areas), expected, "{radii:?}");
        }
    }
}
