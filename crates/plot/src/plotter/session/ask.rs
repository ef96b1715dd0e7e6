//! Questions to the machine and their answers: one at a time.

use super::{End, Handshake, Phase, Session, Step};
use crate::plotter::profile::LEAST_BUFFER;
use std::time::Duration;

/// A machine that is to answer at once has so much time.
const PATIENCE: Duration = Duration::from_millis(1000);
/// Unanswered questions in a row after which the machine is given up.
const MOST_SILENCES: u32 = 5;
/// A full buffer is asked about again after so long, and one with some room after so long: often
/// enough for a fast line, and not so often that the machine has nothing else to do.
const INTERVAL: Duration = Duration::from_millis(40);
const SHORT_INTERVAL: Duration = Duration::from_millis(10);
/// Every so many questions the machine is asked for errors.
const ERROR_EVERY: u32 = 32;
/// Least number of free bytes at which XOFF is asked for: twice what may be on its way.
pub(super) const XOFF_BELOW: usize = 256;

/// What was asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Question {
    Free,
    Size,
    Error,
    Model,
    Position,
}

/// The state of questions and answers.
#[derive(Debug, Clone)]
pub(super) struct Ask {
    /// The open question: when it was asked, and what had been sent by then.
    pub(super) open: Option<(Question, Duration, u64)>,
    /// The last answer to [`Question::Free`]: free bytes, and what had been sent when it was asked.
    pub(super) free: Option<(usize, u64)>,
    pub(super) size: usize,
    pub(super) error: u32,
    pub(super) has_position: bool,
    /// Whether any question was ever answered.
    pub(super) has_answered: bool,
    /// The next question of the probe or of the finish.
    pub(super) stage: usize,
    silences: u32,
    count: u32,
    last: Duration,
}

impl Ask {
    pub(super) fn new(size: usize) -> Self {
        Self {
            open: None,
            free: None,
            size,
            error: 0,
            has_position: false,
            has_answered: false,
            stage: 0,
            silences: 0,
            count: 0,
            last: Duration::ZERO,
        }
    }

    /// Whether the open question was left unanswered; it is closed then.
    pub(super) fn is_unanswered(&mut self, now: Duration, patience: Duration) -> bool {
        let is_late = self.open.is_some_and(|(_, asked, _)| now >= asked + patience);
        if is_late {
            self.open = None;
            self.silences += 1;
        }
        is_late
    }
}

impl Session {
    /// Asks a question; the bytes are to be sent.
    pub(super) fn ask(&mut self, question: Question, now: Duration) -> Step {
        let Some(controls) = self.dialect.controls() else {
            return Step::Wait(INTERVAL);
        };
        self.replies.clear();
        let bytes = match question {
            Question::Free => controls.free,
            Question::Size => controls.size,
            Question::Error => controls.error,
            Question::Model => controls.identify,
            Question::Position => controls.barrier,
        };
        if matches!(question, Question::Model | Question::Position) {
            let arrival = self.line.busy_until().max(now) + self.line.time(bytes.len());
            self.ledger.sent(bytes.len(), self.ledger.strokes_done(), 0.0, arrival);
        }
        self.ask.open = Some((question, now, self.ledger.total()));
        self.ask.last = now;
        self.send_control(bytes, now)
    }

    /// A line came. What does not answer the open question is noise.
    pub(super) fn answered(&mut self, line: &str) {
        let Some((question, _, sent)) = self.ask.open else {
            return;
        };
        let number = line.trim().parse::<usize>().ok();
        match (question, number) {
            (Question::Free, Some(free)) if free <= self.ask.size => {
                self.ask.free = Some((free, sent));
                let held = (self.ask.size - free) as u64;
                self.ledger.taken(sent.saturating_sub(held));
            }
            (Question::Size, Some(size)) if (LEAST_BUFFER..1 << 30).contains(&size) => self.ask.size = size,
            (Question::Error, Some(code)) if code < 100 => self.ask.error = code as u32,
            (Question::Model, None) => {
                let name: String = line.chars().filter(|c| !c.is_control()).take(40).collect();
                self.notes.push(format!("the machine identifies itself as {name}"));
            }
            (Question::Position, None) if line.split(',').count() >= 2 => self.ask.has_position = true,
            _ => return,
        }
        self.ask.open = None;
        self.ask.silences = 0;
        self.ask.has_answered = true;
    }

