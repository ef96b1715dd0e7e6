//! A simulated EiBotBoard with two motors and a pen: it works off one command at a time, has a queue of one,
//! and hears nothing while a further one waits for room there.
//!
//! Source: docs/ebb.html of github.com/evil-mad/EggBot.

use super::dialect::{Dialect, Meaning, Pen};
use super::virtual_machine::{ANSWER_DELAY, Record, VirtualMachine};
use super::{Cutter, Motion, Point, VirtualOptions};
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

/// Commands that wait while one is worked on.
const QUEUE: usize = 1;

/// What is worked on.
#[derive(Debug, Clone)]
struct Work {
    start: Duration,
    end: Duration,
    from: Point,
    to: Point,
}

/// A simulated EiBotBoard.
#[derive(Debug, Clone)]
pub struct VirtualEbb {
    options: VirtualOptions,
    dialect: Arc<dyn Dialect>,
    units_per_mm: f64,
    now: Duration,
    buffer: VecDeque<u8>,
    queue: VecDeque<Vec<u8>>,
    work: Option<Work>,
    /// Along its axes, counted from where the motors were switched on.
    at: Point,
    is_down: bool,
    is_powered: bool,
    record: Record,
    said: u32,
    has_failed: bool,
}

impl VirtualEbb {
    /// A board like a cutter's profile, the carriage at home.
    pub fn new(cutter: &Cutter, options: VirtualOptions) -> Self {
        Self {
            options,
            dialect: cutter.dialect().clone(),
            units_per_mm: cutter.frame().units_per_mm().value(),
            now: Duration::ZERO,
            buffer: VecDeque::new(),
            queue: VecDeque::new(),
            work: None,
            at: Point::default(),
            is_down: false,
            is_powered: false,
            record: Record::default(),
            said: 0,
            has_failed: false,
        }
    }

    /// Whether its motors hold the carriage.
    pub fn is_powered(&self) -> bool {
        self.is_powered
    }

    /// The user switches the motors off and pushes the carriage home.
    pub fn push_home(&mut self) {
        (self.at, self.is_powered) = (Point::default(), false);
    }

    fn say(&mut self, text: &str) {
        let faults = self.options.faults;
        self.said += 1;
        let is_nth = |every: u32| every > 0 && self.said.is_multiple_of(every);
        if !self.options.answers || is_nth(faults.silence_every) {
            return;
        }
        let text = if is_nth(faults.garbage_every) { "?\u{7f}9x\r\n" } else { text };
        self.record.say(self.now + ANSWER_DELAY, text.as_bytes().to_vec());
    }

    /// Reads commands until one has to wait for room in the queue.
    fn read(&mut self) {
        while let Some(length) = self.dialect.first(self.buffer.make_contiguous()) {
            let command: Vec<u8> = self.buffer.iter().take(length).copied().collect();
            if !self.take(&command) {
                return;
            }
            self.buffer.drain(..length);
        }
    }

    /// Whether a command could be taken.
    fn take(&mut self, command: &[u8]) -> bool {
        let name = self.dialect.mnemonic(command).to_ascii_uppercase();
        let meaning = self.dialect.meaning(command);
        let is_queued = matches!(meaning, Meaning::Move { .. }) || name == b"EM";
        if is_queued && self.work.is_some() && self.queue.len() >= QUEUE {
            return false;
        }
        if self.options.faults.error_at.is_some_and(|at| self.record.received >= at) && !self.has_failed {
            self.has_failed = true;
            self.say("!3 Err: Need comma next, found: 'x'\r\nOK\r\n");
            return true;
        }
        match name.as_slice() {
            b"V" => self.say("EBBv13_and_above EB Firmware Version 2.7.0\r\n"),
            b"QM" => {
                let (busy, waiting) = (u8::from(self.work.is_some()), u8::from(!self.queue.is_empty()));
                self.say(&format!("QM,{busy},{busy},{busy},{waiting}\n\r"));
            }
            b"QS" => {
                let at = self.place();
                self.say(&format!("{},{}\n\rOK\r\n", at.x() + at.y(), at.x() - at.y()));
            }
            b"ES" => {
                let was_busy = u8::from(self.work.is_some());
                self.queue.clear();
                self.at = self.place();
                if let Some(work) = self.work.take() {
                    self.log(work.from, self.at);
                }
                self.say(&format!("{was_busy}\n\rOK\r\n"));
            }
            _ if is_queued => {
                self.queue.push_back(command.to_vec());
                self.begin();
                self.say("OK\r\n");
            }
            _ if meaning == Meaning::Setup => self.say("OK\r\n"),
            _ => {
                self.record.broken += 1;
                self.say("!8 Err: Unknown command\r\nOK\r\n");
            }
        }
        true
    }

