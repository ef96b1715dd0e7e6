//! Drawings to strokes of a tool, to jobs of cutters, to what goes over the wire.

pub mod plotter;
pub mod toolpath;

use tatamu_core::geom;
use tatamu_draw::drawing;
