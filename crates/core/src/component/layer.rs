//! The layers of a flat component.
//!
//! Folded flat, the panels above the first fold hinges lie developed round the top panel and those
//! below the last ones round the bottom panel; a convex component has no others. Panels collide
//! when flat exactly where two chains overlap in one of these developments. Slits are free edges,
//! so trimming a panel there never breaks foldability: overlapping chains are cut back to a ray
//! from the corner between their edges. What lies between the two is free to lie in any order
//! against other chains, unless it is of boards, which have a layer each.

use super::panel::ChainId;
use super::symmetry::Symmetry;
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
    pub(super) chain: ChainId,
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
/// convex polygon. Walls that are their own mirror image are trimmed so that they stay so. Returns
/// the area that was cut away, mm².
pub(super) fn trim(walls: &Walls, sides: &mut [Side], are_boards: bool) -> f64 {
    let mut trimmed = 0.0;
    let mut layers = vec![Layer::Top, Layer::Bottom];
    if are_boards {
        let mut between: Vec<Layer> = sides.iter().map(|side| side.layer).collect();
        between.sort_unstable();
        between.dedup();
        layers.extend(between.into_iter().filter(|layer| matches!(layer, Layer::Between { .. })));
    }
    let is_level = walls.symmetry().is_some_and(Symmetry::is_level);
    if is_level {
        // What is cut from the top panel's layer is cut from its image too.
        layers.retain(|layer| *layer != Layer::Bottom);
    }
    for layer in layers {
        for everywhere in [false, true] {
            let clashes = overlaps(sides, layer);
            if clashes.is_empty() {
                break;
            }
            let clash = |j: ChainId| {
                let k = walls.next(j);
                clashes.contains(&(j.min(k), j.max(k)))
            };
            for j in walls.ids() {
                if walls.corner_images(j).any(|image| image.0 < j) {
                    continue;
                }
                if everywhere || clash(j) || walls.corner_images(j).any(|image| clash(image.0)) {
                    trimmed += trim_corner(walls, sides, layer, j);
                }
            }
        }
    }
    trimmed
}

/// Pairs of chains that overlap in a layer, the smaller index first.
pub(super) fn overlaps(sides: &[Side], layer: Layer) -> Vec<(ChainId, ChainId)> {
    let placed: Vec<(ChainId, Vec<DVec2>)> =
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

/// Cuts chains j and j + 1 back to the ray from their corner that costs the least area, and their
/// images to its images.
fn trim_corner(walls: &Walls, sides: &mut [Side], layer: Layer, j: ChainId) -> f64 {
    let costs: Vec<f64> = (0..RAYS).map(|ray| Cut { walls, layer, j, ray }.area(sides)).collect();
    let best = match walls.corner_images(j).any(|image| image.0 == j) {
        // Of the rays from a corner in the plane, one is its own image.
        true => RAYS / 2,
        false => (0..RAYS).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(RAYS / 2),
    };
    let mut cuts = vec![Cut { walls, layer, j, ray: best }];
    if walls.symmetry().is_some_and(Symmetry::is_level) {
        cuts.push(Cut { walls, layer: Layer::Bottom, j, ray: best });
    }
    for (image, is_reflected) in walls.corner_images(j) {
        if cuts.iter().all(|cut| cut.j != image) {
            let ray = if is_reflected { RAYS - 1 - best } else { best };
            cuts.push(Cut { walls, layer, j: image, ray });
        }
    }
    cuts.iter().for_each(|cut| cut.make(sides));
    cuts.len() as f64 * costs[best].max(0.0)
}

/// A cut along one of the rays from the corner of chain j with the next.
#[derive(Clone, Copy)]
struct Cut<'a> {
    walls: &'a Walls,
    layer: Layer,
    j: ChainId,
    ray: usize,
}

impl Cut<'_> {
    /// What it leaves of a side panel; `None` for those that it does not concern.
    fn left(&self, side: &Side) -> Option<Vec<DVec2>> {
        let Self { walls, layer, j, ray } = *self;
        let k = walls.next(j);
        if side.layer != layer || (side.chain != j && side.chain != k) {
            return None;
        }
        let corner =
            walls.corner_at(j, if layer == Layer::Bottom { walls.bottom_mm() } else { walls.top_mm() });
        let from = walls.normal(j).to_angle();
        let turn = (walls.normal(k).to_angle() - from).rem_euclid(std::f64::consts::TAU);
        let direction = DVec2::from_angle(from + turn * ray as f64 / (RAYS - 1) as f64);
        let normal = if side.chain == j { direction.perp() } else { -direction.perp() };
        Some(side.clipped(corner, normal))
    }

    /// The area that it takes, mm².
    fn area(&self, sides: &[Side]) -> f64 {
        let cut = sides.iter().filter_map(|s| Some((s, self.left(s)?)));
        cut.map(|(s, left)| polygon::area(&s.outline) - polygon::area(&left)).sum()
    }

    fn make(&self, sides: &mut [Side]) {
        for side in sides {
            if let Some(left) = self.left(side) {
                side.outline = left;
            }
        }
    }
}