    /// Begins with what waits.
    fn begin(&mut self) {
        while self.work.is_none()
            && let Some(command) = self.queue.pop_front()
        {
            let by_itself_s = self.dialect.seconds(&command);
            let mut to = self.at;
            match self.dialect.meaning(&command) {
                Meaning::Move { pen, to: ends, is_relative } => {
                    match pen {
                        Pen::Up => self.is_down = false,
                        Pen::Down => self.is_down = true,
                        Pen::Keep => {}
                    }
                    if let Some(end) = ends.first() {
                        let is_distance = is_relative == Some(true);
                        to = if is_distance {
                            Point::new(self.at.x() + end.x(), self.at.y() + end.y())
                        } else {
                            *end
                        };
                        self.is_powered = true;
                    }
                }
                _ => {
                    // The motors on or off: where they are is home.
                    self.is_powered = !command.starts_with(b"EM,0");
                    self.at = Point::default();
                    to = self.at;
                }
            }
            // HM runs at the steps a second that it names; 100 mm/s is near enough.
            let seconds = by_itself_s.unwrap_or(self.at.distance(to) / self.units_per_mm / 100.0);
            let end = self.now + Duration::from_secs_f64(seconds * self.options.faults.slowness);
            self.work = Some(Work { start: self.now, end, from: self.at, to });
            if end == self.now {
                self.finish();
            }
        }
    }

    fn finish(&mut self) {
        if let Some(work) = self.work.take() {
            self.log(work.from, work.to);
            self.at = work.to;
        }
    }

    fn log(&mut self, from: Point, to: Point) {
        if from != to {
            self.record.motions.push(Motion { from, to, is_down: self.is_down });
        }
    }

    /// Where it is now, also within a move.
    fn place(&self) -> Point {
        let Some(work) = &self.work else { return self.at };
        let whole = (work.end - work.start).as_secs_f64();
        let share = (self.now.saturating_sub(work.start).as_secs_f64() / whole.max(1e-9)).min(1.0);
        let between = |a: i32, b: i32| a + (f64::from(b - a) * share).round() as i32;
        Point::new(between(work.from.x(), work.to.x()), between(work.from.y(), work.to.y()))
    }
}

impl VirtualMachine for VirtualEbb {
    fn receive(&mut self, byte: u8, now: Duration) {
        self.run_until(now);
        self.record.received += 1;
        if self.buffer.len() < self.options.buffer_bytes {
            self.buffer.push_back(byte);
        } else {
            self.record.lost += 1;
        }
        self.run_until(now);
    }

    fn run_until(&mut self, now: Duration) {
        loop {
            self.read();
            let Some(end) = self.work.as_ref().map(|work| work.end).filter(|&end| end <= now) else { break };
            self.now = self.now.max(end);
            self.finish();
            self.begin();
        }
        self.now = self.now.max(now);
    }

    fn is_idle(&self) -> bool {
        self.work.is_none() && self.queue.is_empty()
    }

    fn is_pen_down(&self) -> bool {
        self.is_down
    }

    fn record(&self) -> &Record {
        &self.record
    }

    fn record_mut(&mut self) -> &mut Record {
        &mut self.record
    }
}
