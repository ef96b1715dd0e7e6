//! From a piece's border walk to lines that are cut once each.

use glam::DVec2;

/// Corners and edges nearer than this lie on one another: no blade cuts between them. The teapot's spout
/// had two sides of a slit 0.002 mm apart; the narrowest slit that one sees on paper is 0.1 mm wide.
const COINCIDENT_MM: f64 = 0.01;

/// The closed outline and, apart from it, the slits whose two sides touch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CutLines {
    pub(crate) outline: Vec<DVec2>,
    pub(crate) slits: Vec<Vec<DVec2>>,
}

/// The corners of a piece as they are drawn: those that lie on one another are one point, their middle.
pub(crate) fn welded(corners: &[DVec2]) -> Vec<DVec2> {
    let mut first: Vec<usize> = (0..corners.len()).collect();
    for k in 0..corners.len() {
        let near = (0..k).find(|&j| corners[j].distance(corners[k]) < COINCIDENT_MM);
        first[k] = near.map_or(k, |j| first[j]);
    }
    let middle = |of: usize| {
        let (sum, count) = first
            .iter()
            .zip(corners)
            .filter(|(f, _)| **f == of)
            .fold((DVec2::ZERO, 0.0), |(sum, count), (_, p)| (sum + *p, count + 1.0));
        sum / count
    };
    let is_alone = |k: usize| first[k] == k && !first[k + 1..].contains(&k);
    (0..corners.len()).map(|k| if is_alone(k) { corners[k] } else { middle(first[k]) }).collect()
}

/// Takes the spikes out of a border walk: where it goes along a line and straight back, the line
/// is a slit without width, to be cut once.
pub(crate) fn cut_lines(mut walk: Vec<DVec2>) -> CutLines {
    let mut slits: Vec<Vec<DVec2>> = Vec::new();
    while let Some(tip) = (0..walk.len()).find(|&k| is_spike(&walk, k)) {
        let n = walk.len();
        let (before, at, after) = (walk[(tip + n - 1) % n], walk[tip], walk[(tip + 1) % n]);
        let mouth = if before.distance(at) < after.distance(at) { before } else { after };
        match slits.iter_mut().find(|s| s.last().is_some_and(|p| p.distance(at) < COINCIDENT_MM)) {
            Some(slit) => slit.push(mouth),
            None => slits.push(vec![at, mouth]),
        }
        walk[tip] = mouth;
        walk.dedup_by(|a, b| a.distance(*b) < COINCIDENT_MM);
        while walk.len() > 1 && walk[0].distance(walk[walk.len() - 1]) < COINCIDENT_MM {
            walk.pop();
        }
    }
    CutLines { outline: walk, slits }
}

fn is_spike(walk: &[DVec2], k: usize) -> bool {
    let n = walk.len();
    let (a, b) = (walk[(k + n - 1) % n] - walk[k], walk[(k + 1) % n] - walk[k]);
    let (short, long) = if a.length() < b.length() { (a, b) } else { (b, a) };
    n > 3 && short.dot(long) > 0.0 && short.perp_dot(long.normalize_or_zero()).abs() < COINCIDENT_MM
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_slit_is_taken_out_once() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let walk = vec![
            at(0.0, 0.0),
            at(10.0, 0.0),
            at(10.0, 10.0),
            at(5.0, 10.0),
            at(5.0, 7.0),
            at(4.0, 4.0),
            at(5.0, 7.0),
            at(5.0, 10.0),
            at(0.0, 10.0),
        ];
        let lines = cut_lines(walk);
        assert_eq!(lines.slits, vec![vec![at(4.0, 4.0), at(5.0, 7.0), at(5.0, 10.0)]]);
        assert_eq!(lines.outline.len(), 5);
        assert_eq!(tatamu_core::geom::polygon::area(&lines.outline), 100.0);
    }

    #[test]
    fn a_slit_whose_sides_lie_within_a_hundredth_of_a_millimetre_is_cut_once() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        // The sides open to 2 µm, and have corners at different heights.
        let walk = vec![
            at(0.0, 0.0),
            at(10.0, 0.0),
            at(10.0, 10.0),
            at(5.001, 10.0),
            at(5.0, 4.0),
            at(4.9995, 7.0),
            at(4.999, 10.0),
            at(0.0, 10.0),
        ];
        let lines = cut_lines(welded(&walk));
        assert_eq!(lines.slits.len(), 1, "{lines:?}");
        let length: f64 = lines.slits[0].windows(2).map(|w| w[0].distance(w[1])).sum();
        assert!((length - 6.0).abs() < 1e-3, "{length}");
        assert_eq!(lines.outline.len(), 5, "{lines:?}");
    }

    #[test]
    fn only_corners_that_lie_on_one_another_move() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let corners = [at(1.0, 1.0), at(3.0, 1.0), at(1.004, 1.0), at(1.0, 1.02)];
        let welded = welded(&corners);
        assert_eq!((welded[0], welded[2]), (at(1.002, 1.0), at(1.002, 1.0)));
        assert_eq!((welded[1], welded[3]), (corners[1], corners[3]));
    }

    #[test]
    fn sides_of_different_length_leave_the_rest() {
        let at = |x: f64, y: f64| DVec2::new(x, y);
        let walk = vec![
            at(0.0, 0.0),
            at(9.0, 0.0),
            at(9.0, 9.0),
            at(5.0, 9.0),
            at(5.0, 3.0),
            at(5.0, 7.0),
            at(0.0, 7.0),
        ];
        let lines = cut_lines(walk);
        assert_eq!(lines.slits, vec![vec![at(5.0, 3.0), at(5.0, 7.0)]]);
        assert!((tatamu_core::geom::polygon::area(&lines.outline) - (9.0 * 9.0 - 5.0 * 2.0)).abs() < 1e-12);
    }
}
