//! A job read from the bytes of a file: whole commands, what each of them moves, and how long that
//! takes.

use super::dialect::{Dialect, Meaning, Pen};
use super::job_error::{JobError, LONGEST_FOREIGN_COMMAND};
use super::motion::Motion;
use super::pace::Pace;
use super::profile::Handshake;
use super::{Cutter, OffBed, Point};

/// One whole command.
#[derive(Debug, Clone, PartialEq)]
pub struct Command {
    bytes: Vec<u8>,
    motions: Vec<Motion>,
    is_setup: bool,
    is_down_after: bool,
    ends_at: Point,
    strokes_done: usize,
    seconds: f64,
}

impl Command {
    /// Its bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// What it moves.
    pub fn motions(&self) -> &[Motion] {
        &self.motions
    }

    /// Whether the pen is down after it.
    pub fn is_down_after(&self) -> bool {
        self.is_down_after
    }

    /// Whether it sets something for what follows, such as a tool.
    pub(crate) fn is_setup(&self) -> bool {
        self.is_setup
    }

    /// Where the pen is after it.
    pub fn ends_at(&self) -> Point {
        self.ends_at
    }

    /// Number of strokes of the job that are finished when this command begins.
    pub fn strokes_done(&self) -> usize {
        self.strokes_done
    }

    /// Time that it takes by the machine's profile, s.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }
}

/// A job.
///
/// # Guarantees
/// Every command is whole and at most 128 bytes long; none asks the machine for an answer; the
/// machine reaches every position; at least one stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    commands: Vec<Command>,
    strokes: usize,
    is_relative: bool,
    seconds: f64,
    dropped: usize,
}

impl Job {
    /// Reads a file for a machine. Questions and device control are left out, since they would
    /// disturb the handshake.
    ///
    /// # Errors
    /// See [`JobError`].
    pub fn parse(bytes: &[u8], cutter: &Cutter) -> Result<Self, JobError> {
        let dialect = cutter.dialect().as_ref();
        let mut reader = Reader::new(cutter);
        let mut at = 0;
        let mut dropped = 0;
        // A file in another language is one long command: that nothing is drawn by it says more.
        let mut too_long = None;
        for command in dialect.split(bytes) {
            let meaning = dialect.meaning(command);
            match meaning {
                Meaning::Broken => {
                    let text: String = command.iter().take(24).map(|&b| char::from(b)).collect();
                    return Err(JobError::Broken {
                        at,
                        text: text.trim().to_owned(),
                        dialect: dialect.name(),
                    });
                }
                Meaning::Query | Meaning::Control => dropped += 1,
                Meaning::Move { .. } | Meaning::Setup => match reader.take_whole(command, meaning, dialect) {
                    Err(Fault::OffBed(error)) => return Err(JobError::OffBed { at, error }),
                    Err(Fault::Long(length)) => {
                        too_long.get_or_insert(JobError::Long { at, length, longest: reader.longest() });
                    }
                    Ok(()) => {}
                },
            }
            at += command.len();
        }
        let job = reader.finished(dropped);
        if job.strokes == 0 {
            return Err(JobError::Empty(dialect.name()));
        }
        too_long.map_or(Ok(job), Err)
    }

    /// The commands.
    pub fn commands(&self) -> &[Command] {
        &self.commands
    }

    /// Number of strokes: from where the pen is set down to where it is lifted.
    pub fn strokes(&self) -> usize {
        self.strokes
    }

    /// Time of the whole job by the machine's profile, s.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Number of questions and control sequences that were left out.
    pub fn dropped(&self) -> usize {
        self.dropped
    }

    /// All bytes that are sent.
    pub fn bytes(&self) -> Vec<u8> {
        self.commands.iter().flat_map(|command| command.bytes.iter().copied()).collect()
    }

