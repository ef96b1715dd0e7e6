//! Sessions over USB: the port takes no more than the machine has room for, and the machine says whether it is
//! ready, still moving, or without a sheet.

use super::{End, Phase, Session, Step};
use std::time::Duration;

/// Time between two questions for the state, and time for an answer.
const INTERVAL: Duration = Duration::from_millis(400);
const PATIENCE: Duration = Duration::from_millis(1500);
/// Questions in a row without an answer after which the machine is one that does not answer.
const MOST_SILENCES: u32 = 3;
/// A machine is done when it says this many times in a row that it is ready.
const SURE: u32 = 2;
/// The second wish to stop waits this long for the port.
const HURRY: Duration = Duration::from_secs(10);
/// The next look where only time passes.
const TICK: Duration = Duration::from_millis(10);

/// What a machine says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Ready,
    Moving,
    Unloaded,
}

/// What is known of a machine on USB.
#[derive(Debug, Clone, Default)]
pub(super) struct Poll {
    has_begun: bool,
    state: Option<State>,
    asked: Option<Duration>,
    last: Duration,
    silences: u32,
    /// Answers in a row that it is ready.
    readies: u32,
    is_load_told: bool,
}

impl Poll {
    /// What it said of itself does not count any more.
    pub(super) fn forget(&mut self) {
        (self.asked, self.readies) = (None, 0);
    }
}

impl Session {
    pub(super) fn usb_step(&mut self, now: Duration) -> Step {
        match self.phase {
            Phase::Probe => self.usb_begin(now),
            Phase::Stream => self.stream(now),
            Phase::Finish(end) => self.usb_finish(end, now),
            Phase::Ended(outcome) => Step::Done(outcome),
        }
    }

    /// An answer came: a digit. Numbers with blanks before them are answers to other questions.
    pub(super) fn usb_answered(&mut self, line: &str) {
        let state = match line.trim_end() {
            "0" => State::Ready,
            "1" => State::Moving,
            "2" => State::Unloaded,
            _ => return,
        };
        self.poll.state = Some(state);
        self.poll.asked = None;
        self.poll.silences = 0;
        self.poll.readies = if state == State::Ready { self.poll.readies + 1 } else { 0 };
    }

    /// Initialises the machine, and waits until it has a sheet.
    fn usb_begin(&mut self, now: Duration) -> Step {
        if self.stop_wishes > 0 {
            return self.end(End::Stopped, true);
        }
        if !std::mem::replace(&mut self.poll.has_begun, true) {
            return self.send_control(self.dialect.initialise(), now);
        }
        let is_silent = self.poll.silences >= MOST_SILENCES;
        if self.poll.state == Some(State::Ready) || is_silent {
            let silent = if is_silent { "no answer from the machine; " } else { "" };
            self.notes.push(format!("{silent}handshake: usb (the port takes what the machine has room for)"));
            self.phase = Phase::Stream;
            self.poll = Poll { has_begun: true, ..Poll::default() };
            return Step::Wait(Duration::ZERO);
        }
        if self.poll.state == Some(State::Unloaded) && !std::mem::replace(&mut self.poll.is_load_told, true) {
            self.notes.push("the machine has no sheet: load it at the machine".to_owned());
        }
        self.ask_state(now)
    }

    /// Waits until the machine has done everything, as far as it says.
    fn usb_finish(&mut self, end: End, now: Duration) -> Step {
        if end == End::Finished && self.stop_wishes > 0 {
            return self.begin_stop(End::Stopped, now);
        }
        // Without a line, nothing is on its way but what the port holds.
        let is_empty = self.line.queued() == 0;
        let is_overdue = now >= self.line.busy_until() + HURRY;
        if self.stop_wishes > 2 || self.stop_wishes > 1 && (is_empty || is_overdue) {
            return self.end(end, false);
        }
        if !is_empty {
            // What it said before it had everything does not count. A question is on its way, too.
            if self.poll.asked.is_none() {
                self.poll.readies = 0;
            }
            return Step::Wait(TICK);
        }
        if self.poll.readies >= SURE {
            return self.end(end, true);
        }
        self.tell_wait(end, now);
        if self.poll.silences >= MOST_SILENCES && now >= self.ledger.done_at() {
            return self.end(end, false);
        }
        self.ask_state(now)
    }

    fn ask_state(&mut self, now: Duration) -> Step {
        if self.poll.asked.is_some_and(|asked| now >= asked + PATIENCE) {
            self.poll.asked = None;
            self.poll.silences += 1;
        }
        if self.poll.asked.is_some() || now < self.poll.last + INTERVAL {
            return Step::Wait(TICK);
        }
        (self.poll.asked, self.poll.last) = (Some(now), now);
        self.send_control(self.dialect.state_question(), now)
    }
}
