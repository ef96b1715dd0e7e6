//! The size in which the model takes no more sheets than its project allows.

use super::super::change::Change;
use super::super::messages::{Cause, Problem};
use super::super::tasks::Stop;
use super::Studio;
use tatamu::front::results::exceeded_sheets;
use tatamu::project::options::SIZE;

impl Studio {
    /// How many sheets the model may take, where it takes more.
    pub fn exceeded_sheets(&self) -> Option<usize> {
        exceeded_sheets(self.document.as_ref()?.settings(), self.laid()?)
    }

    /// Begins to look for the largest size in which the model takes no more; then the project has it.
    pub fn fit_sheets(&mut self) {
        let (Some(opened), Some(document)) = (&self.opened, &self.document) else { return };
        self.messages.clear(Cause::Change);
        let stop = Stop::default();
        self.tasks.fit(opened.clone(), document.project(), stop.clone());
        self.sizing = Some(stop);
    }

    /// Takes the size that was found, unless something was changed meanwhile.
    pub(super) fn take_size(&mut self, size: Result<f64, Problem>) {
        if self.sizing.take().is_none() {
            return;
        }
        match size {
            Ok(mm) => {
                self.change(&Change::Set { option: &SIZE, value: Some(mm.into()) }, None);
                self.messages.tell(Cause::Change, format!("the size is {mm} mm now; Undo takes it back"));
            }
            Err(problem) => self.messages.warn(Cause::Change, problem),
        }
    }

    /// Stops the search; true where there was one.
    pub(super) fn stop_sizing(&mut self) -> bool {
        self.sizing.take().inspect(Stop::stop).is_some()
    }
}
