//! Sending, pausing, finishing and stopping.

use super::search::Search;
use super::{End, Handshake, MOST_IN_FLIGHT, Phase, Question, RESERVE, Session, Step};
use std::time::Duration;

/// The session waits this many times as long as the profile says for a machine that has answered before,
const TOLERANCE: u32 = 3;
/// and this much longer.
const GRACE: Duration = Duration::from_secs(20);
/// For a machine that never answered, it waits this much longer than the profile says.
const LAST_CHANCE: Duration = Duration::from_secs(3);
/// Shorter waits are not reported.
const LONG: Duration = Duration::from_secs(5);
/// After the second request to stop, the port has this time to send the commands that lift the tool.
const HURRY: Duration = Duration::from_secs(10);
/// What a machine on USB may hold is not known, so that more is counted than is likely, bytes.
const USB_BUFFER: usize = 8192;
/// The next look where only time passes.
const TICK: Duration = Duration::from_millis(20);

impl Session {
    pub(super) fn stream(&mut self, now: Duration) -> Step {
        if self.stop_wishes > 0 {
            return self.begin_stop(End::Stopped, now);
        }
        if self.ask.error != 0 {
            return self.begin_stop(End::Device(self.ask.error), now);
        }
        self.ledger_by_flow(now);
        if let Some(step) = self.keep_asking(now).or_else(|| self.await_marks(now)) {
            return step;
        }
        self.follow_pause();
        let bytes = self.commands_that_fit(now);
        if !bytes.is_empty() {
            return Step::Send(bytes);
        }
        if self.is_all_sent() && self.paused.is_none() {
            self.phase = Phase::Finish(End::Finished);
            return Step::Wait(Duration::ZERO);
        }
        let excess = self.line.in_flight(now).saturating_sub(self.most_in_flight() / 2);
        Step::Wait(self.line.time(excess.max(1)).min(TICK))
    }

    /// Whether nothing of the job is left to send.
    pub(super) fn is_all_sent(&self) -> bool {
        self.next == self.job.commands().len() && self.inserted.is_empty()
    }

    /// Counts what the machine has certainly done, where it does not say so itself.
    fn ledger_by_flow(&mut self, now: Duration) {
        match self.handshake {
            Handshake::Paced => self.ledger.taken_by_time(now),
            Handshake::RtsCts | Handshake::XonXoff | Handshake::Usb => {
                let buffer = if self.handshake == Handshake::Usb { USB_BUFFER } else { self.ask.size };
                let held = self.line.in_flight(now) + buffer;
                self.ledger.taken(self.ledger.total().saturating_sub(held as u64));
            }
            Handshake::Auto | Handshake::EscB | Handshake::Count | Handshake::Ok => {}
        }
    }

    /// Lifts the pen for a pause, and sets it down again after it.
    pub(super) fn follow_pause(&mut self) {
        let pen = match (self.wants_pause, self.paused) {
            (true, None) => {
                self.paused = Some(self.is_down);
                if self.is_down { self.dialect.lift(self.at) } else { Vec::new() }
            }
            (false, Some(was_down)) => {
                self.paused = None;
                if was_down { self.lower() } else { Vec::new() }
            }
            _ => Vec::new(),
        };
        self.inserted.extend(self.dialect.split(&pen).into_iter().map(<[u8]>::to_vec));
    }

    /// Sets the pen down: as the language does it, else as the job did it last.
    fn lower(&self) -> Vec<u8> {
        let own = self.dialect.lower(self.at);
        if own.is_empty() { self.job.lowering_before(self.next) } else { own }
    }

    /// Takes as many whole commands as may be sent now.
    pub(super) fn commands_that_fit(&mut self, now: Duration) -> Vec<u8> {
        let mut out = Vec::new();
        loop {
            let is_inserted = !self.inserted.is_empty();
            let length = match (self.inserted.front(), self.job.commands().get(self.next)) {
                (Some(bytes), _) => bytes.len(),
                (None, Some(command)) if self.paused.is_none() => command.bytes().len(),
                _ => break,
            };
            if !self.has_room(length, now) {
                break;
            }
            let arrival = self.line.busy_until().max(now) + self.line.time(length);
            if is_inserted {
                self.ledger.sent(length, self.ledger.strokes_done(), 0.0, arrival);
                out.extend(self.inserted.pop_front().unwrap_or_default());
            } else if let Some(command) = self.job.commands().get(self.next) {
                let before = self.certain;
                if self.handshake != Handshake::Count || self.dialect.waits(command.bytes()) {
                    self.certain = command.strokes_done();
                }
                // A board says OK when the command before begins.
                let certain = if self.handshake == Handshake::Ok { before } else { self.certain };
                self.ledger.sent(length, certain, command.seconds(), arrival);
                self.counter.sent(command.motions().last().map(|motion| motion.to));
                out.extend(command.bytes());
                self.at = command.ends_at();
                self.is_down = command.is_down_after();
                let is_search = self.dialect.is_search(command.bytes());
                self.next += 1;
                if is_search {
                    self.search = Search::Sent;
                    self.line.sent(length, now);
                    break;
                }
            }
            self.line.sent(length, now);
        }
        out
    }

