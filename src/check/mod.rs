//! Checks that recompute what a file claims from the file alone, sharing no code with the stages
//! that made it.

mod fold;

pub use fold::{FoldCheckError, FoldReport, fold};
