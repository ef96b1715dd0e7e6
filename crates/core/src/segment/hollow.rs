//! Hollows: space outside of the solid that the solid nearly encloses, such as that of a cup. Parts
//! are filled by nature, so while parts are searched for hollows count as solid: else nothing about
//! a cup is worth having but its walls.

/// All directions, in the unit of the shares below: their least common denominator.
const ALL: u16 = 840;

/// Directions to the neighbours of a cell, each with the share of all directions that it stands
/// for: faces 1/21, edges 4/105 and corners 9/280 of a cube (Lebedev's quadrature of 26 points).
fn directions() -> impl Iterator<Item = ([isize; 3], u16)> {
    const SHARES: [u16; 4] = [0, ALL / 21, 4 * ALL / 105, 9 * ALL / 280];
    (0..27).filter(|k| *k != 13).map(|k| {
        let step: [isize; 3] = [k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1];
        let length: isize = step.iter().map(|s| s.abs()).sum();
        (step, SHARES[length as usize])
    })
}

/// Marks the cells of a grid of `count` cells from which at least the share `least` of all directions
/// meets an occupied cell. Cells are in the order of their coordinates, the last one fastest.
pub(super) fn enclosed(count: [usize; 3], is_occupied: &[bool], least: f64) -> Vec<bool> {
    let mut met = vec![0u16; is_occupied.len()];
    let mut blocked = vec![false; is_occupied.len()];
    for (step, share) in directions() {
        sweep(count, step, is_occupied, &mut blocked);
        for (sum, blocked) in met.iter_mut().zip(&blocked) {
            *sum += share * u16::from(*blocked);
        }
    }
    // Rounding is no reason to miss a whole number.
    let least = (least * f64::from(ALL) - 1e-9).ceil() as u16;
    met.iter().zip(is_occupied).map(|(met, occupied)| *occupied || *met >= least).collect()
}

/// For each cell, whether a straight way by `step` meets an occupied one.
fn sweep(count: [usize; 3], step: [isize; 3], is_occupied: &[bool], blocked: &mut [bool]) {
    // The row ahead is done before its own.
    let along = |axis: usize| {
        let n = count[axis];
        (0..n).map(move |i| if step[axis] > 0 { n - 1 - i } else { i })
    };
    let ahead = |axis: usize, i: usize| i.checked_add_signed(step[axis]).filter(|&next| next < count[axis]);
    let [_, ny, nz] = count;
    let mut seen = vec![false; nz];
    for i in along(0) {
        let next_i = ahead(0, i);
        for j in along(1) {
            let row = (i * ny + j) * nz;
            // What comes in from outside is free.
            seen.fill(false);
            if let Some(next) = next_i.zip(ahead(1, j)).map(|(i, j)| (i * ny + j) * nz) {
                if next == row {
                    let mut is_blocked = false;
                    for k in along(2) {
                        seen[k] = is_blocked;
                        is_blocked |= is_occupied[row + k];
                    }
                } else {
                    // The cells of this row that have one ahead, and those ahead.
                    let (own, ahead) = match step[2] {
                        0 => (0..nz, 0..nz),
                        1 => (0..nz - 1, 1..nz),
                        _ => (1..nz, 0..nz - 1),
                    };
                    let ahead = next + ahead.start..next + ahead.end;
                    let met = is_occupied[ahead.clone()].iter().zip(&blocked[ahead]);
                    seen[own]
                        .iter_mut()
                        .zip(met)
                        .for_each(|(seen, (occupied, beyond))| *seen = occupied | beyond);
                }
            }
            blocked[row..row + nz].copy_from_slice(&seen);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: usize = 21;

    fn at(i: usize, j: usize, k: usize) -> usize {
        (i * N + j) * N + k
    }

    /// Walls of a square cup of 11 × 11 cells, 11 high, open at the top.
    fn cup() -> Vec<bool> {
        let mut cells = vec![false; N * N * N];
        for i in 5..16 {
            for j in 5..16 {
                for k in 5..16 {
                    cells[at(i, j, k)] = i == 5 || i == 15 || j == 5 || j == 15 || k == 5;
                }
            }
        }
        cells
    }

    #[test]
    fn shares_of_directions_are_a_whole() {
        assert_eq!(directions().map(|d| d.1).sum::<u16>(), ALL);
    }

    #[test]
    fn a_cup_is_filled_and_nothing_beside_it() {
        let filled = enclosed([N; 3], &cup(), 0.7);
        assert!(filled[at(10, 10, 6)] && filled[at(10, 10, 10)]);
        assert!(!filled[at(10, 10, 16)] && !filled[at(10, 10, 18)]);
        assert!(!filled[at(3, 10, 10)] && !filled[at(10, 10, 2)]);
        // From the floor of the middle only straight up is free.
        let nearly = 1.0 - 1.0 / 21.0;
        assert!(enclosed([N; 3], &cup(), nearly - 1e-6)[at(10, 10, 6)]);
        assert!(!enclosed([N; 3], &cup(), nearly + 1e-6)[at(10, 10, 6)]);
    }
}
