//! Who watches a job and steers it.

use crate::app::error::AppError;
use std::path::Path;
use tatamu::plotter::session::{State, Status};

/// Who watches a job and steers it.
pub trait Operator {
    /// The port is open; from now on the session follows the requests below.
    fn begin(&mut self) {}

    /// Asks for a sheet, which may be that of a copy: its number and that of all.
    ///
    /// # Errors
    /// [`AppError`] where it does not come.
    fn load(&mut self, sheet: &str, copy: (u16, u16)) -> Result<(), AppError>;

    /// How often it was asked to stop.
    fn stops(&mut self) -> u32;

    /// Whether the job should pause with its tool lifted; `now` is whether it does.
    fn pauses(&mut self, now: bool) -> bool;

    /// Something to know.
    fn note(&mut self, text: &str);

    /// How far a sheet is, of which some strokes were done before.
    fn show(&mut self, sheet: &str, first: usize, status: &Status);

    /// A sheet is over, finished or not.
    fn sheet_over(&mut self) {}

    /// The job was stopped; `strokes` are how many of its sheet's strokes are certainly done, and how many there are.
    /// It can continue from its journal.
    fn stopped(&mut self, journal: &Path, strokes: (usize, usize));

    /// All is done.
    fn done(&mut self) {}
}

/// What a machine is doing, in words.
pub fn doing(state: State) -> &'static str {
    match state {
        State::Probing => "asking the machine",
        State::Sending => "sending",
        State::Paused => "paused",
        State::Finishing => "the machine is finishing",
        State::Stopping | State::Ended => "lifting the tool",
    }
}
