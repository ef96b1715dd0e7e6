//! Sessions with GRBL. It says `ok` or `error:N` to each line, so that what it has not answered yet is what its
//! buffer may hold. It reacts to some single characters at receipt, whatever is buffered: `?` asks for its state, `!`
//! holds, `~` goes on, and Ctrl-X resets: that switches the beam or the spindle off before anything else.
//!
//! Source: GRBL 1.1, doc/markdown/interface.md, and the functions that are named below (github.com/gnea/grbl).

use super::{End, Phase, Session, Step};
use crate::plotter::Point;
use crate::plotter::dialect::UNITS_PER_MM;
use std::time::Duration;

const ASK: &[u8] = b"?";
const HOLD: &[u8] = b"!";
const GO_ON: &[u8] = b"~";
const RESET: &[u8] = &[0x18];

/// A board that restarts when its port is opened says so within this time.
const GREETING: Duration = Duration::from_millis(1500);
/// Time for an answer to a reset, and how often it is tried.
const AFTER_RESET: Duration = Duration::from_millis(2000);
const MOST_RESETS: u32 = 3;
/// How often the command to lift the tool is sent; once more does no harm.
const MOST_LIFTS: u32 = 4;
/// Time to come to rest in a hold.
const TO_REST: Duration = Duration::from_millis(1500);
/// Time to home, and to lift the tool after a stop.
const TO_HOME: Duration = Duration::from_secs(180);
const TO_LIFT: Duration = Duration::from_secs(15);
/// Time between two questions for the state: in a job, and when it matters.
const INTERVAL: Duration = Duration::from_millis(250);
const SHORT_INTERVAL: Duration = Duration::from_millis(50);
/// Time for the answer to a question, which the board gives at once, and the number of answers in a row that may be lost.
const PATIENCE: Duration = Duration::from_millis(1000);
const MOST_SILENCES: u32 = 5;
/// A machine that says this many times in a row that it is idle has nothing left in its buffer: an answer was lost.
const SURE_IDLE: u32 = 3;
/// How far it may then be from where the job has it, mm: steps, and the places of the report.
const SAME_PLACE_MM: f64 = 0.05;
/// The next look where only time passes.
const TICK: Duration = Duration::from_millis(5);

/// What is done at the beginning and at the end of a session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Stage {
    /// The board may restart by itself.
    #[default]
    Wake,
    /// It was reset this many times.
    Reset(u32),
    /// Is it idle?
    Look,
    Home,
    Settings,
    /// Coming to rest before a reset.
    Hold,
    /// The command to lift the tool was sent this often.
    Lift(u32),
    /// Is it done with that?
    Rest,
}

/// The state that a report names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    Idle,
    Alarm,
    /// Held and at rest.
    Held,
    /// Anything else.
    Other,
}

/// What is known of a machine with GRBL.
#[derive(Debug, Clone, Default)]
pub(super) struct Counter {
    stage: Stage,
    since: Duration,
    /// When the open question for the state was asked.
    asked: Option<Duration>,
    last_asked: Duration,
    silences: u32,
    state: Option<State>,
    /// Reports in a row that it is idle, with nothing sent or answered between.
    idles: u32,
    work_offset_mm: Option<[f64; 2]>,
    place_mm: Option<[f64; 2]>,
    has_greeted: bool,
    had_alarm: bool,
    fault: Option<End>,
    settings: Vec<(u16, f64)>,
    /// Lines beside the job that are not answered yet, and whether one was refused.
    open_lines: u32,
    was_refused: bool,
    is_holding: bool,
    /// Whether the user knows of a hold that is not ours.
    is_hold_told: bool,
    /// Where the lines that were sent end.
    ends_at: Option<Point>,
}

impl Counter {
    fn enter(&mut self, stage: Stage, now: Duration) {
        self.stage = stage;
        self.since = now;
        self.state = None;
        self.asked = None;
        self.idles = 0;
    }

    /// Lines of the job go out.
    pub(super) fn sent(&mut self, ends_at: Option<Point>) {
        self.idles = 0;
        self.ends_at = ends_at.or(self.ends_at);
    }

