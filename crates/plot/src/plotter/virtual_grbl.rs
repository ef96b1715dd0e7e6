//! A simulated machine with GRBL 1.1: a small buffer, a planner of a few moves, characters that take effect at
//! receipt, and states.
//!
//! Source: GRBL 1.1 (github.com/gnea/grbl): `serial.c` (what takes effect at receipt), `mc_reset`,
//! `protocol_main_loop`, `spindle_sync`, `report_realtime_status`.

use super::dialect::{Dialect, Meaning, Pen};
use super::virtual_machine::{ANSWER_DELAY, Record, VirtualMachine};
use super::{Cutter, Motion, Point, VirtualOptions};
use crate::plotter::dialect::UNITS_PER_MM;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

/// Moves that are planned ahead (`BLOCK_BUFFER_SIZE` less one).
const PLANNER: usize = 15;
/// Time to come to rest in a hold.
const BRAKING: Duration = Duration::from_millis(60);
/// Machine coordinates of the work zero, mm.
const WORK_OFFSET_MM: [f64; 3] = [12.5, -7.25, 3.0];
/// One report in this many contains the work zero.
const OFFSET_EVERY: u32 = 10;

/// A move that is planned.
#[derive(Debug, Clone)]
struct Block {
    to: [f64; 3],
    mm_s: f64,
    /// Whether it is a cut (G1).
    is_cut: bool,
    pen: Option<bool>,
}

/// A move that is made.
#[derive(Debug, Clone)]
struct Moving {
    block: Block,
    from: [f64; 3],
    start: Duration,
    end: Duration,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Hold {
    Braking(Duration),
    Held,
}

/// A simulated machine with GRBL.
#[derive(Debug, Clone)]
pub struct VirtualGrbl {
    options: VirtualOptions,
    dialect: Arc<dyn Dialect>,
    is_laser: bool,
    travel_mm_s: f64,
    settings: BTreeMap<u16, f64>,
    now: Duration,
    buffer: VecDeque<u8>,
    line: Option<String>,
    planner: VecDeque<Block>,
    moving: Option<Moving>,
    hold: Option<Hold>,
    dwell: Option<Duration>,
    has_alarm: bool,
    at: [f64; 3],
    planned: [f64; 3],
    is_relative: bool,
    feed_mm_s: f64,
    spindle: u8,
    power: f64,
    is_down: bool,
    record: Record,
    said: u32,
    reports: u32,
    has_failed: bool,
}

impl VirtualGrbl {
    /// A machine like a cutter's profile, with the settings that it needs, at its work zero.
    pub fn new(cutter: &Cutter, options: VirtualOptions) -> Self {
        let needed = cutter.grbl().map_or(&[][..], |grbl| grbl.settings());
        Self {
            options,
            dialect: cutter.dialect().clone(),
            is_laser: cutter.power().is_some(),
            travel_mm_s: cutter.travel_mm_s(),
            settings: needed.iter().map(|&(number, value)| (number, f64::from(value))).collect(),
            now: Duration::ZERO,
            buffer: VecDeque::with_capacity(options.buffer_bytes),
            line: None,
            planner: VecDeque::new(),
            moving: None,
            hold: None,
            dwell: None,
            has_alarm: false,
            at: [0.0; 3],
            planned: [0.0; 3],
            is_relative: false,
            feed_mm_s: 0.0,
            spindle: 5,
            power: 0.0,
            is_down: false,
            record: Record::default(),
            said: 0,
            reports: 0,
            has_failed: false,
        }
    }

    /// Changes a setting, as `$32=0` does.
    pub fn set(&mut self, number: u16, value: f64) {
        self.settings.insert(number, value);
    }

    /// Locks the machine, as a limit switch does.
    pub fn alarm(&mut self, code: u16) {
        self.stop_motion();
        self.planner.clear();
        self.has_alarm = true;
        self.say(format!("ALARM:{code}"));
    }

