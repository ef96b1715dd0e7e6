//! Joining vertices at the same place.

use glam::DVec3;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Side of a grid cell in tolerances. Kept vertices are more than one tolerance apart, so a cell
/// holds a bounded number of them, and a search looks at one to eight cells.
const CELL: f64 = 4.0;

/// Joins each used point to the nearest kept point that is within `tolerance`, or keeps it.
/// Returns the kept points in order, and for each input point the index of its kept one
/// (`u32::MAX` for unused points).
///
/// Kept points do not move and points are only compared with kept ones, so that a chain of near
/// points is not drawn together.
pub(super) fn weld(points: &[DVec3], is_used: &[bool], tolerance: f64) -> (Vec<DVec3>, Vec<u32>) {
    let mut kept: Vec<DVec3> = Vec::new();
    let mut exact: HashMap<[u64; 3], u32> = HashMap::with_capacity(points.len());
    let mut grid = Grid::new(points, is_used, tolerance);
    let of_input = points
        .iter()
        .zip(is_used)
        .map(|(&p, &is_used)| {
            if !is_used {
                return u32::MAX;
            }
            // Adding zero turns -0 into 0.
            let entry = exact.entry((p + DVec3::ZERO).to_array().map(f64::to_bits));
            let vacant = match entry {
                Entry::Occupied(found) => return *found.get(),
                Entry::Vacant(vacant) => vacant,
            };
            let near = grid.find(&kept, p);
            *vacant.insert(near.unwrap_or_else(|| {
                let fresh = kept.len() as u32;
                kept.push(p);
                grid.insert(p, fresh);
                fresh
            }))
        })
        .collect();
    (kept, of_input)
}

/// Kept points by cells; each cell is a linked list, newest first.
struct Grid {
    origin: DVec3,
    tolerance: f64,
    newest: HashMap<[i64; 3], u32>,
    older: Vec<Option<u32>>,
}

impl Grid {
    fn new(points: &[DVec3], is_used: &[bool], tolerance: f64) -> Self {
        let used = points.iter().zip(is_used).filter(|(_, used)| **used);
        let origin = used.fold(DVec3::INFINITY, |low, (&p, _)| low.min(p));
        Self { origin, tolerance, newest: HashMap::with_capacity(points.len()), older: Vec::new() }
    }

    fn cell(&self, p: DVec3) -> [i64; 3] {
        let at = (p - self.origin) / (CELL * self.tolerance);
        at.to_array().map(|x| x.floor() as i64)
    }

    fn insert(&mut self, p: DVec3, index: u32) {
        let older = self.newest.insert(self.cell(p), index);
        self.older.push(older);
    }

    /// The kept point nearest to `p` within the tolerance; the first of equally near ones.
    fn find(&self, kept: &[DVec3], p: DVec3) -> Option<u32> {
        let low = self.cell(p - self.tolerance);
        let high = self.cell(p + self.tolerance);
        let mut best: Option<(f64, u32)> = None;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let mut next = self.newest.get(&[x, y, z]).copied();
                    while let Some(index) = next {
                        let distance = kept[index as usize].distance(p);
                        let is_better = best.is_none_or(|b| (distance, index) < b);
                        if distance <= self.tolerance && is_better {
                            best = Some((distance, index));
                        }
                        next = self.older[index as usize];
                    }
                }
            }
        }
        best.map(|(_, index)| index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_points_are_joined_across_cells_and_chains_are_not() {
        let step = 0.6;
        let points: Vec<DVec3> = (0..100).map(|k| DVec3::X * (step * f64::from(k))).collect();
        let (kept, of_input) = weld(&points, &vec![true; points.len()], 1.0);
        assert_eq!(kept.len(), 50);
        for (p, &k) in points.iter().zip(&of_input) {
            assert!(p.distance(kept[k as usize]) <= 1.0);
        }
    }

    #[test]
    fn no_two_kept_points_are_within_the_tolerance() {
        let mut state = 7u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / 16_777_216.0 - 0.5
        };
        let points: Vec<DVec3> = (0..2000).map(|_| DVec3::new(random(), random(), random()) * 20.0).collect();
        let (kept, of_input) = weld(&points, &vec![true; points.len()], 1.0);
        assert!(kept.len() < 2000);
        for (k, p) in kept.iter().enumerate() {
            assert!(kept[..k].iter().all(|q| p.distance(*q) > 1.0));
        }
        for (p, &k) in points.iter().zip(&of_input) {
            assert!(p.distance(kept[k as usize]) <= 1.0);
        }
    }

    #[test]
    fn minus_zero_is_zero() {
        let (kept, of_input) = weld(&[DVec3::ZERO, -DVec3::ZERO], &[true; 2], 1e-12);
        assert_eq!((kept.len(), of_input), (1, vec![0, 0]));
    }
}
