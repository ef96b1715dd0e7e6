//! Pieces placed on sheets of paper, with page furniture.

mod calibration;
pub mod fit;
pub mod furniture;
mod layout;
pub mod nest;
mod options;
mod pages;
mod pin;
mod registration;

pub use calibration::{Calibration, CalibrationError};
pub use layout::{Layout, LayoutError, PiecePlace};
pub use options::{SheetChoices, SheetOptions};
pub use pin::{Pin, Unheeded};
pub use registration::Registration;
