//! How long work tells of its progress and learns that it should stop. The library itself never
//! prints.

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
pub struct Beside<'a>(pub &'a dyn Progress);

impl Progress for Beside<'_> {
    fn is_cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

/// Ignores everything and never stops.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {}