    /// The bytes of a job that begins with a stroke: all settings up to there, the latest of each
    /// kind, then what lifts the tool if the job says that by itself, the last of the strokes `turns`
    /// before it, which turn a drag knife, and everything from the travel to that stroke on. Where a language
    /// has nothing but distances, that travel begins at the origin. The whole job of another language where
    /// positions are distances, since those need what came before. Where all strokes are done, the last one
    /// begins it, since nothing but what ends the job would be left.
    pub fn from_stroke(&self, stroke: usize, turns: &[usize], dialect: &dyn Dialect) -> Vec<u8> {
        let stroke = stroke.min(self.strokes.saturating_sub(1));
        let is_possible = !self.is_relative || dialect.counts_distances();
        let Some(start) = self.start_of(stroke).filter(|_| is_possible && stroke > 0) else {
            return self.bytes();
        };
        let turn = turns.iter().copied().filter(|&turn| turn < stroke).max();
        let turn = turn.and_then(|turn| Some(self.start_of(turn)?..self.start_of(turn + 1)?));
        let turn = self.commands[turn.unwrap_or(0..0)].iter().filter(|c| !c.is_setup);
        let lifts = |c: &&Command| !c.is_setup && c.motions.is_empty() && !c.is_down_after;
        let lift = self.commands[..start].iter().rfind(lifts);
        let settings: Vec<&Command> = self.commands[..start].iter().filter(|c| c.is_setup).collect();
        let kind = |c: &Command| dialect.mnemonic(&c.bytes).to_ascii_uppercase();
        let is_latest = |k: usize| settings[k + 1..].iter().all(|later| kind(later) != kind(settings[k]));
        let settings = (0..settings.len()).filter(|&k| is_latest(k)).map(|k| settings[k]);
        let mut out: Vec<&[u8]> = settings.chain(lift).chain(turn).map(Command::bytes).collect();
        let way = dialect.travel(Point::default(), self.commands[start].ends_at);
        let (way, next) = if self.is_relative { (way, start + 1) } else { (Vec::new(), start) };
        out.push(&way);
        out.extend(self.commands[next..].iter().map(Command::bytes));
        out.concat()
    }

    /// The commands of their own, if any, that set the pen down last before command `next`.
    pub(super) fn lowering_before(&self, next: usize) -> Vec<u8> {
        let sent = &self.commands[..next];
        let lowers = |&k: &usize| sent[k].is_down_after && (k == 0 || !sent[k - 1].is_down_after);
        let first = (0..sent.len()).rfind(lowers).unwrap_or(sent.len());
        let still = sent[first..].iter().take_while(|command| command.motions.is_empty());
        still.flat_map(|command| command.bytes.iter().copied()).collect()
    }

    /// The command that travels to a stroke.
    fn start_of(&self, stroke: usize) -> Option<usize> {
        let draws = |c: &Command| c.strokes_done == stroke && c.motions.iter().any(|m| m.is_down);
        let first = self.commands.iter().position(draws)?;
        let travels = |c: &Command| !c.is_down_after && !c.motions.is_empty();
        Some(self.commands[..first].iter().rposition(travels).unwrap_or(first))
    }
}

/// What is wrong with a command.
enum Fault {
    Long(usize),
    OffBed(OffBed),
}

/// Follows the pen through a file.
struct Reader<'a> {
    cutter: &'a Cutter,
    commands: Vec<Command>,
    at: Point,
    is_down: bool,
    is_relative: bool,
    was_relative: bool,
    pace: Pace,
    /// Strokes that were begun, and those that were finished.
    begun: usize,
    done: usize,
}

impl<'a> Reader<'a> {
    fn new(cutter: &'a Cutter) -> Self {
        Self {
            cutter,
            commands: Vec::new(),
            at: Point::default(),
            is_down: false,
            is_relative: false,
            was_relative: false,
            pace: Pace::new(cutter),
            begun: 0,
            done: 0,
        }
    }

    /// The longest command that is sent whole: with the room that stays free, and one that is on its way when the
    /// machine says stop, it fits half a buffer. A machine that counts what it is sent has room for whole lines.
    fn longest(&self) -> usize {
        let serial = self.cutter.serial();
        match serial.handshake {
            Handshake::Count | Handshake::Ok | Handshake::Usb => LONGEST_FOREIGN_COMMAND,
            _ => LONGEST_FOREIGN_COMMAND.min(serial.buffer_bytes / 3),
        }
    }

    /// Takes a command, in parts where it is a move that is too long to be sent whole.
    fn take_whole(&mut self, bytes: &[u8], meaning: Meaning, dialect: &dyn Dialect) -> Result<(), Fault> {
        let first = self.commands.len();
        if bytes.len() <= self.longest() {
            self.take(bytes, meaning);
        } else {
            let parts = dialect.in_parts(bytes, self.longest());
            if parts.is_empty() {
                return Err(Fault::Long(bytes.len()));
            }
            parts.iter().for_each(|part| self.take(part, dialect.meaning(part)));
        }
        let mut motions = self.commands[first..].iter().flat_map(|command| &command.motions);
        motions.try_for_each(|motion| self.cutter.frame().check(motion.to)).map_err(Fault::OffBed)
    }

