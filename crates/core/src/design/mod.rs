//! Models drawn by the user instead of made from a mesh (§3.2, Kase et al. 2015): the user draws the
//! top panel and a profile for each of its edges, concave ones too, and chooses among the ways in
//! which the chains can fold flat.
//!
//! ```text
//! Sketch (checked) -> ways to fold each profile -> closed exactly -> ranked -> Component -> Model
//! ```

mod assignment;
mod board;
mod build;
mod closing;
mod facet;
mod hinged;
mod overlap;
mod ranking;
mod refit;
mod search;
mod silhouette;
mod sketch;
mod surface_distance;
mod thick;
mod warning;
mod weights;

pub use assignment::{FoldAssignment, Segment};
pub use board::board;
pub use build::{Design, DesignError, design, rankings};
pub use ranking::{Ranked, Ranking, Refusal, Score, rank};
pub use refit::{Body, Concave, RefitError, refit};
pub use sketch::{Attachment, Sketch, SketchError, parse_panel};
pub use thick::{ThickError, thick};
pub use warning::DesignWarning;

#[cfg(test)]
mod tests;
