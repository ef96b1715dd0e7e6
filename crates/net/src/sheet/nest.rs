//! Nesting: pieces of any shape on as few sheets as possible.
//!
//! Each piece is tried at a list of angles and at all points of a lattice (`raster`), with a row
//! of positions in a machine word (`occupancy`); orders of the pieces are searched (`search`).
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
mod item;
mod occupancy;
mod pins;
mod raster;
mod search;
#[cfg(test)]
mod tests;

pub use check::{NestFault, check};

use super::place::SheetId;
use crate::fit::{self, Rotation};
use glam::{DAffine2, DVec2};
use item::Item;
use occupancy::{Pose, Spot};
use pins::{Pinned, Start};
use raster::Grid;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_2;
use tatamu_core::geom::polygon;
use tatamu_core::progress::{Cancelled, Progress};

/// The outline of one piece.
///
/// # Guarantees
/// At least three corners, all finite; counter-clockwise with a positive area.
#[derive(Debug, Clone, PartialEq)]
pub struct NestPiece {
    outline: Vec<DVec2>,
    group: usize,
    pin: Option<Placement>,
}

impl NestPiece {
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
    /// near to it as can be. Where another pinned piece is in the way it goes elsewhere. Pinned
    /// pieces have no alternatives.
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
    /// How many pieces are put on a sheet in trials beyond the standard orders.
    pub effort: usize,
}

/// A fifth of a second for a dozen pieces. Of thirteen models none takes a sheet less with five times as
/// much, one with fifteen times.
pub const DEFAULT_EFFORT: usize = 2000;
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
    /// The sheet.
    pub sheet: SheetId,
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
    pieces: &[NestPiece],
    options: &NestOptions,
    progress: &dyn Progress,
) -> Result<Vec<Placement>, NestError> {
    let items = pieces.iter().map(|piece| vec![piece]).collect();
    Ok(nest_items(items, options, progress)?.1)
}

/// As [`nest`], of groups that may be cut in several ways: `groups[g][a]` are the pieces of group g
/// in its alternative a, each with as many, and g as the number of their group. Gives the alternative
/// of each group, the first where others save no sheet, and the placements of its pieces.
///
/// # Errors
/// As [`nest`]; of first alternatives. Others that fit no sheet are not used.
pub fn nest_alternatives(
    groups: &[Vec<Vec<NestPiece>>],
    options: &NestOptions,
    progress: &dyn Progress,
) -> Result<Vec<(usize, Vec<Placement>)>, NestError> {
    let count = |group: &[Vec<NestPiece>]| group.first().map_or(0, Vec::len);
    let items = groups.iter().flat_map(|group| {
        (0..count(group)).map(|piece| group.iter().filter_map(|shapes| shapes.get(piece)).collect())
    });
    let (chosen, placements) = nest_items(items.collect(), options, progress)?;
    let mut rest = placements.into_iter();
    let of_group =
        |group: &Vec<Vec<NestPiece>>| -> Vec<Placement> { rest.by_ref().take(count(group)).collect() };
    let placements: Vec<Vec<Placement>> = groups.iter().map(of_group).collect();
    // A group without pieces, at the end, is not among the chosen.
    Ok(chosen.into_iter().chain(std::iter::repeat(0)).zip(placements).collect())
}

