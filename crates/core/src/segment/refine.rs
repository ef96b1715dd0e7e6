//! Cleaning of the borders between segments: each moves within a band to the shortest way along
//! concave edges, near one plane; then stray pieces go to their neighbours.

use super::cut::crease_cost;
use super::maxflow::Network;
use super::patches::{Nearest, Partition};
use super::surface::Surface;
use crate::geom::Plane;
use crate::segment::interface;
use glam::DVec3;
use std::collections::{BTreeMap, BinaryHeap};

/// Half width of a band, as a share of its border's length (a ring has 0.16 of it as radius) and
/// of the square root of the smaller segment's area.
const BAND_OF_LENGTH: f64 = 0.06;
const BAND_OF_SIZE: f64 = 0.25;

/// What it costs that a face is on the wrong side of the border's plane, a band's half width
/// deep, against one border of the same area over that width. With 4 the overlap is better than
/// with 2 on the teapot (0.964, 0.959) and the bunny (0.900, 0.887), and alike elsewhere.
const PLANE_PULL: f64 = 4.0;

/// A border that would take a larger share of the smaller segment stays where it is.
const MOST_CHANGE: f64 = 0.4;

/// Rounds over all borders.
const ROUNDS: usize = 2;

/// Moves all borders; `partition` is one of the surface's cells.
pub(super) fn refine_borders(surface: &Surface, mut partition: Partition) -> Partition {
    for _ in 0..ROUNDS {
        let mut along: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
        for (l, link) in surface.links().iter().enumerate() {
            let [a, b] = link.cells.map(|c| partition.of_cell[c as usize]);
            if a != b {
                along.entry((a.min(b), a.max(b))).or_default().push(l);
            }
        }
        let mut areas = partition.areas(surface);
        let mut place = vec![u32::MAX; surface.len()];
        for (pair, links) in along {
            let before = [areas[pair.0 as usize], areas[pair.1 as usize]];
            let smaller = before[0].min(before[1]);
            let changes = move_border(surface, &partition.of_cell, pair, &links, smaller, &mut place);
            let gain: f64 =
                changes
                    .iter()
                    .map(|&c| {
                        if partition.of_cell[c] == pair.1 { surface.areas()[c] } else { -surface.areas()[c] }
                    })
                    .sum();
            if gain.abs() > MOST_CHANGE * smaller {
                continue;
            }
            areas[pair.0 as usize] += gain;
            areas[pair.1 as usize] -= gain;
            for cell in changes {
                let own = &mut partition.of_cell[cell];
                *own = if *own == pair.0 { pair.1 } else { pair.0 };
            }
        }
    }
    join_strays(surface, partition)
}

/// The cells that change sides when a border moves to the minimum cut of its band. `place` is
/// scratch, all `u32::MAX`.
fn move_border(
    surface: &Surface,
    of_cell: &[u32],
    pair: (u32, u32),
    links: &[usize],
    smaller_area: f64,
    place: &mut [u32],
) -> Vec<usize> {
    let length: f64 = links.iter().map(|&l| surface.links()[l].length).sum();
    let reach = (BAND_OF_LENGTH * length).min(BAND_OF_SIZE * smaller_area.sqrt());
    let seeds = links.iter().flat_map(|&l| surface.links()[l].cells.map(|c| c as usize));
    let band = band(surface, of_cell, pair, seeds, reach, place);
    let plane = border_plane(surface, of_cell, pair, links);
    let mut network = Network::new(band.len(), band.len() * 2);
    for (i, &cell) in band.iter().enumerate() {
        for (other, link) in surface.around(cell) {
            let w = crease_cost(link.turn_rad) * link.length;
            if place[other] == u32::MAX {
                // Beyond the band the other cells are fixed; a third segment does not care.
                let (first, second) = (of_cell[other] == pair.0, of_cell[other] == pair.1);
                network.add_costs(i, if second { w } else { 0.0 }, if first { w } else { 0.0 });
            } else if cell < other {
                network.add_arc(i, place[other] as usize, w, w);
            }
        }
        if let Some(plane) = &plane {
            // The plane looks to the second segment.
            let depth = plane.distance(surface.centres()[cell]) / reach;
            let pull = PLANE_PULL * surface.areas()[cell] / reach * depth;
            network.add_costs(i, pull.max(0.0), (-pull).max(0.0));
        }
    }
    band.iter().for_each(|&c| place[c] = u32::MAX);
    let sides = band.iter().zip(network.sink_side());
    sides.filter(|&(&c, second)| (of_cell[c] == pair.1) != second).map(|(&c, _)| c).collect()
}