    /// Whether its laser burns at this moment: not in a move without a cut, and with M4 not at rest.
    pub fn is_beam_on(&self) -> bool {
        let is_on = self.is_laser && self.spindle != 5 && self.power > 0.0;
        if self.settings.get(&32) != Some(&1.0) {
            return is_on;
        }
        let is_cut = self.moving.as_ref().is_some_and(|moving| moving.block.is_cut);
        is_on && if self.hold == Some(Hold::Held) { false } else { self.spindle == 3 || is_cut }
    }

    /// Whether it is in alarm.
    pub fn has_alarm(&self) -> bool {
        self.has_alarm
    }

    fn say(&mut self, text: String) {
        let faults = self.options.faults;
        self.said += 1;
        let is_nth = |every: u32| every > 0 && self.said.is_multiple_of(every);
        if !self.options.answers || is_nth(faults.silence_every) {
            return;
        }
        let text = if is_nth(faults.garbage_every) { "?\u{7f}9x".to_owned() } else { text };
        self.record.say(self.now + ANSWER_DELAY, format!("{text}\r\n").into_bytes());
    }

    /// Where it is now, also within a move.
    fn place(&self) -> [f64; 3] {
        let Some(moving) = &self.moving else { return self.at };
        let whole = (moving.end - moving.start).as_secs_f64();
        let share = (self.now.saturating_sub(moving.start)).as_secs_f64() / whole.max(1e-9);
        std::array::from_fn(|k| {
            let (from, to) = (moving.from[k], moving.block.to[k]);
            from + (to - from) * share.min(1.0)
        })
    }

    /// Ends the move where it is; what is left of it.
    fn stop_motion(&mut self) -> Option<Block> {
        let place = self.place();
        let moving = self.moving.take()?;
        self.log(moving.from, place);
        self.at = place;
        Some(moving.block)
    }

    fn log(&mut self, from: [f64; 3], to: [f64; 3]) {
        let point = |p: [f64; 3]| {
            let units = |mm: f64| (mm * f64::from(UNITS_PER_MM)).round() as i32;
            Point::new(units(p[0]), units(p[1]))
        };
        let (from, to) = (point(from), point(to));
        if from != to {
            self.record.motions.push(Motion { from, to, is_down: self.is_down });
        }
    }

    fn reset(&mut self) {
        let is_moving = self.moving.is_some() && self.hold != Some(Hold::Held);
        // The spindle is stopped before anything else.
        (self.spindle, self.power) = (5, 0.0);
        self.stop_motion();
        if self.is_laser {
            self.is_down = false;
        }
        self.planner.clear();
        self.buffer.clear();
        self.line = None;
        self.dwell = None;
        self.hold = None;
        self.planned = self.at;
        self.is_relative = false;
        self.feed_mm_s = 0.0;
        if is_moving {
            self.has_alarm = true;
            self.say("ALARM:3".to_owned());
        }
        self.say(String::new());
        self.say("Grbl 1.1h ['$' for help]".to_owned());
        if self.has_alarm {
            self.say("[MSG:'$H'|'$X' to unlock]".to_owned());
        }
    }

    fn report(&mut self) {
        let state = match (self.has_alarm, self.hold, &self.moving) {
            (true, ..) => "Alarm",
            (_, Some(Hold::Held), _) => "Hold:0",
            (_, Some(Hold::Braking(_)), _) => "Hold:1",
            (_, _, Some(_)) => "Run",
            _ => "Idle",
        };
        let place = self.place();
        let [x, y, z]: [f64; 3] = std::array::from_fn(|k| place[k] + WORK_OFFSET_MM[k]);
        let [a, b, c] = WORK_OFFSET_MM;
        let offset = match self.reports.is_multiple_of(OFFSET_EVERY) {
            true => format!("|WCO:{a:.3},{b:.3},{c:.3}"),
            false => String::new(),
        };
        self.reports += 1;
        self.say(format!("<{state}|MPos:{x:.3},{y:.3},{z:.3}|FS:0,{:.0}{offset}>", self.power));
    }

