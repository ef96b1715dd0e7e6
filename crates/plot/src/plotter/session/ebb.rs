//! Sessions with an EiBotBoard. It says `OK` to each command when that is in its queue of one, so that one command is
//! on its way at a time. It forgets nothing that it said `OK` to; what it did not answer is looked for by where its
//! motors are (`QS`) and sent again where it moves nothing.
//!
//! Source: docs/ebb.html of github.com/evil-mad/EggBot: ES (stops at once and empties the queue), QM, QS, V, and the
//! returned errors.

use super::{End, Phase, Session, Step};
use std::collections::VecDeque;
use std::time::Duration;

const VERSION: &[u8] = b"V\r";
const STATE: &[u8] = b"QM\r";
const PLACE: &[u8] = b"QS\r";
const STOP: &[u8] = b"ES\r";

/// HM and ES are as they are needed here since this firmware.
const LEAST_FIRMWARE: [u32; 3] = [2, 6, 2];
/// Time for an answer to a question, and to a command beyond what was sent before it takes.
const PATIENCE: Duration = Duration::from_millis(1000);
const MARGIN: Duration = Duration::from_millis(2000);
/// How often something is tried, and how many questions in a row may be lost.
const MOST_TRIES: u32 = 4;
const MOST_SILENCES: u32 = 5;
/// Time between two questions for the state.
const INTERVAL: Duration = Duration::from_millis(100);
/// The next look where only time passes.
const TICK: Duration = Duration::from_millis(2);

/// What is known of a board.
#[derive(Debug, Clone, Default)]
pub(super) struct Board {
    version: Option<[u32; 3]>,
    /// When the command that is on its way counts as lost.
    open: Option<Duration>,
    /// That command, and whether it moves the motors.
    last: Vec<u8>,
    is_move: bool,
    tries: u32,
    /// `OK`s to questions that come with one.
    extra_oks: u32,
    /// When the open question was asked, and how many were not answered in a row.
    asked: Option<Duration>,
    last_asked: Duration,
    silences: u32,
    /// Whether nothing moves, as it said.
    is_idle: Option<bool>,
    place: Option<[i32; 2]>,
    fault: Option<End>,
    /// What is still to be sent after a stop.
    script: VecDeque<Vec<u8>>,
    is_sure: bool,
}

impl Board {
    /// A command goes out.
    fn sent(&mut self, bytes: &[u8], is_move: bool, due: Duration) {
        if self.last != bytes || self.open.is_none() {
            self.tries = 0;
        }
        self.last = bytes.to_vec();
        self.is_move = is_move;
        self.open = Some(due);
        self.forget();
    }

    /// What it said of itself does not count any more.
    fn forget(&mut self) {
        (self.asked, self.is_idle, self.place, self.silences) = (None, None, None, 0);
    }
}

/// The numbers at the end of `EBBv13_and_above EB Firmware Version 2.7.0`.
fn version(line: &str) -> Option<[u32; 3]> {
    let mut numbers = line.rsplit(' ').next()?.split('.').map(|number| number.parse().ok());
    Some([numbers.next()??, numbers.next()??, numbers.next().flatten().unwrap_or(0)])
}

impl Session {
    pub(super) fn ebb_step(&mut self, now: Duration) -> Step {
        let is_at_work = matches!(self.phase, Phase::Probe | Phase::Stream | Phase::Finish(End::Finished));
        if is_at_work && self.stop_wishes > 0 {
            return self.ebb_halt(End::Stopped, now);
        }
        // The first question may end the part of a command that a lost port left: the board refuses both.
        let is_begun = is_at_work && self.phase != Phase::Probe;
        if let Some(fault) = self.board.fault.filter(|_| is_begun) {
            return self.ebb_halt(fault, now);
        }
        match self.phase {
            Phase::Probe => self.ebb_hello(now),
            Phase::Stream => self.ebb_stream(now),
            Phase::Finish(End::Finished) => self.ebb_rest(now),
            Phase::Finish(end) => self.ebb_halted(end, now),
            Phase::Ended(outcome) => Step::Done(outcome),
        }
    }

    /// A line came.
    pub(super) fn ebb_answered(&mut self, line: &str) {
        let line = line.trim();
        let board = &mut self.board;
        let numbers =
            |text: &str| text.split(',').map(|n| n.trim().parse().ok()).collect::<Option<Vec<i32>>>();
        if line == "OK" {
            if board.extra_oks > 0 {
                board.extra_oks -= 1;
            } else if board.open.take().is_some() {
                board.tries = 0;
                self.ledger.acknowledged();
                board.script.pop_front();
            }
        } else if let Some(rest) = line.strip_prefix('!') {
            let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
            if let Ok(code) = digits.parse() {
                board.fault.get_or_insert(End::Refused(code));
            }
        } else if let Some(state) = line.strip_prefix("QM,").and_then(numbers) {
            if state.len() == 4 && board.asked.take().is_some() {
                board.is_idle = Some(state.iter().all(|&n| n == 0));
                board.silences = 0;
            }
        } else if line.starts_with("EBB") {
            board.version = version(line).or(board.version);
        } else if let Some(&[a, b]) = numbers(line).as_deref()
            && board.asked.take().is_some()
        {
            board.place = Some([a, b]);
            board.silences = 0;
        }
    }

