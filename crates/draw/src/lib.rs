//! The display list of **tatamu**, and scenes in space drawn on it.

pub mod drawing;
pub mod pixels;
pub mod render;

use tatamu_core::{geom, mesh};
