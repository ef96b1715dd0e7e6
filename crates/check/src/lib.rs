//! Checks that recompute what a file claims from the file alone, sharing no code with the stages
//! that made it.

mod area;
mod chains;
mod fold;
mod layers;
mod model;
mod report;
mod verdict;

pub use fold::fold;
pub use model::FoldCheckError;
pub use report::FoldReport;
pub use verdict::{Limits, Verdict};
