//! What the parts of a model do to each other while they fold, for the choice between models.

use tatamu_core::fold::{Detection, FoldPlan, ModelMotion, SweepCache};
use tatamu_core::model::{Alike, Bump, Enough, Judge, Model};
use tatamu_core::progress::{Beside, Cancelled, Progress};

/// Folds models, and tells where they clash.
pub(super) struct FoldJudge<'a> {
    pub(super) thickness_mm: f64,
    pub(super) detection: Detection,
    pub(super) cache: &'a SweepCache,
    pub(super) progress: &'a dyn Progress,
}

impl Judge for FoldJudge<'_> {
    fn bumps(&self, model: &Model, alike: &Alike, is_enough: &Enough<'_>) -> Result<Vec<Bump>, Cancelled> {
        let (motion, progress) = (ModelMotion::new(model), Beside::new(self.progress));
        let how = (self.detection, is_enough);
        Ok(FoldPlan::quick(&motion, self.thickness_mm, alike, self.cache, how, &progress)?.bumps())
    }
}
