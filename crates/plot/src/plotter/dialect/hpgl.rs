//! HP-GL, the common language: HP 7475A Interfacing and Programming Manual, chapters 3 to 10.

use super::{Controls, Dialect, LONGEST_COMMAND, Meaning, Pen, chunked, pairs};
use crate::plotter::Point;

/// The escape character, which begins device control.
const ESC: u8 = 0x1B;
/// Ends a label.
const ETX: u8 = 0x03;
/// Device control with parameters, which a colon ends.
const WITH_PARAMETERS: &[u8] = b"@HIMNPST";

/// HP-GL.
#[derive(Debug, Clone, Copy)]
pub struct Hpgl;

impl Dialect for Hpgl {
    fn name(&self) -> &'static str {
        "hpgl"
    }

    fn travel(&self, _: Point, to: Point) -> Vec<u8> {
        format!("PU{},{};", to.x(), to.y()).into_bytes()
    }

    fn draw(&self, _: Point, through: &[Point]) -> Vec<Vec<u8>> {
        chunked(b"PD", self.tail(), through, LONGEST_COMMAND)
    }

    fn tail(&self) -> &'static [u8] {
        b";"
    }

    fn lift(&self, _: Point) -> Vec<u8> {
        b"PU;".to_vec()
    }

    fn lower(&self, _: Point) -> Vec<u8> {
        b"PD;".to_vec()
    }

    fn first(&self, bytes: &[u8]) -> Option<usize> {
        let blank = bytes.iter().take_while(|b| b.is_ascii_whitespace() || **b == b';').count();
        let command = &bytes[blank..];
        let length = match command {
            // Blanks at the end of a file are no command that waits for more.
            [] => 0,
            [ESC, b'.', letter, rest @ ..] if WITH_PARAMETERS.contains(letter) => {
                3 + 1 + rest.iter().position(|&b| b == b':')?
            }
            [ESC, b'.', _, ..] => 3,
            [ESC, b'.'] | [ESC] => return None,
            [b'L' | b'l', b'B' | b'b', rest @ ..] => 2 + 1 + rest.iter().position(|&b| b == ETX)?,
            [b'P' | b'p', b'E' | b'e', rest @ ..] => 2 + 1 + rest.iter().position(|&b| b == b';')?,
            _ => {
                let name = self.mnemonic(command).len();
                let is_parameter = |b: &u8| b.is_ascii_digit() || b"+-., \t\r\n".contains(b);
                let end = name + command[name..].iter().position(|b| !is_parameter(b))?;
                // What is no letter ends the command and belongs to it.
                end + usize::from(!command[end].is_ascii_alphabetic() && !matches!(command[end], ESC | b'!'))
            }
        };
        Some(blank + length)
    }

    fn mnemonic<'a>(&self, command: &'a [u8]) -> &'a [u8] {
        let command = trimmed(command);
        let mark = usize::from(command.first() == Some(&b'!'));
        &command[..command.len().min(mark + 2)]
    }

    fn meaning(&self, command: &[u8]) -> Meaning {
        let command = trimmed(command);
        let name = self.mnemonic(command).to_ascii_uppercase();
        let parameters = command[name.len()..].strip_suffix(b";").unwrap_or(&command[name.len()..]);
        let motion = |pen, is_relative| match pairs(parameters) {
            Some(to) => Meaning::Move { pen, to, is_relative },
            None => Meaning::Broken,
        };
        match name.as_slice() {
            b"PU" => motion(Pen::Up, None),
            b"PD" => motion(Pen::Down, None),
            b"PA" => motion(Pen::Keep, Some(false)),
            b"PR" => motion(Pen::Keep, Some(true)),
            b"" => Meaning::Setup,
            [ESC, ..] => Meaning::Control,
            [b'O', b'A' | b'C' | b'D' | b'E' | b'F' | b'H' | b'I' | b'O' | b'P' | b'S' | b'T' | b'W'] => {
                Meaning::Query
            }
            name if name.iter().all(|b| b.is_ascii_alphabetic() || *b == b'!') && name.len() >= 2 => {
                Meaning::Setup
            }
            _ => Meaning::Broken,
        }
    }

    fn controls(&self) -> Option<Controls> {
        Some(Controls {
            free: b"\x1b.B",
            size: b"\x1b.L",
            error: b"\x1b.E",
            discard: b"\x1b.K",
            barrier: b"OA;",
            identify: b"OI;",
        })
    }

    fn switch_xon_xoff_on(&self, least_free: usize) -> Vec<u8> {
        format!("\x1b.I{least_free};;17:\x1b.N;19:").into_bytes()
    }
}

/// A command without blanks and empty commands before it.
fn trimmed(command: &[u8]) -> &[u8] {
    let blank = command.iter().take_while(|b| b.is_ascii_whitespace() || **b == b';').count();
    &command[blank..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_bytes() {
        let at = Point::new(-40, 11040);
        assert_eq!(Hpgl.travel(at, at), b"PU-40,11040;");
        assert_eq!(Hpgl.draw(at, &[at, Point::new(0, 7)]), [b"PD-40,11040,0,7;"]);
        assert_eq!((Hpgl.lift(at), Hpgl.lower(at)), (b"PU;".to_vec(), b"PD;".to_vec()));
        assert_eq!(Hpgl.switch_xon_xoff_on(256), b"\x1b.I256;;17:\x1b.N;19:");
    }

    #[test]
    fn commands_end_at_their_semicolon_or_at_the_next_letter() {
        let file = b"\x1b.(IN;PA\nSP1PU10,10PD 20,20 , 30 30;!PG;;LBa;b\x03PU;\x1b.I81;;17:VS40;\n";
        let expected: [&[u8]; 12] = [
            b"\x1b.(",
            b"IN;",
            b"PA\n",
            b"SP1",
            b"PU10,10",
            b"PD 20,20 , 30 30;",
            b"!PG;",
            b";LBa;b\x03",
            b"PU;",
            b"\x1b.I81;;17:",
            b"VS40;",
            b"\n",
        ];
        assert_eq!(Hpgl.split(file), expected);
    }

    #[test]
    fn meanings() {
        let to = vec![Point::new(1, -2)];
        let is = |command: &[u8], pen, is_relative| {
            assert_eq!(Hpgl.meaning(command), Meaning::Move { pen, to: to.clone(), is_relative });
        };
        is(b"PU1,-2;", Pen::Up, None);
        is(b"\npd 1 -2;", Pen::Down, None);
        is(b"PR1,-2", Pen::Keep, Some(true));
        assert_eq!(Hpgl.meaning(b"OI;"), Meaning::Query);
        assert_eq!(Hpgl.meaning(b"\x1b.K"), Meaning::Control);
        assert_eq!(Hpgl.meaning(b"!PG;"), Meaning::Setup);
        for broken in [&b"PD1;"[..], b"PD1,x;", b"7;", b"PD1e5,2;", b"PD99999999999,0;"] {
            assert_eq!(Hpgl.meaning(broken), Meaning::Broken, "{broken:?}");
        }
    }
}
