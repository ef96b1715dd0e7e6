//! A job on its way to the cutter, in a thread of its own.

use super::words;
use super::worker::Wake;
use crate::app::error::AppError;
use crate::app::output;
use crate::app::plot::Sheet;
use crate::app::plot::{Operator, SystemPorts, doing};
use crate::app::plot::{journal, live};
use crate::app::sources::Sources;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use tatamu::plotter::journal::{Header, Position};
use tatamu::plotter::session::Status;
use tatamu::plotter::{Cutter, in_minutes};
use tatamu::progress::Cancelled;

/// Time between two polls of the user's requests.
const LOOK: Duration = Duration::from_millis(10);

/// How far a job is.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct State {
    /// What happens, in words.
    pub text: String,
    /// Share of the sheet that is done.
    pub share: f32,
    /// The sheet that the machine works on, and how many of its strokes are done.
    pub at: Option<(String, usize)>,
    /// What the user is to do with a sheet before the machine works on it.
    pub wants_sheet: Option<String>,
    /// What the machine and the session had to say.
    pub notes: Vec<String>,
    /// Whether the job is paused, with the tool lifted.
    pub is_paused: bool,
    /// How often it was asked to stop.
    pub stops: u32,
    /// How it ended.
    pub end: Option<Result<(), String>>,
}

/// A job on its way.
pub struct Plotting {
    state: Arc<Mutex<State>>,
}

impl Plotting {
    /// Begins to send sheets. The journal is kept in `journal` until all is done.
    pub fn start(
        cutter: &Cutter,
        port: &str,
        copies: u16,
        sheets: &[Sheet],
        journal: PathBuf,
        wake: Wake,
    ) -> Self {
        let header = live::header(sheets, cutter, port.to_owned(), copies);
        Self::begin(header, Position::default(), journal, wake)
    }

    /// Continues a stopped job.
    ///
    /// # Errors
    /// A message where its journal cannot be read.
    pub fn resume(journal: PathBuf, port: &str, wake: Wake) -> Result<Self, String> {
        let (header, at) = journal::read(&journal).map_err(|error| words::error(&error))?;
        let port = if port.is_empty() { header.port } else { port.to_owned() };
        Ok(Self::begin(Header { port, ..header }, at, journal, wake))
    }

    fn begin(header: Header, at: Position, journal: PathBuf, wake: Wake) -> Self {
        let state = Arc::new(Mutex::new(State { text: "opening the port".to_owned(), ..State::default() }));
        let mut hand = Hand { state: state.clone(), wake, is_begun: at.strokes > 0 };
        std::thread::spawn(move || {
            let sent = output::check_places(std::slice::from_ref(&journal), &Sources::none())
                .and_then(|()| live::send_all(&SystemPorts, &mut hand, &journal, &header, at));
            let end = sent.map_err(|error| words::error(&error));
            locked(&hand.state).end = Some(end);
            (hand.wake)();
        });
        Self { state }
    }

    /// How far it is.
    pub fn state(&self) -> State {
        locked(&self.state).clone()
    }

    /// Whether it has not ended.
    pub fn is_running(&self) -> bool {
        locked(&self.state).end.is_none()
    }

    /// Pauses the job with the tool lifted, or continues it.
    pub fn pause(&self) {
        let mut state = locked(&self.state);
        state.is_paused = !state.is_paused;
    }

    /// Lifts the tool and stops.
    pub fn stop(&self) {
        locked(&self.state).stops += 1;
    }

    /// The sheet is loaded.
    pub fn loaded(&self) {
        locked(&self.state).wants_sheet = None;
    }
}

fn locked(state: &Mutex<State>) -> MutexGuard<'_, State> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The user, as the thread knows them.
struct Hand {
    state: Arc<Mutex<State>>,
    wake: Wake,
    /// Whether strokes of the next sheet are done, so that it is in the machine.
    is_begun: bool,
}

impl Operator for Hand {
    fn load(&mut self, sheet: &str, (copy, copies): (u16, u16)) -> Result<(), AppError> {
        let copy = if copies > 1 { format!(" (copy {copy} of {copies})") } else { String::new() };
        let wish = match std::mem::take(&mut self.is_begun) {
            true => format!("Leave the sheet for {sheet}{copy} where it is; the job continues on it."),
            false => format!("Load a sheet for {sheet}{copy}."),
        };
        locked(&self.state).wants_sheet = Some(wish);
        (self.wake)();
        while locked(&self.state).wants_sheet.is_some() {
            if self.stops() > 0 {
                return Err(AppError::Cancelled(Cancelled));
            }
            std::thread::sleep(LOOK);
        }
        Ok(())
    }

    fn stops(&mut self) -> u32 {
        locked(&self.state).stops
    }

    fn pauses(&mut self, _: bool) -> bool {
        locked(&self.state).is_paused
    }

    fn note(&mut self, text: &str) {
        locked(&self.state).notes.push(text.to_owned());
        (self.wake)();
    }

    fn show(&mut self, sheet: &str, first: usize, status: &Status) {
        let (done, all) = (first + status.strokes_done, first + status.strokes);
        let left = in_minutes(status.seconds_left);
        let mut state = locked(&self.state);
        state.text = format!("{sheet}: stroke {done} of {all}, {left} left ({})", doing(status.state));
        state.share = done as f32 / all.max(1) as f32;
        state.at = Some((sheet.to_owned(), done));
        drop(state);
        (self.wake)();
    }

    fn stopped(&mut self, _: &Path, (done, strokes): (usize, usize)) {
        self.note(&format!("at least {done} of {strokes} strokes of this sheet are done"));
    }
}
