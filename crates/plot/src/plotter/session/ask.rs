//! Questions to the machine and their answers: one at a time, unless an answer is late.

use super::{End, Handshake, Phase, Session, Step};
use crate::plotter::profile::LEAST_BUFFER;
use std::collections::VecDeque;
use std::time::Duration;

/// Time for an answer that the machine gives at once.
const PATIENCE: Duration = Duration::from_millis(1000);
/// Unanswered questions in a row after which the machine is given up.
const MOST_SILENCES: u32 = 5;
/// An answer that does not come in this time is lost: a machine that says nothing for as long is given up.
const LOST: Duration = PATIENCE.saturating_mul(MOST_SILENCES);
/// A full buffer is asked about again after this time, and one with some room after [`SHORT_INTERVAL`]: often
/// enough for a fast line, and rarely enough that the machine does other things.
const INTERVAL: Duration = Duration::from_millis(40);
const SHORT_INTERVAL: Duration = Duration::from_millis(10);
/// One question in this many asks the machine for errors.
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
    /// The open questions, the oldest first: when each arrives, and what had been sent before it.
    pub(super) open: VecDeque<(Question, Duration, u64)>,
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
    /// Whether an answer came since the last question, and when that was noticed.
    has_heard: bool,
    heard: Option<Duration>,
}

impl Ask {
    pub(super) fn new(size: usize) -> Self {
        Self {
            open: VecDeque::new(),
            free: None,
            size,
            error: 0,
            has_position: false,
            has_answered: false,
            stage: 0,
            silences: 0,
            count: 0,
            last: Duration::ZERO,
            has_heard: false,
            heard: None,
        }
    }

    /// Whether the last question was left unanswered; it is closed then.
    pub(super) fn is_unanswered(&mut self, now: Duration, patience: Duration) -> bool {
        let is_late = self.open.back().is_some_and(|&(_, asked, _)| now >= asked + patience);
        if is_late {
            self.open.clear();
            self.silences += 1;
        }
        is_late
    }

    /// When an answer came after the last question, as noticed now.
    fn heard(&mut self, now: Duration) -> Option<Duration> {
        if std::mem::take(&mut self.has_heard) {
            self.heard = Some(now);
        }
        self.heard
    }

    /// Whether the line may answer the question.
    fn is_answer(&self, question: Question, line: &str, number: Option<usize>) -> bool {
        match (question, number) {
            (Question::Free, Some(free)) => free <= self.size,
            (Question::Size, Some(size)) => (LEAST_BUFFER..1 << 30).contains(&size),
            (Question::Error, Some(code)) => code < 100,
            (Question::Model, None) => true,
            (Question::Position, None) => line.split(',').count() >= 2,
            _ => false,
        }
    }
}

impl Session {
    /// Asks a question; the bytes are to be sent.
    pub(super) fn ask(&mut self, question: Question, now: Duration) -> Step {
        let Some(controls) = self.dialect.controls() else {
            return Step::Wait(INTERVAL);
        };
        if self.ask.open.is_empty() {
            self.replies.clear();
        }
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
        let sent = self.ledger.total();
        let step = self.send_control(bytes, now);
        // A slow line needs longer than the machine.
        let arrival = now + self.line.time(self.line.in_flight(now));
        self.ask.open.push_back((question, arrival, sent));
        self.ask.last = now;
        (self.ask.has_heard, self.ask.heard) = (false, None);
        step
    }

    /// A line came. It counts for the oldest question that it may answer, so that a late answer never gives credit for
    /// what was sent after its question; what answers none is noise.
    pub(super) fn answered(&mut self, line: &str) {
        let number = line.trim().parse::<usize>().ok();
        let is_answer = |&(question, _, _): &(Question, _, _)| self.ask.is_answer(question, line, number);
        let Some(place) = self.ask.open.iter().position(is_answer) else {
            return;
        };
        let Some((question, _, sent)) = self.ask.open.drain(..=place).next_back() else {
            return;
        };
        match (question, number) {
            (Question::Free, Some(free)) => {
                self.ask.free = Some((free, sent));
                let held = (self.ask.size - free) as u64;
                self.ledger.taken(sent.saturating_sub(held));
            }
            (Question::Size, Some(size)) => self.ask.size = size,
            (Question::Error, Some(code)) => self.ask.error = code as u32,
            (Question::Model, _) => {
                let name: String = line.chars().filter(|c| !c.is_control()).take(40).collect();
                self.notes.push(format!("the machine identifies itself as {name}"));
            }
            _ => self.ask.has_position = true,
        }
        self.ask.has_heard = true;
        self.ask.has_answered = true;
        // What was silent in the probe is remembered to its end.
        if self.phase != Phase::Probe {
            self.ask.silences = 0;
        }
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
        let is_silent = self.ask.is_unanswered(now, PATIENCE);
        if !self.ask.open.is_empty() {
            return Step::Wait(INTERVAL);
        }
        // Without its size, a buffer smaller than the profile's would never have room.
        if is_silent && self.ask.stage == 1 && self.ask.silences == 1 {
            return self.ask(Question::Size, now);
        }
        let questions = [Question::Size, Question::Free, Question::Error, Question::Model];
        if self.ask.stage == 2 && self.ask.free.is_none() {
            let is_auto = self.handshake == Handshake::Auto;
            return if is_auto { self.begin(Handshake::Auto, now) } else { self.end(End::NoAnswer, false) };
        }
        // A late answer would count for a question of the job.
        let is_late = self.ask.stage == 3 && self.ask.silences > 0;
        if is_late && now < self.ask.heard(now).unwrap_or(self.ask.last) + LOST {
            return Step::Wait(INTERVAL);
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
        self.ask.open.clear();
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
        if let (Some(&(question, ..)), Some(&(_, asked, _))) = (self.ask.open.front(), self.ask.open.back()) {
            match self.ask.heard(now) {
                // The machine answers again: what is still open is late or lost.
                Some(heard) if now >= heard + LOST => self.ask.open.clear(),
                None if now >= asked + PATIENCE => {
                    self.ask.silences += 1;
                    let is_given_up = self.ask.silences >= MOST_SILENCES;
                    // The same question again, so that either answer fits either.
                    return Some(if is_given_up {
                        self.begin_stop(End::NoAnswer, now)
                    } else {
                        self.ask(question, now)
                    });
                }
                _ => {}
            }
        }
        let is_low = self.credit() < (self.ask.size - self.reserve()) / 2;
        let interval = if self.credit() > 0 { SHORT_INTERVAL } else { INTERVAL };
        let is_time = now >= self.ask.last + interval;
        if !self.ask.open.is_empty() || !is_low || !is_time {
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