    fn take(&mut self, bytes: &[u8], meaning: Meaning) {
        let strokes_done = self.done;
        let was_down = self.is_down;
        let is_mode = |m: &Meaning| matches!(m, Meaning::Move { pen: Pen::Keep, to, .. } if to.is_empty());
        let is_setup = meaning == Meaning::Setup || is_mode(&meaning);
        if is_setup {
            self.pace.apply_setting(bytes);
        }
        let motions: Vec<Motion> = match meaning {
            Meaning::Move { pen, to, is_relative } => {
                self.is_relative = is_relative.unwrap_or(self.is_relative);
                self.was_relative |= self.is_relative;
                match pen {
                    Pen::Up => self.is_down = false,
                    Pen::Down => self.is_down = true,
                    Pen::Keep => {}
                }
                to.into_iter().map(|to| self.moved(to)).collect()
            }
            _ => Vec::new(),
        };
        if self.is_down && !was_down {
            self.begun += 1;
        }
        if was_down && !self.is_down {
            self.done = self.begun;
        }
        // A command that lifts the pen begins when the stroke before it is finished.
        let strokes_done = if was_down && !self.is_down { self.done } else { strokes_done };
        let pen_s = if was_down == self.is_down { 0.0 } else { self.pace.pen() };
        let by_pace = || pen_s + motions.iter().map(|motion| self.pace.seconds(motion)).sum::<f64>();
        let seconds = self.cutter.dialect().seconds(bytes).unwrap_or_else(by_pace);
        self.commands.push(Command {
            bytes: bytes.to_vec(),
            motions,
            is_setup,
            is_down_after: self.is_down,
            ends_at: self.at,
            strokes_done,
            seconds,
        });
    }

    fn moved(&mut self, to: Point) -> Motion {
        let from = self.at;
        self.at = if self.is_relative {
            Point::new(from.x().saturating_add(to.x()), from.y().saturating_add(to.y()))
        } else {
            to
        };
        Motion { from, to: self.at, is_down: self.is_down }
    }

