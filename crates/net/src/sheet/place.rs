//! The place of a piece.

use glam::DAffine2;

/// Index of a sheet of paper in a layout: 0 is the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SheetId(pub usize);

impl SheetId {
    /// Its number, as people count: 1 for the first.
    pub fn number(self) -> usize {
        self.0 + 1
    }
}

/// Where a piece lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PiecePlace {
    /// The sheet.
    pub sheet: SheetId,
    /// Rigid motion from the piece's coordinates to the sheet's, mm.
    pub place: DAffine2,
}
