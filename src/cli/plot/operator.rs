//! The user at the terminal, who watches a job and steers it.

use super::keys::Keys;
use crate::app::error::AppError;
use crate::app::plot::{Operator, doing};
use crate::cli::{progress, terminal};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::path::Path;
use std::time::Duration;
use tatamu::plotter::in_minutes;
use tatamu::plotter::session::{State, Status};
use tatamu::progress::Cancelled;

/// Longest time between two looks at the keyboard while a sheet is loaded.
const LOOK: Duration = Duration::from_millis(4);

/// The user at the terminal.
pub struct Terminal {
    keys: Option<Keys>,
    /// Whether keys are pressed by a person: what a script writes is no wish to pause.
    has_keyboard: bool,
    asks_nothing: bool,
    is_quiet: bool,
    bar: Option<ProgressBar>,
}

impl Terminal {
    /// A user who is asked for each sheet or not, with all messages or few.
    pub fn new(asks_nothing: bool, is_quiet: bool) -> Self {
        let has_keyboard = std::io::stdin().is_terminal();
        Self { keys: None, has_keyboard, asks_nothing, is_quiet, bar: None }
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
        // A script that plots one file of a list after another keeps the rest of its list.
        if self.has_keyboard || !self.asks_nothing {
            self.keys = Some(Keys::listen());
        }
    }

    fn load(&mut self, sheet: &str, (copy, copies): (u16, u16)) -> Result<(), AppError> {
        let Some(keys) = self.keys.as_ref().filter(|_| !self.asks_nothing) else { return Ok(()) };
        let copy = if copies > 1 { format!(" (copy {copy} of {copies})") } else { String::new() };
        terminal::complain(
            "tatamu",
            &format!("load a sheet for {sheet}{copy}, then press Enter; Ctrl-C stops"),
        );
        loop {
            match keys.poll() {
                Ok(Some(b'\n' | b'\r')) => return Ok(()),
                Ok(_) if progress::stops() > 0 => return Err(AppError::Cancelled(Cancelled)),
                Ok(_) => std::thread::sleep(LOOK),
                Err(()) => {
                    let message = "cannot wait for Enter, because there is no keyboard input; use --yes";
                    return Err(AppError::Options(message.to_owned()));
                }
            }
        }
    }

    fn stops(&mut self) -> u32 {
        progress::stops()
    }

    fn pauses(&mut self, now: bool) -> bool {
        let keys = self.keys.as_ref().filter(|_| self.has_keyboard);
        let keys = std::iter::from_fn(|| keys.and_then(Keys::pressed));
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
            State::Paused => "paused, p: continue",
            state => doing(state),
        };
        let (done, all) = (first + status.strokes_done, first + status.strokes);
        bar.set_length(all as u64);
        bar.set_position(done as u64);
        let left = in_minutes(status.seconds_left);
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
                "at least {done} of {strokes} strokes of this sheet are done; continue with: tatamu plot --resume {}",
                as_word(journal)
            ),
        );
    }

    fn done(&mut self) {
        if !self.is_quiet {
            terminal::say("done");
        }
    }
}

/// A name as one word of a command.
fn as_word(path: &Path) -> String {
    let name = path.display().to_string();
    if name.contains(char::is_whitespace) { format!("\"{name}\"") } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The command that a stopped job names could not be copied.
    #[test]
    fn a_name_with_a_blank_is_one_word() {
        assert_eq!(as_word(Path::new("my bear.tatamu-job")), "\"my bear.tatamu-job\"");
        assert_eq!(as_word(Path::new("bear.tatamu-job")), "bear.tatamu-job");
    }
}
