//! Dropping triangles and vertices that a clean mesh does not have.

use super::{Repairs, Triangle};
use crate::mesh::Edges;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// Drops all but the first of triangles with the same three corners, whichever way they face.
pub(super) fn drop_duplicates(triangles: &mut Vec<Triangle>, repairs: &mut Repairs) {
    let mut order: Vec<([u32; 3], u32)> = triangles
        .par_iter()
        .enumerate()
        .map(|(k, t)| {
            let mut corners = t.corners;
            corners.sort_unstable();
            (corners, k as u32)
        })
        .collect();
    order.par_sort_unstable();
    let mut is_kept = vec![true; triangles.len()];
    for pair in order.windows(2) {
        is_kept[pair[1].1 as usize] = pair[0].0 != pair[1].0;
    }
    let before = triangles.len();
    let mut kept = is_kept.iter();
    triangles.retain(|_| kept.next() == Some(&true));
    repairs.duplicate_faces += before - triangles.len();
}

/// Share of the tolerance below which a triangle has no area. The ears of a disc of 10^5 corners are 160 times as high;
/// coordinates a thousand diagonals off the origin are rounded to a tenth of it.
const NO_HEIGHT: f64 = 1e-5;
/// Such triangles may lie in a row; each round deals with the outermost ones.
const ROUNDS: usize = 32;
/// Rounds for those that are low, but may stay: with 32 a disc of 10^5 corners takes 4 s.
const ROUNDS_OF_LOW: usize = 4;

/// Gets rid of triangles lower than `tolerance`. To leave no slit, the neighbour at the longest edge is cut in
/// two at the third corner, as if the edge between the two were turned. Where that does not help, as at the rim of a
/// finely rounded disc, the triangle stays, unless it has no area at all. Counts the polygons of which nothing is left.
pub(super) fn drop_flat(
    positions: &[DVec3],
    triangles: &mut Vec<Triangle>,
    tolerance: f64,
    repairs: &mut Repairs,
) {
    if triangles.par_iter().all(|t| height(positions, t.corners) > tolerance) {
        return;
    }
    let none = NO_HEIGHT * tolerance;
    let before = polygon_count(triangles);
    for (most, rounds) in [(tolerance, ROUNDS_OF_LOW), (none, ROUNDS)] {
        for _ in 0..rounds {
            let flat: Vec<bool> =
                triangles.par_iter().map(|t| height(positions, t.corners) <= most).collect();
            if !flat.contains(&true) || turn_edges(positions, triangles, &flat) == 0 {
                break;
            }
        }
    }
    triangles.retain(|t| height(positions, t.corners) > none);
    repairs.degenerate_faces += before - polygon_count(triangles);
}

/// Number of different polygons that triangles come from.
fn polygon_count(triangles: &[Triangle]) -> usize {
    let mut polygons: Vec<u32> = triangles.iter().map(|t| t.polygon).collect();
    polygons.sort_unstable();
    polygons.dedup();
    polygons.len()
}

/// Turns the edge between each flat triangle and a neighbour that is not flat where both are higher then, no triangle
/// twice. Returns the number of turned edges.
fn turn_edges(positions: &[DVec3], triangles: &mut [Triangle], flat: &[bool]) -> usize {
    let faces: Vec<[u32; 3]> = triangles.iter().map(|t| t.corners).collect();
    let edges = Edges::new(&faces);
    let mut is_touched = vec![false; faces.len()];
    let mut added: BTreeSet<[u32; 2]> = BTreeSet::new();
    let mut count = 0;
    for f in (0..faces.len()).filter(|&f| flat[f]) {
        let k = longest_side(positions, faces[f]);
        let Some((other, side)) = edges.opposite(f, k) else {
            continue;
        };
        let middle = faces[f][(k + 2) % 3];
        let apex = faces[other][(side + 2) % 3];
        let fresh = [middle.min(apex), middle.max(apex)];
        let (start, end) = (faces[other][side], faces[other][(side + 1) % 3]);
        let halves = [[start, middle, apex], [middle, end, apex]];
        let flat_height = height(positions, faces[f]);
        if is_touched[f]
            || is_touched[other]
            || flat[other]
            || middle == apex
            || halves.iter().any(|&half| height(positions, half) <= flat_height)
            || edges.find(fresh).is_some()
            || !added.insert(fresh)
        {
            continue;
        }
        triangles[other].corners = halves[0];
        triangles[f] = Triangle { corners: halves[1], polygon: triangles[other].polygon };
        is_touched[f] = true;
        is_touched[other] = true;
        count += 1;
    }
    count
}

/// The side (from corner `k` to the next) that is the longest.
fn longest_side(positions: &[DVec3], corners: [u32; 3]) -> usize {
    let p = corners.map(|v| positions[v as usize]);
    let length = |k: usize| p[k].distance_squared(p[(k + 1) % 3]);
    (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best })
}

/// Height of a triangle over its longest side.
fn height(positions: &[DVec3], corners: [u32; 3]) -> f64 {
    let k = longest_side(positions, corners);
    let [a, b, c] = [0, 1, 2].map(|i| positions[corners[(k + i) % 3] as usize]);
    let along = (b - a).normalize_or_zero();
    (c - a).reject_from_normalized(along).length()
}

/// Drops vertices without a face, and numbers the others again in their order.
pub(super) fn drop_unused(positions: &mut Vec<DVec3>, triangles: &mut [Triangle]) {
    let mut fresh = vec![u32::MAX; positions.len()];
    for v in triangles.iter().flat_map(|t| t.corners) {
        fresh[v as usize] = 0;
    }
    for (slot, index) in fresh.iter_mut().filter(|slot| **slot == 0).zip(0..) {
        *slot = index;
    }
    let mut slots = fresh.iter();
    positions.retain(|_| slots.next() != Some(&u32::MAX));
    for v in triangles.iter_mut().flat_map(|t| &mut t.corners) {
        *v = fresh[*v as usize];
    }
}
