//! DM/PL, the language of Houston Instrument's plotters: letters with parameters and a comma after
//! each command; there is no other sign that ends one.

use super::{Dialect, Meaning, Pen, pairs};
use crate::plotter::Point;

/// DM/PL.
#[derive(Debug, Clone, Copy)]
pub struct Dmpl;

impl Dialect for Dmpl {
    fn name(&self) -> &'static str {
        "dmpl"
    }

    fn travel(&self, _: Point, to: Point) -> Vec<u8> {
        format!("U{},{},", to.x(), to.y()).into_bytes()
    }

    /// One pair a command, so that the plotter knows where each ends.
    fn draw(&self, _: Point, through: &[Point]) -> Vec<Vec<u8>> {
        through.iter().map(|at| format!("D{},{},", at.x(), at.y()).into_bytes()).collect()
    }

    fn tail(&self) -> &'static [u8] {
        b","
    }

    fn lift(&self, _: Point) -> Vec<u8> {
        b"U,".to_vec()
    }

    fn lower(&self, _: Point) -> Vec<u8> {
        b"D,".to_vec()
    }

    /// A command is complete when the next one has begun, or at the end of what there is with the
    /// comma after a pair, or after a letter alone.
    fn first(&self, bytes: &[u8]) -> Option<usize> {
        let is_start = |b: &u8| b.is_ascii_alphabetic() || *b == b';';
        let blank = bytes.iter().take_while(|b| !is_start(b)).count();
        let name = self.mnemonic(bytes).len();
        let rest = &bytes[blank + name..];
        if let Some(next) = rest.iter().position(is_start) {
            return Some(blank + name + next);
        }
        let commas = rest.iter().filter(|&&b| b == b',').count();
        let is_pairs = rest == b"," || commas == 2;
        (name > 0 && rest.ends_with(b",") && is_pairs).then_some(bytes.len())
    }

    fn mnemonic<'a>(&self, command: &'a [u8]) -> &'a [u8] {
        let start = command.iter().position(|b| b.is_ascii_alphabetic() || *b == b';');
        let command = &command[start.unwrap_or(command.len())..];
        let length = match command {
            [b';', b':', ..] => 2,
            [b'E', b'C', ..] | [b'B', b'P', ..] => 2,
            [] => 0,
            _ => 1,
        };
        &command[..length]
    }

    fn meaning(&self, command: &[u8]) -> Meaning {
        let name = self.mnemonic(command);
        let start = command.iter().position(|b| name.first() == Some(b)).unwrap_or(0);
        let parameters = &command[start + name.len()..];
        let motion = |pen| match pairs(parameters) {
            Some(to) => Meaning::Move { pen, to, is_relative: None },
            None => Meaning::Broken,
        };
        match name {
            b"U" => motion(Pen::Up),
            b"D" => motion(Pen::Down),
            b"H" => Meaning::Move { pen: Pen::Up, to: vec![Point::default()], is_relative: None },
            b"A" => Meaning::Move { pen: Pen::Keep, to: Vec::new(), is_relative: Some(false) },
            b"R" => Meaning::Move { pen: Pen::Keep, to: Vec::new(), is_relative: Some(true) },
            _ => Meaning::Setup,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_bytes() {
        let at = Point::new(1000, -45);
        assert_eq!(Dmpl.travel(at, at), b"U1000,-45,");
        assert_eq!(Dmpl.draw(at, &[at, Point::new(0, 7)]), [&b"D1000,-45,"[..], b"D0,7,"]);
        assert_eq!((Dmpl.lift(at), Dmpl.lower(at)), (b"U,".to_vec(), b"D,".to_vec()));
    }

    #[test]
    fn commands_end_where_the_next_begins() {
        let file = b";:HAL0 V10 EC1 U10,20,D5,6,7,8,P0,U0,0,Z";
        let expected: [&[u8]; 11] =
            [b";:", b"H", b"A", b"L0 ", b"V10 ", b"EC1 ", b"U10,20,", b"D5,6,7,8,", b"P0,", b"U0,0,", b"Z"];
        assert_eq!(Dmpl.split(file), expected);
    }
}
