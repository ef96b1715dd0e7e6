//! How long work tells of its progress and learns that it should stop. The library itself never
//! prints.

use std::sync::atomic::{AtomicBool, Ordering};

/// Work was stopped at the user's wish.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("stopped at your request")]
pub struct Cancelled;

/// Receiver of progress; all methods have defaults that ignore it.
pub trait Progress: Sync {
    /// A stage begins.
    fn stage(&self, name: &'static str) {
        let _ = name;
    }

    /// Part of the current stage that is done, 0 to 1.
    fn fraction(&self, done: f64) {
        let _ = done;
    }

    /// Whether the user asked to stop.
    fn is_cancelled(&self) -> bool {
        false
    }

    /// `Err` once the user asked to stop.
    fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}

/// Passes on nothing but the wish to stop: for work that goes on beside the stage that is shown.
pub struct Beside<'a> {
    shown: &'a dyn Progress,
    is_futile: AtomicBool,
}

impl<'a> Beside<'a> {
    /// For work beside what tells its progress to `shown`.
    pub fn new(shown: &'a dyn Progress) -> Self {
        Self { shown, is_futile: AtomicBool::new(false) }
    }

    /// Stops the work, since nobody will want what it finds.
    pub fn give_up(&self) {
        self.is_futile.store(true, Ordering::Relaxed);
    }
}

impl Progress for Beside<'_> {
    fn is_cancelled(&self) -> bool {
        self.is_futile.load(Ordering::Relaxed) || self.shown.is_cancelled()
    }
}

/// Ignores everything and never stops.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_beside_stops_when_it_is_given_up_and_what_is_shown_goes_on() {
        let beside = Beside::new(&Silent);
        assert_eq!(beside.check(), Ok(()));
        beside.give_up();
        assert_eq!((beside.check(), Silent.check()), (Err(Cancelled), Ok(())));
    }
}
