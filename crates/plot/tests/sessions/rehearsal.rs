//! A host, a line and a simulated machine, in modelled time.

use std::collections::VecDeque;
use std::time::Duration;
use tatamu_plot::plotter::profile::Handshake;
use tatamu_plot::plotter::session::{Outcome, Session, Step};
use tatamu_plot::plotter::{
    Cutter, Job, VirtualEbb, VirtualGrbl, VirtualMachine, VirtualOptions, VirtualPlotter,
};

/// Longest time between two looks at the port, unless a test says otherwise.
const LOOK: Duration = Duration::from_millis(4);
/// Most jobs of these tests take no longer.
pub const TOO_LONG: Duration = Duration::from_secs(3000);

/// A machine with a protocol of its own.
pub trait Simulated: VirtualMachine + Sized {
    /// How it keeps a host from sending too much.
    const HANDSHAKE: Handshake;

    /// One like a cutter's profile.
    fn like(cutter: &Cutter, options: VirtualOptions) -> Self;

    /// What it says when its port is opened.
    fn greeting(&self) -> &'static [u8] {
        b""
    }

    /// Time of a byte on its way; none where a port takes what the machine has room for.
    fn byte_s(cutter: &Cutter) -> f64 {
        cutter.serial().byte_s()
    }

    fn has_room(&self) -> bool {
        true
    }

    /// Whether its tool or its beam is at work.
    fn is_at_work(&self) -> bool {
        self.is_pen_down()
    }

    /// What the user does before a job goes on.
    fn is_made_ready(&mut self) {}
}

impl Simulated for VirtualGrbl {
    const HANDSHAKE: Handshake = Handshake::Count;

    fn like(cutter: &Cutter, options: VirtualOptions) -> Self {
        Self::new(cutter, options)
    }

    fn greeting(&self) -> &'static [u8] {
        b"\r\nGrbl 1.1h ['$' for help]\r\n"
    }

    fn is_at_work(&self) -> bool {
        self.is_beam_on()
    }
}

impl Simulated for VirtualEbb {
    const HANDSHAKE: Handshake = Handshake::Ok;

    fn like(cutter: &Cutter, options: VirtualOptions) -> Self {
        Self::new(cutter, options)
    }

    fn is_made_ready(&mut self) {
        self.push_home();
    }
}

impl Simulated for VirtualPlotter {
    const HANDSHAKE: Handshake = Handshake::Usb;

    fn like(cutter: &Cutter, options: VirtualOptions) -> Self {
        Self::new(cutter, options)
    }

    fn byte_s(_: &Cutter) -> f64 {
        0.0
    }

    fn has_room(&self) -> bool {
        self.free() > 0
    }
}

/// A host, a line and a machine.
pub struct Rehearsal<M> {
    pub session: Session,
    pub machine: M,
    /// After this byte the user asks to stop the job, `stop_wishes` times.
    pub stop_at: Option<u64>,
    pub stop_wishes: u32,
    /// After this byte the port is gone, with what it holds.
    pub unplug_at: Option<u64>,
    /// Whether the machine starts when its port is opened.
    pub greets: bool,
    /// The command with this text does not arrive, once.
    pub swallowed: Option<&'static str>,
    /// Shortest time between two looks at the port.
    pub least_look: Duration,
    /// The job takes no longer.
    pub too_long: Duration,
    /// How late each answer comes.
    pub late: Duration,
    pub now: Duration,
    pub notes: Vec<String>,
    /// When the session ended, and whether anything was at work since.
    pub ended_at: Duration,
    pub worked_after_end: bool,
    port: VecDeque<u8>,
    answers: VecDeque<(Duration, Vec<u8>)>,
    byte: Duration,
    line_free: Duration,
}

impl<M: Simulated> Rehearsal<M> {
    pub fn new(job: &[u8], cutter: &Cutter, options: VirtualOptions) -> Self {
        Self::with(M::like(cutter, options), job, cutter)
    }

