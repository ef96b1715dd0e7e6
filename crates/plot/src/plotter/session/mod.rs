//! Sending a job: a state machine without a port and without a clock. What the machine said and
//! what time it is go in; what to send comes out.
//!
//! # Guarantees
//! - Only whole commands are sent, so that stopping never leaves a part of one.
//! - At most [`MOST_IN_FLIGHT`] bytes are on their way at any time, and [`RESERVE`] bytes of the
//!   machine's buffer stay free, so that what lifts the tool always fits; less where the buffer is small.
//! - However a session ends, unless the port is lost, the last thing that is sent lifts the tool.

mod ask;
mod ebb;
mod grbl;
mod ledger;
mod line;
mod replies;
mod search;
mod stream;
mod usb;

pub use ledger::SLOWNESS;

use super::profile::{Grbl, Handshake, Serial};
use super::{Cutter, Job, Point};
use crate::plotter::dialect::Dialect;
use ask::{Ask, Question};
use ebb::Board;
use grbl::Counter;
use ledger::Ledger;
use line::SerialLine;
use replies::{Replies, Reply};
use search::Search;
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;
use usb::Poll;

/// Most bytes that are handed to the port before they have arrived: what the kernel and adapters
/// still send after the machine said stop.
pub const MOST_IN_FLIGHT: usize = 128;
/// Bytes of the machine's buffer that stay free.
pub const RESERVE: usize = 128;

/// What the owner of the port is to do next.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Step {
    /// Hand these bytes to the port, all of them.
    Send(Vec<u8>),
    /// Nothing for this time, unless the machine says something.
    Wait(Duration),
    /// Close the port.
    Done(Outcome),
}

/// Why a session ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// Everything was sent.
    Finished,
    /// The user stopped it.
    Stopped,
    /// The machine reported this error of the connection (ESC.E).
    Device(u32),
    /// The machine does not answer, though it has to for the handshake.
    NoAnswer,
    /// The machine refuses a line (`error:N` of GRBL).
    Rejected(u16),
    /// The machine refuses a command (`!N` of the EBB).
    Refused(u16),
    /// The firmware of the machine is too old; nothing was sent.
    Firmware {
        /// Its version.
        found: [u32; 3],
        /// The oldest one that will do.
        needed: [u32; 3],
    },
    /// The machine is in alarm (`ALARM:N` of GRBL). The tool was not lifted.
    Alarm(u16),
    /// The machine is locked or busy; nothing was sent.
    Locked,
    /// A setting of the machine is not what its profile needs; nothing was sent.
    Setting {
        /// Its number, as in `$32`.
        number: u16,
        /// What it has to be.
        needed: i32,
    },
    /// The machine restarted by itself.
    Restarted,
    /// The machine is idle at another place than the lines that were sent lead to.
    LinesLost,
    /// The machine did not find the printed marks; nothing was cut.
    MarksNotFound,
    /// The machine did not say whether it found the printed marks; nothing was cut.
    MarksUnanswered,
    /// The port is gone. Where the tool is is not known.
    PortLost,
}

/// How a session ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outcome {
    /// Why.
    pub end: End,
    /// Whether the machine itself said that it did everything, the lifting included. Otherwise
    /// that was only waited for.
    pub is_confirmed: bool,
    /// Strokes that are certainly finished.
    pub strokes_done: usize,
}

/// What a session is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// It finds out what the machine answers.
    Probing,
    /// It sends.
    Sending,
    /// It holds, the tool lifted.
    Paused,
    /// Everything is sent; the machine works on.
    Finishing,
    /// The command to lift the tool was sent; nothing more is sent.
    Stopping,
    /// It is over.
    Ended,
}

/// How far a session is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Status {
    /// What it does.
    pub state: State,
    /// How it keeps from overrunning the machine.
    pub handshake: Handshake,
    /// Strokes that are certainly finished.
    pub strokes_done: usize,
    /// Strokes of the job.
    pub strokes: usize,
    /// Time that the rest of the job takes by the machine's profile, s.
    pub seconds_left: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    Probe,
    Stream,
    /// Everything is sent, for this end.
    Finish(End),
    Ended(Outcome),
}

/// A job on its way to a machine.
#[derive(Debug)]
pub struct Session {
    job: Job,
    dialect: Arc<dyn Dialect>,
    serial: Serial,
    stop: String,
    handshake: Handshake,
    line: SerialLine,
    ledger: Ledger,
    replies: Replies,
    ask: Ask,
    grbl: Option<Grbl>,
    counter: Counter,
    poll: Poll,
    board: Board,
    search: Search,
    phase: Phase,
    /// The next command of the job.
    next: usize,
    /// What goes before it.
    inserted: VecDeque<Vec<u8>>,
    at: Point,
    is_down: bool,
    /// Strokes that are certainly finished when the last command that was sent is acknowledged.
    certain: usize,
    /// Whether a pause set in, and whether the pen was down before it.
    paused: Option<bool>,
    wants_pause: bool,
    stop_wishes: u32,
    is_held: bool,
    has_clear_to_send: Option<bool>,
    /// Whether the user knows what is waited for at the end.
    is_wait_told: bool,
    is_cleared: bool,
    notes: Vec<String>,
}

