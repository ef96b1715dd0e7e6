//! Hollows: space outside of the solid that the solid nearly encloses, such as that of a cup. Parts
//! are filled by nature, so while parts are searched for hollows count as solid: else nothing about
//! a cup is worth having but its walls.

/// Directions to the neighbours of a cell, each with the share of all directions that it stands
/// for: faces, edges and corners of a cube (Lebedev's quadrature of 26 points).
fn directions() -> impl Iterator<Item = ([isize; 3], f64)> {
    const SHARES: [f64; 4] = [0.0, 1.0 / 21.0, 4.0 / 105.0, 9.0 / 280.0];
    (0..27).filter(|k| *k != 13).map(|k| {
        let step: [isize; 3] = [k / 9 - 1, k / 3 % 3 - 1, k % 3 - 1];
        let length: isize = step.iter().map(|s| s.abs()).sum();
        (step, SHARES[length as usize])
    })
}

/// Marks the cells of a grid of `count` cells from which at least `least` of all directions meet
/// an occupied cell. Cells are in the order of their coordinates, the last one fastest.
pub(super) fn enclosed(count: [usize; 3], is_occupied: &[bool], least: f64) -> Vec<bool> {
    let mut met = vec![0.0f32; is_occupied.len()];
    let mut blocked = vec![false; is_occupied.len()];
    for (step, share) in directions() {
        sweep(count, step, is_occupied, &mut blocked);
        for (sum, blocked) in met.iter_mut().zip(&blocked) {
            if *blocked {
                *sum += share as f32;
            }
        }
    }
    met.iter().zip(is_occupied).map(|(m, occupied)| *occupied || f64::from(*m) >= least).collect()
}

/// For each cell, whether a straight way by `step` meets an occupied one.
fn sweep(count: [usize; 3], step: [isize; 3], is_occupied: &[bool], blocked: &mut [bool]) {
    // The cell ahead is done before its own.
    let along = |axis: usize| {
        let n = count[axis];
        (0..n).map(move |i| if step[axis] > 0 { n - 1 - i } else { i })
    };
    let ahead = |axis: usize, i: usize| i.checked_add_signed(step[axis]).filter(|&next| next < count[axis]);
    let [_, ny, nz] = count;
    for i in along(0) {
        let next_i = ahead(0, i);
        for j in along(1) {
            let next_j = ahead(1, j);
            let row = (i * ny + j) * nz;
            let next_row = next_i.zip(next_j).map(|(i, j)| (i * ny + j) * nz);
            for k in along(2) {
                let next = next_row.zip(ahead(2, k)).map(|(row, k)| row + k);
                blocked[row + k] = next.is_some_and(|n| is_occupied[n] || blocked[n]);
            }
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
        assert!((directions().map(|d| d.1).sum::<f64>() - 1.0).abs() < 1e-12);
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
