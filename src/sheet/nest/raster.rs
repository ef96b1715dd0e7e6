//! Polygons as runs of cells on the lattice of a sheet.
//!
//! A piece may stand where its corner is on a lattice point. Its *body* is every cell that it
//! touches; its *halo* is every cell that has a point nearer to it than the spacing. Where the
//! body of one misses the halo of another, their distance is at least the spacing: no tolerance
//! is involved, so a layout on the lattice is valid in exact geometry.

use crate::geom::polygon;
use glam::DVec2;

/// Most cells across the sheet, so that a row is four machine words.
pub(super) const COLUMNS: usize = 256;

/// The short side of the sheet is this many cells: 0.76 mm on A4. Finer packs tighter by the
/// wasted part of a cell at each gap, and costs time with the cube.
const CELLS_ACROSS: f64 = 250.0;

/// Most cells along the sheet; a longer one (a roll) gets larger cells.
const CELLS_ALONG: f64 = 4000.0;

/// A cell that a piece enters by less than this part of its size is not touched: rounding,
/// 1e-9 mm at most on any sheet.
const SLIVER: f64 = 1e-9;

/// The lattice of a sheet in portrait format.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Size of a cell.
    pub cell_mm: f64,
    /// Width and height of the usable area, `width <= height`.
    pub sheet_mm: DVec2,
}

impl Grid {
    pub fn new(sheet_mm: DVec2) -> Self {
        let cell_mm = (sheet_mm.x / CELLS_ACROSS).max(sheet_mm.y / CELLS_ALONG);
        Self { cell_mm, sheet_mm }
    }

    /// Rows of cells that cover the sheet.
    pub fn rows(&self) -> usize {
        (self.sheet_mm.y / self.cell_mm).ceil() as usize + 1
    }
}

/// Cells `start..end` of one row; may be outside of the sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Run {
    pub row: i32,
    pub start: i32,
    pub end: i32,
}

/// Runs of the cells that are nearer than `grow_mm` to the polygon; with 0, of those that it
/// touches. Disjoint, in the order of rows.
pub(super) fn runs(outline: &[DVec2], grow_mm: f64, cell_mm: f64) -> Vec<Run> {
    let mut found = Vec::new();
    let scaled: Vec<DVec2> = outline.iter().map(|&p| p / cell_mm).collect();
    for (a, b) in polygon::edges(&scaled) {
        border_runs(a, b, grow_mm / cell_mm, &mut found);
    }
    inner_runs(&scaled, &mut found);
    found.sort_unstable();
    let mut merged: Vec<Run> = Vec::with_capacity(found.len());
    for run in found {
        match merged.last_mut() {
            Some(last) if last.row == run.row && run.start <= last.end => {
                last.end = last.end.max(run.end);
            }
            _ => merged.push(run),
        }
    }
    merged
}

/// Cells nearer than `grow` to an edge: a stadium, cut into rows. All in units of cells.
fn border_runs(a: DVec2, b: DVec2, grow: f64, found: &mut Vec<Run>) {
    let (low, high) = (a.y.min(b.y) - grow, a.y.max(b.y) + grow);
    let side = (b - a).perp().normalize_or_zero() * grow;
    for row in (low + SLIVER).floor() as i32..(high - SLIVER).ceil() as i32 {
        let band = (f64::from(row), f64::from(row) + 1.0);
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for centre in [a, b] {
            let away = centre.y - centre.y.clamp(band.0, band.1);
            if away.abs() <= grow {
                let half = (grow * grow - away * away).max(0.0).sqrt();
                from = from.min(centre.x - half);
                to = to.max(centre.x + half);
            }
        }
        for offset in [side, -side] {
            if let Some((x, y)) = span_in_band(a + offset, b + offset, band) {
                from = from.min(x);
                to = to.max(y);
            }
        }
        if from <= to {
            let start = (from + SLIVER).floor() as i32;
            let end = (to - SLIVER).ceil() as i32;
            found.extend((start < end).then_some(Run { row, start, end }));
        }
    }
}

/// Range of x of the part of a segment with y in `band`.
fn span_in_band(a: DVec2, b: DVec2, band: (f64, f64)) -> Option<(f64, f64)> {
    let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
    if b.y < band.0 || a.y > band.1 {
        return None;
    }
    let at = |y: f64| {
        let t = if b.y > a.y { (y - a.y) / (b.y - a.y) } else { 0.0 };
        a.x + (b.x - a.x) * t.clamp(0.0, 1.0)
    };
    let lower = if a.y >= band.0 { a.x } else { at(band.0) };
    let upper = if b.y <= band.1 { b.x } else { at(band.1) };
    Some((lower.min(upper), lower.max(upper)))
}

/// Cells whose centre is inside the polygon (even–odd): among those that no edge touches, these
/// are the cells that it covers.
fn inner_runs(scaled: &[DVec2], found: &mut Vec<Run>) {
    let mut crossings: Vec<(i32, f64)> = Vec::new();
    for (a, b) in polygon::edges(scaled) {
        let (low, high) = (a.y.min(b.y), a.y.max(b.y));
        // Rows whose middle is in low..high: the upper end is left out.
        for row in (low - 0.5).ceil() as i32..(high - 0.5).ceil() as i32 {
            let y = f64::from(row) + 0.5;
            crossings.push((row, a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))));
        }
    }
    crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    for pair in crossings.chunks_exact(2) {
        let start = (pair[0].1 - 0.5).ceil() as i32;
        let end = (pair[1].1 - 0.5).floor() as i32 + 1;
        let row = pair[0].0;
        found.extend((start < end).then_some(Run { row, start, end }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::polygon::cross3;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    fn contains(runs: &[Run], p: DVec2, cell_mm: f64) -> bool {
        let cell = (p / cell_mm).floor().as_ivec2();
        runs.iter().any(|r| r.row == cell.y && (r.start..r.end).contains(&cell.x))
    }

    proptest! {
        /// Points of a triangle are in its body, and points near it in its halo.
        #[test]
        fn runs_cover_all_points(
            corners in prop::array::uniform3((0.0..40.0_f64, 0.0..40.0_f64)),
            weights in prop::collection::vec((0.0..1.0_f64, 0.0..1.0_f64, 0.0..TAU, 0.0..0.999_f64), 50),
            grow in 0.1..5.0_f64,
        ) {
            let mut t = corners.map(DVec2::from);
            if cross3(t[0], t[1], t[2]) < 0.0 {
                t.swap(0, 1);
            }
            let cell_mm = 0.7;
            let (body, halo) = (runs(&t, 0.0, cell_mm), runs(&t, grow, cell_mm));
            for (u, v, angle, reach) in weights {
                let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                let p = t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
                prop_assert!(contains(&body, p, cell_mm));
                let near = p + DVec2::from_angle(angle) * (grow * reach);
                prop_assert!(contains(&halo, near, cell_mm));
            }
        }
    }

    /// Rounding outwards is by less than a cell, so that no paper is wasted.
    #[test]
    fn runs_are_no_larger_than_need_be() {
        let square = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)].map(DVec2::from);
        let cells = |runs: &[Run]| runs.iter().map(|r| r.end - r.start).sum::<i32>();
        assert_eq!(cells(&runs(&square, 0.0, 1.0)), 4);
        // The disc of radius 1 at a corner enters the corner's outer cell.
        assert_eq!(cells(&runs(&square, 1.0, 1.0)), 16);
        // The cells beyond the corner are nearer than 1.4 but for the outermost.
        assert_eq!(cells(&runs(&square, 1.4, 1.0)), 32);
    }
}
