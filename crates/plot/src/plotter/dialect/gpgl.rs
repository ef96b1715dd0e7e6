//! GP-GL, the language of Graphtec's cutters: one letter, parameters, ETX.

use super::{Dialect, LONGEST_COMMAND, Meaning, Pen, chunked, pairs};
use crate::plotter::Point;

/// Ends every command.
const ETX: u8 = 0x03;

/// Time to look for printed marks, s: a guess, since the machine says when it has them.
const SEARCH_S: f64 = 20.0;

/// GP-GL.
#[derive(Debug, Clone, Copy)]
pub struct Gpgl;

impl Dialect for Gpgl {
    fn name(&self) -> &'static str {
        "gpgl"
    }

    fn travel(&self, _: Point, to: Point) -> Vec<u8> {
        format!("M{},{}\x03", to.x(), to.y()).into_bytes()
    }

    fn draw(&self, _: Point, through: &[Point]) -> Vec<Vec<u8>> {
        chunked(b"D", self.tail(), through, LONGEST_COMMAND)
    }

    fn tail(&self) -> &'static [u8] {
        &[ETX]
    }

    /// A move to where the pen is.
    fn lift(&self, at: Point) -> Vec<u8> {
        self.travel(at, at)
    }

    fn lower(&self, _: Point) -> Vec<u8> {
        Vec::new()
    }

    /// ESC EOT.
    fn initialise(&self) -> &'static [u8] {
        b"\x1b\x04"
    }

    /// ESC ENQ.
    fn state_question(&self) -> &'static [u8] {
        b"\x1b\x05"
    }

    /// ESC and a character are a command without ETX.
    fn first(&self, bytes: &[u8]) -> Option<usize> {
        if bytes.first() == Some(&0x1B) {
            return (bytes.len() > 1).then_some(2);
        }
        Some(bytes.iter().position(|&b| b == ETX)? + 1)
    }

    fn mnemonic<'a>(&self, command: &'a [u8]) -> &'a [u8] {
        let command = command.trim_ascii_start();
        let letters = command.iter().take_while(|b| b.is_ascii_alphabetic()).count();
        // The number after TB is a part of the name.
        let digits = match &command[..letters] {
            b"TB" => command[letters..].iter().take_while(|b| b.is_ascii_digit()).count(),
            _ => 0,
        };
        &command[..(letters + digits).max(1).min(command.len())]
    }

    fn seconds(&self, command: &[u8]) -> Option<f64> {
        self.is_search(command).then_some(SEARCH_S)
    }

    /// By hand, three marks, four marks.
    fn is_search(&self, command: &[u8]) -> bool {
        matches!(self.mnemonic(command), b"TB23" | b"TB123" | b"TB124")
    }

    fn meaning(&self, command: &[u8]) -> Meaning {
        let name = self.mnemonic(command);
        let command = command.trim_ascii_start();
        let parameters = command[name.len()..].strip_suffix(&[ETX]).unwrap_or(&command[name.len()..]);
        let motion = |pen, is_relative| match pairs(parameters) {
            Some(to) => Meaning::Move { pen, to, is_relative: Some(is_relative) },
            None => Meaning::Broken,
        };
        match name {
            b"M" => motion(Pen::Up, false),
            b"D" => motion(Pen::Down, false),
            b"O" => motion(Pen::Up, true),
            b"E" => motion(Pen::Down, true),
            b"H" => Meaning::Move { pen: Pen::Up, to: vec![Point::default()], is_relative: Some(false) },
            b"G" | b"C" | b"?" | b"[" | b"U" | b"V" | b"@" | b"#" => Meaning::Query,
            b"=" | b"\"" | b":" | b";" | [0x1B] => Meaning::Control,
            _ => Meaning::Setup,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_bytes() {
        let at = Point::new(200, 45);
        assert_eq!(Gpgl.travel(at, at), b"M200,45\x03");
        assert_eq!(Gpgl.draw(at, &[at, Point::new(0, 7)]), [b"D200,45,0,7\x03"]);
        assert_eq!((Gpgl.lift(at), Gpgl.lower(at)), (b"M200,45\x03".to_vec(), Vec::new()));
        assert_eq!(Gpgl.split(b"!10\x03FX14\x03M0,0\x03"), [&b"!10\x03"[..], b"FX14\x03", b"M0,0\x03"]);
        assert_eq!(Gpgl.split(b"\x1b\x04FN0\x03"), [&b"\x1b\x04"[..], b"FN0\x03"]);
        assert_eq!((Gpgl.mnemonic(b"FX14\x03"), Gpgl.mnemonic(b"!10\x03")), (&b"FX"[..], &b"!"[..]));
        assert_eq!((Gpgl.mnemonic(b"TB50,0\x03"), Gpgl.mnemonic(b"TB99\x03")), (&b"TB50"[..], &b"TB99"[..]));
        assert!(Gpgl.is_search(b"TB123,1,2,3,4\x03") && !Gpgl.is_search(b"TB50,0\x03"));
    }
}
