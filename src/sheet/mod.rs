//! Pieces placed on sheets of paper, with page furniture.