impl Session {
    /// A session for a job. `has_clear_to_send` is the state of the line CTS, where it is known.
    pub fn new(job: Job, cutter: &Cutter, handshake: Handshake, has_clear_to_send: Option<bool>) -> Self {
        let serial = *cutter.serial();
        Self {
            job,
            dialect: cutter.dialect().clone(),
            serial,
            stop: cutter.stop().to_owned(),
            handshake,
            line: SerialLine::new(serial.byte_s()),
            ledger: Ledger::default(),
            replies: Replies::default(),
            ask: Ask::new(serial.buffer_bytes),
            grbl: cutter.grbl().cloned(),
            counter: Counter::default(),
            poll: Poll::default(),
            board: Board::default(),
            search: Search::default(),
            phase: Phase::Probe,
            next: 0,
            inserted: VecDeque::new(),
            at: Point::default(),
            is_down: false,
            certain: 0,
            paused: None,
            wants_pause: false,
            stop_wishes: 0,
            is_held: false,
            has_clear_to_send,
            is_wait_told: false,
            is_cleared: false,
            notes: Vec::new(),
        }
    }

    /// The machine sent something.
    pub fn received(&mut self, bytes: &[u8]) {
        for reply in self.replies.read(bytes) {
            match reply {
                Reply::Line(line) if self.handshake == Handshake::Count => self.grbl_answered(&line),
                Reply::Line(line) if self.search.is_going_on() => self.search.answered(&line),
                Reply::Line(line) if self.handshake == Handshake::Usb => self.usb_answered(&line),
                Reply::Line(line) if self.handshake == Handshake::Ok => self.ebb_answered(&line),
                Reply::Go | Reply::Stop
                    if matches!(self.handshake, Handshake::Count | Handshake::Ok | Handshake::Usb) => {}
                Reply::Go => self.is_held = false,
                Reply::Stop => self.is_held = true,
                Reply::Line(line) => self.answered(&line),
            }
        }
    }

    /// The user wants to stop. The second time nothing but the lifting of the tool is waited for;
    /// the third time not even that.
    pub fn stop(&mut self) {
        self.stop_wishes += 1;
    }

    /// The user wants the tool lifted until further notice.
    pub fn pause(&mut self) {
        self.wants_pause = true;
    }

    /// The user wants to go on.
    pub fn go_on(&mut self) {
        self.wants_pause = false;
    }

    /// Whether the user wants the tool lifted.
    pub fn is_pausing(&self) -> bool {
        self.wants_pause
    }

    /// The port has another speed than the machine's profile.
    pub fn set_baud(&mut self, baud: u32) {
        self.serial.baud = baud.max(1);
        self.line = SerialLine::new(self.serial.byte_s());
    }

    /// The port is gone.
    pub fn port_lost(&mut self) {
        self.end(End::PortLost, false);
    }

    /// How far it is.
    pub fn status(&self) -> Status {
        let state = match self.phase {
            Phase::Probe => State::Probing,
            Phase::Stream if self.paused.is_some() => State::Paused,
            Phase::Stream => State::Sending,
            Phase::Finish(End::Finished) => State::Finishing,
            Phase::Finish(_) => State::Stopping,
            Phase::Ended(_) => State::Ended,
        };
        Status {
            state,
            handshake: self.handshake,
            strokes_done: self.ledger.strokes_done(),
            strokes: self.job.strokes(),
            seconds_left: (self.job.seconds() - self.ledger.seconds_done()).max(0.0),
        }
    }

    /// What there is to tell the user since the last time.
    pub fn take_notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }

    /// What to do now. `queued` is the number of bytes that the port holds, as far as it says.
    pub fn step(&mut self, now: Duration, queued: usize) -> Step {
        self.line.observe(queued);
        match self.handshake {
            Handshake::Count => return self.grbl_step(now),
            Handshake::Usb => return self.usb_step(now),
            Handshake::Ok => return self.ebb_step(now),
            _ => {}
        }
        match self.phase {
            Phase::Probe => self.probe(now),
            Phase::Stream => self.stream(now),
            Phase::Finish(end) => self.finish(end, now),
            Phase::Ended(outcome) => Step::Done(outcome),
        }
    }

    fn end(&mut self, end: End, is_confirmed: bool) -> Step {
        if !matches!(self.phase, Phase::Ended(_)) {
            if end == End::Finished {
                self.ledger.taken(self.ledger.total());
            }
            let strokes_done = match end {
                End::Finished => self.job.strokes(),
                _ => self.ledger.strokes_done(),
            };
            self.phase = Phase::Ended(Outcome { end, is_confirmed, strokes_done });
        }
        match self.phase {
            Phase::Ended(outcome) => Step::Done(outcome),
            _ => Step::Wait(Duration::ZERO),
        }
    }

    /// Hands bytes over that the machine acts on at receipt.
    fn send_control(&mut self, bytes: &[u8], now: Duration) -> Step {
        let bytes = [self.clearing(), bytes].concat();
        self.line.sent(bytes.len(), now);
        Step::Send(bytes)
    }

    /// What comes first: the machine forgets the part of a command that a lost port left in its buffer, which would
    /// be read as one with what follows.
    fn clearing(&mut self) -> &'static [u8] {
        let is_first = !std::mem::replace(&mut self.is_cleared, true);
        let controls = self.dialect.controls().filter(|_| is_first && self.serial.answers);
        controls.map_or(&[], |controls| controls.discard)
    }

    /// Whether the machine may be asked.
    fn may_ask(&self) -> bool {
        self.serial.answers && self.dialect.controls().is_some()
    }
}