/// The cells of two segments within reach of their border; `place` tells each one's index.
fn band(
    surface: &Surface,
    of_cell: &[u32],
    pair: (u32, u32),
    seeds: impl Iterator<Item = usize>,
    reach: f64,
    place: &mut [u32],
) -> Vec<usize> {
    let mut heap: BinaryHeap<Nearest> = seeds.map(|cell| Nearest { distance: 0.0, cell }).collect();
    let mut band = Vec::new();
    while let Some(Nearest { distance, cell }) = heap.pop() {
        if place[cell] != u32::MAX {
            continue;
        }
        place[cell] = band.len() as u32;
        band.push(cell);
        for (other, _) in surface.around(cell) {
            let step = distance + surface.centres()[cell].distance(surface.centres()[other]);
            let own = of_cell[other] == pair.0 || of_cell[other] == pair.1;
            if own && place[other] == u32::MAX && step <= reach {
                heap.push(Nearest { distance: step, cell: other });
            }
        }
    }
    band
}

/// The least-squares plane of a border, looking to the second segment; `None` where the border is
/// not near one.
fn border_plane(surface: &Surface, of_cell: &[u32], pair: (u32, u32), links: &[usize]) -> Option<Plane> {
    let points: Vec<DVec3> = links
        .iter()
        .map(|&l| {
            let [a, b] = surface.links()[l].cells.map(|c| surface.centres()[c as usize]);
            (a + b) / 2.0
        })
        .collect();
    let (plane, residual) = interface::fit_plane(&points)?;
    let spread = interface::spread(&points);
    if residual > 0.3 * spread {
        return None;
    }
    let forward: f64 = links
        .iter()
        .map(|&l| {
            let [a, b] = surface.links()[l].cells.map(|c| c as usize);
            let step = plane.distance(surface.centres()[b]) - plane.distance(surface.centres()[a]);
            if of_cell[a] == pair.0 { step } else { -step }
        })
        .sum();
    Some(if forward < 0.0 { plane.flipped() } else { plane })
}

/// Gives every piece of a set but the largest to the neighbour with the longest common border,
/// where it has one.
pub(super) fn join_strays(surface: &Surface, mut partition: Partition) -> Partition {
    const ROUNDS: usize = 8;
    for _ in 0..ROUNDS {
        let (piece, pieces) = surface.components(|c| partition.of_cell[c]);
        let mut area = vec![0.0; pieces];
        let mut set = vec![0u32; pieces];
        for (cell, &p) in piece.iter().enumerate() {
            area[p as usize] += surface.areas()[cell];
            set[p as usize] = partition.of_cell[cell];
        }
        let mut largest: Vec<Option<usize>> = vec![None; partition.count];
        for p in 0..pieces {
            let best = &mut largest[set[p] as usize];
            if best.is_none_or(|b| area[p] > area[b]) {
                *best = Some(p);
            }
        }
        let mut border: BTreeMap<(u32, u32), f64> = BTreeMap::new();
        for link in surface.links() {
            let [a, b] = link.cells.map(|c| c as usize);
            for (own, other) in [(a, b), (b, a)] {
                let p = piece[own];
                if piece[other] != p && largest[set[p as usize] as usize] != Some(p as usize) {
                    *border.entry((p, partition.of_cell[other])).or_insert(0.0) += link.length;
                }
            }
        }
        let mut host: BTreeMap<u32, (f64, u32)> = BTreeMap::new();
        for ((p, other), length) in border {
            let best = host.entry(p).or_insert((length, other));
            if length > best.0 {
                *best = (length, other);
            }
        }
        if host.is_empty() {
            break;
        }
        for (cell, p) in piece.iter().enumerate() {
            if let Some(&(_, other)) = host.get(p) {
                partition.of_cell[cell] = other;
            }
        }
    }
    partition.compacted()
}
