//! Nesting: pieces of any shape on as few sheets as possible.
//!
//! Each piece is tried at a list of angles and at all points of a lattice ([`raster`]), with a row
//! of positions in a machine word ([`occupancy`]); orders of the pieces are searched ([`search`]).
//! Hollows need no special care: a free place is free wherever it is.
//!
//! # Why on a lattice
//! A collision engine such as jagua-rs answers "does it collide here?" in single precision, and
//! leaves the search and the repair of hairline overlaps to the caller. No-fit polygons of
//! concave pieces are exact but need hundreds of unions for each pair and angle. On the lattice
//! all positions of a piece are known at once, and no overlap can hide: bodies and halos are
//! rounded outwards, so every layout is valid in exact geometry. The price is up to two cells
//! (1.5 mm on A4) of paper at a gap.

mod bits;
mod check;
mod occupancy;
mod raster;
mod search;
#[cfg(test)]
mod tests;

pub use check::{NestFault, check};

use super::fit::{self, Rotation};
use crate::geom::polygon;
use crate::progress::{Cancelled, Progress};
use glam::{DAffine2, DVec2};
use occupancy::Pose;
use raster::Grid;
use rayon::prelude::*;
use search::{Item, Pinned};
use std::f64::consts::FRAC_PI_2;

/// The outline of one piece.
///
/// # Guarantees
/// At least three corners, all finite; counter-clockwise with a positive area.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    outline: Vec<DVec2>,
    group: usize,
    pin: Option<Placement>,
}

impl Shape {
    /// A simple polygon, counter-clockwise, in mm; it may be concave, and touch itself at corners.
    /// Pieces with the same `group` (their component) are kept together where that costs nothing.
    /// `None` where a guarantee would be broken.
    pub fn new(outline: Vec<DVec2>, group: usize) -> Option<Self> {
        let is_sound = outline.iter().all(|p| p.is_finite()) && polygon::area(&outline) > 0.0;
        is_sound.then_some(Self { outline, group, pin: None })
    }

    /// Corners.
    pub fn outline(&self) -> &[DVec2] {
        &self.outline
    }

    /// The same piece at the place where the user wants it: on the lattice, within the sheet, as
    /// near to it as can be. Where another pinned piece is in the way it goes elsewhere.
    #[must_use]
    pub fn pinned(self, place: Placement) -> Self {
        Self { pin: Some(place), ..self }
    }

    /// Number of its group.
    pub fn group(&self) -> usize {
        self.group
    }
}

/// How to nest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NestOptions {
    /// Width of the usable area of a sheet, mm.
    pub width_mm: f64,
    /// Height of the usable area of a sheet, mm.
    pub height_mm: f64,
    /// Least distance between pieces, mm; the border of the usable area may be touched.
    pub spacing_mm: f64,
    /// Allowed angles.
    pub rotation: Rotation,
    /// How many pieces are put on a sheet in trials beyond the standard orders; so with n pieces
    /// `effort / n` more orders are tried.
    pub effort: usize,
}

/// 25 orders of 60 pieces, 150 of 10.
pub const DEFAULT_EFFORT: usize = 1500;
/// Scissors pass between pieces.
pub const DEFAULT_SPACING_MM: f64 = 2.0;

impl NestOptions {
    /// Free rotation, 2 mm apart, default effort.
    pub fn new(width_mm: f64, height_mm: f64) -> Self {
        Self {
            width_mm,
            height_mm,
            spacing_mm: DEFAULT_SPACING_MM,
            rotation: Rotation::Free,
            effort: DEFAULT_EFFORT,
        }
    }

    fn check(&self) -> Result<(), NestError> {
        let &Self { width_mm, height_mm, spacing_mm, .. } = self;
        let has_area = [width_mm, height_mm].iter().all(|&x| x.is_finite() && x > 0.0);
        if has_area && spacing_mm.is_finite() && spacing_mm >= 0.0 {
            Ok(())
        } else {
            Err(NestError::BadSheet { width_mm, height_mm, spacing_mm })
        }
    }
}

/// Where a piece goes: turned about its own origin, then moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Index of the sheet, from 0.
    pub sheet: usize,
    /// Angle, counter-clockwise.
    pub rotation_rad: f64,
    /// Place of the piece's origin from the lower left corner of the usable area, mm.
    pub translation: DVec2,
}

impl Placement {
    /// The motion from the piece's coordinates to the usable area's.
    pub fn motion(&self) -> DAffine2 {
        DAffine2::from_angle_translation(self.rotation_rad, self.translation)
    }
}

/// Why nesting failed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NestError {
    /// The sheet has no area, or a number is not finite, or the spacing is negative.
    #[error("a sheet of {width_mm} × {height_mm} mm with {spacing_mm} mm between pieces cannot be used")]
    BadSheet {
        /// As given.
        width_mm: f64,
        /// As given.
        height_mm: f64,
        /// As given.
        spacing_mm: f64,
    },
    /// A piece does not fit the empty sheet at any allowed angle.
    #[error(
        "piece {index} of {long_mm:.1} × {short_mm:.1} mm does not fit the sheet at any allowed \
         angle: cut it up, or make it {scale:.3} of its size"
    )]
    TooLarge {
        /// Its index in the input.
        index: usize,
        /// Long side of its least bounding rectangle.
        long_mm: f64,
        /// Short side of its least bounding rectangle.
        short_mm: f64,
        /// Factor by which it would just fit.
        scale: f64,
    },
    /// The user stopped it.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Puts every piece on a sheet: as few sheets as the search finds, no two pieces nearer than the
