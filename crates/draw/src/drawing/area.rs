//! Areas that are filled with a tint or with lines.

use super::{Fill, Layer, LineStyles, Mark, Polyline};
use glam::DVec2;
use std::f64::consts::FRAC_PI_4;
use tatamu_core::geom::polygon;

/// Distance of the lines of a hatch, mm.
const HATCH_MM: f64 = 1.4;

/// The corners of an upright rectangle, from the lower left one to the right and round.
pub fn rectangle(low: DVec2, high: DVec2) -> [DVec2; 4] {
    [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]
}

impl Mark {
    /// A convex area of a layer, filled as its style says; none where that leaves it plain.
    pub fn area(layer: Layer, corners: &[DVec2], styles: &LineStyles) -> Option<Self> {
        match styles.fill(layer) {
            Fill::Plain => None,
            Fill::Tint(colour) => Some(Self::filled(layer, corners.to_vec(), colour)),
            Fill::Hatch => Some(Self::path(layer, hatch(corners), Some(styles.stroke(layer).clone()), None)),
        }
    }
}

/// Parallel lines in a convex area, at multiples of their distance from the middle of it.
fn hatch(corners: &[DVec2]) -> Vec<Polyline> {
    let along = DVec2::from_angle(FRAC_PI_4);
    let across = along.perp();
    let middle = polygon::centroid(corners);
    let (low, high) = corners
        .iter()
        .map(|&c| across.dot(c - middle))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let lines = (low / HATCH_MM).ceil() as i64..=(high / HATCH_MM).floor() as i64;
    lines.filter_map(|k| chord(corners, middle + across * (k as f64 * HATCH_MM), along)).collect()
}

/// The part of a line that lies in a convex area.
fn chord(corners: &[DVec2], start: DVec2, along: DVec2) -> Option<Polyline> {
    let meetings = polygon::edges(corners).filter_map(|(a, b)| {
        let (edge, speed) = (b - a, along.perp_dot(b - a));
        let at_edge = (a - start).perp_dot(along) / speed;
        let is_met = speed != 0.0 && (0.0..1.0).contains(&at_edge);
        is_met.then(|| along.dot(a + edge * at_edge - start))
    });
    let (low, high) =
        meetings.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), t| (low.min(t), high.max(t)));
    (low < high).then(|| Polyline::open(vec![start + along * low, start + along * high]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_runs_round_its_middle_counterclockwise() {
        let (low, high) = (DVec2::new(-1.0, 2.0), DVec2::new(3.0, 7.0));
        let corners = rectangle(low, high);
        assert_eq!((corners[0], polygon::bounds(corners)), (low, Some((low, high))));
        // The area is the product of the sides only if no two corners are swapped.
        assert_eq!(polygon::area(&corners), 20.0);
    }

    #[test]
    fn a_hatch_fills_an_area_and_stays_in_it() {
        let tab = [DVec2::ZERO, DVec2::new(30.0, 0.0), DVec2::new(27.0, 6.0), DVec2::new(4.0, 6.0)];
        let lines = hatch(&tab);
        // Each line stands for a strip of its distance.
        let total: f64 = lines.iter().map(|l| l.points[0].distance(l.points[1])).sum();
        let area = polygon::area(&tab);
        assert!((total * HATCH_MM - area).abs() < 0.1 * area, "{total} {area}");
        for point in lines.iter().flat_map(|line| &line.points) {
            assert!(polygon::depth_outside(&tab, *point) < 1e-9, "{point}");
        }
    }

    #[test]
    fn the_style_decides_how_an_area_is_filled() {
        let square = rectangle(DVec2::ZERO, DVec2::splat(9.0));
        let area = |styles: &LineStyles| Mark::area(Layer::Tab, &square, styles);
        let style = |fill: &str| LineStyles::parse(&format!("[tab]\nfill = \"{fill}\"")).unwrap();
        assert!(area(&style("none")).is_none());
        assert!(area(&style("#e0e0e0").with_plain(Layer::Tab)).is_none());
        let fills = |mark: Option<Mark>| match mark.unwrap().shape {
            super::super::Shape::Path { fill, stroke, .. } => (fill.is_some(), stroke.is_some()),
            _ => panic!("no path"),
        };
        assert_eq!(fills(area(&style("#e0e0e0"))), (true, false));
        assert_eq!(fills(area(&style("hatch"))), (false, true));
        assert!(LineStyles::parse("[tab]\nfill = \"dots\"").unwrap_err().to_string().contains("hatch"));
    }
}
