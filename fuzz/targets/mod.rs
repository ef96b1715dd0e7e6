//! What each fuzz target does with one input; `tests/fuzz_corpus.rs` does it with the stored inputs.

pub mod fold;
pub mod folding;
pub mod journal;
pub mod mesh;
pub mod model;
pub mod options;
pub mod planner;
pub mod plt;
pub mod profile;
pub mod project;
pub mod replies;
pub mod threemf;