/// Alternative of each group by its number, and a placement for each item, which is given as one
/// shape for each alternative of its group.
fn nest_items(
    items: Vec<Vec<&NestPiece>>,
    options: &NestOptions,
    progress: &dyn Progress,
) -> Result<(Vec<usize>, Vec<Placement>), NestError> {
    options.check()?;
    let frame = PortraitArea::new(options);
    // Collected before the first error is taken, so that which piece is named depends on no thread.
    let pins: Vec<Option<Pinned>> =
        items.iter().map(|shapes| frame.pinned(shapes.first()?, options)).collect();
    let outlines: Vec<Option<Vec<DVec2>>> = items
        .iter()
        .zip(&pins)
        .map(|(shapes, pin)| {
            let pin = pin.as_ref()?;
            let motion = frame.placement(pin.sheet, &pin.pose, &pin.spot).motion();
            Some(shapes.first()?.outline().iter().map(|&p| motion.transform_point2(p)).collect())
        })
        .collect();
    let items: Vec<Result<Item, NestError>> = items
        .into_par_iter()
        .enumerate()
        .map(|(index, shapes)| frame.item(index, &shapes, options))
        .collect();
    let items = items.into_iter().collect::<Result<Vec<_>, _>>()?;
    let start = Start::new(&pins, &outlines, options.spacing_mm, &frame.grid);
    let found = search::search(&items, &frame.grid, &start, options.effort, progress)?;
    let mut placements = vec![None; items.len()];
    for (index, pin) in pins.iter().enumerate().filter(|(index, _)| !start.is_free(*index)) {
        placements[index] = pin.as_ref().map(|pin| frame.placement(pin.sheet, &pin.pose, &pin.spot));
    }
    for (sheet, placed) in (0..).map(SheetId).zip(&found.sheets) {
        for p in placed {
            let item = &items[p.item];
            let pose = item.alternative(found.chosen[item.group()]).pose(p.pose);
            placements[p.item] = Some(frame.placement(sheet, pose, &p.spot));
        }
    }
    let mut placements: Vec<Placement> = placements.into_iter().flatten().collect();
    // Pins may have left sheets before theirs empty.
    let used: BTreeSet<SheetId> = placements.iter().map(|p| p.sheet).collect();
    placements.iter_mut().for_each(|p| p.sheet = SheetId(used.range(..p.sheet).count()));
    Ok((found.chosen, placements))
}

/// The usable area in portrait format, which the search works in.
struct PortraitArea {
    grid: Grid,
    /// Height of the portrait sheet where the user's is landscape.
    turned_mm: Option<f64>,
}

impl PortraitArea {
    fn new(options: &NestOptions) -> Self {
        let (width, height) = (options.width_mm, options.height_mm);
        Self {
            grid: Grid::new(DVec2::new(width.min(height), width.max(height))),
            turned_mm: (width > height).then_some(width),
        }
    }

    fn item<'a>(
        &'a self,
        index: usize,
        shapes: &[&'a NestPiece],
        options: &NestOptions,
    ) -> Result<Item<'a>, NestError> {
        let item = Item::new(shapes, options.rotation, options.spacing_mm, &self.grid);
        if item.alternative(0).is_empty() {
            let DVec2 { x, y } = self.grid.sheet_mm;
            let (_, least) = polygon::least_rectangle(&shapes[0].outline);
            let scale = fit::best_fit(&shapes[0].outline, x, y, options.rotation).scale;
            return Err(NestError::TooLarge { index, long_mm: least.x, short_mm: least.y, scale });
        }
        Ok(item)
    }

    /// A piece at the place of its pin, if it has one and fits the sheet at that angle.
    fn pinned(&self, shape: &NestPiece, options: &NestOptions) -> Option<Pinned> {
        let pin = shape.pin?;
        let (angle_rad, at) = match self.turned_mm {
            None => (pin.rotation_rad, pin.translation),
            Some(height) => {
                (pin.rotation_rad - FRAC_PI_2, DVec2::new(pin.translation.y, height - pin.translation.x))
            }
        };
        let DVec2 { x, y } = self.grid.sheet_mm;
        let is_within = fit::is_within(polygon::extent(&shape.outline, angle_rad), x, y);
        let pose = is_within.then(|| Pose::new(&shape.outline, angle_rad, options.spacing_mm, &self.grid))?;
        let spot = pose.nearest((at - pose.origin) / self.grid.cell_mm);
        Some(Pinned { sheet: pin.sheet, pose, spot })
    }

    fn placement(&self, sheet: SheetId, pose: &Pose, spot: &Spot) -> Placement {
        let at = pose.origin + DVec2::new(spot.column as f64, spot.row as f64) * self.grid.cell_mm;
        let angle_rad = pose.angle_rad;
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
