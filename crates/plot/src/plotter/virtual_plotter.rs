//! A simulated plotter: it takes bytes at the speed of the line into a small buffer, works
//! them off in modelled time, answers as plotters do, and remembers what it drew and what it lost.
//!
//! It reads bytes whether or not it asked for silence, as a real one does: a host that sends too
//! much loses data here too.

use super::dialect::{Dialect, Meaning, Pen};
use super::pace::Pace;
use super::virtual_machine::{ANSWER_DELAY, Record, VirtualMachine};
use super::{Cutter, Motion, Point};
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

const ESC: u8 = 0x1B;
const XON: u8 = 17;
const XOFF: u8 = 19;
/// The error that ESC.E reports after an overflow.
const OVERFLOW: u32 = 16;
/// How far the marks may be from where they should be, mm.
const SEARCH_RANGE_MM: f64 = 10.0;
/// CTS falls when fewer bytes are free, and rises again at twice as many.
const CTS_BELOW: usize = 64;

/// What a virtual plotter is like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualOptions {
    /// Size of the buffer, bytes.
    pub buffer_bytes: usize,
    /// Whether it answers questions and knows device control.
    pub answers: bool,
    /// Whether it sends XOFF and XON from the start, at this number of free bytes.
    pub xoff_below: Option<usize>,
    /// Where the corner of printed marks is along its axes, mm; without them it finds none.
    pub marks_mm: Option<[f64; 2]>,
    /// Faults.
    pub faults: Faults,
}

impl Default for VirtualOptions {
    fn default() -> Self {
        Self {
            buffer_bytes: 1024,
            answers: true,
            xoff_below: None,
            marks_mm: None,
            faults: Faults::default(),
        }
    }
}

/// What is wrong with a virtual plotter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Faults {
    /// Factor by which motion takes longer than the profile says.
    pub slowness: f64,
    /// One answer in this many is noise; 0 for none.
    pub garbage_every: u32,
    /// One answer in this many is missing; 0 for none.
    pub silence_every: u32,
    /// Number of bytes after which it reports a framing error.
    pub error_at: Option<u64>,
}

impl Default for Faults {
    fn default() -> Self {
        Self { slowness: 1.0, garbage_every: 0, silence_every: 0, error_at: None }
    }
}

/// A simulated plotter.
#[derive(Debug, Clone)]
pub struct VirtualPlotter {
    options: VirtualOptions,
    dialect: Arc<dyn Dialect>,
    pace: Pace,
    units_per_mm: f64,
    now: Duration,
    busy_until: Duration,
    buffer: VecDeque<u8>,
    control: Vec<u8>,
    record: Record,
    asked: u32,
    xoff_below: Option<usize>,
    has_sent_xoff: bool,
    is_clear_to_send: bool,
    is_down: bool,
    is_relative: bool,
    at: Point,
    /// Where it counts from: the corner of the marks, once it has found them.
    origin: Point,
    error: u32,
}

impl VirtualMachine for VirtualPlotter {
    fn receive(&mut self, byte: u8, now: Duration) {
        self.run_until(now);
        self.record.received += 1;
        if self.options.faults.error_at == Some(self.record.received) {
            self.error = 15;
        }
        let has_state = !self.dialect.state_question().is_empty();
        let knows_control = self.options.answers && (self.dialect.controls().is_some() || has_state);
        if knows_control && (byte == ESC || !self.control.is_empty()) {
            if byte == ESC {
                // The part of a sequence that a lost port left is none.
                self.control.clear();
            }
            self.control.push(byte);
            self.handle_control();
        } else if self.buffer.len() < self.options.buffer_bytes {
            self.buffer.push_back(byte);
        } else {
            self.record.lost += 1;
            self.error = OVERFLOW;
        }
        self.run_until(now);
        self.signal();
    }

    fn run_until(&mut self, now: Duration) {
        while self.busy_until <= now {
            let bytes = self.buffer.make_contiguous();
            let Some(length) = self.dialect.first(bytes).filter(|&n| n > 0) else {
                break;
            };
            let command: Vec<u8> = self.buffer.drain(..length).collect();
            self.busy_until = self.busy_until.max(self.now);
            self.execute(&command);
            self.signal();
        }
        self.now = self.now.max(now);
    }