    /// The next line of the buffer, or the one that waits.
    fn next_line(&mut self) -> Option<String> {
        if let Some(line) = self.line.take() {
            return Some(line);
        }
        let end = self.buffer.iter().position(|&b| b == b'\n')?;
        let bytes: Vec<u8> = self.buffer.drain(..=end).collect();
        Some(String::from_utf8_lossy(&bytes).split_whitespace().collect::<String>().to_uppercase())
    }

    /// Works on lines until one has to wait.
    fn read_lines(&mut self) {
        while self.dwell.is_none() && self.hold.is_none() {
            let Some(line) = self.next_line() else { return };
            if !self.execute(&line) {
                self.line = Some(line);
                return;
            }
        }
    }

    /// Whether a line could be worked on.
    fn execute(&mut self, line: &str) -> bool {
        let is_idle = self.moving.is_none() && self.planner.is_empty();
        if line.starts_with('$') {
            let answer = self.system(line, is_idle);
            self.say(answer);
            return true;
        }
        if self.has_alarm {
            self.say("error:9".to_owned());
            return true;
        }
        if self.options.faults.error_at.is_some_and(|at| self.record.received >= at) && !self.has_failed {
            self.has_failed = true;
            self.say("error:2".to_owned());
            return true;
        }
        let Some(words) = words(line) else {
            self.record.broken += 1;
            self.say("error:1".to_owned());
            return true;
        };
        let value = |letter: char| words.iter().find(|word| word.0 == letter).map(|word| word.1);
        let has = |letter: char, number: f64| words.contains(&(letter, number));
        let spindle = [3u8, 4, 5].into_iter().find(|&code| has('M', f64::from(code)));
        let power = value('S').unwrap_or(self.power);
        let changes_spindle = spindle.is_some_and(|code| code != self.spindle)
            || power != self.power && self.spindle != 5 && !self.is_laser;
        let moves = ['X', 'Y', 'Z'].into_iter().any(|axis| value(axis).is_some());
        if (changes_spindle || has('G', 4.0)) && !is_idle || moves && self.planner.len() >= PLANNER {
            return false;
        }
        self.power = power;
        self.spindle = spindle.unwrap_or(self.spindle);
        self.feed_mm_s = value('F').map_or(self.feed_mm_s, |f| f / 60.0);
        self.is_relative = (self.is_relative || has('G', 91.0)) && !has('G', 90.0);
        let pen = match self.dialect.meaning(line.as_bytes()) {
            Meaning::Move { pen: Pen::Up, .. } => Some(false),
            Meaning::Move { pen: Pen::Down, .. } => Some(true),
            _ => None,
        };
        if moves {
            let is_cut = has('G', 1.0);
            if is_cut && self.feed_mm_s == 0.0 {
                self.say("error:22".to_owned());
                return true;
            }
            let to = std::array::from_fn(|k| match value(['X', 'Y', 'Z'][k]) {
                Some(by) if self.is_relative => self.planned[k] + by,
                Some(to) => to,
                None => self.planned[k],
            });
            let mm_s = if is_cut { self.feed_mm_s } else { self.travel_mm_s };
            self.planned = to;
            self.planner.push_back(Block { to, mm_s, is_cut, pen });
        } else if let Some(is_down) = pen {
            self.is_down = is_down;
        }
        match value('P').filter(|_| has('G', 4.0)) {
            Some(seconds) => self.dwell = Some(self.now + Duration::from_secs_f64(seconds)),
            None => self.say("ok".to_owned()),
        }
        true
    }

