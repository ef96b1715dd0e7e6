//! Pieces placed on sheets of paper, with page furniture.

pub mod fit;
pub mod nest;