    fn finished(self, dropped: usize) -> Job {
        Job {
            seconds: self.commands.iter().map(Command::seconds).sum(),
            commands: self.commands,
            strokes: self.begun,
            is_relative: self.was_relative,
            dropped,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plotter::profile::CUTTERS;

    fn generic() -> Cutter {
        Cutter::parse(CUTTERS[0].text).unwrap()
    }

    const FILE: &[u8] = b"IN;SP1;FS20;VS5;PU400,0;PD800,0,800,400;PU0,0;SP2;FS90;PD0,400;PU;PG;";

    #[test]
    fn strokes_positions_and_time() {
        let job = Job::parse(FILE, &generic()).unwrap();
        assert_eq!((job.strokes(), job.dropped()), (2, 0));
        assert_eq!(job.bytes(), FILE);
        let done: Vec<usize> = job.commands().iter().map(Command::strokes_done).collect();
        assert_eq!(done, [0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2]);
        let drawn: f64 = job
            .commands()
            .iter()
            .flat_map(Command::motions)
            .filter(|m| m.is_down)
            .map(|m| m.from.distance(m.to))
            .sum();
        assert_eq!(drawn, 1200.0);
        // 30 mm drawn at 50 mm/s, three times from rest; 10 mm and 22.36 mm travelled, too short
        // for 300 mm/s; four times 0.1 s.
        let a: f64 = generic().acceleration_mm_s2();
        let travel = 2.0 * ((10.0 / a).sqrt() + (500f64.sqrt() / a).sqrt());
        assert!((job.seconds() - (30.0 / 50.0 + 3.0 * 50.0 / a + travel + 0.4)).abs() < 1e-9);
    }

    #[test]
    fn a_later_stroke_keeps_the_latest_settings() {
        let job = Job::parse(FILE, &generic()).unwrap();
        let rest = job.from_stroke(1, &[], generic().dialect().as_ref());
        assert_eq!(String::from_utf8_lossy(&rest), "IN;SP1;FS20;VS5;PU0,0;SP2;FS90;PD0,400;PU;PG;");
        let three = b"IN;SP1;FS20;PU1,1;PD2,2;PU3,3;SP2;FS30;PU4,4;PD5,5;PU;SP3;PU6,6;PD7,7;PU;";
        let job = Job::parse(three, &generic()).unwrap();
        let rest = job.from_stroke(2, &[], generic().dialect().as_ref());
        assert_eq!(String::from_utf8_lossy(&rest), "IN;FS30;SP3;PU;PU6,6;PD7,7;PU;");
        // A drag knife is turned first; what turns it for another tool is of no use.
        let turned = job.from_stroke(2, &[0, 1, 2], generic().dialect().as_ref());
        assert_eq!(String::from_utf8_lossy(&turned), "IN;FS30;SP3;PU;PU4,4;PD5,5;PU;PU6,6;PD7,7;PU;");
        // A tool that is lifted by a command of its own is lifted first.
        let own = b"IN;PU;PU1,1;PD;PA2,2;PU;PU3,3;PD;PA4,4;PU;PU5,5;PD;PA6,6;PU;";
        let job = Job::parse(own, &generic()).unwrap();
        let rest = job.from_stroke(2, &[0], generic().dialect().as_ref());
        let expected = "IN;PU;PU1,1;PD;PA2,2;PU;PU5,5;PD;PA6,6;PU;";
        assert_eq!(String::from_utf8_lossy(&rest), expected);
        let job = Job::parse(three, &generic()).unwrap();
        assert_eq!(job.from_stroke(0, &[], generic().dialect().as_ref()), three);
    }

    /// A job that was stopped on the way home, all strokes done, was drawn once more from the first stroke on.
    #[test]
    fn a_job_whose_strokes_are_all_done_goes_on_with_the_last_one() {
        let job = Job::parse(FILE, &generic()).unwrap();
        for done in [2, 3, 99] {
            let rest = job.from_stroke(done, &[], generic().dialect().as_ref());
            assert_eq!(rest, job.from_stroke(1, &[], generic().dialect().as_ref()), "{done}");
        }
    }

    #[test]
    fn other_programs_files() {
        let job = Job::parse(b"\x1b.(;IN;OI;PU0,0\nPD10,0PR0,10,-10,0;PA;PU;", &generic()).unwrap();
        assert_eq!((job.strokes(), job.dropped()), (1, 2));
        assert_eq!(job.commands().last().map(Command::ends_at), Some(Point::new(0, 10)));
        // Distances mean nothing without what came before.
        assert_eq!(job.from_stroke(1, &[], generic().dialect().as_ref()), job.bytes());
        assert!(matches!(Job::parse(b"", &generic()), Err(JobError::Empty(_))));
        assert!(matches!(Job::parse(b"%PDF-1.4 1 0 obj", &generic()), Err(JobError::Broken { at: 0, .. })));
    }

    #[test]
    fn a_long_move_is_sent_in_parts_and_what_cannot_be_parted_is_refused() {
        let corners: Vec<String> = (1..=50).map(|k| format!("{k}00,{}", k % 7)).collect();
        let long = format!("PU0,0;PD{}PU;", corners.join(","));
        let job = Job::parse(long.as_bytes(), &generic()).unwrap();
        assert!(job.commands().iter().all(|c| c.bytes().len() <= LONGEST_FOREIGN_COMMAND));
        let down: Vec<Point> =
            job.commands().iter().flat_map(Command::motions).filter(|m| m.is_down).map(|m| m.to).collect();
        assert_eq!(down, (1..=50).map(|k| Point::new(k * 100, k % 7)).collect::<Vec<_>>());
        assert_eq!(job.strokes(), 1);
        let label = format!("PU0,0;PD9,9;LB{}\x03", "x".repeat(200));
        assert!(matches!(Job::parse(label.as_bytes(), &generic()), Err(JobError::Long { at: 12, .. })));
    }

    #[test]
    fn a_file_that_leaves_the_bed_is_refused() {
        let file = b"IN;PU0,0;PD400,400;PU0,99000;";
        let refused = Job::parse(file, &generic());
        assert!(matches!(refused, Err(JobError::OffBed { at: 19, .. })), "{refused:?}");
        let refused = Job::parse(b"PU0,0;PR;PD400,400,-401,0;PU;", &generic());
        assert!(matches!(refused, Err(JobError::OffBed { at: 9, .. })), "{refused:?}");
    }
}