    /// A line that is no G-code.
    fn system(&mut self, line: &str, is_idle: bool) -> String {
        let set =
            line[1..].split_once('=').and_then(|(n, value)| Some((n.parse().ok()?, value.parse().ok()?)));
        match line {
            "$X" | "$H" => self.has_alarm = false,
            _ if !is_idle => return "error:8".to_owned(),
            "$$" => {
                let settings: Vec<String> =
                    self.settings.iter().map(|(n, value)| format!("${n}={value}")).collect();
                settings.into_iter().for_each(|line| self.say(line));
            }
            _ => match set {
                Some((number, value)) => self.set(number, value),
                None => return "error:3".to_owned(),
            },
        }
        "ok".to_owned()
    }

    fn begin_block(&mut self) {
        if self.moving.is_some() || self.hold.is_some() || self.dwell.is_some() {
            return;
        }
        let Some(block) = self.planner.pop_front() else { return };
        let length = (0..3).map(|k| (block.to[k] - self.at[k]).powi(2)).sum::<f64>().sqrt();
        let seconds = length / block.mm_s * self.options.faults.slowness;
        let end = self.now + Duration::from_secs_f64(seconds);
        self.moving = Some(Moving { block, from: self.at, start: self.now, end });
    }

    /// What happens next.
    fn next_event(&self) -> Option<Duration> {
        let end = self.moving.as_ref().filter(|_| self.hold != Some(Hold::Held)).map(|moving| moving.end);
        let brake = match self.hold {
            Some(Hold::Braking(until)) => Some(until),
            _ => None,
        };
        [end, brake, self.dwell].into_iter().flatten().min()
    }

    fn happen(&mut self) {
        if self.dwell.is_some_and(|until| until <= self.now) {
            self.dwell = None;
            self.say("ok".to_owned());
        }
        if self.moving.as_ref().is_some_and(|moving| moving.end <= self.now)
            && let Some(moving) = self.moving.take()
        {
            self.log(moving.from, moving.block.to);
            self.at = moving.block.to;
            self.is_down = moving.block.pen.unwrap_or(self.is_down);
        }
        if let Some(Hold::Braking(until)) = self.hold
            && until <= self.now
        {
            self.hold = Some(Hold::Held);
            if let Some(rest) = self.stop_motion() {
                self.planner.push_front(rest);
            }
        }
    }
}

impl VirtualMachine for VirtualGrbl {
    fn receive(&mut self, byte: u8, now: Duration) {
        self.run_until(now);
        self.record.received += 1;
        match byte {
            0x18 => self.reset(),
            b'?' => self.report(),
            b'!' if self.hold.is_none() => {
                let brakes = self.moving.is_some();
                self.hold = Some(if brakes { Hold::Braking(self.now + BRAKING) } else { Hold::Held });
            }
            b'!' => {}
            b'~' => self.hold = self.hold.filter(|&hold| hold != Hold::Held),
            0x80.. => {}
            _ if self.buffer.len() < self.options.buffer_bytes => self.buffer.push_back(byte),
            _ => self.record.lost += 1,
        }
        self.run_until(now);
    }

    fn run_until(&mut self, now: Duration) {
        loop {
            self.read_lines();
            self.begin_block();
            // Moves make room for lines.
            self.read_lines();
            match self.next_event().filter(|&event| event <= now) {
                Some(event) => self.now = self.now.max(event),
                None => break,
            }
            self.happen();
        }
        self.now = self.now.max(now);
    }

    fn is_idle(&self) -> bool {
        self.moving.is_none() && self.planner.is_empty() && self.dwell.is_none() && self.line.is_none()
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

/// Letters with numbers.
fn words(line: &str) -> Option<Vec<(char, f64)>> {
    let starts: Vec<usize> =
        line.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()).map(|(k, _)| k).collect();
    if !line.is_empty() && starts.first() != Some(&0) {
        return None;
    }
    let ends = starts.iter().skip(1).copied().chain([line.len()]);
    let word = |(start, end): (&usize, usize)| {
        Some((line[*start..].chars().next()?, line[start + 1..end].parse().ok()?))
    };
    starts.iter().zip(ends).map(word).collect()
}
