//! What is free on one sheet, and where a piece may go.
//!
//! Positions are tested in blocks first. At a position in block X of 2^k cells, a body's cell
//! whose column is a multiple of 2^k, say block i, is in block X + i of the sheet, whichever of
//! the block's positions it is; the same for rows. Where that block is taken whole, all positions
//! of block X clash, and none of them needs a look.

use super::bits::{Layer, Positions, Probe, WORDS, doubled, first_positions};
use super::raster::{COLUMNS, Grid, Run, runs};
use glam::DVec2;
use std::sync::OnceLock;
use tatamu_core::geom::polygon::extent;

/// Cells, then blocks of 2, 4 and 8 cells.
const LAYERS: usize = 4;

/// A piece may leave the sheet by this part of a cell: rounding, below 1e-8 mm.
const POSITION_SLACK: f64 = 1e-9;

/// A piece at one angle, ready to be placed.
#[derive(Debug, Clone)]
pub(super) struct Pose {
    pub angle_rad: f64,
    /// The turned piece's origin from the lower left corner of its bounding box.
    pub origin: DVec2,
    /// Size of the bounding box.
    extent: DVec2,
    /// Cells that it touches.
    cells: usize,
    /// Positions across and along the sheet.
    columns: usize,
    rows: usize,
    probes: [Vec<Probe>; LAYERS],
    /// The turned piece, the lower left corner of its bounding box in the origin.
    outline: Vec<DVec2>,
    spacing_mm: f64,
    /// Made when the pose is placed first: most never are.
    halo: OnceLock<Vec<Run>>,
}

impl Pose {
    /// Turns an outline by an angle, at which it must fit the sheet.
    pub fn new(outline: &[DVec2], angle_rad: f64, spacing_mm: f64, grid: &Grid) -> Self {
        let turn = DVec2::from_angle(angle_rad);
        let turned = outline.iter().map(|&p| turn.rotate(p));
        let low = turned.clone().fold(DVec2::INFINITY, DVec2::min);
        let at_corner: Vec<DVec2> = turned.map(|p| p - low).collect();
        let body = runs(&at_corner, 0.0, grid.cell_mm);
        let extent = extent(outline, angle_rad);
        let steps = (grid.sheet_mm - extent) / grid.cell_mm + POSITION_SLACK;
        Self {
            angle_rad,
            origin: -low,
            extent,
            cells: body.iter().map(|r| (r.end - r.start) as usize).sum(),
            columns: steps.x.max(0.0) as usize + 1,
            rows: steps.y.max(0.0) as usize + 1,
            probes: std::array::from_fn(|layer| Probe::of_body(&body, layer)),
            outline: at_corner,
            spacing_mm,
            halo: OnceLock::new(),
        }
    }

    fn halo(&self, cell_mm: f64) -> &[Run] {
        self.halo.get_or_init(|| runs(&self.outline, self.spacing_mm, cell_mm))
    }

    /// The position nearest to a point of the lattice, in cells.
    pub fn nearest(&self, at: DVec2) -> Spot {
        let within = |x: f64, count: usize| x.round().clamp(0.0, (count - 1) as f64) as usize;
        Spot { cost: 0.0, column: within(at.x, self.columns), row: within(at.y, self.rows) }
    }
}

/// A position on the lattice, in cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spot {
    pub cost: f64,
    pub column: usize,
    pub row: usize,
}

/// One sheet in the making.
#[derive(Debug, Clone)]
pub(super) struct Occupancy {
    layers: [Layer; LAYERS],
    cell_mm: f64,
    /// At least the number of free cells.
    free: usize,
}

impl Occupancy {
    pub fn new(grid: &Grid) -> Self {
        let rows = grid.rows().next_multiple_of(1 << (LAYERS - 1));
        Self {
            layers: std::array::from_fn(|k| Layer::new(rows >> k)),
            cell_mm: grid.cell_mm,
            free: rows * COLUMNS,
        }
    }

    /// Whether the free cells are fewer than the pose needs, wherever they are.
    pub fn is_too_full_for(&self, pose: &Pose) -> bool {
        self.free < pose.cells
    }

    /// Whether a pose may stand at a position of the sheet.
    pub fn is_free(&self, pose: &Pose, spot: &Spot) -> bool {
        let bit = 1 << (spot.column % 64);
        self.layers[0].free(&pose.probes[0], spot.row, spot.column / 64, bit) != 0
    }

    /// The cheapest free position of a pose, if it costs less than `limit`. The cost is `pull` ·
    /// the point in mm at the share `lean` of the way from the bounding box's lower left to its
    /// upper right corner; both parts of `pull` are at least 0.
    pub fn best_spot(&self, pose: &Pose, pull: DVec2, lean: f64, limit: f64) -> Option<Spot> {
        let fixed = least_cost(pose.extent, pull, lean);
        let mut query = Query { pose, fixed, step: pull * self.cell_mm, limit, best: None };
        let top = LAYERS - 1;
        for row in 0..pose.rows.div_ceil(1 << top) {
            self.visit(&mut query, top, row, &[u64::MAX; WORDS]);
        }
        query.best
    }