    /// Finds out what the machine answers, and chooses the handshake.
    pub(super) fn probe(&mut self, now: Duration) -> Step {
        if self.stop_wishes > 0 {
            return self.begin_stop(End::Stopped, now);
        }
        let wants_answers = matches!(self.handshake, Handshake::Auto | Handshake::EscB) && self.may_ask();
        if !wants_answers {
            let is_possible = self.handshake != Handshake::EscB;
            return if is_possible {
                self.begin(self.handshake, now)
            } else {
                self.end(End::NoAnswer, false)
            };
        }
        if self.ask.open.is_some() && !self.ask.is_unanswered(now, PATIENCE) {
            return Step::Wait(INTERVAL);
        }
        let questions = [Question::Size, Question::Free, Question::Error, Question::Model];
        if self.ask.stage == 2 && self.ask.free.is_none() {
            let is_auto = self.handshake == Handshake::Auto;
            return if is_auto { self.begin(Handshake::Auto, now) } else { self.end(End::NoAnswer, false) };
        }
        match questions.get(self.ask.stage) {
            Some(&question) => {
                self.ask.stage += 1;
                self.ask(question, now)
            }
            None => {
                // An error from before this job is none of it.
                self.ask.error = 0;
                self.ask.silences = 0;
                self.begin(Handshake::EscB, now)
            }
        }
    }

    /// Begins to send by a handshake; `auto` means that the machine did not answer.
    fn begin(&mut self, handshake: Handshake, now: Duration) -> Step {
        let fallback = match self.serial.fallback {
            Handshake::RtsCts if self.has_clear_to_send != Some(true) => Handshake::Paced,
            other => other,
        };
        let has_no_cts = handshake == Handshake::RtsCts && self.has_clear_to_send.is_none();
        self.handshake = match handshake {
            Handshake::Auto => fallback,
            _ if has_no_cts => Handshake::Paced,
            other => other,
        };
        // What a machine does with questions that it does not know is anybody's guess.
        self.serial.answers &= handshake != Handshake::Auto && self.handshake != Handshake::Paced;
        let why = match self.handshake {
            Handshake::EscB => format!("asks for free bytes (ESC.B), buffer of {} bytes", self.ask.size),
            Handshake::RtsCts => "the line CTS".to_owned(),
            Handshake::XonXoff => "XON/XOFF".to_owned(),
            _ => format!("by time: at most {} bytes ahead of the machine", self.ask.size),
        };
        let asked = match handshake {
            Handshake::Auto => "no answer from the machine; ",
            _ if has_no_cts => "the port has no line CTS; ",
            _ => "",
        };
        self.notes.push(format!("{asked}handshake: {} ({why})", self.handshake.name()));
        self.phase = Phase::Stream;
        self.ask.stage = 0;
        self.ask.open = None;
        let switch = self.dialect.switch_xon_xoff_on(XOFF_BELOW.min(self.ask.size / 2));
        let is_switched = self.handshake == Handshake::XonXoff && self.may_ask();
        let switch = if is_switched { switch } else { Vec::new() };
        let has_control = !switch.is_empty() || self.may_ask() && !self.is_cleared;
        if has_control { self.send_control(&switch, now) } else { Step::Wait(Duration::ZERO) }
    }

    /// The next question while sending by ESC.B, if it is time for one.
    pub(super) fn keep_asking(&mut self, now: Duration) -> Option<Step> {
        if self.handshake != Handshake::EscB {
            return None;
        }
        if self.ask.is_unanswered(now, PATIENCE) && self.ask.silences >= MOST_SILENCES {
            return Some(self.begin_stop(End::NoAnswer, now));
        }
        let is_low = self.credit() < (self.ask.size - self.reserve()) / 2;
        let interval = if self.credit() > 0 { SHORT_INTERVAL } else { INTERVAL };
        let is_time = now >= self.ask.last + interval;
        if self.ask.open.is_some() || !is_low || !is_time {
            return None;
        }
        self.ask.count += 1;
        let question =
            if self.ask.count.is_multiple_of(ERROR_EVERY) { Question::Error } else { Question::Free };
        Some(self.ask(question, now))
    }

    /// Bytes that the machine certainly has room for, by its last answer.
    pub(super) fn credit(&self) -> usize {
        let Some((free, asked)) = self.ask.free else {
            return 0;
        };
        let since = (self.ledger.total() - asked) as usize;
        free.saturating_sub(self.reserve() + since)
    }
}