    fn is_idle(&self) -> bool {
        let bytes: Vec<u8> = self.buffer.iter().copied().collect();
        self.busy_until <= self.now && self.dialect.first(&bytes).is_none_or(|n| n == 0)
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

impl VirtualPlotter {
    /// A plotter like a cutter's profile.
    pub fn new(cutter: &Cutter, options: VirtualOptions) -> Self {
        Self {
            options,
            dialect: cutter.dialect().clone(),
            pace: Pace::new(cutter),
            units_per_mm: cutter.frame().units_per_mm().value(),
            now: Duration::ZERO,
            busy_until: Duration::ZERO,
            buffer: VecDeque::with_capacity(options.buffer_bytes),
            control: Vec::new(),
            record: Record::default(),
            asked: 0,
            xoff_below: options.xoff_below,
            has_sent_xoff: false,
            is_clear_to_send: true,
            is_down: false,
            is_relative: false,
            at: Point::default(),
            origin: Point::default(),
            error: 0,
        }
    }

    /// Whether the line CTS is up.
    pub fn is_clear_to_send(&self) -> bool {
        self.is_clear_to_send
    }

    /// Free bytes of the buffer.
    pub fn free(&self) -> usize {
        self.options.buffer_bytes - self.buffer.len()
    }

    /// Whether it told the host to be silent.
    pub fn holds_host(&self) -> bool {
        self.has_sent_xoff
    }

    /// Forgets what is in the buffer, and lifts the pen.
    pub fn switch_off_and_on(&mut self) {
        self.buffer.clear();
        self.control.clear();
        self.is_down = false;
        self.signal();
    }

    fn answer(&mut self, text: String) {
        self.answer_at(self.now, text);
    }

    fn answer_at(&mut self, at: Duration, text: String) {
        let faults = self.options.faults;
        self.asked += 1;
        let is_nth = |every: u32| every > 0 && self.asked.is_multiple_of(every);
        if !self.options.answers || is_nth(faults.silence_every) {
            return;
        }
        let text = if is_nth(faults.garbage_every) { "?\u{7f}9x".to_owned() } else { text };
        self.record.say(at + ANSWER_DELAY, format!("{text}\r").into_bytes());
    }

    /// Acts on device control when it is complete.
    fn handle_control(&mut self) {
        let Some(length) = self.dialect.first(&self.control).filter(|&n| n == self.control.len()) else {
            return;
        };
        let control = std::mem::take(&mut self.control);
        debug_assert_eq!(length, control.len());
        if control.len() < 3 {
            if control == self.dialect.state_question() {
                let state = if self.is_idle() { "0" } else { "1" };
                self.answer(state.to_owned());
            }
            if control == self.dialect.initialise() {
                self.origin = Point::default();
            }
            return;
        }
        let parameters = String::from_utf8_lossy(&control[3..control.len()]).into_owned();
        let numbers: Vec<usize> =
            parameters.trim_end_matches(':').split(';').map(|n| n.parse().unwrap_or(0)).collect();
        match control[2] {
            b'B' => self.answer(self.free().to_string()),
            b'L' => self.answer(self.options.buffer_bytes.to_string()),
            b'E' => {
                self.answer(self.error.to_string());
                self.error = 0;
            }
            b'K' => {
                self.buffer.clear();
                self.busy_until = self.busy_until.min(self.now);
            }
            b'I' => self.xoff_below = numbers.first().copied().filter(|&n| n > 0),
            _ => {}
        }
    }

    /// XOFF, XON and CTS by the number of free bytes.
    fn signal(&mut self) {
        let free = self.free();
        let low = CTS_BELOW.min(self.options.buffer_bytes / 4);
        self.is_clear_to_send = free >= if self.is_clear_to_send { low } else { 2 * low };
        let Some(below) = self.xoff_below else {
            return;
        };
        let is_low = free < below;
        let is_high = free > (2 * below).min(self.options.buffer_bytes - 1);
        if is_low && !self.has_sent_xoff || is_high && self.has_sent_xoff {
            self.has_sent_xoff = is_low;
            let sign = if is_low { XOFF } else { XON };
            self.record.say(self.now, vec![sign]);
        }
    }

    /// Looks for printed marks, up to twice as far from where the search begins as they should be.
    fn look_for_marks(&mut self, command: &[u8]) {
        let seconds = self.dialect.seconds(command).unwrap_or_default();
        self.spend(seconds);
        let text = String::from_utf8_lossy(command).into_owned();
        let numbers: Vec<f64> =
            text.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).skip(1).collect();
        let found = self.options.marks_mm.map(|at_mm| at_mm.map(|mm| (mm * self.units_per_mm).round()));
        let found = found.filter(|at| {
            let range = 2.0 * SEARCH_RANGE_MM * self.units_per_mm;
            numbers.len() == 4 && (0..2).all(|k| (0.0..=range).contains(&(at[k] - numbers[2 + k])))
        });
        if let Some([x, y]) = found {
            self.origin = Point::new(x as i32, y as i32);
        }
        let text = if found.is_some() { "    0" } else { "    1" };
        self.answer_at(self.busy_until, text.to_owned());
    }

    fn execute(&mut self, command: &[u8]) {
        if self.dialect.is_search(command) {
            return self.look_for_marks(command);
        }
        match self.dialect.meaning(command) {
            Meaning::Move { pen, to, is_relative } => {
                self.is_relative = is_relative.unwrap_or(self.is_relative);
                let was_down = self.is_down;
                self.is_down = match pen {
                    Pen::Up => false,
                    Pen::Down => true,
                    Pen::Keep => was_down,
                };
                if was_down != self.is_down {
                    let seconds = self.pace.pen();
                    self.spend(seconds);
                }
                to.into_iter().for_each(|to| self.go(to));
            }
            Meaning::Query => {
                let name = self.dialect.mnemonic(command).to_ascii_uppercase();
                match name.as_slice() {
                    b"OA" | b"OC" => {
                        let text = format!("{},{},{}", self.at.x(), self.at.y(), u8::from(self.is_down));
                        self.answer(text);
                    }
                    b"OI" => self.answer("virtual".to_owned()),
                    b"OS" => self.answer("16".to_owned()),
                    _ => self.answer("0".to_owned()),
                }
            }
            Meaning::Broken | Meaning::Control => self.record.broken += 1,
            Meaning::Setup => self.pace.apply_setting(command),
        }
    }

    fn go(&mut self, to: Point) {
        let from = self.at;
        self.at = if self.is_relative {
            Point::new(from.x().saturating_add(to.x()), from.y().saturating_add(to.y()))
        } else {
            Point::new(self.origin.x().saturating_add(to.x()), self.origin.y().saturating_add(to.y()))
        };
        let motion = Motion { from, to: self.at, is_down: self.is_down };
        let seconds = self.pace.seconds(&motion);
        self.spend(seconds);
        self.record.motions.push(motion);
    }

    fn spend(&mut self, seconds: f64) {
        self.busy_until += Duration::from_secs_f64(seconds * self.options.faults.slowness);
    }
}
