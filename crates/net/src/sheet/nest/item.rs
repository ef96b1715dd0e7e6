//! A piece in all the ways in which it may be put on a sheet.

use super::occupancy::Pose;
use super::raster::Grid;
use super::{NestPiece, Rotation};
use crate::fit;
use glam::DVec2;
use std::f64::consts::FRAC_PI_2;
use std::sync::OnceLock;
use tatamu_core::geom::polygon;

/// A piece in all alternatives of its group, at least one.
pub(super) struct Item<'a> {
    alternatives: Vec<Alternative<'a>>,
    area_mm2: f64,
    longest_mm: f64,
}

impl<'a> Item<'a> {
    /// A piece from its shape in each alternative.
    pub fn new(shapes: &[&'a NestPiece], rotation: Rotation, spacing_mm: f64, grid: &'a Grid) -> Self {
        let alternative = |&shape| Alternative { shape, rotation, spacing_mm, grid, angles: OnceLock::new() };
        Self {
            area_mm2: polygon::area(shapes[0].outline()),
            longest_mm: polygon::least_rectangle(shapes[0].outline()).1.x,
            alternatives: shapes.iter().map(alternative).collect(),
        }
    }

    /// The piece in an alternative of its group.
    pub fn alternative(&self, number: usize) -> &Alternative<'a> {
        &self.alternatives[number]
    }

    /// Number of alternatives.
    pub fn alternatives(&self) -> usize {
        self.alternatives.len()
    }

    /// Number of its group.
    pub fn group(&self) -> usize {
        self.alternatives[0].shape.group()
    }

    /// Area in the first alternative.
    pub fn area_mm2(&self) -> f64 {
        self.area_mm2
    }

    /// Long side of the least rectangle in the first alternative.
    pub fn longest_mm(&self) -> f64 {
        self.longest_mm
    }
}

/// One shape at all angles at which it fits an empty sheet. Angles and poses are worked out when
/// they are needed first: most never are.
pub(super) struct Alternative<'a> {
    shape: &'a NestPiece,
    rotation: Rotation,
    spacing_mm: f64,
    grid: &'a Grid,
    angles: OnceLock<Vec<Angle>>,
}

struct Angle {
    angle_rad: f64,
    /// Size of the bounding box.
    extent: DVec2,
    pose: OnceLock<Pose>,
}

impl Alternative<'_> {
    /// Number of poses.
    pub fn len(&self) -> usize {
        self.angles().len()
    }

    /// Whether it fits at no angle.
    pub fn is_empty(&self) -> bool {
        self.angles().is_empty()
    }

    /// Pose `k`.
    pub fn pose(&self, k: usize) -> &Pose {
        let Angle { angle_rad, pose, .. } = &self.angles()[k];
        pose.get_or_init(|| Pose::new(self.shape.outline(), *angle_rad, self.spacing_mm, self.grid))
    }

    /// Size of the bounding box of pose `k`.
    pub fn extent(&self, k: usize) -> DVec2 {
        self.angles()[k].extent
    }

    fn angles(&self) -> &[Angle] {
        self.angles.get_or_init(|| {
            let outline = self.shape.outline();
            let DVec2 { x, y } = self.grid.sheet_mm;
            let best = fit::best_fit(outline, x, y, self.rotation);
            let (least_angle, _) = polygon::least_rectangle(outline);
            let hull = polygon::convex_hull(outline);
            let all = angles(&hull, &[best.angle_rad, least_angle], self.rotation).into_iter();
            let angle = |angle_rad| Angle {
                angle_rad,
                extent: polygon::extent(&hull, angle_rad),
                pose: OnceLock::new(),
            };
            all.map(angle).filter(|a| fit::is_within(a.extent, x, y)).collect()
        })
    }
}

/// Edges of the hull that a piece is laid on, beside the special angles.
const EDGES: usize = 5;

/// Angles in steps of a right angle by this number, tried beside those.
const STEPS: usize = 9;

/// Angles nearer than this are tried once.
const SAME_RAD: f64 = 0.02;

/// Angles worth trying: those given, and those that bring a long edge of the hull parallel to
/// the sheet's sides; each with its quarter turns.
fn angles(hull: &[DVec2], special: &[f64], rotation: Rotation) -> Vec<f64> {
    let mut base: Vec<f64> = Vec::new();
    if rotation == Rotation::Free {
        let mut edges: Vec<DVec2> = polygon::edges(hull).map(|(a, b)| b - a).collect();
        edges.sort_by(|a, b| b.length().total_cmp(&a.length()));
        let along_edges = edges.iter().map(|e| -e.to_angle());
        for angle in special.iter().copied().chain(along_edges) {
            let angle = angle.rem_euclid(FRAC_PI_2);
            let apart = |other: &f64| {
                let gap = (angle - other).abs();
                gap.min(FRAC_PI_2 - gap) > SAME_RAD
            };
            if base.len() < special.len() + EDGES && base.iter().all(apart) {
                base.push(angle);
            }
        }
        base.extend((0..STEPS).map(|k| FRAC_PI_2 * (k as f64 + 0.5) / STEPS as f64));
    } else {
        base.push(0.0);
    }
    let turns = |angle: f64| (0..4).map(move |k| angle + f64::from(k) * FRAC_PI_2);
    base.into_iter().flat_map(turns).collect()
}
