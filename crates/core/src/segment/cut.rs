//! Labels by graph cut: α-expansion (Boykov, Veksler and Zabih 2001) of a Potts energy that does
//! not depend on the resolution.

use super::gmm::Mixture;
use super::maxflow::Network;
use super::surface::Surface;

/// Smaller probabilities count as this one.
const LEAST_PROBABILITY: f64 = 5e-6;

/// Convex edges count as this share of their angle.
const CONVEX: f64 = 0.08;

/// Most passes over all labels.
const PASSES: usize = 4;

/// What it costs to cut along an edge of mean length, by the angle between the normals (positive
/// where concave): little along sharp concave edges.
/// The formula is that of the edge term in Shapira et al. 2008.
pub(super) fn crease_cost(turn_rad: f64) -> f64 {
    let share = if turn_rad > 0.0 { turn_rad } else { CONVEX * -turn_rad };
    -libm::log((share / std::f64::consts::PI).max(LEAST_PROBABILITY))
}

/// Labels the cells by the mixture's Gaussians. Data terms are weighted by area and borders by
/// length, each over its mean.
pub(super) fn soft_labels(surface: &Surface, values: &[f64], mixture: &Mixture, smoothing: f64) -> Vec<u32> {
    let labels = mixture.len();
    let mean_area = surface.total_area() / surface.len().max(1) as f64;
    let mut data = Vec::with_capacity(surface.len() * labels);
    for (value, area) in values.iter().zip(surface.areas()) {
        for p in mixture.memberships(*value) {
            data.push(-libm::log(p.max(LEAST_PROBABILITY)) * area / mean_area);
        }
    }
    let mean_length = surface.mean_length();
    let weights: Vec<f64> = surface
        .links()
        .iter()
        .map(|l| smoothing * crease_cost(l.turn_rad) * l.length / mean_length)
        .collect();
    let cheapest = |cell: usize| {
        let costs = &data[cell * labels..(cell + 1) * labels];
        (0..labels).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(0) as u32
    };
    let mut label: Vec<u32> = (0..surface.len()).map(cheapest).collect();
    for _ in 0..PASSES {
        let mut changed = false;
        for alpha in 0..labels as u32 {
            changed |= expand(surface, &data, &weights, labels, &mut label, alpha);
        }
        if !changed {
            break;
        }
    }
    label
}

/// One expansion move: each cell keeps its label (source) or takes `alpha` (sink).
fn expand(
    surface: &Surface,
    data: &[f64],
    weights: &[f64],
    labels: usize,
    label: &mut [u32],
    alpha: u32,
) -> bool {
    let mut network = Network::new(label.len(), weights.len());
    for (cell, &own) in label.iter().enumerate() {
        let cost = |l: u32| data[cell * labels + l as usize];
        // A cell that has the label already stays.
        let keep = if own == alpha { f64::MAX.sqrt() } else { cost(own) };
        network.add_costs(cell, keep, cost(alpha));
    }
    for (link, &w) in surface.links().iter().zip(weights) {
        let [a, b] = link.cells.map(|c| c as usize);
        let differ = |p: u32, q: u32| if p == q { 0.0 } else { w };
        let stay = differ(label[a], label[b]);
        let (only_b, only_a) = (differ(label[a], alpha), differ(alpha, label[b]));
        // Kolmogorov and Zabih 2004: a pair's energy as terminal costs and one arc.
        network.add_costs(a, stay, 0.0);
        let forth = only_b - stay;
        if forth < 0.0 {
            network.add_costs(a, forth, 0.0);
            network.add_costs(b, -forth, 0.0);
            network.add_arc(a, b, 0.0, forth + only_a);
        } else {
            network.add_arc(a, b, forth, only_a);
        }
    }
    let mut changed = false;
    for (own, takes) in label.iter_mut().zip(network.sink_side()) {
        if takes && *own != alpha {
            *own = alpha;
            changed = true;
        }
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::f64::consts::PI;

    #[test]
    fn creases_cost_what_the_formula_gives_by_hand() {
        for (turn_rad, by_hand) in [
            (0.0, 12.206_073),      // −ln 5e-6
            (PI / 4.0, 1.386_294),  // −ln ¼
            (-PI / 2.0, 3.218_876), // −ln 0.04
            (PI / 3.0, 1.098_612),  // −ln ⅓
            (-PI, 2.525_729),       // −ln 0.08
        ] {
            assert!((crease_cost(turn_rad) - by_hand).abs() < 1e-6, "{turn_rad}");
        }
    }

    /// A folded strip of 12 triangles.
    fn strip() -> Surface {
        let positions: Vec<DVec3> = (0..7)
            .flat_map(|i| {
                let x = f64::from(i);
                let z = if i > 3 { x - 3.0 } else { 0.0 };
                [DVec3::new(x, 0.0, z), DVec3::new(x, 1.0 + 0.1 * x, z)]
            })
            .collect();
        let faces: Vec<[u32; 3]> =
            (0..6).flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 1], [2 * i + 1, 2 * i + 2, 2 * i + 3]]).collect();
        Surface::of_faces(&positions, &faces)
    }

    /// The energy as it is defined, term by term.
    fn energy(surface: &Surface, values: &[f64], mixture: &Mixture, smoothing: f64, label: &[u32]) -> f64 {
        let mean_area = surface.total_area() / surface.len() as f64;
        let data = (0..surface.len()).map(|c| {
            let p = mixture.memberships(values[c])[label[c] as usize];
            -libm::log(p.max(5e-6)) * surface.areas()[c] / mean_area
        });
        let borders =
            surface.links().iter().filter(|l| label[l.cells[0] as usize] != label[l.cells[1] as usize]);
        let borders = borders.map(|l| smoothing * crease_cost(l.turn_rad) * l.length / surface.mean_length());
        data.sum::<f64>() + borders.sum::<f64>()
    }

    #[test]
    fn two_labels_are_cut_at_the_least_energy_of_all() {
        let surface = strip();
        let values = [0.1, 0.2, 0.15, 0.6, 0.1, 0.5, 0.7, 0.8, 0.3, 0.9, 0.85, 0.2];
        let mixture = Mixture::fit(&values, surface.areas(), 2);
        for smoothing in [0.0, 0.02, 0.1, 0.5, 3.0] {
            let value = |label: &[u32]| energy(&surface, &values, &mixture, smoothing, label);
            let least = (0..1u32 << 12)
                .map(|bits| value(&(0..12).map(|c| bits >> c & 1).collect::<Vec<_>>()))
                .fold(f64::INFINITY, f64::min);
            let found = value(&soft_labels(&surface, &values, &mixture, smoothing));
            assert!((found - least).abs() < 1e-9, "{smoothing}: {found}, not {least}");
        }
    }
}
