//! Laying panels out flat: across hinges, into pieces, and on a sheet of given size.

use crate::fit::{self, Rotation};
use glam::{DAffine2, DMat2, DVec2, Vec2Swizzles};
use std::f64::consts::PI;
use std::sync::LazyLock;
use tatamu_core::component::{HingeId, HingeSide, PanelId, PanelSet};
use tatamu_core::geom::polygon;

/// Turns tried between those of the hull's edges, for a smaller box among those that fit: half a step from the best
/// at worst, which is 0.03% of the size.
const TURN_STEP_RAD: f64 = PI / 120.0;
/// The directions of these steps, over half a turn.
static STEPS: LazyLock<[DVec2; 120]> =
    LazyLock::new(|| std::array::from_fn(|k| DVec2::from_angle(k as f64 * TURN_STEP_RAD)));

/// Excess that counts as fitting: below what any printer resolves, above the rounding.
const FIT_TOLERANCE_MM: f64 = 1e-6;

/// Rotation by the angle of the unit complex number `unit`.
pub(crate) fn turn(unit: DVec2) -> DMat2 {
    DMat2::from_cols(unit, unit.perp())
}

/// The rigid motion that brings the plane of `hinge.sides[1 - side]` next to that of
/// `hinge.sides[side]`, unfolded flat about the hinge.
pub fn across(set: &PanelSet, hinge: HingeId, side: usize) -> DAffine2 {
    let sides = set.hinges()[hinge.0].sides;
    let [fixed, moved] = [sides[side], sides[1 - side]].map(|s| edge(set, s));
    let unit = (fixed[0] - fixed[1]).rotate((moved[1] - moved[0]) * DVec2::new(1.0, -1.0));
    let rotation = turn(unit.normalize_or(DVec2::X));
    let (to, from) = ((fixed[0] + fixed[1]) / 2.0, (moved[0] + moved[1]) / 2.0);
    DAffine2::from_mat2_translation(rotation, to - rotation * from)
}

/// Both ends of a hinge on one of its sides, in that panel's plane coordinates.
pub fn edge(set: &PanelSet, side: HingeSide) -> [DVec2; 2] {
    set.panel(side.panel).edge(side.edge)
}

/// Length of a hinge, mm.
pub fn hinge_length(set: &PanelSet, hinge: HingeId) -> f64 {
    let [a, b] = edge(set, set.hinges()[hinge.0].sides[0]);
    a.distance(b)
}

/// A panel's outline at a place.
pub(crate) fn placed_outline(set: &PanelSet, panel: PanelId, place: DAffine2) -> Vec<DVec2> {
    set.panel(panel).outline.iter().map(|&p| place.transform_point2(p)).collect()
}

/// One piece before it has tabs: its panels at their places, and the hinges that stay joined.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout {
    pub(crate) panels: Vec<(PanelId, DAffine2)>,
    pub(crate) creases: Vec<HingeId>,
}

impl Layout {
    /// The place of a panel, if it is in this piece.
    pub(crate) fn place(&self, panel: PanelId) -> Option<DAffine2> {
        self.panels.iter().find(|(id, _)| *id == panel).map(|(_, place)| *place)
    }

    /// Outlines of all panels.
    pub(crate) fn outlines(&self, set: &PanelSet) -> Vec<Vec<DVec2>> {
        self.panels.iter().map(|&(id, place)| placed_outline(set, id, place)).collect()
    }
}

/// The pieces that remain joined when the hinges with `is_cut` are cut, each unfolded from its
/// panel with the lowest id. `is_cut` must leave no cycle.
pub(crate) fn pieces(set: &PanelSet, is_cut: &[bool]) -> Vec<Layout> {
    let mut place: Vec<Option<DAffine2>> = vec![None; set.panels().len()];
    let mut out = Vec::new();
    for root in 0..place.len() {
        if place[root].is_some() {
            continue;
        }
        place[root] = Some(DAffine2::IDENTITY);
        let mut layout = Layout { panels: vec![(PanelId(root), DAffine2::IDENTITY)], creases: Vec::new() };
        let mut next = 0;
        while next < layout.panels.len() {
            let (from, at) = layout.panels[next];
            next += 1;
            for (id, hinge) in set.hinges().iter().enumerate().filter(|(id, _)| !is_cut[*id]) {
                let Some(side) = hinge.sides.iter().position(|s| s.panel == from) else {
                    continue;
                };
                let to = hinge.sides[1 - side].panel;
                if place[to.0].is_none() {
                    let there = at * across(set, HingeId(id), side);
                    place[to.0] = Some(there);
                    layout.panels.push((to, there));
                    layout.creases.push(HingeId(id));
                }
            }
        }
        layout.creases.sort();
        out.push(layout);
    }
    out
}

