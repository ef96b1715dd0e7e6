//! Rows of bits, and the question "which positions of a body in a row of cells are free?", for a
//! word of positions at once.

use super::raster::{COLUMNS, Run, stretch};

/// Words of a row of cells.
pub(super) const WORDS: usize = COLUMNS / 64;

/// One bit a position.
pub(super) type Positions = [u64; WORDS];

/// A row of cells; the words past the sheet stay 0 so that shifting needs no test.
type Row = [u64; 2 * WORDS];

/// Level k tells for each cell whether any of the 2^k cells from it on is taken.
const LEVELS: usize = COLUMNS.ilog2() as usize + 1;

/// Rows that are this power of two apart come first among probes.
const FAR_APART: u32 = 6;

/// A run of a body, as two stretches of 2^level cells that overlap or meet. A layout has a million of them at a time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    row: u32,
    level: u8,
    starts: [u8; 2],
}

const _: () = assert!(COLUMNS <= 1 << u8::BITS, "a column is a byte");

impl Probe {
    /// Probes for the cells of a body whose row and column are multiples of 2^layer, counted in
    /// blocks of that size.
    pub fn of_body(body: &[Run], layer: usize) -> Vec<Self> {
        let size = 1 << layer;
        let block = |cell: i32| (cell.max(0) as usize).div_ceil(size);
        let rows = body.iter().filter(|r| r.row >= 0 && r.row % size as i32 == 0);
        let mut probes: Vec<Self> = Vec::with_capacity(body.len());
        probes.extend(rows.filter(|r| block(r.start) < block(r.end)).map(|r| {
            let (start, end) = (block(r.start), block(r.end).min(COLUMNS));
            let level = (end - start).ilog2() as u8;
            let starts = [start, end - (1 << level)].map(|cell| cell as u8);
            Self { row: r.row as u32 / size as u32, level, starts }
        }));
        // Rows far apart first: they find a clash sooner than neighbours do.
        let mut sorted = Vec::with_capacity(probes.len());
        for zeros in (0..=FAR_APART).rev() {
            sorted.extend(probes.iter().filter(|p| p.row.trailing_zeros().min(FAR_APART) == zeros));
        }
        sorted
    }
}

/// Taken cells of a sheet, or blocks of 2^k × 2^k cells that are taken whole.
#[derive(Debug, Clone)]
pub(super) struct Layer {
    rows: usize,
    /// Level after level.
    levels: Vec<Row>,
}

impl Layer {
    pub fn new(rows: usize) -> Self {
        Self { rows, levels: vec![[0; 2 * WORDS]; LEVELS * rows] }
    }

    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Of the positions of one word, those at which no probe meets a taken cell.
    pub fn free(&self, probes: &[Probe], row: usize, word: usize, positions: u64) -> u64 {
        let mut free = positions;
        for probe in probes {
            if free == 0 {
                break;
            }
            let taken = &self.levels[usize::from(probe.level) * self.rows + row + probe.row as usize];
            let [first, second] = probe.starts.map(|start| shifted(taken, usize::from(start), word));
            free &= !(first | second);
        }
        free
    }

    /// Takes the cells `start..end` of a row and tells how many were free. To be followed by
    /// [`Layer::finish`] of the row.
    pub fn take(&mut self, row: usize, start: usize, end: usize) -> usize {
        let mut gained = 0;
        for (k, word) in self.levels[row].iter_mut().take(WORDS).enumerate() {
            let bits = stretch(start, end, k);
            gained += (bits & !*word).count_ones() as usize;
            *word |= bits;
        }
        gained
    }

    /// Makes the levels of a row right after its cells changed.
    pub fn finish(&mut self, row: usize) {
        for level in 1..LEVELS {
            let below = self.levels[(level - 1) * self.rows + row];
            let at = level * self.rows + row;
            for k in 0..WORDS {
                self.levels[at][k] = below[k] | shifted(&below, 1 << (level - 1), k);
            }
        }
    }

