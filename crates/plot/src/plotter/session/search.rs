//! Waiting until the machine has looked for printed marks: nothing is sent before it has found them.
//!
//! A machine answers with a number in five places: 0 where it found them. Its answers about its state have one place
//! only, so that a late one is not mistaken. Source: `plot` and `status` of silhouette/Graphtec.py
//! (github.com/fablabnbg/inkscape-silhouette), which waits 40 s.

use super::{End, Session, Step};
use std::time::Duration;

/// Time for the answer, from when the machine has the question.
const PATIENCE: Duration = Duration::from_secs(60);
/// The next look where only time passes.
const TICK: Duration = Duration::from_millis(20);

/// Where a search for marks is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Search {
    /// None is going on.
    #[default]
    Over,
    /// The command is on its way.
    Sent,
    /// The machine has had it since then.
    Asked(Duration),
    /// It said whether it found them.
    Answered(bool),
}

impl Search {
    pub(super) fn is_going_on(self) -> bool {
        self != Self::Over
    }

    /// A line came.
    pub(super) fn answered(&mut self, line: &str) {
        let number = line.strip_prefix(' ').and_then(|text| text.trim().parse::<u32>().ok());
        if let (Some(number), Self::Sent | Self::Asked(_)) = (number, *self) {
            *self = Self::Answered(number == 0);
        }
    }
}

impl Session {
    /// What to do while the machine looks for marks; nothing special where it does not.
    pub(super) fn await_marks(&mut self, now: Duration) -> Option<Step> {
        match self.search {
            Search::Over => None,
            Search::Answered(true) => {
                self.notes.push("the machine found the registration marks".to_owned());
                self.search = Search::Over;
                None
            }
            Search::Answered(false) => Some(self.begin_stop(End::MarksNotFound, now)),
            Search::Asked(since) if now >= since + PATIENCE => {
                Some(self.begin_stop(End::MarksUnanswered, now))
            }
            Search::Asked(_) => Some(Step::Wait(TICK)),
            Search::Sent => {
                if self.line.in_flight(now) == 0 {
                    self.search = Search::Asked(now);
                }
                Some(Step::Wait(TICK))
            }
        }
    }
}
