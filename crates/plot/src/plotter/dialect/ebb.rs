//! The language of the EiBotBoard (EBB), which drives AxiDraws: two letters, parameters, a carriage return. Moves are
//! distances of both axes with the time that they take. The board knows no acceleration, so that long moves are
//! written as short ones, from slow to fast to slow.
//!
//! Source: docs/ebb.html and docs/ebb2.html of github.com/evil-mad/EggBot (firmware 2.6.2 and later).

use super::{Dialect, Meaning, Pen, pairs};
use crate::plotter::Point;

/// Longest move, s: the board hears nothing while it waits for room in its queue, a stop neither.
const LONGEST_S: f64 = 0.25;
/// Length of a step of speed, s. Shorter ones leave the board waiting for the next; longer ones jerk.
const RAMP_S: f64 = 0.05;
/// Speed that the motors take from rest, mm/s: that of AxiDraw's slowest drawing moves.
const FROM_REST_MM_S: f64 = 10.0;
/// Most steps a second of one motor.
const MOST_STEPS_S: f64 = 25_000.0;

/// The language of the EBB.
#[derive(Debug, Clone)]
pub struct Ebb {
    lift: String,
    units_per_mm: f64,
    travel_mm_s: f64,
    draw_mm_s: f64,
    acceleration_mm_s2: f64,
}

impl Ebb {
    /// The language of a board whose tool this command lifts; none where its motors cannot step so fast.
    pub fn new(
        lift: &str,
        units_per_mm: f64,
        speeds_mm_s: [f64; 2],
        acceleration_mm_s2: f64,
    ) -> Option<Self> {
        let [travel_mm_s, draw_mm_s] = speeds_mm_s;
        // A slanted move turns one motor by the sum of both axes.
        let steps_s = travel_mm_s.max(draw_mm_s) * units_per_mm * std::f64::consts::SQRT_2;
        (steps_s <= MOST_STEPS_S).then(|| Self {
            lift: lift.to_owned(),
            units_per_mm,
            travel_mm_s,
            draw_mm_s,
            acceleration_mm_s2,
        })
    }

    /// Parts of a straight move: share of the way that is done at the end of each, and its duration, s.
    fn parts(&self, length_mm: f64, speed_mm_s: f64) -> Vec<(f64, f64)> {
        let slow = FROM_REST_MM_S.min(speed_mm_s);
        let a = self.acceleration_mm_s2;
        let fast = speed_mm_s.min((slow * slow + a * length_mm).sqrt());
        let ramp_s = (fast - slow) / a;
        let ramps = (ramp_s / RAMP_S).ceil() as usize;
        let gained = |share: f64| (slow + a * ramp_s * share / 2.0) * ramp_s * share;
        let level_mm = (length_mm - 2.0 * gained(1.0)).max(0.0);
        let level_s = level_mm / fast;
        let levels = (level_s / LONGEST_S).ceil() as usize;
        let share = |k: usize| k as f64 / ramps as f64;
        let up = (1..=ramps).map(|k| (gained(share(k)), ramp_s / ramps as f64));
        let level = (1..=levels)
            .map(|k| (gained(1.0) + level_mm * k as f64 / levels as f64, level_s / levels as f64));
        let down = (0..ramps).rev().map(|k| (length_mm - gained(share(k)), ramp_s / ramps as f64));
        up.chain(level).chain(down).map(|(mm, s)| (mm / length_mm, s)).collect()
    }

    /// A straight move, as commands. Each ends on a whole step of the way, so that nothing adds up.
    fn moves(&self, from: Point, to: Point, speed_mm_s: f64) -> Vec<Vec<u8>> {
        let length_mm = from.distance(to) / self.units_per_mm;
        let way = [to.x() - from.x(), to.y() - from.y()];
        let mut done = [0; 2];
        let mut out = Vec::new();
        let mut waited_s = 0.0;
        let parts = if length_mm > 0.0 { self.parts(length_mm, speed_mm_s) } else { Vec::new() };
        for (k, (share, seconds)) in parts.iter().enumerate() {
            let is_last = k + 1 == parts.len();
            let at = way.map(|w| if is_last { w } else { (f64::from(w) * share).round() as i32 });
            let steps = [at[0] - done[0], at[1] - done[1]];
            waited_s += seconds;
            if steps == [0; 2] {
                continue;
            }
            let ms = (waited_s * 1000.0).round().max(1.0);
            out.push(format!("XM,{ms},{},{}\r", steps[0], steps[1]).into_bytes());
            (done, waited_s) = (at, 0.0);
        }
        out
    }
}

