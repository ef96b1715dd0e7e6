//! G-code as GRBL 1.1 reads it: one command a line, millimetres to three places. How a machine sets its
//! tool down and lifts it (Z, a servo, a laser's beam) is text of its profile.
//!
//! Source: GRBL 1.1, doc/markdown/commands.md and laser_mode.md (github.com/gnea/grbl).

use super::{Dialect, Meaning, Pen};
use crate::plotter::Point;

/// Units in a millimetre: coordinates have three places.
pub const UNITS_PER_MM: u32 = 1000;

/// G-code.
#[derive(Debug, Clone)]
pub struct Gcode {
    lift: String,
    /// Lines that lift the tool, and lines that set it down, without blanks.
    lifting: Vec<String>,
    lowering: Vec<String>,
}

impl Gcode {
    /// The language of a machine whose tool these lines lift, and those set down.
    pub fn new(lift: &str, lower: &[&str]) -> Self {
        let lines = |text: &str| text.lines().map(|line| bare(line.as_bytes())).collect::<Vec<_>>();
        let moves_tool = |line: &String| !line.is_empty() && !is_dwell(line);
        Self {
            lift: lift.to_owned(),
            lifting: lines(lift).into_iter().filter(moves_tool).collect(),
            lowering: lower.iter().flat_map(|text| lines(text)).filter(moves_tool).collect(),
        }
    }

    /// What a line does to the tool.
    fn pen(&self, line: &str, words: &[(char, f64)]) -> Pen {
        let is_among = |lines: &[String]| lines.iter().any(|other| other == line);
        if is_among(&self.lifting) {
            return Pen::Up;
        }
        if is_among(&self.lowering) {
            return Pen::Down;
        }
        let value = |letter| words.iter().find(|word| word.0 == letter).map(|word| word.1);
        let has = |letter, number: f64| words.contains(&(letter, number));
        match value('Z') {
            _ if has('M', 5.0) || has('M', 2.0) || has('M', 30.0) => Pen::Up,
            _ if has('M', 3.0) || has('M', 4.0) => match value('S') {
                Some(0.0) => Pen::Up,
                _ => Pen::Down,
            },
            Some(z) if z > 0.0 => Pen::Up,
            Some(_) => Pen::Down,
            None => Pen::Keep,
        }
    }
}

impl Dialect for Gcode {
    fn name(&self) -> &'static str {
        "gcode"
    }

    fn travel(&self, _: Point, to: Point) -> Vec<u8> {
        line("G0", to)
    }

    fn draw(&self, _: Point, through: &[Point]) -> Vec<Vec<u8>> {
        through.iter().map(|&to| line("G1", to)).collect()
    }

    fn tail(&self) -> &'static [u8] {
        b"\n"
    }

    fn lift(&self, _: Point) -> Vec<u8> {
        self.lift.clone().into_bytes()
    }

    /// Empty: each tool has lines of its own for it, which the job says.
    fn lower(&self, _: Point) -> Vec<u8> {
        Vec::new()
    }

    fn first(&self, bytes: &[u8]) -> Option<usize> {
        Some(bytes.iter().position(|&b| b == b'\n')? + 1)
    }

    /// Letter and number of a G or M word; the letter of others.
    fn mnemonic<'a>(&self, command: &'a [u8]) -> &'a [u8] {
        let command = command.trim_ascii_start();
        let digits = command.iter().skip(1).take_while(|b| b.is_ascii_digit() || **b == b'.').count();
        match command.first() {
            Some(b'G' | b'g' | b'M' | b'm') => &command[..1 + digits],
            Some(_) => &command[..1],
            None => command,
        }
    }

    fn meaning(&self, command: &[u8]) -> Meaning {
        let line = bare(command);
        if line.is_empty() || line == "%" {
            return Meaning::Setup;
        }
        if line.starts_with(['$', '?', '!', '~']) || !line.is_ascii() || line.contains('\u{18}') {
            return Meaning::Control;
        }
        let Some(words) = words(&line) else {
            return Meaning::Broken;
        };
        let value = |letter| words.iter().find(|word| word.0 == letter).map(|word| word.1);
        let has = |letter, number: f64| words.contains(&(letter, number));
        // Arcs and inches are not read, since nothing here writes them.
        if [2.0, 3.0, 20.0].into_iter().any(|number| has('G', number)) {
            return Meaning::Broken;
        }
        let pen = self.pen(&line, &words);
        let to = match (value('X'), value('Y')) {
            (Some(x), Some(y)) => match (units(x), units(y)) {
                (Some(x), Some(y)) => vec![Point::new(x, y)],
                _ => return Meaning::Broken,
            },
            (None, None) => Vec::new(),
            // What the other axis does depends on what came before.
            _ => return Meaning::Broken,
        };
        let is_relative = match (has('G', 90.0), has('G', 91.0)) {
            (false, false) => None,
            (_, is_relative) => Some(is_relative),
        };
        if to.is_empty() && pen == Pen::Keep && is_relative.is_none() {
            return Meaning::Setup;
        }
        Meaning::Move { pen, to, is_relative }
    }

    /// GRBL empties its planner before it changes the spindle or dwells (`protocol_buffer_synchronize`).
    fn waits(&self, command: &[u8]) -> bool {
        let words = words(&bare(command)).unwrap_or_default();
        let is_sync = |&(letter, number): &(char, f64)| match letter {
            'M' => [3.0, 4.0, 5.0].contains(&number),
            'G' => number == 4.0,
            _ => false,
        };
        words.iter().any(is_sync)
    }

    /// A line is never divided.
    fn in_parts(&self, _: &[u8], _: usize) -> Vec<Vec<u8>> {
        Vec::new()
    }
}

