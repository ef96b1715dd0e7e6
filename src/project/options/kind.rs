//! What an option may be.

use super::{Settings, Written};
use crate::units::{parse_length_mm, parse_length_or_zero_mm};

/// What an option may be, and where its value goes.
#[derive(Debug)]
pub enum Kind {
    /// A number with a unit.
    Number(Number),
    /// A whole number.
    Count(Count),
    /// On or off.
    Switch(Switch),
    /// One of some names, or another text.
    Text(Text),
}

/// The unit of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A length in mm, which users write with any unit.
    Length,
    /// An angle in degrees.
    Degrees,
    /// None.
    Bare,
}

/// Which numbers are accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// All above 0.
    Positive,
    /// 0 too.
    NotNegative,
    /// From the first to the second.
    Within(f64, f64),
}

/// A number with a unit.
#[derive(Debug)]
pub struct Number {
    /// Its unit.
    pub unit: Unit,
    /// Which are accepted.
    pub range: Range,
    /// What is said of one out of range, with `{least}` and `{most}`.
    pub fault: &'static str,
    /// An example, and where its dial begins.
    pub such_as: f64,
    /// Its value; none where it is automatic.
    pub get: fn(&Settings) -> Option<f64>,
    /// Makes a value take effect.
    pub set: fn(&mut Settings, f64) -> Result<(), String>,
}

/// A whole number.
#[derive(Debug)]
pub struct Count {
    /// The least that is accepted.
    pub least: usize,
    /// The most that is accepted.
    pub most: usize,
    /// What is said of one out of range, with `{least}` and `{most}`.
    pub fault: &'static str,
    /// An example, and where its dial begins.
    pub such_as: usize,
    /// Its value; none where it is automatic.
    pub get: fn(&Settings) -> Option<usize>,
    /// Makes a value take effect.
    pub set: fn(&mut Settings, usize) -> Result<(), String>,
}

/// On or off.
#[derive(Debug)]
pub struct Switch {
    /// Whether it is on.
    pub get: fn(&Settings) -> bool,
    /// Puts it on or off.
    pub set: fn(&mut Settings, bool) -> Result<(), String>,
}

/// One of some names, or another text.
#[derive(Debug)]
pub struct Text {
    /// The names.
    pub names: fn() -> Vec<&'static str>,
    /// What else is accepted, as the reference says it; nothing where only the names are.
    pub other: &'static str,
    /// An example.
    pub such_as: &'static str,
    /// Its value; none where it is automatic.
    pub get: fn(&Settings) -> Option<String>,
    /// Makes a value take effect.
    pub set: fn(&mut Settings, &str) -> Result<(), String>,
}

/// What is said of most counts.
pub(super) const FROM_TO: &str = "the number must be from {least} to {most}";

impl Kind {
    /// A switch of nothing.
    pub(super) const NONE: Self = Self::Switch(Switch { get: |_| false, set: |_, _| Ok(()) });

    /// Makes a value take effect, if it is accepted.
    pub(super) fn set(&self, settings: &mut Settings, written: &Written) -> Result<(), String> {
        match (self, written) {
            (Self::Number(number), written) => (number.set)(settings, number.read(written)?),
            (Self::Count(count), written) => (count.set)(settings, count.read(written)?),
            (Self::Switch(switch), Written::Switch(is_on)) => (switch.set)(settings, *is_on),
            (Self::Text(text), Written::Text(written)) => (text.set)(settings, written),
            (Self::Text(text), Written::Number(x)) => {
                let error = (text.set)(settings, &x.to_string()).err();
                let error = error.map_or(String::new(), |error| format!(": {error}"));
                Err(format!("write text in quotes instead of {x}{error}"))
            }
            (Self::Switch(_) | Self::Text(_), _) => Err(format!("write {}", self.expected())),
        }
    }

    /// What stands on the command line, as a value.
    pub(super) fn written(&self, text: &str) -> Result<Written, String> {
        let text = text.trim_matches(|c: char| c.is_whitespace() && !matches!(self, Self::Text(_)));
        match self {
            Self::Number(Number { unit: Unit::Length, .. }) | Self::Text(_) => {
                Ok(Written::Text(text.to_owned()))
            }
            Self::Number(Number { unit, such_as, .. }) => {
                let of = if *unit == Unit::Degrees { " of degrees" } else { "" };
                let message = |_| format!("this must be a number{of} such as {such_as}");
                text.parse().map(Written::Number).map_err(message)
            }
            Self::Count(count) => {
                let message = |_| format!("this must be a whole number such as {}", count.such_as);
                text.parse::<u64>().map(|n| Written::Number(n as f64)).map_err(message)
            }
            Self::Switch(_) => {
                text.parse().map(Written::Switch).map_err(|_| "this must be true or false".to_owned())
            }
        }
    }

    /// The value as a text of the command line; none where it is automatic.
    pub(super) fn text(&self, settings: &Settings) -> Option<String> {
        match self {
            Self::Number(number) => (number.get)(settings).map(|x| format!("{x}{}", number.unit.suffix())),
            Self::Count(count) => (count.get)(settings).map(|n| n.to_string()),
            Self::Switch(switch) => Some((switch.get)(settings).to_string()),
            Self::Text(text) => (text.get)(settings),
        }
    }
}

impl Number {
    fn read(&self, written: &Written) -> Result<f64, String> {
        let parse = if self.range == Range::NotNegative { parse_length_or_zero_mm } else { parse_length_mm };
        let length = |text: &str| parse(text).map_err(|error| error.to_string());
        let x = match (self.unit, written) {
            (Unit::Length, Written::Text(text)) => length(text)?,
            (Unit::Length, Written::Number(mm)) => length(&mm.to_string())?,
            (_, Written::Number(x)) => *x,
            (_, other) => return Err(no_number(other)),
        };
        let is_within = match self.range {
            Range::Positive => x > 0.0,
            Range::NotNegative => x >= 0.0,
            Range::Within(least, most) => (least..=most).contains(&x),
        };
        is_within.then_some(x).ok_or_else(|| super::words::with_range(self.fault, self.bounds()))
    }

    /// Least and most, as texts without their unit.
    pub(super) fn bounds(&self) -> [String; 2] {
        match self.range {
            Range::Positive | Range::NotNegative => ["0".to_owned(), String::new()],
            Range::Within(least, most) => [least.to_string(), most.to_string()],
        }
    }
}

impl Count {
    fn read(&self, written: &Written) -> Result<usize, String> {
        let Written::Number(x) = written else { return Err(no_number(written)) };
        if x.fract() != 0.0 || *x < 0.0 {
            return Err(format!("{x} is not a whole number from 0 up"));
        }
        // Numbers that are too large for the type become its largest.
        let count = *x as usize;
        let is_within = (self.least..=self.most).contains(&count);
        is_within.then_some(count).ok_or_else(|| super::words::with_range(self.fault, self.bounds()))
    }

    /// Least and most, as texts.
    pub(super) fn bounds(&self) -> [String; 2] {
        [self.least.to_string(), self.most.to_string()]
    }
}

fn no_number(written: &Written) -> String {
    match written {
        Written::Text(text) => format!("write a number instead of the text \"{text}\""),
        Written::Number(x) => format!("{x} is not a usable number"),
        Written::Switch(is_on) => format!("write a number instead of {is_on}"),
    }
}

impl Unit {
    /// What stands behind the number.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Length => "mm",
            Self::Degrees | Self::Bare => "",
        }
    }
}