/// spacing, none outside of the usable area. Results are in the order of the input; sheets are
/// numbered so that groups come in their order as far as that is possible. The same input gives
/// the same result on any number of threads.
///
/// # Errors
/// [`NestError::TooLarge`] names the first piece that fits no empty sheet.
pub fn nest(
    pieces: &[Shape],
    options: &NestOptions,
    progress: &dyn Progress,
) -> Result<Vec<Placement>, NestError> {
    options.check()?;
    let frame = Frame::new(options);
    // Collected before the first error is taken, so that which piece is named depends on no thread.
    let items: Vec<Result<Item, NestError>> =
        pieces.par_iter().enumerate().map(|(index, piece)| frame.item(index, piece, options)).collect();
    let items = items.into_iter().collect::<Result<Vec<_>, _>>()?;
    let orders = options.effort / pieces.len().max(1);
    let sheets = search::search(&items, &frame.grid, orders, progress)?;
    let mut placements = vec![None; pieces.len()];
    // Pins may have left sheets before theirs empty.
    for (sheet, placed) in sheets.iter().filter(|sheet| !sheet.is_empty()).enumerate() {
        for p in placed {
            let pose = &items[p.item].poses[p.pose];
            let cell = DVec2::new(p.spot.column as f64, p.spot.row as f64);
            let at = pose.origin + cell * frame.grid.cell_mm;
            placements[p.item] = Some(frame.placement(sheet, pose.angle_rad, at));
        }
    }
    Ok(placements.into_iter().flatten().collect())
}

/// The usable area in portrait format, which the search works in.
struct Frame {
    grid: Grid,
    /// Height of the portrait sheet where the user's is landscape.
    turned_mm: Option<f64>,
}

impl Frame {
    fn new(options: &NestOptions) -> Self {
        let (width, height) = (options.width_mm, options.height_mm);
        Self {
            grid: Grid::new(DVec2::new(width.min(height), width.max(height))),
            turned_mm: (width > height).then_some(width),
        }
    }

    fn item(&self, index: usize, piece: &Shape, options: &NestOptions) -> Result<Item, NestError> {
        let DVec2 { x, y } = self.grid.sheet_mm;
        let best = fit::best_fit(&piece.outline, x, y, options.rotation);
        let (least_angle, least) = fit::least_rectangle(&piece.outline);
        let group = piece.group;
        let area_mm2 = polygon::area(&piece.outline);
        let item = |poses, pin| Item { poses, group, area_mm2, longest_mm: least.x, pin };
        if let Some((pose, pin)) = piece.pin.and_then(|pin| self.pinned(piece, pin, options)) {
            return Ok(item(vec![pose], Some(pin)));
        }
        let mut poses = Vec::new();
        for angle in angles(&piece.outline, &[best.angle_rad, least_angle], options.rotation) {
            if fit::is_within(fit::extent(&piece.outline, angle), x, y) {
                poses.push(Pose::new(&piece.outline, angle, options.spacing_mm, &self.grid));
            }
        }
        if poses.is_empty() {
            return Err(NestError::TooLarge {
                index,
                long_mm: least.x,
                short_mm: least.y,
                scale: best.scale,
            });
        }
        Ok(item(poses, None))
    }

    /// A piece at the place of its pin: its pose, and sheet, column and row of its lower left corner;
    /// none where it does not fit the sheet at that angle.
    fn pinned(&self, piece: &Shape, pin: Placement, options: &NestOptions) -> Option<(Pose, Pinned)> {
        let (angle, at) = match self.turned_mm {
            None => (pin.rotation_rad, pin.translation),
            Some(height) => {
                (pin.rotation_rad - FRAC_PI_2, DVec2::new(pin.translation.y, height - pin.translation.x))
            }
        };
        let DVec2 { x, y } = self.grid.sheet_mm;
        let is_within = fit::is_within(fit::extent(&piece.outline, angle), x, y);
        let pose = is_within.then(|| Pose::new(&piece.outline, angle, options.spacing_mm, &self.grid))?;
        let [column, row] = pose.nearest((at - pose.origin) / self.grid.cell_mm);
        Some((pose, Pinned { sheet: pin.sheet, column, row }))
    }

    fn placement(&self, sheet: usize, angle_rad: f64, at: DVec2) -> Placement {
        match self.turned_mm {
            None => Placement { sheet, rotation_rad: angle_rad, translation: at },
            Some(height) => Placement {
                sheet,
                rotation_rad: angle_rad + FRAC_PI_2,
                translation: DVec2::new(height - at.y, at.x),
            },
        }
    }
}

/// Edges of the hull that a piece is laid on, beside the special angles.
const EDGES: usize = 5;

/// Angles in steps of a right angle by this number, tried beside those.
const STEPS: usize = 18;

/// Angles nearer than this are tried once.
const SAME_RAD: f64 = 0.02;

/// Angles worth trying: those given, and those that bring a long edge of the hull parallel to
/// the sheet's sides; each with its quarter turns.
fn angles(outline: &[DVec2], special: &[f64], rotation: Rotation) -> Vec<f64> {
    let mut base: Vec<f64> = Vec::new();
    if rotation == Rotation::Free {
        let hull = polygon::convex_hull(outline);
        let mut edges: Vec<DVec2> = polygon::edges(&hull).map(|(a, b)| b - a).collect();
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