    /// Looks at the positions in a row of blocks, and within the free ones in smaller blocks.
    fn visit(&self, query: &mut Query, layer: usize, row: usize, positions: &Positions) {
        let worth = query.worth_looking(layer, row);
        let mut free = [0; WORDS];
        let mut any = 0;
        for word in 0..WORDS {
            let asked = positions[word] & worth[word];
            free[word] = self.layers[layer].free(&query.pose.probes[layer], row, word, asked);
            any |= free[word];
        }
        if any == 0 {
            return;
        }
        if layer == 0 {
            query.found(row, &free);
        } else {
            let inner = doubled(&free);
            self.visit(query, layer - 1, 2 * row, &inner);
            self.visit(query, layer - 1, 2 * row + 1, &inner);
        }
    }

    /// Takes the cells round a pose at a position.
    pub fn place(&mut self, pose: &Pose, spot: &Spot) {
        let rows = self.layers[0].rows() as i32;
        let (mut first, mut last) = (rows - 1, 0);
        for run in pose.halo(self.cell_mm) {
            let row = run.row + spot.row as i32;
            if (0..rows).contains(&row) {
                (first, last) = (first.min(row), last.max(row));
                let column = |c: i32| (c + spot.column as i32).clamp(0, COLUMNS as i32) as usize;
                let gained = self.layers[0].take(row as usize, column(run.start), column(run.end));
                self.free = self.free.saturating_sub(gained);
            }
        }
        for row in first as usize..=last as usize {
            self.layers[0].finish(row);
        }
        for layer in 1..LAYERS {
            let (finer, coarser) = self.layers.split_at_mut(layer);
            for row in first as usize >> layer..=last as usize >> layer {
                coarser[0].merge_from(&finer[layer - 1], row);
            }
        }
    }
}

/// Cost of a pose of a given extent in the corner of the sheet, where it is least; see
/// [`Occupancy::best_spot`].
pub(super) fn least_cost(extent: DVec2, pull: DVec2, lean: f64) -> f64 {
    pull.dot(extent) * lean
}

/// A search for the cheapest position of one pose on one sheet.
struct Query<'a> {
    pose: &'a Pose,
    fixed: f64,
    step: DVec2,
    limit: f64,
    best: Option<Spot>,
}

impl Query<'_> {
    /// The positions of a row of blocks that are on the sheet and cheap enough.
    fn worth_looking(&self, layer: usize, row: usize) -> Positions {
        let first_row = row << layer;
        let budget = self.limit - self.fixed - self.step.y * first_row as f64;
        if first_row >= self.pose.rows || budget <= 0.0 {
            return [0; WORDS];
        }
        // An infinite quotient becomes the largest count.
        let cheap = (budget / self.step.x).ceil() as usize;
        first_positions(cheap.min(self.pose.columns).div_ceil(1 << layer))
    }

    /// Notes the leftmost of free positions in a row of cells.
    fn found(&mut self, row: usize, free: &Positions) {
        if let Some(word) = free.iter().position(|&w| w != 0) {
            let column = 64 * word + free[word].trailing_zeros() as usize;
            let cost = self.fixed + self.step.dot(DVec2::new(column as f64, row as f64));
            if cost < self.limit {
                self.limit = cost;
                self.best = Some(Spot { cost, column, row });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The search by blocks against a look at every position.
    #[test]
    fn no_cheaper_position_is_missed() {
        let mut rng = fastrand::Rng::with_seed(5);
        let grid = Grid::new(DVec2::new(100.0, 130.0));
        let mut star = |radius: f64| -> Vec<DVec2> {
            let corner = |k: i32| DVec2::from_angle(f64::from(k) * 0.78) * radius;
            (0..8).map(|k| corner(k) * (0.3 + 0.7 * rng.f64())).collect()
        };
        let mut sheet = Occupancy::new(&grid);
        for k in 0..9 {
            let pose = Pose::new(&star(28.0), f64::from(k), 1.0, &grid);
            let pull = DVec2::from_angle(0.1 + 0.15 * f64::from(k));
            let found = sheet.best_spot(&pose, pull, 0.5, f64::INFINITY);
            let layer = &sheet.layers[0];
            let mut naive = f64::INFINITY;
            for row in 0..pose.rows {
                for column in 0..pose.columns {
                    let bit = 1 << (column % 64);
                    if layer.free(&pose.probes[0], row, column / 64, bit) != 0 {
                        let at = DVec2::new(column as f64, row as f64) * grid.cell_mm;
                        naive = naive.min(pull.dot(at + pose.extent / 2.0));
                    }
                }
            }
            let Some(spot) = found else {
                assert_eq!(naive, f64::INFINITY);
                continue;
            };
            assert!((spot.cost - naive).abs() < 1e-9);
            sheet.place(&pose, &spot);
        }
        assert!(sheet.free < grid.rows() * COLUMNS / 2, "the sheet was to be well filled");
    }
}
