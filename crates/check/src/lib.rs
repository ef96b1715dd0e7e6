//! Checks that recompute what a file claims from the file alone, sharing no code with the stages
//! that made it.

mod chains;
mod fold;
mod layers;
mod verdict;

pub use fold::{FoldCheckError, FoldReport, fold};
pub use verdict::{Limits, Verdict};
