//! Over-segmentation: connected sets of one label, the large ones split.

use super::cut::crease_cost;
use super::surface::{Link, Surface};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

/// A set of cells, as a number `0..count` for each cell.
#[derive(Debug, Clone)]
pub(super) struct Partition {
    pub of_cell: Vec<u32>,
    pub count: usize,
}

impl Partition {
    /// Areas of the sets.
    pub fn areas(&self, surface: &Surface) -> Vec<f64> {
        let mut areas = vec![0.0; self.count];
        for (&p, a) in self.of_cell.iter().zip(surface.areas()) {
            areas[p as usize] += a;
        }
        areas
    }

    /// Length of the common border of each pair of neighbouring sets, the smaller number first.
    pub fn borders(&self, surface: &Surface) -> BTreeMap<(u32, u32), f64> {
        let mut borders = BTreeMap::new();
        for link in surface.links() {
            let [a, b] = link.cells.map(|c| self.of_cell[c as usize]);
            if a != b {
                *borders.entry((a.min(b), a.max(b))).or_insert(0.0) += link.length;
            }
        }
        borders
    }

    /// What it costs to cut along the border of each pair of neighbouring sets: its length, over
    /// the square root of the whole area, that of concave edges counted less.
    pub fn border_costs(&self, surface: &Surface) -> BTreeMap<(u32, u32), f64> {
        let flat = crease_cost(0.0) * surface.total_area().sqrt();
        let mut costs = BTreeMap::new();
        for link in surface.links() {
            let [a, b] = link.cells.map(|c| self.of_cell[c as usize]);
            if a != b {
                let cost = crease_cost(link.turn_rad) * link.length / flat;
                *costs.entry((a.min(b), a.max(b))).or_insert(0.0) += cost;
            }
        }
        costs
    }

    /// Numbers the used sets from 0 in the order of their first cells.
    pub fn compacted(mut self) -> Self {
        let mut number = vec![u32::MAX; self.count];
        let mut count = 0;
        for p in &mut self.of_cell {
            let n = &mut number[*p as usize];
            if *n == u32::MAX {
                *n = count;
                count += 1;
            }
            *p = *n;
        }
        self.count = count as usize;
        self
    }
}

/// Connected sets of cells with one label.
pub(super) fn connected(surface: &Surface, label: &[u32]) -> Partition {
    let (of_cell, count) = surface.components(|c| label[c]);
    Partition { of_cell, count }
}

/// Joins sets smaller than `least_area` to the neighbour with the longest common border, the
/// smallest first. Those without a neighbour stay.
pub(super) fn absorb_small(surface: &Surface, partition: Partition, least_area: f64) -> Partition {
    let mut areas = partition.areas(surface);
    let mut around: Vec<BTreeMap<u32, f64>> = vec![BTreeMap::new(); partition.count];
    for ((a, b), length) in partition.borders(surface) {
        around[a as usize].insert(b, length);
        around[b as usize].insert(a, length);
    }
    let mut small: BinaryHeap<Nearest> = (0..partition.count)
        .filter(|&p| areas[p] < least_area)
        .map(|p| Nearest { distance: areas[p], cell: p })
        .collect();
    let mut into: Vec<u32> = (0..partition.count as u32).collect();
    while let Some(Nearest { distance, cell: p }) = small.pop() {
        if into[p] != p as u32 || areas[p] != distance {
            continue;
        }
        let longest = around[p].iter().max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(a.0)));
        let Some(host) = longest.map(|(&h, _)| h) else {
            continue;
        };
        into[p] = host;
        areas[host as usize] += areas[p];
        for (other, length) in std::mem::take(&mut around[p]) {
            around[other as usize].remove(&(p as u32));
            if other != host {
                *around[other as usize].entry(host).or_insert(0.0) += length;
                *around[host as usize].entry(other).or_insert(0.0) += length;
            }
        }
        if areas[host as usize] < least_area {
            small.push(Nearest { distance: areas[host as usize], cell: host as usize });
        }
    }
    let root = |mut p: u32| {
        while into[p as usize] != p {
            p = into[p as usize];
        }
        p
    };
    let of_cell = partition.of_cell.iter().map(|&p| root(p)).collect();
    Partition { of_cell, count: partition.count }.compacted()
}