    /// With a machine that is there.
    fn with(machine: M, job: &[u8], cutter: &Cutter) -> Self {
        let job = Job::parse(job, cutter).expect("valid");
        Self {
            session: Session::new(job, cutter, M::HANDSHAKE, None),
            machine,
            stop_at: None,
            stop_wishes: 1,
            unplug_at: None,
            greets: true,
            swallowed: None,
            least_look: Duration::from_micros(200),
            too_long: TOO_LONG,
            late: Duration::ZERO,
            now: Duration::ZERO,
            notes: Vec::new(),
            ended_at: Duration::ZERO,
            worked_after_end: false,
            port: VecDeque::new(),
            answers: VecDeque::new(),
            byte: Duration::from_secs_f64(M::byte_s(cutter)),
            line_free: Duration::ZERO,
        }
    }

    /// Another session with the same machine, later; nobody heard what it said meanwhile.
    pub fn again(mut self, job: &[u8], cutter: &Cutter, pause: Duration) -> Self {
        self.now += pause;
        self.machine.run_until(self.now);
        self.machine.take_answers(self.now);
        self.machine.is_made_ready();
        Self { now: self.now, greets: false, ..Self::with(self.machine, job, cutter) }
    }

    /// The host dies; what its port holds still goes out.
    pub fn die(&mut self) {
        self.session.port_lost();
        while !self.port.is_empty() {
            self.pass(LOOK);
        }
    }

    /// To the end of the session, and until the machine has been idle for a while.
    pub fn run(&mut self) -> Outcome {
        if self.greets && self.now.is_zero() {
            self.session.received(self.machine.greeting());
        }
        let outcome = loop {
            if let Some(outcome) = self.advance() {
                break outcome;
            }
            assert!(self.now < self.too_long, "no end: {:?}", self.session.status());
        };
        self.notes.extend(self.session.take_notes());
        self.ended_at = self.now;
        for k in 0..100_000 {
            if k >= 1000 && self.machine.is_idle() && self.port.is_empty() {
                break;
            }
            self.pass(Duration::from_millis(5));
            self.worked_after_end |= self.machine.is_at_work();
        }
        outcome
    }

    /// One step of the session.
    pub fn advance(&mut self) -> Option<Outcome> {
        self.notes.extend(self.session.take_notes());
        match self.session.step(self.now, self.port.len()) {
            Step::Done(outcome) => return Some(outcome),
            Step::Send(bytes) => self.send(bytes),
            Step::Wait(wait) => self.pass(wait.clamp(self.least_look, LOOK.max(self.least_look))),
        }
        None
    }

    fn send(&mut self, mut bytes: Vec<u8>) {
        let place = |text: &str| bytes.windows(text.len()).position(|part| part == text.as_bytes());
        if let Some(at) = self.swallowed.and_then(place) {
            let is_end = |byte: &u8| b"\r\n".contains(byte);
            let length = bytes[at..].iter().position(is_end).map_or(bytes.len() - at, |end| end + 1);
            bytes.drain(at..at + length);
            self.swallowed = None;
        }
        self.port.extend(bytes);
    }

    /// Time passes: bytes go over the line, answers come back.
    pub fn pass(&mut self, wait: Duration) {
        let end = self.now + wait;
        self.machine.run_until(self.now);
        self.line_free = self.line_free.max(self.now);
        while self.line_free + self.byte <= end
            && self.machine.has_room()
            && let Some(byte) = self.port.pop_front()
        {
            self.line_free += self.byte;
            self.machine.receive(byte, self.line_free);
            self.happen(self.machine.received());
        }
        self.machine.run_until(end);
        self.now = end;
        let answers = self.machine.take_answers(end);
        self.answers.push_back((end + self.late, answers));
        while self.answers.front().is_some_and(|(due, _)| *due <= end) {
            self.answers.pop_front().iter().for_each(|(_, bytes)| self.session.received(bytes));
        }
    }

    /// Makes happen what is planned after this number of bytes.
    fn happen(&mut self, received: u64) {
        if self.stop_at == Some(received) {
            (0..self.stop_wishes).for_each(|_| self.session.stop());
        }
        if self.unplug_at == Some(received) {
            self.session.port_lost();
            self.port.clear();
        }
    }
}