    /// Sets a row of blocks from two rows of a layer with blocks half as large.
    pub fn merge_from(&mut self, finer: &Self, row: usize) {
        let [a, b] = [2 * row, 2 * row + 1].map(|r| finer.levels[r]);
        for k in 0..WORDS / 2 {
            let halves = [2 * k, 2 * k + 1].map(|k| u64::from(halved(a[k] & b[k])));
            self.levels[row][k] = halves[0] | halves[1] << 32;
        }
        self.finish(row);
    }
}

/// Positions in blocks, as positions in blocks half as large.
pub(super) fn doubled(positions: &Positions) -> Positions {
    std::array::from_fn(|k| spread((positions[k / 2] >> (32 * (k % 2))) as u32))
}

/// The first `count` positions.
pub(super) fn first_positions(count: usize) -> Positions {
    std::array::from_fn(|k| match count.saturating_sub(64 * k) {
        0 => 0,
        n => u64::MAX >> (64 - n.min(64)),
    })
}

/// Word `k` of a row moved down by `by` cells (`by` < [`COLUMNS`]).
fn shifted(row: &Row, by: usize, k: usize) -> u64 {
    let (word, bit) = (k + by / 64, by % 64);
    // Two steps, since a shift by 64 is not defined.
    (row[word] >> bit) | (row[word + 1] << 1 << (63 - bit))
}

/// Each bit twice (interleaving as in Warren, Hacker's Delight, 7-2).
fn spread(bits: u32) -> u64 {
    let mut x = u64::from(bits);
    x = (x | x << 16) & 0x0000_ffff_0000_ffff;
    x = (x | x << 8) & 0x00ff_00ff_00ff_00ff;
    x = (x | x << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    x = (x | x << 2) & 0x3333_3333_3333_3333;
    x = (x | x << 1) & 0x5555_5555_5555_5555;
    x | x << 1
}

/// A bit for each pair of bits: whether both are set.
fn halved(bits: u64) -> u32 {
    let mut x = bits & bits >> 1 & 0x5555_5555_5555_5555;
    x = (x | x >> 1) & 0x3333_3333_3333_3333;
    x = (x | x >> 2) & 0x0f0f_0f0f_0f0f_0f0f;
    x = (x | x >> 4) & 0x00ff_00ff_00ff_00ff;
    x = (x | x >> 8) & 0x0000_ffff_0000_ffff;
    (x | x >> 16) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_undoes_spreading_and_needs_both_bits() {
        for bits in [0, 1, 0x8000_0001, 0xdead_beef, u32::MAX] {
            assert_eq!(halved(spread(bits)), bits);
            assert_eq!(halved(spread(bits) & 0x5555_5555_5555_5555), 0);
        }
    }

    /// The quick answer against one cell after the other.
    #[test]
    fn free_positions_are_those_where_no_cell_is_taken() {
        let mut rng = fastrand::Rng::with_seed(1);
        for _ in 0..50 {
            let mut layer = Layer::new(8);
            let mut taken = [[false; COLUMNS]; 8];
            for (row, is_taken) in taken.iter_mut().enumerate() {
                let start = rng.usize(..COLUMNS);
                let end = (start + rng.usize(..90)).min(COLUMNS);
                layer.take(row, start, end);
                layer.finish(row);
                is_taken[start..end].fill(true);
            }
            let body: Vec<Run> = (0..4)
                .map(|row| {
                    let start = rng.i32(0..60);
                    let end = start + 1 + rng.i32(0..70);
                    Run { row, start, end }
                })
                .collect();
            let probes = Probe::of_body(&body, 0);
            for row in 0..5 {
                for column in 0..COLUMNS - 130 {
                    let clash = body
                        .iter()
                        .any(|r| (r.start..r.end).any(|c| taken[row + r.row as usize][column + c as usize]));
                    let word = layer.free(&probes, row, column / 64, u64::MAX);
                    assert_eq!(word >> (column % 64) & 1 == 0, clash);
                }
            }
        }
    }
}