/// Splits connected sets that are larger than `most_area`, each into the cells nearest to seeds
/// that are far from each other. Distances grow across concave edges, so splits like to lie there.
pub(super) fn split_large(surface: &Surface, partition: &Partition, most_area: f64) -> Partition {
    let areas = partition.areas(surface);
    let mut cells: Vec<Vec<usize>> = vec![Vec::new(); partition.count];
    for (cell, &p) in partition.of_cell.iter().enumerate() {
        cells[p as usize].push(cell);
    }
    let mut of_cell = partition.of_cell.clone();
    let mut count = partition.count;
    let mut distance = vec![f64::INFINITY; surface.len()];
    for (p, members) in cells.iter().enumerate() {
        let pieces = (areas[p] / most_area).round() as usize;
        if pieces < 2 {
            continue;
        }
        let base = count as u32;
        // The first seed is as far as can be from the first cell.
        spread(surface, members[0], &mut of_cell, p as u32, &mut distance);
        let first = farthest(members, &distance);
        members.iter().for_each(|&c| distance[c] = f64::INFINITY);
        spread(surface, first, &mut of_cell, p as u32, &mut distance);
        for _ in 1..pieces {
            let seed = farthest(members, &distance);
            if distance[seed] <= 0.0 {
                break;
            }
            let own = |q| q == p as u32 || q >= base;
            spread_among(surface, seed, &mut of_cell, count as u32, &mut distance, own);
            count += 1;
        }
    }
    Partition { of_cell, count }
}

fn farthest(members: &[usize], distance: &[f64]) -> usize {
    let far = |a: &&usize, b: &&usize| distance[**a].total_cmp(&distance[**b]).then(b.cmp(a));
    members.iter().max_by(far).copied().unwrap_or(0)
}

fn spread(surface: &Surface, seed: usize, of_cell: &mut [u32], set: u32, distance: &mut [f64]) {
    spread_among(surface, seed, of_cell, set, distance, |q| q == set);
}

/// Dijkstra from a seed over cells of allowed sets; cells that it reaches sooner than the seeds
/// before join `set`.
fn spread_among(
    surface: &Surface,
    seed: usize,
    of_cell: &mut [u32],
    set: u32,
    distance: &mut [f64],
    allowed: impl Fn(u32) -> bool,
) {
    let mut heap = BinaryHeap::from([Nearest { distance: 0.0, cell: seed }]);
    while let Some(Nearest { distance: d, cell }) = heap.pop() {
        if d >= distance[cell] {
            continue;
        }
        distance[cell] = d;
        of_cell[cell] = set;
        for (other, link) in surface.around(cell) {
            let step = d + step_length(surface, cell, other, link);
            if step < distance[other] && allowed(of_cell[other]) {
                heap.push(Nearest { distance: step, cell: other });
            }
        }
    }
}

/// Distance of two cells' centres, several times as long across a sharp concave edge.
fn step_length(surface: &Surface, a: usize, b: usize, link: &Link) -> f64 {
    let centres = surface.centres();
    let flat = crease_cost(0.0);
    centres[a].distance(centres[b]) * (flat / crease_cost(link.turn_rad).max(0.5))
}

/// A heap entry; the nearest is the greatest, of equal ones that with the smaller index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nearest {
    pub distance: f64,
    pub cell: usize,
}

impl Eq for Nearest {}

impl Ord for Nearest {
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance.total_cmp(&self.distance).then(other.cell.cmp(&self.cell))
    }
}

impl PartialOrd for Nearest {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
