//! Pieces placed on sheets of paper, with page furniture.

pub mod fit;
pub mod furniture;
mod layout;
pub mod nest;

pub use layout::{Layout, LayoutError, PiecePlace, SheetOptions};
