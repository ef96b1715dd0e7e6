//! Large meshes are worked on as a surface of few cells, so that time and result depend little on
//! the number of faces.

use super::surface::Surface;
use rayon::prelude::*;

/// More cells than this are grouped.
const MOST_CELLS: usize = 12_000;

/// A round that removes a smaller share than this is the last one.
const LEAST_PROGRESS: f64 = 0.05;

/// Groups the cells in pairs, again and again, until few are left. Returns the coarse surface and
/// the coarse cell of each cell of the given one.
pub(super) fn coarsen(fine: &Surface) -> (Surface, Vec<u32>) {
    let mut cell_of: Vec<u32> = (0..fine.len() as u32).collect();
    let mut coarse = fine.clone();
    while coarse.len() > MOST_CELLS {
        let (group, count) = pairs(&coarse);
        let progress = 1.0 - count as f64 / coarse.len() as f64;
        coarse = coarse.grouped(&group, count);
        for cell in &mut cell_of {
            *cell = group[*cell as usize];
        }
        if progress < LEAST_PROGRESS {
            break;
        }
    }
    (coarse, cell_of)
}

/// A matching: small cells first, each with the free neighbour that gives the most compact and
/// flattest pair.
fn pairs(surface: &Surface) -> (Vec<u32>, usize) {
    const FREE: u32 = u32::MAX;
    let area = surface.areas();
    let mut order: Vec<usize> = (0..surface.len()).collect();
    order.par_sort_unstable_by(|&a, &b| area[a].total_cmp(&area[b]).then(a.cmp(&b)));
    let mut group = vec![FREE; surface.len()];
    let mut count = 0;
    for cell in order {
        if group[cell] != FREE {
            continue;
        }
        group[cell] = count;
        let fit = |other: usize, length: f64, turn_rad: f64| {
            length / (area[cell] + area[other]).sqrt() * (1.0 + turn_rad.cos()).max(0.01)
        };
        let best = surface
            .around(cell)
            .filter(|&(other, _)| group[other] == FREE)
            .map(|(other, link)| (fit(other, link.length, link.turn_rad), other))
            .max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        if let Some((_, other)) = best {
            group[other] = count;
        }
        count += 1;
    }
    (group, count as usize)
}