    /// A report: `<Idle|WPos:0.000,0.000,0.000|…>`, in work coordinates or with their offset every now and then.
    fn report(&mut self, line: &str) {
        let mut fields = line.trim_matches(['<', '>']).split('|');
        let state = match fields.next().unwrap_or_default() {
            "Idle" => State::Idle,
            "Alarm" => State::Alarm,
            "Hold:0" => State::Held,
            "Run" | "Hold" | "Hold:1" | "Jog" | "Check" | "Home" | "Sleep" | "Tool" => State::Other,
            other if other.starts_with("Door") => State::Held,
            // Noise.
            _ => return,
        };
        self.state = Some(state);
        self.asked = None;
        self.silences = 0;
        self.idles = if state == State::Idle { self.idles + 1 } else { 0 };
        self.place_mm = None;
        let mut machine_mm = None;
        for field in fields {
            match field.split_once(':') {
                Some(("WPos", text)) => self.place_mm = place(text),
                Some(("MPos", text)) => machine_mm = place(text),
                Some(("WCO", text)) => self.work_offset_mm = place(text).or(self.work_offset_mm),
                _ => {}
            }
        }
        if let (Some([x, y]), Some([dx, dy])) = (machine_mm, self.work_offset_mm) {
            self.place_mm = Some([x - dx, y - dy]);
        }
    }

    /// Whether it is where the lines that were sent end, as far as it says.
    fn is_in_place(&self) -> bool {
        let (Some(at), Some([x, y])) = (self.ends_at, self.place_mm) else {
            return true;
        };
        let mm = |units: i32| f64::from(units) / f64::from(UNITS_PER_MM);
        (x - mm(at.x())).abs().max((y - mm(at.y())).abs()) <= SAME_PLACE_MM
    }
}

fn place(text: &str) -> Option<[f64; 2]> {
    let mut numbers = text.split(',').map(|number| number.parse().ok());
    Some([numbers.next()??, numbers.next()??])
}

impl Session {
    pub(super) fn grbl_step(&mut self, now: Duration) -> Step {
        let is_over = matches!(self.phase, Phase::Probe | Phase::Stream | Phase::Finish(End::Finished));
        if is_over && self.stop_wishes > 0 {
            return self.halt(End::Stopped, now);
        }
        if let Some(fault) = self.counter.fault.filter(|_| is_over) {
            return self.halt(fault, now);
        }
        match self.phase {
            Phase::Probe => self.wake(now),
            Phase::Stream => self.count(now),
            Phase::Finish(End::Finished) => self.come_to_rest(now),
            Phase::Finish(end) => self.halted(end, now),
            Phase::Ended(outcome) => Step::Done(outcome),
        }
    }

    /// A line came.
    pub(super) fn grbl_answered(&mut self, line: &str) {
        let line = line.trim();
        let is_job = matches!(self.phase, Phase::Stream | Phase::Finish(End::Finished));
        let code = |prefix: &str| line.strip_prefix(prefix).and_then(|code| code.trim().parse::<u16>().ok());
        let counter = &mut self.counter;
        if line == "ok" || code("error:").is_some() {
            counter.idles = 0;
            if counter.open_lines > 0 {
                counter.open_lines -= 1;
                counter.was_refused |= line != "ok";
            } else if is_job {
                self.ledger.acknowledged();
            }
        }
        let is_stopping = matches!(self.phase, Phase::Finish(end) if end != End::Finished);
        if let Some(code) = code("error:").filter(|_| !is_stopping) {
            counter.fault.get_or_insert(End::Rejected(code));
        }
        if let Some(code) = code("ALARM:") {
            counter.had_alarm = true;
            if !is_stopping {
                counter.fault.get_or_insert(End::Alarm(code));
            }
        }
        if line.get(..4).is_some_and(|name| name.eq_ignore_ascii_case("grbl")) {
            counter.has_greeted = true;
            if is_job {
                counter.fault.get_or_insert(End::Restarted);
            }
        }
        if line.starts_with('<') {
            counter.report(line);
        }
        if let Some((number, value)) = line.strip_prefix('$').and_then(|setting| setting.split_once('=')) {
            let value = value.split_whitespace().next().and_then(|value| value.parse().ok());
            counter.settings.extend(number.parse().ok().zip(value));
        }
    }

