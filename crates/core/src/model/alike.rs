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

    /// The mirror image of a part; the part itself where the model is not its own image.
    pub fn twin(&self, part: PartId) -> PartId {
        self.twins.as_ref().map_or(part, |twins| twins[part.0])
    }

    /// The images of two parts, the smaller id first, as in the pair itself.
    pub fn image(&self, pair: [PartId; 2]) -> [PartId; 2] {
        let mut image = pair.map(|part| self.twin(part));
        image.sort();
        image
    }
}
