//! Pieces on their sheets.

use super::SheetOptions;
use super::nest::{NestError, Shape, nest};
use super::pin::{Pin, Unheeded, unheeded};
use crate::geom::polygon;
use crate::net::{Net, Piece};
use crate::progress::Progress;
use glam::DAffine2;
use std::collections::BTreeMap;

/// Where a piece lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PiecePlace {
    /// Index of the sheet.
    pub sheet: usize,
    /// Rigid motion from the piece's coordinates to the sheet's, mm.
    pub place: DAffine2,
}

/// Why there is no layout.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LayoutError {
    /// Margins and strip leave no room.
    #[error(
        "a sheet of {width_mm:.0} × {height_mm:.0} mm with a margin of {margin_mm} mm leaves no room for pieces; use larger --paper or a smaller --margin"
    )]
    NoRoom {
        /// Width of the sheet.
        width_mm: f64,
        /// Height of the sheet.
        height_mm: f64,
        /// The margin.
        margin_mm: f64,
    },
    /// Nesting failed.
    #[error(transparent)]
    Nest(#[from] NestError),
}

/// All pieces of a model on sheets.
#[derive(Debug, Clone)]
pub struct Layout {
    unheeded: Vec<Unheeded>,
    options: SheetOptions,
    places: Vec<Vec<PiecePlace>>,
    sheets: usize,
    utilisation: f64,
}

impl Layout {
    /// Nests the pieces of all nets, those that are pinned, by name, at their places.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn new(
        nets: &[Net],
        options: &SheetOptions,
        pins: &BTreeMap<String, Pin>,
        progress: &dyn Progress,
    ) -> Result<Self, LayoutError> {
        let room = options.room_mm();
        if room.min_element() <= 0.0 {
            let size = options.size_mm();
            return Err(LayoutError::NoRoom {
                width_mm: size.x,
                height_mm: size.y,
                margin_mm: options.border_mm(),
            });
        }
        let pieces = || nets.iter().enumerate().flat_map(|(n, net)| net.pieces().iter().map(move |p| (n, p)));
        let shape = |(n, piece): (usize, &Piece)| {
            let shape = Shape::new(piece.outline().to_vec(), n)?;
            Some(match pins.get(piece.name()) {
                Some(pin) => shape.pinned(pin.placement(piece.outline(), options.origin_mm())),
                None => shape,
            })
        };
        let shapes: Vec<Shape> = pieces().filter_map(shape).collect();
        debug_assert_eq!(shapes.len(), pieces().count(), "every piece has an area");
        let placements = nest(&shapes, &options.nesting(), progress)?;
        let mut places = vec![Vec::new(); nets.len()];
        for ((n, _), placement) in pieces().zip(&placements) {
            let place = DAffine2::from_translation(options.origin_mm()) * placement.motion();
            places[n].push(PiecePlace { sheet: placement.sheet, place });
        }
        let sheets = placements.iter().map(|p| p.sheet + 1).max().unwrap_or(0);
        let area: f64 = shapes.iter().map(|s| polygon::area(s.outline())).sum();
        let utilisation = area / (room.x * room.y * sheets.max(1) as f64);
        let places_of = pieces().map(|(_, piece)| piece).zip(places.iter().flatten());
        let unheeded = unheeded(pins, places_of);
        Ok(Self { unheeded, options: *options, places, sheets, utilisation })
    }

    /// Pins that could not be heeded.
    pub fn unheeded_pins(&self) -> &[Unheeded] {
        &self.unheeded
    }

    /// Places of the pieces of net `n`, in the net's order.
    pub fn places(&self, n: usize) -> &[PiecePlace] {
        &self.places[n]
    }

    /// Number of sheets.
    pub fn sheet_count(&self) -> usize {
        self.sheets
    }

    /// What the sheets are like.
    pub fn options(&self) -> &SheetOptions {
        &self.options
    }

    /// Share of the usable area that is covered by pieces.
    pub fn utilisation(&self) -> f64 {
        self.utilisation
    }
}
