//! Filling and smoothing of values on a surface, at a scale that does not depend on its
//! resolution.

use super::surface::Surface;

/// The smoothing reaches this share of the square root of the area.
const REACH: f64 = 0.02;

/// At most as many cells are averaged for one.
const MOST_NEIGHBOURS: usize = 48;

/// Fills missing values from the neighbours, outwards from the known ones; those of bodies with
/// none get the smallest. `None` where all are missing.
pub(super) fn fill(surface: &Surface, values: &[Option<f64>]) -> Option<Vec<f64>> {
    let least = values.iter().flatten().copied().min_by(f64::total_cmp)?;
    let mut filled = values.to_vec();
    let mut front: Vec<usize> = (0..values.len()).filter(|&c| values[c].is_none()).collect();
    while !front.is_empty() {
        let mean = |cell: usize| {
            let known = surface.around(cell).filter_map(|(other, _)| filled[other]);
            let (sum, n) = known.fold((0.0, 0), |(s, n), v| (s + v, n + 1));
            (n > 0).then(|| sum / n as f64)
        };
        let found: Vec<(usize, f64)> = front.iter().filter_map(|&c| Some((c, mean(c)?))).collect();
        if found.is_empty() {
            break;
        }
        for (cell, value) in found {
            filled[cell] = Some(value);
        }
        front.retain(|&c| filled[c].is_none());
    }
    Some(filled.into_iter().map(|v| v.unwrap_or(least)).collect())
}

/// Bilateral filter over the cells within reach: near in distance and alike in value count most.
pub(super) fn bilateral(surface: &Surface, values: &[f64]) -> Vec<f64> {
    let reach = REACH * surface.total_area().sqrt();
    let centres = surface.centres();
    let mut seen = vec![u32::MAX; surface.len()];
    let mut near = Vec::new();
    let mut out = Vec::with_capacity(values.len());
    for cell in 0..surface.len() {
        gather(surface, cell, reach, &mut seen, &mut near);
        let square = |c: &usize| (values[*c] - values[cell]).powi(2);
        let spread = 1.5 * (near.iter().map(square).sum::<f64>() / near.len() as f64).sqrt();
        let (mut sum, mut weight) = (0.0, 0.0);
        for c in &near {
            let d = centres[*c].distance_squared(centres[cell]) / (reach * reach / 2.0);
            let r = if spread > 0.0 { square(c) / (2.0 * spread * spread) } else { 0.0 };
            let w = surface.areas()[*c] * libm::exp(-d - r);
            sum += w * values[*c];
            weight += w;
        }
        out.push(if weight > 0.0 { sum / weight } else { values[cell] });
    }
    out
}

/// The cells within reach of one, breadth first, itself first.
fn gather(surface: &Surface, cell: usize, reach: f64, seen: &mut [u32], near: &mut Vec<usize>) {
    near.clear();
    near.push(cell);
    seen[cell] = cell as u32;
    let mut head = 0;
    while head < near.len() {
        let from = near[head];
        head += 1;
        for (other, _) in surface.around(from) {
            let close = surface.centres()[other].distance(surface.centres()[cell]) <= reach;
            if seen[other] != cell as u32 && (close || head == 1) && near.len() < MOST_NEIGHBOURS {
                seen[other] = cell as u32;
                near.push(other);
            }
        }
    }
}

/// Logarithmic scale from 0 to 1, which tells small diameters apart better than large ones
/// (Shapira et al. 2008, α = 4).
pub(super) fn normalise(values: &[f64]) -> Vec<f64> {
    const ALPHA: f64 = 4.0;
    let lo = values.iter().copied().fold(f64::INFINITY, f64::min);
    let hi = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let span = if hi > lo { hi - lo } else { 1.0 };
    values.iter().map(|v| libm::log1p(ALPHA * (v - lo) / span) / libm::log1p(ALPHA)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::shapes::balls_in_a_row;
    use super::*;

    fn ball() -> Surface {
        let (positions, faces) = balls_in_a_row(&[(0.0, 1.0)], 80, 80);
        Surface::of_faces(&positions, &faces)
    }

    #[test]
    fn the_scale_is_that_of_the_formula_by_hand() {
        // ln(4 · x + 1)/ln 5 at x = 0, ½, 1.
        let found = normalise(&[3.0, 5.0, 7.0]);
        for (found, by_hand) in found.iter().zip([0.0, 0.682_606, 1.0]) {
            assert!((found - by_hand).abs() < 1e-6, "{found}");
        }
        assert_eq!(normalise(&[2.0, 2.0]), [0.0, 0.0]);
    }

    #[test]
    fn missing_values_are_filled_from_their_neighbours() {
        let surface = ball();
        let known = |c: usize| c.is_multiple_of(7);
        let values: Vec<Option<f64>> =
            (0..surface.len()).map(|c| known(c).then(|| surface.centres()[c].z)).collect();
        let filled = fill(&surface, &values).unwrap();
        for (c, value) in filled.iter().enumerate() {
            assert!((value - surface.centres()[c].z).abs() < 0.5, "{c}: {value}");
            assert!(!known(c) || *value == surface.centres()[c].z);
        }
        assert_eq!(fill(&surface, &vec![None; surface.len()]), None);
    }

    #[test]
    fn smoothing_quiets_noise_and_keeps_a_step() {
        let surface = ball();
        let noise = |c: usize| (libm::sin(c as f64 * 12.9898) * 43_758.545).fract() * 0.1;
        let step = |c: usize| f64::from(u8::from(surface.centres()[c].z > 0.0));
        let values: Vec<f64> = (0..surface.len()).map(|c| step(c) + noise(c)).collect();
        let smooth = bilateral(&surface, &values);
        let off = |v: &[f64]| (0..v.len()).map(|c| (v[c] - step(c)).powi(2)).sum::<f64>();
        assert!(off(&smooth) < 0.7 * off(&values), "{} {}", off(&smooth), off(&values));
        // A plain mean leaves cells at the step in the middle, at a distance of 0.5.
        assert!((0..smooth.len()).all(|c| (smooth[c] - step(c)).abs() < 0.45));
    }
}
