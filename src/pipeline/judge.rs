//! What the parts of a model do to each other while they fold, for the choice between models.

use crate::fold::{FoldPlan, ModelMotion};
use crate::model::{Bump, Judge, Model};
use crate::progress::{Beside, Cancelled, Progress};
use std::collections::BTreeMap;

/// Folds models and tells where they bump.
pub(super) struct FoldJudge<'a> {
    pub(super) thickness_mm: f64,
    pub(super) progress: &'a dyn Progress,
}

impl Judge for FoldJudge<'_> {
    fn bumps(&self, model: &Model, _ids: &[u64]) -> Result<Vec<Bump>, Cancelled> {
        let plan = FoldPlan::new(&ModelMotion::new(model), self.thickness_mm, &Beside::new(self.progress))?;
        let mut bumps = BTreeMap::new();
        let clashes = plan.clashes().iter().map(|c| (c.parts, c.depth_mm));
        let overlaps = plan.overlaps().iter().map(|o| (o.parts, o.depth_mm));
        for (pair, depth_mm) in clashes.chain(overlaps).filter(|b| b.1 > self.thickness_mm) {
            let deepest = bumps.entry(pair).or_insert(0.0_f64);
            *deepest = deepest.max(depth_mm);
        }
        Ok(bumps.into_iter().collect())
    }
}
