//! What need not be asked twice of models: they share parts, and one half is often the image of the other.

use super::PartId;

/// Which parts are alike, of a model and of others.
#[derive(Debug, Clone)]
pub struct Alike {
    /// For each part a number that is equal only where its shape and the way it sits on its parent are.
    pub ids: Vec<u64>,
    /// The mirror image of each part, which may be the part itself, where the whole model is its own image.
    pub twins: Option<Vec<PartId>>,
}

impl Alike {
    /// Nothing is known of a model with this number of parts.
    pub fn unknown(parts: usize) -> Self {
        Self { ids: (0..parts as u64).collect(), twins: None }
    }
}