    /// Finds out that the machine is there, idle, and set up as its profile needs it.
    fn wake(&mut self, now: Duration) -> Step {
        let waited = now.saturating_sub(self.counter.since);
        match self.counter.stage {
            Stage::Wake | Stage::Reset(_) if self.counter.has_greeted => {
                self.counter.enter(Stage::Look, now);
                Step::Wait(Duration::ZERO)
            }
            Stage::Wake if waited < GREETING => Step::Wait(TICK),
            Stage::Reset(_) if waited < AFTER_RESET => Step::Wait(TICK),
            Stage::Wake => self.reset(1, now),
            Stage::Reset(tries) if tries < MOST_RESETS => self.reset(tries + 1, now),
            Stage::Look => match self.counter.state {
                None => self.look(SHORT_INTERVAL, now).unwrap_or(Step::Wait(TICK)),
                Some(State::Idle | State::Alarm) if self.homes() => {
                    self.counter.enter(Stage::Home, now);
                    self.notes.push("the machine homes".to_owned());
                    self.line_beside(b"$H\n", now)
                }
                Some(State::Idle) => {
                    self.counter.enter(Stage::Settings, now);
                    self.line_beside(b"$$\n", now)
                }
                Some(_) => self.end(End::Locked, false),
            },
            Stage::Home | Stage::Settings if self.counter.open_lines > 0 => {
                let patience = if self.counter.stage == Stage::Home { TO_HOME } else { AFTER_RESET };
                if waited < patience { Step::Wait(TICK) } else { self.halt(End::NoAnswer, now) }
            }
            Stage::Home => {
                self.counter.enter(Stage::Settings, now);
                self.line_beside(b"$$\n", now)
            }
            Stage::Settings => self.begin_to_count(),
            _ => self.end(End::NoAnswer, false),
        }
    }

    fn holds(&self) -> bool {
        self.grbl.as_ref().is_some_and(|grbl| grbl.holds())
    }

    fn homes(&self) -> bool {
        self.grbl.as_ref().is_some_and(|grbl| grbl.homes())
    }

    /// Checks the settings: with some of them wrong, a laser is on where it must not be.
    fn begin_to_count(&mut self) -> Step {
        let needed = self.grbl.as_ref().map_or(&[][..], |grbl| grbl.settings());
        let found = |number: u16| self.counter.settings.iter().rfind(|s| s.0 == number).map(|s| s.1);
        let is_wrong = |&&(number, value): &&(u16, i32)| found(number) != Some(f64::from(value));
        if let Some(&(number, needed)) = needed.iter().find(is_wrong) {
            return self.end(End::Setting { number, needed }, false);
        }
        self.notes.push(format!("handshake: count (ok to each line, buffer of {} bytes)", self.ask.size));
        self.phase = Phase::Stream;
        Step::Wait(Duration::ZERO)
    }

    /// Sends what fits, and looks at the state now and then.
    fn count(&mut self, now: Duration) -> Step {
        if let Some(step) = self.watch(now).or_else(|| self.follow_hold(now)) {
            return step;
        }
        let bytes = self.commands_that_fit(now);
        if !bytes.is_empty() {
            return Step::Send(bytes);
        }
        if self.is_all_sent() && self.paused.is_none() {
            self.phase = Phase::Finish(End::Finished);
            self.counter.enter(Stage::Rest, now);
        }
        Step::Wait(TICK)
    }

    /// Pauses at once, or with the tool lifted.
    fn follow_hold(&mut self, now: Duration) -> Option<Step> {
        if !self.holds() {
            self.follow_pause();
            return None;
        }
        if self.wants_pause == self.counter.is_holding {
            return None;
        }
        self.counter.is_holding = self.wants_pause;
        self.paused = self.wants_pause.then_some(false);
        Some(self.send_control(if self.wants_pause { HOLD } else { GO_ON }, now))
    }

    /// All is sent: the machine is done when it is idle.
    fn come_to_rest(&mut self, now: Duration) -> Step {
        if let Some(step) =
            self.watch(now).or_else(|| if self.holds() { self.follow_hold(now) } else { None })
        {
            return step;
        }
        let is_done = self.ledger.unanswered_bytes() == 0 && self.counter.idles > 1;
        if is_done { self.end(End::Finished, true) } else { Step::Wait(TICK) }
    }

    /// Asks for the state. A machine that is idle though lines are unanswered has lost an answer.
    fn watch(&mut self, now: Duration) -> Option<Step> {
        if self.counter.idles >= SURE_IDLE
            && self.ledger.unanswered_bytes() > 0
            && self.line.in_flight(now) == 0
        {
            if !self.counter.is_in_place() {
                return Some(self.halt(End::LinesLost, now));
            }
            self.notes.push("an answer of the machine was lost; it is where the job has it".to_owned());
            self.counter.idles = 0;
            self.ledger.taken(self.ledger.total());
        }
        let is_held = self.counter.state == Some(State::Held) && !self.counter.is_holding;
        if is_held && !std::mem::replace(&mut self.counter.is_hold_told, true) {
            self.notes
                .push("the machine holds by its own button or door; continue there, or stop".to_owned());
        }
        self.look(INTERVAL, now)
    }

