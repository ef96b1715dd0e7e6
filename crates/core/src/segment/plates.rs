//! What stands on a plate begins at its flat side.
//!
//! The shortest border of the leg of a table is below the fillet. With such stubs the hull of the top is no plate, and
//! the planes of its joints lean.

use super::patches::Partition;
use super::surface::Surface;
use crate::geom::{FlatSide, Patch, Plane};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// What stands on a plate leads away from its side within this angle of the normal.
const LEANING_RAD: f64 = 60.0_f64.to_radians();
/// A larger share of a plate is no stub.
const STUB: f64 = 0.25;

/// The parts with the stubs that plates have of others joined to those.
pub(super) fn without_stubs(surface: &Surface, mut parts: Partition) -> Partition {
    let mut cells: Vec<Vec<usize>> = vec![Vec::new(); parts.count];
    parts.of_cell.iter().enumerate().for_each(|(cell, &part)| cells[part as usize].push(cell));
    let patch = |&cell: &usize| Patch {
        centre: surface.centres()[cell],
        normal: surface.normals()[cell],
        area: surface.areas()[cell],
    };
    for (plate, own) in (0u32..).zip(&cells) {
        let most_area = STUB * area(surface, own);
        for side in FlatSide::of_patches(&own.iter().map(patch).collect::<Vec<_>>()) {
            let borders = borders(surface, &parts, plate);
            let is_beyond = |cell: usize| {
                parts.of_cell[cell] == plate && side.plane.distance(surface.centres()[cell]) > side.roughness
            };
            let (piece, _) = surface.components(|cell| u32::from(is_beyond(cell)));
            let mut beyond: Vec<usize> = own.iter().copied().filter(|&cell| is_beyond(cell)).collect();
            for (other, border) in borders {
                if !stands_on(surface, &side.plane, &cells[other as usize], &border) {
                    continue;
                }
                let touched: BTreeSet<u32> = border.iter().map(|[cell, _]| piece[*cell]).collect();
                let (stub, rest): (Vec<usize>, Vec<usize>) =
                    beyond.iter().partition(|cell| touched.contains(&piece[**cell]));
                if area(surface, &stub) <= most_area {
                    stub.into_iter().for_each(|cell| parts.of_cell[cell] = other);
                    beyond = rest;
                }
            }
        }
    }
    parts
}

fn area(surface: &Surface, cells: &[usize]) -> f64 {
    cells.iter().map(|&cell| surface.areas()[cell]).sum()
}

/// Where a part borders on each of the others: pairs of cells, its own first.
fn borders(surface: &Surface, parts: &Partition, part: u32) -> BTreeMap<u32, Vec<[usize; 2]>> {
    let mut borders: BTreeMap<u32, Vec<[usize; 2]>> = BTreeMap::new();
    for link in surface.links() {
        let [a, b] = link.cells.map(|c| c as usize);
        match (parts.of_cell[a], parts.of_cell[b]) {
            (own, other) if own == part && other != part => borders.entry(other).or_default().push([a, b]),
            (other, own) if own == part && other != part => borders.entry(other).or_default().push([b, a]),
            _ => {}
        }
    }
    borders
}

/// Whether a part leads away from a side of another from where the two meet.
fn stands_on(surface: &Surface, side: &Plane, cells: &[usize], border: &[[usize; 2]]) -> bool {
    let centres = surface.centres();
    let meets = border.iter().flatten().map(|&cell| centres[cell]).sum::<DVec3>() / (2 * border.len()) as f64;
    let end =
        cells.iter().map(|&cell| centres[cell] * surface.areas()[cell]).sum::<DVec3>() / area(surface, cells);
    let away = (end - meets).dot(side.normal());
    away > libm::cos(LEANING_RAD) * end.distance(meets) && side.distance(end) > away / 2.0
}

#[cfg(test)]
mod tests {
    use super::super::shapes::turned;
    use super::*;

    /// A surface of revolution through points of a half plane, from its upper end to its lower one.
    fn surface(corners: &[(f64, f64)], steps: &[u32]) -> Surface {
        let lines = corners.windows(2).zip(steps).flat_map(|(ends, n)| line(ends[0], ends[1], *n));
        let mut rings: Vec<(f64, f64)> = lines.skip(1).collect();
        rings.reverse();
        let (positions, faces) = turned((corners[corners.len() - 1].1, corners[0].1), &rings, 24);
        Surface::of_faces(&positions, &faces)
    }

    /// Along straight lines between points.
    fn line(from: (f64, f64), to: (f64, f64), steps: u32) -> impl Iterator<Item = (f64, f64)> {
        (0..steps).map(move |k| {
            let t = f64::from(k) / f64::from(steps);
            (from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t)
        })
    }

    /// A round table on one leg, whose border is 3 below the top.
    #[test]
    fn the_leg_of_a_table_begins_at_its_top() {
        let corners = [(0.0, 1.0), (20.0, 1.0), (20.0, 0.0), (2.0, 0.0), (2.0, -25.0), (0.0, -25.0)];
        let surface = surface(&corners, &[20, 3, 20, 50, 4]);
        let parts_at = |z: f64| {
            let of_cell = surface.centres().iter().map(|c| u32::from(c.z < z)).collect();
            Partition { of_cell, count: 2 }
        };
        let lowest = |parts: &Partition| {
            let top = parts.of_cell.iter().zip(surface.centres()).filter(|(part, _)| **part == 0);
            top.map(|(_, centre)| centre.z).fold(f64::INFINITY, f64::min)
        };
        let parts = parts_at(-3.0);
        assert!(lowest(&parts) < -2.5);
        let trimmed = without_stubs(&surface, parts);
        assert!(lowest(&trimmed) > -0.7, "{}", lowest(&trimmed));
        // What is at the top already stays.
        let at_top = parts_at(-0.1);
        assert_eq!(without_stubs(&surface, at_top.clone()).of_cell, at_top.of_cell);
    }

    /// Neither half of a thick post is a plate.
    #[test]
    fn borders_elsewhere_stay() {
        let corners = [(0.0, 20.0), (8.0, 20.0), (8.0, -20.0), (0.0, -20.0)];
        let surface = surface(&corners, &[8, 40, 8]);
        let of_cell: Vec<u32> = surface.centres().iter().map(|c| u32::from(c.z < 3.0)).collect();
        let parts = Partition { of_cell: of_cell.clone(), count: 2 };
        assert_eq!(without_stubs(&surface, parts).of_cell, of_cell);
    }
}
