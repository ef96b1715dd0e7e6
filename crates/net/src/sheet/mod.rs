//! Pieces placed on sheets of paper, with page furniture.

mod beside;
mod calibration;
pub mod furniture;
mod layout;
pub mod nest;
mod options;
mod pages;
mod pin;
mod place;

pub use crate::fit::Rotation;
pub use calibration::{Calibration, CalibrationError};
pub use layout::{Layout, LayoutError};
pub use options::{SheetChoices, SheetOptions};
pub use pages::Imprint;
pub use pin::{Pin, PinWarning};
pub use place::{PiecePlace, SheetId};
pub use tatamu_draw::drawing::Registration;
