//! Polygons as runs of cells on the lattice of a sheet.
//!
//! A piece may stand where its corner is on a lattice point. Its *body* is every cell that it
//! touches; its *halo* is every cell that has a point nearer to it than the spacing. Where the
//! body of one misses the halo of another, their distance is at least the spacing: no tolerance
//! is involved, so a layout on the lattice is valid in exact geometry.

use glam::{DVec2, IVec2};
use tatamu_core::geom::polygon;

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
    let scaled: Vec<DVec2> = outline.iter().map(|&p| p / cell_mm).collect();
    let grow = grow_mm / cell_mm;
    let Some((low, high)) = polygon::bounds(scaled.iter().copied()) else {
        return Vec::new();
    };
    let mut cells = Cells::new((low - grow).floor().as_ivec2(), (high + grow).ceil().as_ivec2());
    // First a bit where the inside begins or ends.
    for (a, b) in polygon::edges(&scaled) {
        crossings(a, b, |row, column| cells.toggle(row, column));
    }
    cells.fill_between();
    for (a, b) in polygon::edges(&scaled) {
        border_runs(a, b, grow, |run| cells.set(run));
    }
    cells.runs()
}

/// Cells nearer than `grow` to an edge: a stadium, cut into rows. All in units of cells.
fn border_runs(a: DVec2, b: DVec2, grow: f64, mut found: impl FnMut(Run)) {
    let (low, high) = (a.y.min(b.y) - grow, a.y.max(b.y) + grow);
    let side = (b - a).perp().normalize_or_zero() * grow;
    let sides = [Slope::new(a + side, b + side), Slope::new(a - side, b - side)];
    // Without a growth the stadium is the edge.
    let (centres, sides) = if grow > 0.0 { (&[a, b][..], &sides[..]) } else { (&[][..], &sides[..1]) };
    for row in (low + SLIVER).floor() as i32..(high - SLIVER).ceil() as i32 {
        let band = (f64::from(row), f64::from(row) + 1.0);
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for centre in centres {
            let away = centre.y - centre.y.clamp(band.0, band.1);
            if away.abs() <= grow {
                let half = (grow * grow - away * away).max(0.0).sqrt();
                from = from.min(centre.x - half);
                to = to.max(centre.x + half);
            }
        }
        for side in sides {
            if let Some((x, y)) = side.span_in_band(band) {
                from = from.min(x);
                to = to.max(y);
            }
        }
        if from <= to {
            let start = (from + SLIVER).floor() as i32;
            let end = (to - SLIVER).ceil() as i32;
            if start < end {
                found(Run { row, start, end });
            }
        }
    }
}

/// A segment from its lower end up.
struct Slope {
    low: DVec2,
    high: DVec2,
    /// Change of x with y; 0 for a level one.
    run: f64,
}

impl Slope {
    fn new(a: DVec2, b: DVec2) -> Self {
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        let way = high - low;
        Self { low, high, run: if way.y > 0.0 { way.x / way.y } else { 0.0 } }
    }

    /// Range of x of the part with y in `band`.
    fn span_in_band(&self, band: (f64, f64)) -> Option<(f64, f64)> {
        let Self { low, high, run } = *self;
        if high.y < band.0 || low.y > band.1 {
            return None;
        }
        let within = |x: f64| x.clamp(low.x.min(high.x), low.x.max(high.x));
        let at = |y: f64| within(low.x + (y - low.y) * run);
        let lower = if low.y >= band.0 { low.x } else { at(band.0) };
        let upper = if high.y <= band.1 { high.x } else { at(band.1) };
        Some((lower.min(upper), lower.max(upper)))
    }
}

/// For each row whose middle the edge crosses, the first column whose centre is behind it. The
/// edge's upper end is left out, so that a corner between two edges counts once.
fn crossings(a: DVec2, b: DVec2, mut found: impl FnMut(i32, i32)) {
    let (low, high) = (a.y.min(b.y), a.y.max(b.y));
    for row in (low - 0.5).ceil() as i32..(high - 0.5).ceil() as i32 {
        let y = f64::from(row) + 0.5;
        let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
        found(row, (x - 0.5).ceil() as i32);
    }
}

/// A rectangle of cells, a bit each.
struct Cells {
    /// Row and column of the first cell.
    low: IVec2,
    /// Words of a row.
    words: usize,
    bits: Vec<u64>,
}

impl Cells {
    /// All free, from `low` up to and without `high`.
    fn new(low: IVec2, high: IVec2) -> Self {
        // A crossing on the right edge begins behind the last cell.
        let size = (high - low).max(IVec2::ZERO).as_usizevec2() + 1;
        let words = size.x.div_ceil(64);
        Self { low, words, bits: vec![0; words * size.y] }
    }

    fn row(&mut self, row: i32) -> &mut [u64] {
        let start = (row - self.low.y) as usize * self.words;
        &mut self.bits[start..start + self.words]
    }

    fn toggle(&mut self, row: i32, column: i32) {
        let column = (column - self.low.x) as usize;
        self.row(row)[column / 64] ^= 1 << (column % 64);
    }

    /// Sets the cells from every first to every second bit of a row, that one left out.
    fn fill_between(&mut self) {
        for row in self.bits.chunks_exact_mut(self.words) {
            let mut is_inside = 0;
            for word in row {
                for by in [1, 2, 4, 8, 16, 32] {
                    *word ^= *word << by;
                }
                *word ^= is_inside;
                is_inside = ((*word as i64) >> 63) as u64;
            }
        }
    }

    fn set(&mut self, run: Run) {
        let (start, end) = ((run.start - self.low.x) as usize, (run.end - self.low.x) as usize);
        for (k, word) in self.row(run.row).iter_mut().enumerate().take(end.div_ceil(64)).skip(start / 64) {
            *word |= stretch(start, end, k);
        }
    }

    fn runs(&self) -> Vec<Run> {
        // Two runs to a row, mostly fewer.
        let mut runs = Vec::with_capacity(2 * self.bits.len() / self.words);
        for (row, words) in (self.low.y..).zip(self.bits.chunks_exact(self.words)) {
            let mut start = None;
            for (k, &word) in words.iter().enumerate() {
                let column = |bit: u32| self.low.x + 64 * k as i32 + bit as i32;
                let mut bit = 0;
                while bit < 64 {
                    let rest = if start.is_some() { !word >> bit } else { word >> bit };
                    bit += rest.trailing_zeros();
                    if bit < 64 {
                        match start.take() {
                            Some(start) => runs.push(Run { row, start, end: column(bit) }),
                            None => start = Some(column(bit)),
                        }
                    }
                }
            }
            let end = self.low.x + 64 * self.words as i32;
            runs.extend(start.map(|start| Run { row, start, end }));
        }
        runs
    }
}

/// The bits of word `k` that belong to `start..end`, counted from word 0 on.
pub(super) fn stretch(start: usize, end: usize, k: usize) -> u64 {
    let from = start.saturating_sub(64 * k).min(64);
    let to = end.saturating_sub(64 * k).min(64);
    if from < to { (u64::MAX >> (64 - (to - from))) << from } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::TAU;
    use tatamu_core::geom::polygon::cross3;

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
