//! Who watches a job and steers it: here the user at the terminal.

use super::jobs;
use super::keys::Keys;
use crate::cli::error::CliError;
use crate::cli::{progress, terminal};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::path::Path;
use std::time::Duration;
use tatamu::plotter::session::{State, Status};
use tatamu::progress::Cancelled;

/// Longest time between two looks at the keyboard while a sheet is loaded.
const LOOK: Duration = Duration::from_millis(4);

/// Who watches a job and steers it.
pub trait Operator {
    /// The port is open; from now on the wishes below count.
    fn begin(&mut self) {}

    /// Asks for a sheet, which may be that of a copy: its number and that of all.
    ///
    /// # Errors
    /// [`CliError`] where it does not come.
    fn load(&mut self, sheet: &str, copy: (u16, u16)) -> Result<(), CliError>;

    /// How often it was asked to stop.
    fn stops(&mut self) -> u32;

    /// Whether the tool is to be lifted until further notice; `now` is what was wanted before.
    fn pauses(&mut self, now: bool) -> bool;

    /// Something to know.
    fn note(&mut self, text: &str);

    /// How far a sheet is, of which some strokes were done before.
    fn show(&mut self, sheet: &str, first: usize, status: &Status);

    /// A sheet is over, finished or not.
    fn sheet_over(&mut self) {}

    /// The job was stopped, with so many of so many strokes of its sheet certainly done; it can go
    /// on from its journal.
    fn stopped(&mut self, journal: &Path, strokes: (usize, usize));

    /// All is done.
    fn done(&mut self) {}
}

/// What a machine is doing, in words.
pub fn doing(state: State) -> &'static str {
    match state {
        State::Probing => "asking the machine",
        State::Sending => "at work",
        State::Paused => "paused",
        State::Finishing => "the machine works on",
        State::Stopping | State::Ended => "lifting the tool",
    }
}

/// The user at the terminal.
pub struct Terminal {
    keys: Option<Keys>,
    asks_nothing: bool,
    is_quiet: bool,
    bar: Option<ProgressBar>,
}

impl Terminal {
    /// One who asks for sheets or not, and says much or little.
    pub fn new(asks_nothing: bool, is_quiet: bool) -> Self {
        Self { keys: None, asks_nothing, is_quiet, bar: None }
    }

    fn bar(&self) -> ProgressBar {
        if self.is_quiet || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::new(1);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}") {
            bar.set_style(style);
        }
        bar
    }
}

impl Operator for Terminal {
    fn begin(&mut self) {
        progress::count_stops();
        self.keys = Some(Keys::listen());
    }

    fn load(&mut self, sheet: &str, (copy, copies): (u16, u16)) -> Result<(), CliError> {
        let Some(keys) = self.keys.as_ref().filter(|_| !self.asks_nothing) else { return Ok(()) };
        let copy = if copies > 1 { format!(" (copy {copy} of {copies})") } else { String::new() };
        terminal::complain(
            "tatamu",
            &format!("load a sheet for {sheet}{copy}, then press Enter; Ctrl-C ends"),
        );
        loop {
            match keys.poll() {
                Ok(Some(b'\n' | b'\r')) => return Ok(()),
                Ok(_) if progress::stops() > 0 => return Err(CliError::Cancelled(Cancelled)),
                Ok(_) => std::thread::sleep(LOOK),
                Err(()) => {
                    let message = "there is no one to ask whether the sheet is loaded; use --yes";
                    return Err(CliError::Options(message.to_owned()));
                }
            }
        }
    }

    fn stops(&mut self) -> u32 {
        progress::stops()
    }

    fn pauses(&mut self, now: bool) -> bool {
        let keys = std::iter::from_fn(|| self.keys.as_ref().and_then(Keys::pressed));
        now ^ (keys.filter(|key| matches!(key, b'p' | b' ')).count() % 2 == 1)
    }

    fn note(&mut self, text: &str) {
        if !self.is_quiet {
            terminal::complain("tatamu", text);
        }
    }

    fn show(&mut self, sheet: &str, first: usize, status: &Status) {
        let bar = self.bar.take().unwrap_or_else(|| self.bar());
        let what = match status.state {
            State::Sending => "p: pause",
            State::Paused => "paused, p: go on",
            state => doing(state),
        };
        let (done, all) = (first + status.strokes_done, first + status.strokes);
        bar.set_length(all as u64);
        bar.set_position(done as u64);
        let left = jobs::minutes(status.seconds_left);
        bar.set_message(format!("{sheet}: stroke {done} of {all}, {left} left ({what})"));
        self.bar = Some(bar);
    }

    fn sheet_over(&mut self) {
        self.bar.take().iter().for_each(ProgressBar::finish_and_clear);
    }

    fn stopped(&mut self, journal: &Path, (done, strokes): (usize, usize)) {
        terminal::complain(
            "tatamu",
            &format!(
                "{done} of {strokes} strokes of this sheet are certainly done; go on with: tatamu plot --resume {}",
                journal.display()
            ),
        );
    }

    fn done(&mut self) {
        if !self.is_quiet {
            terminal::say("done");
        }
    }
}
