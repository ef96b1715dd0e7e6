//! Places of pieces that the user chose.

use super::nest::Placement;
use super::place::{PiecePlace, SheetId};
use crate::net::Blank;
use glam::DVec2;
use std::collections::BTreeMap;
use std::fmt;
use tatamu_core::codes;
use tatamu_core::geom::polygon;
use tatamu_core::remedy::Remedy;

/// A piece is where it was pinned if it is not farther from there, mm: the layout works on a
/// lattice, whose cells are about 0.8 mm wide on A4 and 5 mm on the largest sheets.
const NEAR_MM: f64 = 6.0;

/// Where the user wants a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pin {
    /// The sheet.
    pub sheet: SheetId,
    /// Lower left corner of the turned piece's bounding box on the sheet, seen from outside, mm.
    pub at_mm: DVec2,
    /// Its turn, counter-clockwise, radians.
    pub turn_rad: f64,
    /// Which of the alternative nets of its component the piece is of.
    pub net: usize,
}

/// A pin that could not be followed, by the name of its piece.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PinWarning {
    /// No piece has this name.
    NoPiece(String),
    /// Another pinned piece is there, or the piece does not fit the sheet at that angle.
    NoRoom(String),
}

codes!(PinWarning {
    NoPiece => "pin_without_piece",
    NoRoom => "pin_without_room",
});

impl PinWarning {
    /// What can be done.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::NoPiece(_) => vec![Remedy::RemovePin],
            Self::NoRoom(_) => vec![Remedy::MovePin],
        }
    }
}

impl fmt::Display for PinWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPiece(name) => write!(f, "{name}: there is no piece of this name any more"),
            Self::NoRoom(name) => {
                write!(f, "{name}: it does not fit where it is pinned, so it was put elsewhere")
            }
        }
    }
}

impl Pin {
    /// The pin of a piece of a best net, with this outline, that lies at this place.
    pub fn of_place(outline: &[DVec2], place: &PiecePlace) -> Self {
        let on_sheet = outline.iter().map(|&p| place.place.transform_point2(p));
        let (low, _) = polygon::bounds(on_sheet).unwrap_or_default();
        Self { sheet: place.sheet, at_mm: low, turn_rad: place.place.matrix2.x_axis.to_angle(), net: 0 }
    }

    /// The place of a piece with this outline, from the lower left corner of the area for pieces.
    pub(super) fn placement(&self, outline: &[DVec2], origin_mm: DVec2) -> Placement {
        let turn = DVec2::from_angle(self.turn_rad);
        let (low, _) = polygon::bounds(outline.iter().map(|&p| turn.rotate(p))).unwrap_or_default();
        let translation = self.at_mm - low - origin_mm;
        Placement { sheet: self.sheet, rotation_rad: self.turn_rad, translation }
    }
}

/// The pins that no piece, or none at its place, has.
pub(super) fn pin_warnings<'a>(
    pins: &BTreeMap<String, Pin>,
    places: impl Iterator<Item = (&'a Blank, &'a PiecePlace)>,
) -> Vec<PinWarning> {
    let places: BTreeMap<&str, Pin> =
        places.map(|(blank, place)| (blank.name(), Pin::of_place(blank.outline(), place))).collect();
    let fault = |(name, pin): (&String, &Pin)| match places.get(name.as_str()) {
        None => Some(PinWarning::NoPiece(name.clone())),
        // A sheet with a lower number may have become empty.
        Some(found) if found.sheet > pin.sheet || found.at_mm.distance(pin.at_mm) > NEAR_MM => {
            Some(PinWarning::NoRoom(name.clone()))
        }
        Some(_) => None,
    };
    pins.iter().filter_map(fault).collect()
}