/// How a set of points lies best on a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BestTurn {
    /// Rotation to apply, as a unit complex number.
    pub(crate) unit: DVec2,
    /// Factor by which the points could grow and still fit; below 1 they do not fit.
    pub(crate) scale: f64,
    /// Size of the bounding box after the rotation, mm.
    pub(crate) size_mm: DVec2,
}

impl BestTurn {
    /// Whether the points fit.
    pub(crate) fn fits(&self) -> bool {
        self.scale >= 1.0
    }

    /// Fitting comes first, then the smaller box; where neither fits, the one that nearly does.
    pub(crate) fn beats(&self, other: &Self) -> bool {
        if self.fits() && other.fits() {
            self.size_mm.element_product() < other.size_mm.element_product() * (1.0 - 1e-9)
        } else {
            self.scale > other.scale * (1.0 + 1e-9)
        }
    }
}

/// The rotation with the smallest bounding box among those that fit `sheet_mm`; where none fits,
/// the one that needs the least shrinking. Tries the directions of the convex hull's edges, which
/// hold the smallest box (Freeman and Shapira 1975), and even steps between them.
pub(crate) fn best_turn(points: &[DVec2], sheet_mm: DVec2) -> BestTurn {
    let hull = polygon::convex_hull(points);
    let edges: Vec<DVec2> = polygon::edges(&hull)
        .filter_map(|(a, b)| (b - a).try_normalize())
        .flat_map(|d| [d, d.perp()])
        .map(|d| DVec2::new(d.x, -d.y))
        .collect();
    let mut best = BestTurn { unit: DVec2::X, scale: 0.0, size_mm: DVec2::ZERO };
    for unit in edges.into_iter().chain(STEPS.iter().copied()) {
        let turn = measured(&hull, unit, sheet_mm);
        if turn.beats(&best) {
            best = turn;
        }
    }
    if best.fits() {
        return best;
    }
    // Whether a piece fits must not depend on how it lies beforehand, as the even steps do.
    let exact = fit::best_fit(&hull, sheet_mm.x, sheet_mm.y, Rotation::Free);
    let turn = measured(&hull, DVec2::from_angle(exact.angle_rad), sheet_mm);
    if turn.beats(&best) { turn } else { best }
}

/// Whether points fit `sheet_mm` at some angle: [`best_turn`] where only this is asked.
pub(crate) fn fits(points: &[DVec2], sheet_mm: DVec2) -> bool {
    let hull = polygon::convex_hull(points);
    let room_mm = sheet_mm + FIT_TOLERANCE_MM;
    let is_within = |size_mm: DVec2| size_mm.cmple(room_mm).all() || size_mm.yx().cmple(room_mm).all();
    // A width w is at least w cos δ - d sin δ after a turn by δ, where d is the diagonal of the box.
    let half_step = DVec2::from_angle(TURN_STEP_RAD / 2.0);
    let mut is_near = false;
    for &unit in &STEPS[..STEPS.len() / 2] {
        let size_mm = measured(&hull, unit, sheet_mm).size_mm;
        if is_within(size_mm) {
            return true;
        }
        is_near |= is_within(size_mm * half_step.x - size_mm.length() * half_step.y);
    }
    is_near && best_turn(&hull, sheet_mm).fits()
}

/// How points lie on a sheet after one rotation.
pub(crate) fn measured(points: &[DVec2], unit: DVec2, sheet_mm: DVec2) -> BestTurn {
    let turned = points.iter().map(|&p| unit.rotate(p));
    let size_mm = polygon::bounds(turned).map_or(DVec2::ZERO, |(lo, hi)| hi - lo);
    BestTurn { unit, scale: ((sheet_mm + FIT_TOLERANCE_MM) / size_mm).min_element(), size_mm }
}

