//! A session with the virtual plotter, on a line of modelled speed and in modelled time.

use std::collections::VecDeque;
use std::time::Duration;
use tatamu::plotter::profile::Handshake;
use tatamu::plotter::session::{End, Outcome, Session, State, Step};
use tatamu::plotter::{Cutter, Job, VirtualMachine, VirtualOptions, VirtualPlotter};

/// Longest time between two looks at the port, unless a test says otherwise.
const LOOK: Duration = Duration::from_millis(4);
/// Free bytes that count as room: the reserve, what may be on its way, and a chunk to send.
const ROOM: usize = 384;
/// Most jobs of these tests take no longer.
const TOO_LONG: Duration = Duration::from_secs(20_000);

/// A host, a line and a plotter.
pub struct Rehearsal {
    pub session: Session,
    pub plotter: VirtualPlotter,
    /// After this byte the user asks to stop the job, `stop_wishes` times.
    pub stop_at: Option<u64>,
    pub stop_wishes: u32,
    /// After this byte the port is gone.
    pub unplug_at: Option<u64>,
    /// How late an answer is that the plotter gives at this time.
    pub lateness: fn(Duration) -> Duration,
    /// Shortest time between two looks at the port.
    pub least_look: Duration,
    /// The job takes no longer.
    pub too_long: Duration,
    /// Most bytes that the port held.
    pub most_queued: usize,
    handshake: Handshake,
    byte: Duration,
    /// Modelled time that has passed.
    pub now: Duration,
    /// What the port holds.
    pub port: VecDeque<u8>,
    /// Answers on their way, and when they arrive.
    answers: VecDeque<(Duration, Vec<u8>)>,
    line_free: Duration,
    /// Time in which the plotter had room: all of it, and that in which the line carried the job.
    room: Duration,
    busy: Duration,
    /// Bytes of a question (ESC . and a letter) that are still to come.
    question: u8,
}

impl Rehearsal {
    pub fn new(job: Job, cutter: &Cutter, handshake: Handshake, options: VirtualOptions) -> Self {
        Self {
            session: Session::new(job, cutter, handshake, Some(handshake == Handshake::RtsCts)),
            plotter: VirtualPlotter::new(cutter, options),
            stop_at: None,
            stop_wishes: 1,
            unplug_at: None,
            lateness: |_| Duration::ZERO,
            least_look: Duration::from_micros(100),
            too_long: TOO_LONG,
            most_queued: 0,
            handshake,
            byte: Duration::from_secs_f64(cutter.serial().byte_s()),
            now: Duration::ZERO,
            port: VecDeque::new(),
            answers: VecDeque::new(),
            line_free: Duration::ZERO,
            room: Duration::ZERO,
            busy: Duration::ZERO,
            question: 0,
        }
    }

    /// Runs to the end of the session, and until the plotter has nothing left to do.
    pub fn run(&mut self) -> Outcome {
        let outcome = self.advance_to_end();
        while !self.port.is_empty() && outcome.end != End::PortLost {
            self.pass(LOOK, false);
        }
        self.now += Duration::from_secs(1000);
        self.plotter.run_until(self.now);
        outcome
    }

    /// Runs to the end of the session.
    pub fn advance_to_end(&mut self) -> Outcome {
        loop {
            if let Some(outcome) = self.advance() {
                return outcome;
            }
            assert!(self.now < self.too_long, "no end: {:?}", self.session.status());
        }
    }

    /// One step of the session.
    pub fn advance(&mut self) -> Option<Outcome> {
        let is_sending = self.session.status().state == State::Sending;
        let wait = match self.session.step(self.now, self.port.len()) {
            Step::Done(outcome) => return Some(outcome),
            Step::Send(bytes) => {
                self.port.extend(bytes);
                self.most_queued = self.most_queued.max(self.port.len());
                Duration::ZERO
            }
            Step::Wait(wait) => wait.clamp(self.least_look, LOOK.max(self.least_look)),
        };
        self.pass(wait, is_sending);
        None
    }

    /// Modelled time that has passed.
    pub fn now(&self) -> Duration {
        self.now
    }

    /// Share of the time in which the line carried the job, of that in which the plotter had room
    /// and there was something to send. Questions do not count.
    pub fn busy_share(&self) -> f64 {
        self.busy.as_secs_f64() / self.room.as_secs_f64()
    }

    /// Time passes: bytes go over the line, answers come back.
    pub fn pass(&mut self, wait: Duration, is_sending: bool) {
        let end = self.now + wait;
        while self.line_free + self.byte <= end {
            let is_held = self.handshake == Handshake::RtsCts && !self.plotter.is_clear_to_send();
            let has_room = self.plotter.free() >= ROOM && !self.plotter.holds_host() && !is_held;
            let counts = has_room && is_sending;
            let Some(byte) = self.port.front().copied().filter(|_| !is_held) else {
                if counts {
                    self.room += end - self.line_free;
                }
                self.line_free = end;
                self.plotter.run_until(end);
                break;
            };
            self.port.pop_front();
            self.line_free += self.byte;
            self.question = if byte == 0x1B { 3 } else { self.question };
            if counts {
                self.room += self.byte;
                self.busy += if self.question == 0 { self.byte } else { Duration::ZERO };
            }
            self.question = self.question.saturating_sub(1);
            self.plotter.receive(byte, self.line_free);
            self.happen(self.plotter.received());
        }
        // A byte of a slow line takes longer than one poll.
        if self.port.is_empty() {
            self.line_free = self.line_free.max(end);
        }
        self.now = end;
        let answers = self.plotter.take_answers(end);
        let last = self.answers.back().map_or(Duration::ZERO, |(due, _)| *due);
        self.answers.push_back((last.max(end + (self.lateness)(end)), answers));
        while let Some((_, answers)) = self.answers.pop_front_if(|(due, _)| *due <= end) {
            self.session.received(&answers);
        }
    }

    /// Makes happen what is planned after this number of bytes.
    fn happen(&mut self, received: u64) {
        if self.stop_at == Some(received) {
            (0..self.stop_wishes).for_each(|_| self.session.stop());
        }
        if self.unplug_at == Some(received) {
            self.session.port_lost();
        }
    }
}
