//! Pieces on their sheets.

use super::SheetOptions;
use super::nest::{NestError, Placement, Shape, nest_alternatives};
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
    options: SheetOptions,
    places: Vec<Vec<PiecePlace>>,
    sheets: usize,
    utilisation: f64,
    unheeded: Vec<Unheeded>,
}

impl Layout {
    /// Nests the pieces of all nets.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn new(nets: &[Net], options: &SheetOptions, progress: &dyn Progress) -> Result<Self, LayoutError> {
        let alternatives: Vec<&[Net]> = nets.iter().map(std::slice::from_ref).collect();
        Ok(Self::nested(&alternatives, options, &BTreeMap::new(), progress)?.0)
    }

    /// Nests the pieces of one net of each list, which are alternatives with as many pieces, the
    /// best first; also gives the nets that were taken. Pieces that are pinned, by name, lie where
    /// they are pinned; a net that has one is the first of its list.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn of_alternatives(
        nets: &[Vec<Net>],
        options: &SheetOptions,
        pins: &BTreeMap<String, Pin>,
        progress: &dyn Progress,
    ) -> Result<(Self, Vec<Net>), LayoutError> {
        let has_pin = |net: &Net| net.pieces().iter().any(|piece| pins.contains_key(piece.name()));
        let usable = |nets: &[Net]| if nets.first().is_some_and(has_pin) { 1 } else { nets.len() };
        let alternatives: Vec<&[Net]> = nets.iter().map(|nets| &nets[..usable(nets)]).collect();
        let (layout, taken) = Self::nested(&alternatives, options, pins, progress)?;
        Ok((layout, taken.into_iter().cloned().collect()))
    }

    fn nested<'n>(
        nets: &[&'n [Net]],
        options: &SheetOptions,
        pins: &BTreeMap<String, Pin>,
        progress: &dyn Progress,
    ) -> Result<(Self, Vec<&'n Net>), LayoutError> {
        let room = options.room_mm();
        if room.min_element() <= 0.0 {
            let size = options.size_mm();
            return Err(LayoutError::NoRoom {
                width_mm: size.x,
                height_mm: size.y,
                margin_mm: options.border_mm(),
            });
        }
        let groups: Vec<Vec<Vec<Shape>>> = nets
            .iter()
            .enumerate()
            .map(|(n, nets)| nets.iter().map(|net| shapes(net, n, pins, options)).collect())
            .collect();
        let placed = nest_alternatives(&groups, &options.nesting(), progress)?;
        let place = |p: &Placement| PiecePlace {
            sheet: p.sheet,
            place: DAffine2::from_translation(options.origin_mm()) * p.motion(),
        };
        let places: Vec<Vec<PiecePlace>> =
            placed.iter().map(|(_, placements)| placements.iter().map(place).collect()).collect();
        let sheets = places.iter().flatten().map(|p| p.sheet + 1).max().unwrap_or(0);
        let taken: Vec<&Net> = nets.iter().zip(&placed).map(|(nets, (chosen, _))| &nets[*chosen]).collect();
        let pieces = taken.iter().flat_map(|net| net.pieces());
        let area: f64 = pieces.map(|p| polygon::area(p.outline())).sum();
        let utilisation = area / (room.x * room.y * sheets.max(1) as f64);
        let pieces = taken.iter().flat_map(|net| net.pieces());
        let unheeded = unheeded(pins, pieces.zip(places.iter().flatten()));
        Ok((Self { options: *options, places, sheets, utilisation, unheeded }, taken))
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

/// The pieces of net `n` as the nesting sees them.
fn shapes(net: &Net, n: usize, pins: &BTreeMap<String, Pin>, options: &SheetOptions) -> Vec<Shape> {
    let shape = |piece: &Piece| {
        let shape = Shape::new(piece.outline().to_vec(), n)?;
        Some(match pins.get(piece.name()) {
            Some(pin) => shape.pinned(pin.placement(piece.outline(), options.origin_mm())),
            None => shape,
        })
    };
    let shapes: Vec<Shape> = net.pieces().iter().filter_map(shape).collect();
    debug_assert_eq!(shapes.len(), net.pieces().len(), "every piece has an area");
    shapes
}
