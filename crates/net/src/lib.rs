//! Nets of foldable components, and sheets of paper full of them.

pub mod net;
pub mod sheet;

use tatamu_core::{component, geom, memory, model, progress, units};
use tatamu_draw::drawing;