    /// Asks for the state if it is time for that; gives a silent machine up.
    fn look(&mut self, interval: Duration, now: Duration) -> Option<Step> {
        if let Some(asked) = self.counter.asked {
            if now < asked + PATIENCE {
                return None;
            }
            self.counter.asked = None;
            self.counter.silences += 1;
            if self.counter.silences >= MOST_SILENCES && !self.is_halting() {
                return Some(self.halt(End::NoAnswer, now));
            }
        }
        if now < self.counter.last_asked + interval {
            return None;
        }
        (self.counter.asked, self.counter.last_asked) = (Some(now), now);
        Some(self.send_control(ASK, now))
    }

    fn is_halting(&self) -> bool {
        matches!(self.phase, Phase::Finish(end) if end != End::Finished)
    }

    /// Stops the machine. Where it may be in motion it is held first, so that it keeps its position.
    fn halt(&mut self, end: End, now: Duration) -> Step {
        self.phase = Phase::Finish(end);
        self.inserted.clear();
        self.counter.open_lines = 0;
        self.counter.was_refused = false;
        if matches!(end, End::Alarm(_) | End::Restarted) {
            return self.reset(1, now);
        }
        self.counter.enter(Stage::Hold, now);
        self.send_control(HOLD, now)
    }

    /// After the hold: reset, lift, and see that it is done.
    fn halted(&mut self, end: End, now: Duration) -> Step {
        if self.stop_wishes > 2 {
            return self.end(end, false);
        }
        let waited = now.saturating_sub(self.counter.since);
        match self.counter.stage {
            Stage::Hold => {
                let is_at_rest = self.counter.state.is_some_and(|state| state != State::Other);
                if is_at_rest || self.stop_wishes > 1 || waited >= TO_REST {
                    return self.reset(1, now);
                }
                self.look(SHORT_INTERVAL, now).unwrap_or(Step::Wait(TICK))
            }
            Stage::Reset(_) if self.counter.has_greeted => self.lift_after_reset(end, now),
            Stage::Reset(_) if waited < AFTER_RESET => Step::Wait(TICK),
            Stage::Reset(tries) if tries < MOST_RESETS => self.reset(tries + 1, now),
            Stage::Lift(_) if self.counter.open_lines == 0 && !self.counter.was_refused => {
                self.counter.enter(Stage::Rest, now);
                Step::Wait(Duration::ZERO)
            }
            // An answer was lost or refused, and the machine has nothing left to do.
            Stage::Lift(tries) if self.counter.idles > SURE_IDLE && tries < MOST_LIFTS => {
                self.lift(tries + 1, now)
            }
            Stage::Rest if self.counter.idles > 1 => self.end(end, true),
            Stage::Lift(_) | Stage::Rest if waited < TO_LIFT => {
                self.look(SHORT_INTERVAL, now).unwrap_or(Step::Wait(TICK))
            }
            _ => {
                let message = "the machine did not confirm that its tool is lifted or off; switch it off";
                self.notes.push(message.to_owned());
                self.end(end, false)
            }
        }
    }

    /// Resets: the beam or the spindle is off before anything else happens (`mc_reset`), and what was buffered is
    /// gone.
    fn reset(&mut self, tries: u32, now: Duration) -> Step {
        self.counter.has_greeted = false;
        self.counter.had_alarm = false;
        self.counter.enter(Stage::Reset(tries), now);
        self.send_control(RESET, now)
    }

    /// The machine has answered the reset.
    fn lift_after_reset(&mut self, end: End, now: Duration) -> Step {
        // Where a machine in alarm or in the middle of homing is, is not certain, so that nothing may move.
        if matches!(end, End::Alarm(_)) || self.next == 0 {
            return self.end(end, true);
        }
        if self.counter.had_alarm {
            let message = "the machine was reset while it moved and may have lost its position; home it or set its \
                           zero again before you continue";
            self.notes.push(message.to_owned());
        }
        self.is_down = false;
        self.lift(1, now)
    }

    /// Unlocks the machine and lifts the tool: a reset leaves a knife where it is.
    fn lift(&mut self, tries: u32, now: Duration) -> Step {
        self.counter.enter(Stage::Lift(tries), now);
        self.counter.was_refused = false;
        let lines = [b"$X\n", self.dialect.lift(self.at).as_slice(), self.stop.as_bytes()].concat();
        self.counter.open_lines = self.dialect.split(&lines).len() as u32;
        self.send_control(&lines, now)
    }

    /// A line that is no part of the job.
    fn line_beside(&mut self, line: &[u8], now: Duration) -> Step {
        self.counter.open_lines += 1;
        self.send_control(line, now)
    }
}