    /// Finds out that a board is there, and that it knows what is sent to it.
    fn ebb_hello(&mut self, now: Duration) -> Step {
        if let Some(version) = self.board.version {
            if version < LEAST_FIRMWARE {
                return self.end(End::Firmware { found: version, needed: LEAST_FIRMWARE }, false);
            }
            let [a, b, c] = version;
            self.notes
                .push(format!("EiBotBoard with firmware {a}.{b}.{c}; handshake: ok (OK to each command)"));
            self.board = Board { version: self.board.version, ..Board::default() };
            self.phase = Phase::Stream;
            return Step::Wait(Duration::ZERO);
        }
        if self.board.asked.is_some_and(|asked| now < asked + PATIENCE) {
            return Step::Wait(TICK);
        }
        if self.board.tries >= MOST_TRIES {
            return self.end(End::NoAnswer, false);
        }
        self.board.tries += 1;
        self.board.asked = Some(now);
        self.send_control(VERSION, now)
    }

    fn ebb_stream(&mut self, now: Duration) -> Step {
        if self.board.open.is_some() {
            return self.ebb_await(now);
        }
        self.follow_pause();
        let is_move = self.inserted.is_empty() && self.moves_next();
        let bytes = self.commands_that_fit(now);
        if !bytes.is_empty() {
            let due = self.ledger.done_at().max(now) + MARGIN;
            self.board.sent(&bytes, is_move, due);
            return Step::Send(bytes);
        }
        if self.is_all_sent() && self.paused.is_none() {
            self.phase = Phase::Finish(End::Finished);
            self.board.forget();
        }
        Step::Wait(TICK)
    }

    /// Whether the next command of the job moves the motors.
    fn moves_next(&self) -> bool {
        let next = self.job.commands().get(self.next);
        next.is_some_and(|command| command.motions().iter().any(|motion| motion.from != motion.to))
    }

    /// Waits for an `OK`. Where it does not come, the place of the motors says whether a move arrived; what moves
    /// nothing does no harm twice.
    fn ebb_await(&mut self, now: Duration) -> Step {
        if self.board.open.is_some_and(|due| now < due) {
            return Step::Wait(TICK);
        }
        if self.board.silences >= MOST_SILENCES || self.board.tries >= MOST_TRIES {
            return self.ebb_halt(End::NoAnswer, now);
        }
        if self.board.is_idle != Some(true) {
            return self.ebb_ask(STATE, now);
        }
        let Some([a, b]) = self.board.place else {
            return self.ebb_ask(PLACE, now);
        };
        let is_in_place = [self.at.x() + self.at.y(), self.at.x() - self.at.y()] == [a, b];
        if !is_in_place {
            return self.ebb_halt(End::LinesLost, now);
        }
        if self.board.is_move {
            self.notes.push("an answer of the machine was lost; it is where the job has it".to_owned());
            self.board.open = None;
            self.ledger.acknowledged();
            return Step::Wait(Duration::ZERO);
        }
        self.board.tries += 1;
        self.board.open = Some(now + MARGIN);
        // The place holds: nothing moves.
        self.board.is_idle = None;
        let again = self.board.last.clone();
        self.send_control(&again, now)
    }

    /// Asks a question if it is time for that.
    fn ebb_ask(&mut self, question: &[u8], now: Duration) -> Step {
        if let Some(asked) = self.board.asked {
            if now < asked + PATIENCE {
                return Step::Wait(TICK);
            }
            self.board.silences += 1;
            self.board.asked = None;
        }
        if now < self.board.last_asked + INTERVAL {
            return Step::Wait(TICK);
        }
        (self.board.asked, self.board.last_asked) = (Some(now), now);
        self.board.extra_oks = u32::from(question == PLACE);
        self.send_control(question, now)
    }

    /// All is sent and accepted: the machine is done when nothing moves.
    fn ebb_rest(&mut self, now: Duration) -> Step {
        if self.board.is_idle == Some(true) {
            return self.end(End::Finished, true);
        }
        if self.board.silences >= MOST_SILENCES && now >= self.ledger.done_at() {
            return self.end(End::Finished, false);
        }
        self.ebb_ask(STATE, now)
    }

    /// Stops the motors at once, lifts the pen, goes home, and switches the motors off.
    fn ebb_halt(&mut self, end: End, now: Duration) -> Step {
        if matches!(self.phase, Phase::Probe) {
            return self.end(end, true);
        }
        self.phase = Phase::Finish(end);
        self.inserted.clear();
        let tail = [self.dialect.lift(self.at), self.stop.as_bytes().to_vec()].concat();
        let tail = self.dialect.split(&tail).into_iter().map(<[u8]>::to_vec);
        let script = std::iter::once(STOP.to_vec()).chain(tail).collect();
        self.board = Board { version: self.board.version, script, is_sure: true, ..Board::default() };
        self.ebb_halted(end, now)
    }

    /// Sends what belongs to a stop, each until it is answered, a few times at most.
    fn ebb_halted(&mut self, end: End, now: Duration) -> Step {
        if self.stop_wishes > 2 {
            return self.end(end, false);
        }
        if self.board.open.is_some_and(|due| now < due) {
            return Step::Wait(TICK);
        }
        if self.board.open.take().is_some() {
            self.board.tries += 1;
            if self.board.tries >= MOST_TRIES {
                self.board.tries = 0;
                self.board.is_sure = false;
                self.board.script.pop_front();
            }
        }
        if let Some(command) = self.board.script.front().cloned() {
            self.board.forget();
            self.board.open = Some(now + PATIENCE);
            return self.send_control(&command, now);
        }
        if self.board.is_idle == Some(true) || self.board.silences >= MOST_SILENCES {
            let is_confirmed = self.board.is_idle == Some(true) && self.board.is_sure;
            return self.end(end, is_confirmed);
        }
        self.ebb_ask(STATE, now)
    }
}