/// Whether two panels of one piece are too close: overlapping where they share a corner, nearer
/// than `gap_mm` where they do not.
pub(crate) fn clash(a: &[DVec2], b: &[DVec2], gap_mm: f64) -> bool {
    let touch = a.iter().any(|p| b.iter().any(|q| p.distance_squared(*q) < 1e-12));
    polygon::convex_overlap(a, b, if touch { 1e-6 } else { -gap_mm })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn rectangle(width: f64, height: f64, turn_rad: f64) -> Vec<DVec2> {
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        corners.iter().map(|&c| DVec2::from_angle(turn_rad).rotate(c.into())).collect()
    }

    #[test]
    fn a_turned_rectangle_fits_its_own_size_and_no_less() {
        let points = rectangle(190.0, 277.0, 0.4321);
        let sheet_mm = DVec2::new(190.0, 277.0);
        let best = best_turn(&points, sheet_mm);
        assert!(best.fits() && best.scale < 1.0 + 1e-6);
        assert!((best.size_mm - sheet_mm).length() < 1e-9);
        let small = best_turn(&points, sheet_mm * 0.8);
        assert!(!small.fits() && (small.scale - 0.8).abs() < 1e-6);
    }

    #[test]
    fn a_long_strip_fits_along_the_diagonal() {
        let best = best_turn(&rectangle(300.0, 10.0, 0.0), DVec2::new(190.0, 277.0));
        assert!(best.fits());
        assert!(best.size_mm.x <= 190.0 && best.size_mm.y <= 277.0);
    }

    /// A strip that fits the diagonal within 0.1° only: once it fitted where it was searched for, and not where its
    /// piece was laid out.
    #[test]
    fn whether_a_strip_fits_does_not_depend_on_how_it_lies() {
        let sheet_mm = DVec2::new(190.0, 277.0);
        let strip = |share: f64| rectangle(320.0 * share, 12.0 * share, 0.0);
        let most = fit::best_fit(&strip(1.0), sheet_mm.x, sheet_mm.y, Rotation::Free).scale;
        for turn in (0..90).map(|k| DVec2::from_angle(f64::from(k) * 0.037)) {
            let is_laid_out = |share: f64| {
                let turned: Vec<DVec2> = strip(share * most).iter().map(|&p| turn.rotate(p)).collect();
                assert_eq!(fits(&turned, sheet_mm), best_turn(&turned, sheet_mm).fits());
                best_turn(&turned, sheet_mm).fits()
            };
            assert!(is_laid_out(1.0 - 1e-6) && !is_laid_out(1.0 + 1e-6), "{turn}");
        }
    }

    #[test]
    fn panels_at_a_corner_may_touch_but_others_need_room() {
        let square = rectangle(10.0, 10.0, 0.0);
        let moved = |by: DVec2| square.iter().map(|&p| p + by).collect::<Vec<_>>();
        assert!(!clash(&square, &moved(DVec2::new(10.0, 0.0)), 0.5));
        assert!(clash(&square, &moved(DVec2::new(10.0, 3.0)), 0.5));
        assert!(!clash(&square, &moved(DVec2::new(10.6, 3.0)), 0.5));
        assert!(clash(&square, &moved(DVec2::new(9.9, 0.0)), 0.5));
    }

    proptest! {
        #[test]
        fn points_fit_where_the_best_turn_does(
            points in prop::collection::vec((0.0..300.0, 0.0..120.0, 0.0..120.0), 3..12),
            share in prop::sample::select(vec![0.5, 0.97, 1.0 - 1e-6, 1.0 + 1e-6, 1.02, 1.5]),
        ) {
            let points: Vec<DVec2> = points.into_iter().map(|(x, y, z)| DVec2::new(x, y + z)).collect();
            let sheet_mm = DVec2::new(190.0, 277.0);
            let most = best_turn(&points, sheet_mm).scale;
            let sized: Vec<DVec2> = points.iter().map(|&p| p * share * most).collect();
            prop_assert_eq!(fits(&sized, sheet_mm), best_turn(&sized, sheet_mm).fits());
        }
    }
}