    /// Most bytes that may be on their way: a small buffer has no room for more after it said stop.
    fn most_in_flight(&self) -> usize {
        match self.handshake {
            Handshake::XonXoff => MOST_IN_FLIGHT.min(self.ask.size / 4),
            _ => MOST_IN_FLIGHT,
        }
    }

    /// Bytes of the machine's buffer that stay free.
    pub(super) fn reserve(&self) -> usize {
        RESERVE.min(self.ask.size / 4)
    }

    /// Whether a command may be sent: the line is not too far behind, and the machine has room.
    fn has_room(&self, length: usize, now: Duration) -> bool {
        let in_flight = self.line.in_flight(now);
        let is_line_free = in_flight + length <= self.most_in_flight() || in_flight == 0;
        is_line_free
            && !self.is_held
            && match self.handshake {
                Handshake::EscB => length <= self.credit(),
                Handshake::Paced => self.ledger.held_by_time(now) + length + self.reserve() <= self.ask.size,
                Handshake::Count => self.ledger.unanswered_bytes() + length <= self.ask.size,
                Handshake::Ok => self.ledger.unanswered_bytes() == 0,
                Handshake::Auto | Handshake::RtsCts | Handshake::XonXoff | Handshake::Usb => true,
            }
    }

    /// Lifts the tool: nothing of the job is sent after this. It is sent even where the machine
    /// said stop, since some of its buffer was kept free.
    pub(super) fn begin_stop(&mut self, end: End, now: Duration) -> Step {
        let mut bytes = Vec::new();
        if let Some(controls) = self.dialect.controls().filter(|_| self.serial.answers) {
            bytes.extend(controls.discard);
            // Whether a silent machine discards anything is not known.
            if self.ask.has_answered {
                self.ledger.discard(now);
            }
        }
        bytes.extend(self.dialect.lift(self.at));
        bytes.extend(self.stop.as_bytes());
        self.is_down = false;
        self.search = Search::Over;
        self.ask.open.clear();
        self.ask.stage = 0;
        self.poll.forget();
        self.phase = Phase::Finish(end);
        self.ledger.sent(bytes.len(), self.ledger.strokes_done(), 0.0, now);
        self.send_control(&bytes, now)
    }

    /// Waits until the machine has done everything, as far as that can be known.
    pub(super) fn finish(&mut self, end: End, now: Duration) -> Step {
        if end == End::Finished && self.stop_wishes > 0 {
            return self.begin_stop(End::Stopped, now);
        }
        let is_empty = self.line.in_flight(now) == 0;
        let is_overdue = now >= self.line.busy_until() + HURRY;
        if self.stop_wishes > 2 || self.stop_wishes > 1 && (is_empty || is_overdue) {
            return self.end(end, false);
        }
        self.ledger_by_flow(now);
        if !is_empty {
            return Step::Wait(TICK);
        }
        self.tell_wait(end, now);
        if !self.may_ask() || end == End::NoAnswer {
            // Only time tells. A machine that holds the line is not done.
            let is_done = now >= self.ledger.done_at() && !self.is_held;
            return if is_done { self.end(end, false) } else { Step::Wait(TICK) };
        }
        self.confirm(end, now)
    }

    /// Says what a long wait is for, and when it ends.
    pub(super) fn tell_wait(&mut self, end: End, now: Duration) {
        let left = self.ledger.done_at().saturating_sub(now);
        if std::mem::replace(&mut self.is_wait_told, true) || left < LONG {
            return;
        }
        let sent = if end == End::Finished { "everything is sent" } else { "the lift of the tool is sent" };
        let until = match (self.may_ask(), self.ask.has_answered) {
            (true, true) => "the machine answers that it has finished",
            _ => "the machine should have finished by its profile, because it does not answer",
        };
        self.notes.push(format!("{sent}; waiting about {} s, until {until}", left.as_secs()));
    }

    /// Asks for a position, which is answered when everything before is done, then for errors.
    fn confirm(&mut self, end: End, now: Duration) -> Step {
        let stage = self.ask.stage;
        if stage == 0 {
            self.ask.stage = 1;
            self.ask.has_position = false;
            return self.ask(Question::Position, now);
        }
        if stage == 1 && self.ask.has_position {
            self.ask.stage = 2;
            return self.ask(Question::Error, now);
        }
        if stage == 2 && self.ask.open.is_empty() {
            return self.end(self.with_error(end), true);
        }
        let asked = self.ask.open.back().map_or(now, |&(_, asked, _)| asked);
        let works_on = self.ledger.done_at().saturating_sub(asked);
        let patience = match (stage, self.ask.has_answered) {
            (1, true) => works_on * TOLERANCE + GRACE,
            (1, false) => works_on + LAST_CHANCE,
            _ => GRACE,
        };
        // A machine that holds the line is not done.
        if stage == 1 && self.is_held || !self.ask.is_unanswered(now, patience) {
            return Step::Wait(TICK);
        }
        if stage == 1 {
            let waited = patience.as_secs();
            self.notes.push(format!(
                "the machine did not say within {waited} s that it has finished; look whether it is still moving"
            ));
        }
        self.end(end, stage == 2)
    }

    /// An error that the machine reported at last.
    fn with_error(&self, end: End) -> End {
        match end {
            End::Finished if self.ask.error != 0 => End::Device(self.ask.error),
            other => other,
        }
    }
}
