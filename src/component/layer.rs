//! The layers of a flat component.
//!
//! Folded flat, the panels above the first fold hinges lie developed round the top panel and those
//! below the last ones round the bottom panel; a convex component has no others. Panels collide
//! when flat exactly where two chains overlap in one of these developments. Slits are free edges,
//! so trimming a panel there never breaks foldability: overlapping chains are cut back to a ray
//! from the corner between their edges. What lies between the two is free to lie in any order
//! against other chains, unless it is of boards, which have a layer each.

use super::walls::Walls;
use crate::geom::polygon;
use glam::{DAffine2, DVec2};

/// A layer of the flat stack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Layer {
    /// The top panel's.
    Top,
    /// One between them, whose panels face up or down.
    Between {
        /// Whether it shows its outside upwards.
        faces_up: bool,
        /// Its number under the top panel's.
        run: usize,
    },
    /// The bottom panel's.
    Bottom,
}

impl Layer {
    /// Whether its panels face up.
    pub(super) fn faces_up(self) -> bool {
        match self {
            Layer::Top => true,
            Layer::Bottom => false,
            Layer::Between { faces_up, .. } => faces_up,
        }
    }
}

/// A side panel under construction.
#[derive(Debug, Clone)]
pub(super) struct Side {
    /// Chain.
    pub(super) chain: usize,
    /// Outline in the panel's plane: x along the edge, y up the slope from the lower hinge.
    pub(super) outline: Vec<DVec2>,
    /// Placement in its layer, seen from above.
    pub(super) to_layer: DAffine2,
    /// Where it lies.
    pub(super) layer: Layer,
}

impl Side {
    /// Outline in the layer, counter-clockwise as seen from above.
    fn in_layer(&self) -> Vec<DVec2> {
        let mut outline: Vec<DVec2> =
            self.outline.iter().map(|&p| self.to_layer.transform_point2(p)).collect();
        if !self.layer.faces_up() {
            outline.reverse();
        }
        outline
    }

    /// Outline without what lies beyond the line through `corner` with normal `normal`. The
    /// corner itself stays.
    fn clipped(&self, corner: DVec2, normal: DVec2) -> Vec<DVec2> {
        let local = self.to_layer.matrix2.transpose() * normal;
        let offset = normal.dot(corner - self.to_layer.translation);
        polygon::clip(&self.outline, local, offset + KEEP_CORNER_MM)
    }
}

/// Clipping lines pass through corners of the outlines; this keeps rounding from cutting them.
const KEEP_CORNER_MM: f64 = 1e-9;
/// Overlaps below this depth are rounding.
const OVERLAP_MM: f64 = 1e-6;
/// Directions tried for the ray between two overlapping chains.
const RAYS: usize = 33;

/// Trims panels that overlap when flat: first only between the chains concerned, and where that
/// is not enough at every corner, which always suffices: the rays then part the plane round the
/// convex polygon. Returns the area that was cut away, mm².
pub(super) fn trim(walls: &Walls, sides: &mut [Side]) -> f64 {
    let mut trimmed = 0.0;
    let mut layers = vec![Layer::Top, Layer::Bottom];
    if walls.outside().is_some() {
        let mut between: Vec<Layer> = sides.iter().map(|side| side.layer).collect();
        between.sort_unstable();
        between.dedup();
        layers.extend(between.into_iter().filter(|layer| matches!(layer, Layer::Between { .. })));
    }
    for layer in layers {
        for everywhere in [false, true] {
            let clashes = overlaps(sides, layer);
            if clashes.is_empty() {
                break;
            }
            for j in 0..walls.count() {
                let k = walls.next(j);
                if everywhere || clashes.contains(&(j.min(k), j.max(k))) {
                    trimmed += trim_corner(walls, sides, layer, j);
                }
            }
        }
    }
    trimmed
}

/// Pairs of chains that overlap in a layer, the smaller index first.
pub(super) fn overlaps(sides: &[Side], layer: Layer) -> Vec<(usize, usize)> {
    let placed: Vec<(usize, Vec<DVec2>)> =
        sides.iter().filter(|s| s.layer == layer).map(|s| (s.chain, s.in_layer())).collect();
    let mut pairs = Vec::new();
    for (k, (a, p)) in placed.iter().enumerate() {
        for (b, q) in &placed[k + 1..] {
            if a != b && polygon::convex_overlap(p, q, OVERLAP_MM) {
                pairs.push((*a.min(b), *a.max(b)));
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// Cuts chains j and j + 1 back to the ray from their corner that costs the least area.
fn trim_corner(walls: &Walls, sides: &mut [Side], layer: Layer, j: usize) -> f64 {
    let k = walls.next(j);
    let corner = walls.corner_at(j, if layer == Layer::Bottom { walls.bottom_mm() } else { walls.top_mm() });
    let from = walls.normal(j).to_angle();
    let turn = (walls.normal(k).to_angle() - from).rem_euclid(std::f64::consts::TAU);
    let normal = |chain: usize, ray: usize| {
        let direction = DVec2::from_angle(from + turn * ray as f64 / (RAYS - 1) as f64);
        if chain == j { direction.perp() } else { -direction.perp() }
    };
    let concerned = |s: &&mut Side| s.layer == layer && (s.chain == j || s.chain == k);
    let cost = |ray: usize, sides: &mut [Side]| -> f64 {
        sides
            .iter_mut()
            .filter(concerned)
            .map(|s| polygon::area(&s.outline) - polygon::area(&s.clipped(corner, normal(s.chain, ray))))
            .sum()
    };
    let costs: Vec<f64> = (0..RAYS).map(|ray| cost(ray, sides)).collect();
    let best = (0..RAYS).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(RAYS / 2);
    for side in sides.iter_mut().filter(concerned) {
        side.outline = side.clipped(corner, normal(side.chain, best));
    }
    costs[best].max(0.0)
}
