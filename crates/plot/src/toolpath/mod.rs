//! From the lines of a drawing to the motion of tools: what is drawn, creased and cut, in which
//! order, and where the tool's shaft has to go.
//!
//! ```text
//! drawing -> tasks (lines by operation) -> order -> perforation, overcut, passes -> blade -> strokes
//! ```
//!
//! Coordinates are millimetres on the sheet, as in the drawing. Nothing here knows of machines.

mod blade;
mod inside;
mod order;
mod perforation;
mod strokes;
mod task;
mod tip;
mod tooling;
mod tooling_error;
mod visit;

use blade::ARC_TOLERANCE_MM;
pub use order::{in_order, travel_mm};
pub use perforation::Perforation;
pub use strokes::{Stroke, Toolpath};
pub use task::{Operation, Task, tasks};
pub use tip::{Tip, deviation_mm};
pub use tooling::{Tooling, Toolset};
pub use tooling_error::ToolingError;
