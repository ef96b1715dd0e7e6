//! Sheets that ride on the panels of the component that moves.

use super::super::chain::{Shares, Sway};
use super::super::contact::Sheet;
use super::super::motion::{ComponentMotion, End};
use super::super::track::Moment;
use crate::component::PanelId;
use crate::geom::bounds;
use glam::DVec3;

/// A ball with what is needed to bound its motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    pub(super) centre: DVec3,
    pub(super) radius_mm: f64,
    sway_mm: Sway,
}

impl Ball {
    fn round<'a>(corners: impl Iterator<Item = &'a DVec3> + Clone, sway_mm: Sway) -> Self {
        let (low, high) = bounds(corners.clone().copied());
        let centre = 0.5 * (low + high);
        let radius_mm = corners.map(|c| c.distance(centre)).fold(0.0, f64::max);
        Self { centre, radius_mm, sway_mm }
    }

    /// Whether two balls with their middles at these points can meet once they have moved by `way_mm`.
    pub(super) fn can_meet([a, b]: [&Self; 2], [p, q]: [DVec3; 2], way_mm: f64) -> bool {
        let reach_mm = a.radius_mm + b.radius_mm + way_mm;
        p.distance_squared(q) <= reach_mm * reach_mm
    }

    /// How far apart they are, mm.
    pub(super) fn gap_mm([a, b]: [&Self; 2], [p, q]: [DVec3; 2]) -> f64 {
        p.distance(q) - a.radius_mm - b.radius_mm
    }
}

/// Sheets that ride on one panel.
#[derive(Debug, Clone)]
pub(in crate::fold) struct Body {
    pub(super) carrier: PanelId,
    end: End,
    pub(super) ball: Ball,
    pub(super) sheets: Vec<(Sheet, Ball)>,
}

impl Body {
    /// Sheets, as they lie in the axes of the component that moves when that is deployed, and the
    /// panel that carries them.
    pub(in crate::fold) fn new(sheets: Vec<Sheet>, carrier: PanelId, motion: &ComponentMotion) -> Self {
        let sheets: Vec<(Sheet, Ball)> = sheets
            .into_iter()
            .map(|sheet| {
                let ball = Ball::round(sheet.corners.iter(), motion.sway_mm(carrier, &sheet.corners));
                (sheet, ball)
            })
            .collect();
        let larger = |a: Sway, b: Sway| [a[0].max(b[0]), a[1].max(b[1])];
        let sway = sheets.iter().map(|s| s.1.sway_mm).fold([0.0; 2], larger);
        let ball = Ball::round(sheets.iter().flat_map(|s| &s.0.corners), sway);
        Self { carrier, end: motion.end_of(carrier), ball, sheets }
    }

    /// The panel that carries it.
    pub(in crate::fold) fn carrier(&self) -> PanelId {
        self.carrier
    }

    /// How far any point of a ball moves between two moments, whose shares these are, against the end that the
    /// carrier hangs from.
    pub(super) fn way_mm(&self, ball: &Ball, from: &[Shares], to: &[Shares]) -> f64 {
        let (End::Top(Some(chain)) | End::Bottom(Some(chain))) = self.end else { return 0.0 };
        let (from, to) = (from[chain.0], to[chain.0]);
        ball.sway_mm[0] * (from.above - to.above).abs() + ball.sway_mm[1] * (from.below - to.below).abs()
    }

    /// Writes one of its sheets at a moment.
    pub(super) fn pose(&self, sheet: usize, at: &Moment<'_>, posed: &mut Sheet) {
        let (motion, sheet) = (at.moved(self.carrier), &self.sheets[sheet].0);
        posed.corners.clear();
        posed.corners.extend(sheet.corners.iter().map(|&c| motion.transform_point3(c)));
        posed.normal = motion.transform_vector3(sheet.normal);
    }

    pub(super) fn hangs_from_top(&self) -> bool {
        matches!(self.end, End::Top(_))
    }
}

/// One sheet of a body: the indices of both.
pub(in crate::fold) type BodySheet = (usize, usize);

/// Whether two balls are farther apart than `way_mm`.
pub(super) fn are_far([a, b]: [(&Body, &Ball); 2], at: &Moment<'_>, way_mm: f64) -> bool {
    let centres = [a, b].map(|(body, ball)| at.moved(body.carrier).transform_point3(ball.centre));
    !Ball::can_meet([a.1, b.1], centres, way_mm)
}