impl Dialect for Ebb {
    fn name(&self) -> &'static str {
        "ebb"
    }

    /// At least one command, so that each stroke begins with one.
    fn travel(&self, from: Point, to: Point) -> Vec<u8> {
        let moves = self.moves(from, to, self.travel_mm_s).concat();
        if moves.is_empty() { b"XM,1,0,0\r".to_vec() } else { moves }
    }

    fn draw(&self, from: Point, through: &[Point]) -> Vec<Vec<u8>> {
        let starts = std::iter::once(&from).chain(through);
        starts.zip(through).flat_map(|(&from, &to)| self.moves(from, to, self.draw_mm_s)).collect()
    }

    fn tail(&self) -> &'static [u8] {
        b"\r"
    }

    fn lift(&self, _: Point) -> Vec<u8> {
        self.lift.clone().into_bytes()
    }

    /// Empty: each tool has a command of its own for it, which the job says.
    fn lower(&self, _: Point) -> Vec<u8> {
        Vec::new()
    }

    fn first(&self, bytes: &[u8]) -> Option<usize> {
        Some(bytes.iter().position(|&b| b == b'\r')? + 1)
    }

    /// The letters; for SC with the number of what it sets.
    fn mnemonic<'a>(&self, command: &'a [u8]) -> &'a [u8] {
        let command = command.trim_ascii_start();
        let letters = command.iter().take_while(|b| b.is_ascii_alphanumeric()).count();
        let number = command[letters..].iter().skip(1).take_while(|b| b.is_ascii_digit()).count();
        let is_setting = command[..letters].eq_ignore_ascii_case(b"SC") && number > 0;
        &command[..letters + if is_setting { 1 + number } else { 0 }]
    }

    fn meaning(&self, command: &[u8]) -> Meaning {
        let text = String::from_utf8_lossy(command.trim_ascii()).to_ascii_uppercase();
        let (name, parameters) = text.split_once(',').unwrap_or((&text, ""));
        let pen = |pen| Meaning::Move { pen, to: Vec::new(), is_relative: None };
        match name {
            "XM" => match parameters.split_once(',').and_then(|(_, steps)| pairs(steps.as_bytes())) {
                Some(to) if to.len() == 1 && self.seconds(command).is_some() => {
                    Meaning::Move { pen: Pen::Keep, to, is_relative: Some(true) }
                }
                _ => Meaning::Broken,
            },
            "SP" => match parameters.split(',').next() {
                Some("1") => pen(Pen::Up),
                Some("0") => pen(Pen::Down),
                _ => Meaning::Broken,
            },
            // Back to where the motors were switched on.
            "HM" if !parameters.contains(',') => {
                Meaning::Move { pen: Pen::Keep, to: vec![Point::default()], is_relative: Some(false) }
            }
            "" | "EM" | "SC" | "SR" => Meaning::Setup,
            "V" | "QB" | "QC" | "QE" | "QG" | "QL" | "QM" | "QN" | "QP" | "QR" | "QS" | "QT" | "QU" => {
                Meaning::Query
            }
            "ES" | "R" | "RB" | "CU" => Meaning::Control,
            _ => Meaning::Broken,
        }
    }

    /// The time in the command.
    fn seconds(&self, command: &[u8]) -> Option<f64> {
        let text = String::from_utf8_lossy(command.trim_ascii()).to_ascii_uppercase();
        let mut words = text.split(',');
        let place = match words.next() {
            Some("XM") => 0,
            Some("SP") => 1,
            _ => return None,
        };
        let ms = words.nth(place).map_or(Some(0), |word| word.parse::<u32>().ok());
        ms.map(|ms| f64::from(ms) / 1000.0)
    }

    fn counts_distances(&self) -> bool {
        true
    }

    /// A move is never divided.
    fn in_parts(&self, _: &[u8], _: usize) -> Vec<Vec<u8>> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ebb() -> Ebb {
        Ebb::new("SP,1,300\r", 80.0, [100.0, 25.0], 400.0).unwrap()
    }

    fn steps(commands: &[Vec<u8>]) -> Vec<(f64, Point)> {
        let step = |command: &Vec<u8>| match ebb().meaning(command) {
            Meaning::Move { pen: Pen::Keep, to, is_relative: Some(true) } => {
                (ebb().seconds(command).unwrap(), to[0])
            }
            other => panic!("{other:?}"),
        };
        commands.iter().map(step).collect()
    }

    #[test]
    fn exact_bytes() {
        let (a, b) = (Point::new(100, 40), Point::new(180, 40));
        // A millimetre is too short for more than one step of speed.
        assert_eq!(ebb().draw(a, &[b]), [&b"XM,31,40,0\r"[..], b"XM,31,40,0\r"]);
        assert_eq!(ebb().travel(a, a), b"XM,1,0,0\r");
        assert_eq!(ebb().lift(a), b"SP,1,300\r");
        assert_eq!(ebb().split(b"EM,1,1\rSP,1,300\r"), [&b"EM,1,1\r"[..], b"SP,1,300\r"]);
        assert_eq!(
            (ebb().mnemonic(b"SC,4,16000\r"), ebb().mnemonic(b"XM,1,2,3\r")),
            (&b"SC,4"[..], &b"XM"[..])
        );
    }

    #[test]
    fn moves_lose_no_step_gain_speed_gently_and_stay_short() {
        for to in [Point::new(9000, 12001), Point::new(-3, 1), Point::new(-4000, 0), Point::new(1, -799)] {
            let commands = ebb()
                .split(&ebb().travel(Point::default(), to))
                .iter()
                .map(|c| c.to_vec())
                .collect::<Vec<_>>();
            let moves = steps(&commands);
            let sum = moves.iter().fold((0, 0), |(x, y), (_, p)| (x + p.x(), y + p.y()));
            assert_eq!(sum, (to.x(), to.y()));
            assert!(moves.iter().all(|(s, _)| *s <= LONGEST_S + 1e-3 && *s > 0.0), "{moves:?}");
            let speeds: Vec<f64> =
                moves.iter().map(|(s, p)| p.distance(Point::default()) / 80.0 / s).collect();
            // 400 mm/s² in 50 ms are 20 mm/s; the rest is rounding of short moves.
            assert!(speeds[0] < 25.0 && speeds[speeds.len() - 1] < 25.0, "{to:?}: {speeds:?}");
            assert!(speeds.windows(2).all(|w| (w[0] - w[1]).abs() < 25.0), "{to:?}: {speeds:?}");
            assert!(speeds.iter().all(|&v| v < 103.0), "{to:?}: {speeds:?}");
        }
    }

    #[test]
    fn meanings() {
        let pen = |pen| Meaning::Move { pen, to: Vec::new(), is_relative: None };
        assert_eq!(ebb().meaning(b"SP,1,300\r"), pen(Pen::Up));
        assert_eq!(ebb().meaning(b"sp,0\r"), pen(Pen::Down));
        let home = Meaning::Move { pen: Pen::Keep, to: vec![Point::default()], is_relative: Some(false) };
        assert_eq!(ebb().meaning(b"HM,4000\r"), home);
        assert_eq!((ebb().meaning(b"QM\r"), ebb().meaning(b"ES\r")), (Meaning::Query, Meaning::Control));
        assert_eq!(
            (ebb().meaning(b"EM,1,1\r"), ebb().meaning(b"SC,4,16000\r")),
            (Meaning::Setup, Meaning::Setup)
        );
        for broken in
            [&b"XM,10,5\r"[..], b"XM,x,5,5\r", b"SP,7\r", b"HM,4000,1,2\r", b"LM,1,2,3\r", b"G0 X1\r"]
        {
            assert_eq!(ebb().meaning(broken), Meaning::Broken, "{broken:?}");
        }
    }

    #[test]
    fn a_speed_that_the_motors_cannot_step_is_refused() {
        assert!(Ebb::new("", 80.0, [300.0, 25.0], 400.0).is_none());
    }
}
