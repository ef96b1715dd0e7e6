//! Whether a piece fits a sheet, at which angle, and how large it may be.
//!
//! While a polygon turns, the corners that bound it change only at angles where an edge of its
//! convex hull is parallel to an axis (rotating calipers). Between two such angles the width and
//! the height of its bounding box are each a cosine arch, hence concave. So the smallest share of
//! the sheet that the piece needs, `max(width / sheet width, height / sheet height)`, is reached
//! at one of these angles or where the two shares are equal: a finite list of candidates, exact.

use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, PI};
use tatamu_core::geom::polygon::{self, extent};

/// Angles at which a piece may stand on the sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rotation {
    /// Any angle.
    #[default]
    Free,
    /// Multiples of 90° only, for paper with a grain.
    QuarterTurns,
}

/// A piece may be larger than the sheet by this share: rounding, 2e-8 mm on a sheet of 200 mm.
const ROUNDING: f64 = 1e-10;

/// The best way to put one piece on an empty sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Angle by which to turn the piece, counter-clockwise.
    pub angle_rad: f64,
    /// Largest factor by which the piece may be scaled and still fits: below 1, it is too large.
    pub scale: f64,
}

/// The angle at which a polygon may be largest on a sheet of `width_mm` × `height_mm`, exact for
/// [`Rotation::Free`] too. Infinite scale for a polygon without an extent.
pub fn best_fit(outline: &[DVec2], width_mm: f64, height_mm: f64, rotation: Rotation) -> Fit {
    let hull = polygon::convex_hull(outline);
    let sheet = DVec2::new(width_mm, height_mm);
    let candidates = match rotation {
        Rotation::Free => free_angles(&hull, sheet),
        Rotation::QuarterTurns => vec![0.0, FRAC_PI_2],
    };
    let start = Fit { angle_rad: 0.0, scale: 0.0 };
    candidates.into_iter().fold(start, |best, angle_rad| {
        let scale = (sheet / extent(&hull, angle_rad)).min_element();
        // The margin prefers the first of equal angles, whatever the rounding.
        if scale > best.scale * (1.0 + ROUNDING) { Fit { angle_rad, scale } } else { best }
    })
}

/// Whether an extent fits the sheet within rounding.
pub(super) fn is_within(extent: DVec2, width_mm: f64, height_mm: f64) -> bool {
    let sheet = DVec2::new(width_mm, height_mm);
    extent.cmple(sheet * (1.0 + ROUNDING)).all()
}

/// All angles in [0, π) at which the share of the sheet can be least.
fn free_angles(hull: &[DVec2], sheet: DVec2) -> Vec<f64> {
    let mut critical: Vec<f64> =
        polygon::edges(hull).map(|(a, b)| (-(b - a).to_angle()).rem_euclid(FRAC_PI_2)).collect();
    critical.extend(critical.clone().iter().map(|a| a + FRAC_PI_2));
    critical.sort_by(f64::total_cmp);
    let mut angles = critical.clone();
    let wrap = critical.first().map(|a| a + PI);
    let ends = critical.iter().copied().skip(1).chain(wrap);
    for (&from, to) in critical.iter().zip(ends) {
        let angle = equal_share_angle(hull, sheet, (from + to) / 2.0);
        if (from..=to).contains(&angle) {
            angles.push(angle);
        }
    }
    angles
}

/// The angle within 90° of `middle` at which the corners that bound the hull at `middle` take
/// the same share of the sheet's width and height. With `p` from the leftmost to the rightmost corner
/// and `q` from the lowest to the topmost:
/// `(p.x cos θ − p.y sin θ) / width = (q.x sin θ + q.y cos θ) / height`.
fn equal_share_angle(hull: &[DVec2], sheet: DVec2, middle: f64) -> f64 {
    let turn = DVec2::from_angle(middle);
    let span = |key: fn(DVec2) -> f64| {
        let along = |p: &DVec2| key(turn.rotate(*p));
        let by_key = |a: &&DVec2, b: &&DVec2| along(a).total_cmp(&along(b));
        let (lo, hi) = (hull.iter().min_by(by_key), hull.iter().max_by(by_key));
        hi.copied().unwrap_or_default() - lo.copied().unwrap_or_default()
    };
    let p = span(|r| r.x) / sheet.x;
    let q = span(|r| r.y) / sheet.y;
    let angle = libm::atan2(p.x - q.y, q.x + p.y);
    middle + (angle - middle + FRAC_PI_2).rem_euclid(PI) - FRAC_PI_2
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// An angle at which the polygon fits the sheet, if there is one.
    fn fits(outline: &[DVec2], width_mm: f64, height_mm: f64, rotation: Rotation) -> Option<f64> {
        let fit = best_fit(outline, width_mm, height_mm, rotation);
        (fit.scale >= 1.0 - ROUNDING).then_some(fit.angle_rad)
    }

    fn rectangle(width: f64, height: f64) -> Vec<DVec2> {
        [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(DVec2::from).to_vec()
    }

    #[test]
    fn a_rectangle_of_the_sheets_size_fits_in_any_pose() {
        for angle in [0.0, 0.3, 1.0, 2.0, 4.5] {
            let turn = DVec2::from_angle(angle);
            let piece: Vec<_> = rectangle(277.0, 190.0).into_iter().map(|p| turn.rotate(p)).collect();
            let found = fits(&piece, 190.0, 277.0, Rotation::Free).unwrap();
            let size = extent(&piece, found);
            assert!((size - DVec2::new(190.0, 277.0)).abs().max_element() < 1e-9);
        }
    }

    #[test]
    fn a_needle_fits_along_the_diagonal_up_to_the_closed_formula() {
        let (width, height, thick) = (190.0_f64, 277.0_f64, 4.0);
        // Largest length l of an l × t bar: both equations l cos θ + t sin θ = 190 and
        // l sin θ + t cos θ = 277 hold; solved by bisection on θ, independent of the code.
        let (mut lo, mut hi) = (0.0_f64, FRAC_PI_2);
        let length = |a: f64| (width - thick * libm::sin(a)) / libm::cos(a);
        for _ in 0..200 {
            let mid = (lo + hi) / 2.0;
            if length(mid) * libm::sin(mid) + thick * libm::cos(mid) < height {
                lo = mid;
            } else {
                hi = mid;
            }
        }
        let longest = length(lo);
        assert!(longest > height + 40.0);
        let at = |l: f64| fits(&rectangle(l, thick), width, height, Rotation::Free);
        assert!(at(longest - 1e-6).is_some());
        assert!(at(longest + 1e-6).is_none());
        let quarter = Rotation::QuarterTurns;
        assert!(fits(&rectangle(277.1, thick), width, height, quarter).is_none());
        assert!(fits(&rectangle(276.9, thick), width, height, quarter).is_some());
    }

    proptest! {
        /// No angle of a fine sweep beats the exact answer, and the answer is reached.
        #[test]
        fn no_angle_allows_a_larger_scale(
            points in prop::collection::vec((-50.0..50.0, -50.0..50.0), 3..12),
            width in 20.0..300.0_f64,
            height in 20.0..300.0_f64,
        ) {
            let points: Vec<_> = points.into_iter().map(DVec2::from).collect();
            let fit = best_fit(&points, width, height, Rotation::Free);
            let scale = |a: f64| (DVec2::new(width, height) / extent(&points, a)).min_element();
            prop_assert!((scale(fit.angle_rad) - fit.scale).abs() < 1e-9 * fit.scale);
            for step in 0..720 {
                let other = scale(PI * f64::from(step) / 720.0);
                prop_assert!(other <= fit.scale * (1.0 + 1e-9));
            }
        }
    }
}
