//! The place of a piece.

use glam::DAffine2;

/// Where a piece lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PiecePlace {
    /// Index of the sheet.
    pub sheet: usize,
    /// Rigid motion from the piece's coordinates to the sheet's, mm.
    pub place: DAffine2,
}
