//! The languages of plotters, one file each behind one trait.

mod dmpl;
mod ebb;
mod gcode;
mod gpgl;
mod hpgl;

use super::Point;

pub use dmpl::Dmpl;
pub use ebb::Ebb;
pub use gcode::{Gcode, UNITS_PER_MM};
pub use gpgl::Gpgl;
pub use hpgl::Hpgl;

/// Longest command that is written, bytes: a command is sent whole or not at all, so it has to be
/// shorter than what may be on its way.
pub const LONGEST_COMMAND: usize = 64;

/// What a command does to the pen before it moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pen {
    /// Lifts it.
    Up,
    /// Sets it down.
    Down,
    /// Leaves it as it is.
    Keep,
}

/// What a command means to a job.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Meaning {
    /// Moves the pen through these positions, after what it says of the pen.
    Move {
        /// Up or down.
        pen: Pen,
        /// Positions, or distances where `is_relative`.
        to: Vec<Point>,
        /// Whether positions are distances from the last one; none where the command does not say.
        is_relative: Option<bool>,
    },
    /// Sets something for what follows: a tool, a force, a speed.
    Setup,
    /// Asks the machine for an answer.
    Query,
    /// Does something else to the connection or the machine that a job must leave alone.
    Control,
    /// Cannot be read.
    Broken,
}

/// Device control that is acted on when it is received, before what is buffered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Controls {
    /// Asks for the number of free bytes.
    pub free: &'static [u8],
    /// Asks for the size of the buffer.
    pub size: &'static [u8],
    /// Asks for the last error of the connection.
    pub error: &'static [u8],
    /// Discards what is buffered.
    pub discard: &'static [u8],
    /// Asks for a position, answered when all before it is done.
    pub barrier: &'static [u8],
    /// Asks for the model.
    pub identify: &'static [u8],
}

/// A language.
pub trait Dialect: Send + Sync + std::fmt::Debug {
    /// Name in small letters, as in profiles.
    fn name(&self) -> &'static str;

    /// Moves with the pen up from where it is, as whole commands.
    fn travel(&self, from: Point, to: Point) -> Vec<u8>;

    /// Moves with the pen down from where it is, as whole commands of at most [`LONGEST_COMMAND`] bytes.
    fn draw(&self, from: Point, through: &[Point]) -> Vec<Vec<u8>>;

    /// What ends a command.
    fn tail(&self) -> &'static [u8];

    /// Lifts the pen at its place.
    fn lift(&self, at: Point) -> Vec<u8>;

    /// Sets the pen down at its place; empty where the next move does that.
    fn lower(&self, at: Point) -> Vec<u8>;

    /// Length of the first command with what ends it; none where it is not complete.
    fn first(&self, bytes: &[u8]) -> Option<usize>;

    /// What a whole command means.
    fn meaning(&self, command: &[u8]) -> Meaning;

    /// The letters that say what kind of command it is.
    fn mnemonic<'a>(&self, command: &'a [u8]) -> &'a [u8];

    /// Device control, where the language has it.
    /// None by default: models of GP-GL differ in how they are asked.
    fn controls(&self) -> Option<Controls> {
        None
    }

    /// Initialises the machine; empty where the job does that.
    fn initialise(&self) -> &'static [u8] {
        b""
    }

    /// Asks whether the machine is ready (0), moving (1) or without a sheet (2), acted on when it is received;
    /// empty where the language cannot.
    fn state_question(&self) -> &'static [u8] {
        b""
    }

    /// Whether this command makes the machine look for printed marks: it answers when it has, and counts from
    /// them afterwards.
    fn is_search(&self, _command: &[u8]) -> bool {
        false
    }

    /// Time that a command takes, s, where that does not follow from the speed of the machine.
    fn seconds(&self, _command: &[u8]) -> Option<f64> {
        None
    }

    /// Whether all moves are distances, so that what is left of a job begins with a way from the origin.
    fn counts_distances(&self) -> bool {
        false
    }

    /// Whether a machine acknowledges this command only when all before it is done.
    fn waits(&self, _command: &[u8]) -> bool {
        false
    }

    /// Switches XON/XOFF on, with XOFF sent when fewer bytes are free; empty where the language
    /// cannot.
    fn switch_xon_xoff_on(&self, _least_free: usize) -> Vec<u8> {
        Vec::new()
    }

    /// A move through many positions as several commands of at most `longest` bytes, unless one position takes more;
    /// empty for other commands.
    fn in_parts(&self, command: &[u8], longest: usize) -> Vec<Vec<u8>> {
        match self.meaning(command) {
            Meaning::Move { to, .. } => chunked(self.mnemonic(command), self.tail(), &to, longest),
            _ => Vec::new(),
        }
    }

    /// All commands of a file, in their order; what is left over at the end counts as one.
    fn split<'a>(&self, bytes: &'a [u8]) -> Vec<&'a [u8]> {
        let mut out = Vec::new();
        let mut rest = bytes;
        while !rest.is_empty() {
            let length = self.first(rest).filter(|&n| n > 0).unwrap_or(rest.len());
            let (command, after) = rest.split_at(length);
            out.push(command);
            rest = after;
        }
        out
    }
}