/// A line without blanks and comments, in capitals.
fn bare(command: &[u8]) -> String {
    let mut out = String::new();
    let mut is_comment = false;
    for c in String::from_utf8_lossy(command).chars() {
        match c {
            ';' => break,
            '(' => is_comment = true,
            ')' => is_comment = false,
            _ if is_comment || c.is_whitespace() => {}
            _ => out.push(c.to_ascii_uppercase()),
        }
    }
    out
}

fn is_dwell(line: &str) -> bool {
    line.starts_with("G4P") || line.starts_with("G04P")
}

/// Letters with their numbers; none where there is anything else.
fn words(line: &str) -> Option<Vec<(char, f64)>> {
    let mut out = Vec::new();
    let mut rest = line;
    while let Some(letter) = rest.chars().next() {
        let number = rest.get(1..)?;
        let length = number.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(number.len());
        let (number, after) = number.split_at(length);
        let is_plain = number.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b));
        out.push((letter, number.parse().ok().filter(|_| letter.is_ascii_alphabetic() && is_plain)?));
        rest = after;
    }
    Some(out)
}

fn units(mm: f64) -> Option<i32> {
    let units = (mm * f64::from(UNITS_PER_MM)).round();
    (units.abs() < f64::from(i32::MAX)).then_some(units as i32)
}

fn line(motion: &str, to: Point) -> Vec<u8> {
    format!("{motion} X{} Y{}\n", decimal(to.x()), decimal(to.y())).into_bytes()
}

/// Units as millimetres, without zeros at the end.
fn decimal(units: i32) -> String {
    let (whole, places) = (units.unsigned_abs() / UNITS_PER_MM, units.unsigned_abs() % UNITS_PER_MM);
    let sign = if units < 0 { "-" } else { "" };
    let text = format!("{sign}{whole}.{places:03}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_bytes() {
        let laser = Gcode::new("M5\n", &["M4\n"]);
        let at = Point::new(-12_340, 100_005);
        assert_eq!(laser.travel(at, at), b"G0 X-12.34 Y100.005\n");
        assert_eq!(
            laser.draw(at, &[at, Point::new(0, -7)]),
            [&b"G1 X-12.34 Y100.005\n"[..], b"G1 X0 Y-0.007\n"]
        );
        assert_eq!((laser.lift(at), laser.lower(at)), (b"M5\n".to_vec(), Vec::new()));
        assert_eq!(laser.split(b"G21\r\nM5\nG0 X1 Y2"), [&b"G21\r\n"[..], b"M5\n", b"G0 X1 Y2"]);
        assert_eq!((laser.mnemonic(b"G21\n"), laser.mnemonic(b"S400\n")), (&b"G21"[..], &b"S"[..]));
    }

    #[test]
    fn the_profile_says_what_lifts_a_tool() {
        let is = |machine: &Gcode, line: &[u8], pen| {
            assert_eq!(machine.meaning(line), Meaning::Move { pen, to: Vec::new(), is_relative: None });
        };
        let servo = Gcode::new("M3 S300\nG4 P0.2\n", &["M3 S700\nG4 P0.2\n"]);
        is(&servo, b"m3s300\n", Pen::Up);
        is(&servo, b"M3 S700\n", Pen::Down);
        assert_eq!(servo.meaning(b"G4 P0.2\n"), Meaning::Setup);
        let knife = Gcode::new("G0 Z4\n", &["G0 Z-0.4\n", "G0 Z-0.8\n"]);
        is(&knife, b"G0 Z4 (up)\n", Pen::Up);
        is(&knife, b"G1 Z-0.8 F300\n", Pen::Down);
        let laser = Gcode::new("M5\n", &["M4\n"]);
        is(&laser, b"M4 S0\n", Pen::Up);
        is(&laser, b"M3\n", Pen::Down);
        assert!(laser.waits(b"M5\n") && laser.waits(b"G4 P0.01\n") && !laser.waits(b"G0 X1 Y1\n"));
    }

    #[test]
    fn meanings() {
        let laser = Gcode::new("M5\n", &["M4\n"]);
        let to = vec![Point::new(1500, -2000)];
        let moved = Meaning::Move { pen: Pen::Keep, to, is_relative: None };
        assert_eq!(laser.meaning(b"g1x1.5Y-2.0F600 ; along\n"), moved);
        let relative = Meaning::Move { pen: Pen::Keep, to: Vec::new(), is_relative: Some(true) };
        assert_eq!(laser.meaning(b"G91\n"), relative);
        for control in [&b"$H\n"[..], b"?\n", b"!\n"] {
            assert_eq!(laser.meaning(control), Meaning::Control);
        }
        for broken in
            [&b"G1 X1\n"[..], b"G2 X1 Y1 I1 J0\n", b"G20\n", b"G1 X99999999999 Y1\n", b"IN;PU;\n", b"G\n"]
        {
            assert_eq!(laser.meaning(broken), Meaning::Broken, "{broken:?}");
        }
    }
}
