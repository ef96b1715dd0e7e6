//! Single values of profiles.

use crate::plotter::{Direction, Origin, Ratio};
use crate::toolpath::{Perforation, Tooling, ToolingError};
use serde::Deserialize;

/// A number above 0.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct Positive(pub f64);

impl TryFrom<f64> for Positive {
    type Error = String;

    fn try_from(x: f64) -> Result<Self, String> {
        let is_usable = x > 0.0 && x <= 1e6;
        is_usable.then_some(Self(x)).ok_or_else(|| format!("{x} is not a usable size; use a number above 0"))
    }
}

/// A share of the most that a machine has, percent.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct Percent(pub f64);

impl TryFrom<f64> for Percent {
    type Error = String;

    fn try_from(x: f64) -> Result<Self, String> {
        (x > 0.0 && x <= 100.0)
            .then_some(Self(x))
            .ok_or_else(|| format!("{x} is not a power from 0 to 100 percent"))
    }
}

/// Distance from the shaft's axis to the blade's tip, mm.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct BladeOffset(pub f64);

impl TryFrom<f64> for BladeOffset {
    type Error = ToolingError;

    fn try_from(mm: f64) -> Result<Self, ToolingError> {
        Tooling::new(mm, 0.0, 1).map(|_| Self(mm))
    }
}

/// How far closed lines are followed past their start, mm.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct Overcut(pub f64);

impl TryFrom<f64> for Overcut {
    type Error = ToolingError;

    fn try_from(mm: f64) -> Result<Self, ToolingError> {
        Tooling::new(0.0, mm, 1).map(|_| Self(mm))
    }
}

/// Number of passes.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "u32")]
pub(super) struct Passes(pub u32);

impl Default for Passes {
    fn default() -> Self {
        Self(1)
    }
}

impl TryFrom<u32> for Passes {
    type Error = ToolingError;

    fn try_from(passes: u32) -> Result<Self, ToolingError> {
        Tooling::new(0.0, 0.0, passes).map(|_| Self(passes))
    }
}

/// Length of dashes and gaps, mm.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "[f64; 2]")]
pub(super) struct Dashes(pub Perforation);

impl TryFrom<[f64; 2]> for Dashes {
    type Error = ToolingError;

    fn try_from([dash_mm, gap_mm]: [f64; 2]) -> Result<Self, ToolingError> {
        Perforation::new(dash_mm, gap_mm).map(Self)
    }
}

/// A ratio written as "n" or "n/d".
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct RatioText(pub Ratio);

impl TryFrom<String> for RatioText {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let ratio = Ratio::parse(&text);
        ratio
            .map(Self)
            .ok_or_else(|| format!("\"{text}\" is not a ratio; write it as \"40\" or \"5105/127\""))
    }
}

/// The name of a dialect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub(super) enum DialectName {
    Hpgl,
    Gpgl,
    Dmpl,
    Gcode,
    Ebb,
}

impl TryFrom<String> for DialectName {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        match name.as_str() {
            "hpgl" => Ok(Self::Hpgl),
            "gpgl" => Ok(Self::Gpgl),
            "dmpl" => Ok(Self::Dmpl),
            "gcode" => Ok(Self::Gcode),
            "ebb" => Ok(Self::Ebb),
            _ => Err(format!("\"{name}\" is not a dialect; use hpgl, gpgl, dmpl, gcode or ebb")),
        }
    }
}

/// Text that is sent as it is. Newlines and control characters are written as in any TOML string.
#[derive(Debug, Clone, PartialEq, Eq, Default, Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Ascii(pub String);

impl TryFrom<String> for Ascii {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let is_usable = text.is_ascii() && text.len() <= 200;
        let message = "a command has at most 200 characters, all ASCII";
        is_usable.then_some(Self(text)).ok_or_else(|| message.to_owned())
    }
}

/// A command with `{}` in the place of its number.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "Ascii")]
pub(super) struct Template(pub String);

impl TryFrom<Ascii> for Template {
    type Error = String;

    fn try_from(text: Ascii) -> Result<Self, String> {
        let is_usable = text.0.matches("{}").count() == 1;
        let message = format!("\"{}\" needs {{}} once, where the number goes, such as \"FS{{}};\"", text.0);
        is_usable.then_some(Self(text.0)).ok_or(message)
    }
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case", remote = "Origin")]
pub(super) enum OriginName {
    LowerLeft,
    LowerRight,
    UpperLeft,
    UpperRight,
    Centre,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case", remote = "Direction")]
pub(super) enum DirectionName {
    Right,
    Up,
    Left,
    Down,
}
