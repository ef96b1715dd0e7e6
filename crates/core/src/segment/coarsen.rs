//! Large meshes are worked on as a surface of few cells, so that time and result depend little on
//! the number of faces.

use super::surface::Surface;
use rayon::prelude::*;
use std::borrow::Cow;

/// More cells than this are grouped where borders are drawn. A border that is half a cell off is
/// then off by 0.2% of the size.
const MOST_BORDER_CELLS: usize = 100_000;

/// More cells than this are grouped for all else.
const MOST_CELLS: usize = 12_000;

/// A round that removes a smaller share than this is the last one.
const LEAST_PROGRESS: f64 = 0.05;

/// A surface of fewer cells.
#[derive(Clone)]
pub(super) struct Coarse<'a> {
    pub surface: Cow<'a, Surface>,
    /// The cell of each cell of the surface that it was made from.
    pub cell_of: Vec<u32>,
}

/// Groups the cells of the faces' surface in pairs, again and again, until few are left: the
/// surface to draw borders on, and the one for all else.
pub(super) fn coarsen(fine: &Surface) -> [Coarse<'_>; 2] {
    let itself = (0..fine.len() as u32).collect();
    let borders = Coarse { surface: Cow::Borrowed(fine), cell_of: itself }.reduced(MOST_BORDER_CELLS);
    let coarse = borders.clone().reduced(MOST_CELLS);
    [borders, coarse]
}

impl Coarse<'_> {
    fn reduced(mut self, most_cells: usize) -> Self {
        while self.surface.len() > most_cells {
            let (group, count) = pairs(&self.surface);
            let progress = 1.0 - count as f64 / self.surface.len() as f64;
            self.surface = Cow::Owned(self.surface.grouped(&group, count));
            self.cell_of.par_iter_mut().for_each(|cell| *cell = group[*cell as usize]);
            if progress < LEAST_PROGRESS {
                break;
            }
        }
        self
    }
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
            length / (area[cell] + area[other]).sqrt() * (1.0 + libm::cos(turn_rad)).max(0.01)
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