/// Commands of one kind for many positions, each as long as it may be.
fn chunked(head: &[u8], tail: &[u8], through: &[Point], longest: usize) -> Vec<Vec<u8>> {
    let mut out = Vec::new();
    let mut command: Vec<u8> = Vec::new();
    for &at in through {
        let pair = format!("{},{}", at.x(), at.y());
        let is_full = command.len() + 1 + pair.len() + tail.len() > longest;
        if is_full && !command.is_empty() {
            command.extend(tail);
            out.push(std::mem::take(&mut command));
        }
        command.extend(if command.is_empty() { head } else { b"," });
        command.extend(pair.as_bytes());
    }
    if !command.is_empty() {
        command.extend(tail);
        out.push(command);
    }
    out
}

/// Numbers separated by commas or blanks, as pairs, rounded to whole units. None for anything
/// else, an odd count, or numbers out of range.
fn pairs(parameters: &[u8]) -> Option<Vec<Point>> {
    let text = std::str::from_utf8(parameters).ok()?;
    let fields = text.split([',', ' ', '\t', '\r', '\n']).filter(|field| !field.is_empty());
    let number = |field: &str| {
        let is_plain = field.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b));
        let value: f64 = field.parse().ok()?;
        let is_usable = is_plain && value.abs() < f64::from(i32::MAX);
        is_usable.then(|| value.round() as i32)
    };
    let numbers: Vec<i32> = fields.map(number).collect::<Option<_>>()?;
    let is_even = numbers.len().is_multiple_of(2);
    is_even.then(|| numbers.chunks(2).map(|pair| Point::new(pair[0], pair[1])).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Those that write positions; that of the EBB writes distances.
    fn dialects() -> [Box<dyn Dialect>; 4] {
        [Box::new(Hpgl), Box::new(Gpgl), Box::new(Dmpl), Box::new(Gcode::new("M5\n", &["M4\n"]))]
    }

    #[test]
    fn commands_are_short_and_lose_no_position() {
        let through: Vec<Point> = (0..200).map(|k| Point::new(k * 163 - 16000, -k * 161)).collect();
        for dialect in dialects() {
            let commands = dialect.draw(Point::default(), &through);
            assert!(commands.iter().all(|c| c.len() <= LONGEST_COMMAND), "{}", dialect.name());
            let file = commands.concat();
            assert_eq!(dialect.split(&file), commands, "{}", dialect.name());
            let read = commands.iter().flat_map(|command| match dialect.meaning(command) {
                Meaning::Move { pen: Pen::Down | Pen::Keep, to, .. } => to,
                other => panic!("{other:?}"),
            });
            assert_eq!(read.collect::<Vec<_>>(), through, "{}", dialect.name());
        }
    }

    #[test]
    fn every_first_part_of_a_command_is_incomplete() {
        for dialect in dialects() {
            // DMPL has no sign that ends a command but its comma.
            let command = dialect.travel(Point::default(), Point::new(12, 345));
            assert_eq!(dialect.first(&command), Some(command.len()), "{}", dialect.name());
            for end in 1..command.len() - 1 {
                let found = dialect.first(&command[..end]);
                assert!(found.is_none(), "{}: {:?}", dialect.name(), &command[..end]);
            }
            let two = [command.clone(), dialect.lift(Point::new(12, 345))].concat();
            assert_eq!(dialect.first(&two), Some(command.len()));
        }
    }
}
