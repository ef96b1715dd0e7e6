//! Force and speed: the settings of a machine for grams or millimetres per second.

use super::fields::{Positive, Template};
use serde::Deserialize;

/// A setting of the machine, such as its force, and the command for it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(try_from = "LevelTable")]
pub struct Level {
    command: String,
    per_unit: f64,
    range: [u32; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LevelTable {
    command: Template,
    per_unit: Positive,
    range: [u32; 2],
}

impl TryFrom<LevelTable> for Level {
    type Error = String;

    fn try_from(table: LevelTable) -> Result<Self, String> {
        let [least, most] = table.range;
        let message = "the range must go from the least to the greatest number of the command";
        let level = Self { command: table.command.0, per_unit: table.per_unit.0, range: table.range };
        (least <= most).then_some(level).ok_or_else(|| message.to_owned())
    }
}

impl Level {
    /// The command for a value in grams or mm/s, by the nearest step that the machine has, and
    /// whether that step is within its range.
    pub fn command(&self, value: f64) -> (String, bool) {
        let wish = (value * self.per_unit).round();
        let [least, most] = self.range.map(f64::from);
        let step = wish.clamp(least, most);
        (self.command.replace("{}", &step.to_string()), step == wish)
    }

    /// What a command of a job sets in grams or mm/s: none inside where it sets the machine's own
    /// choice, none at all where it is another command.
    pub fn read(&self, command: &[u8]) -> Option<Option<f64>> {
        let head = self.command.split("{}").next().unwrap_or_default().trim_start();
        let command = std::str::from_utf8(command).ok()?.trim_start_matches([';', ' ', '\r', '\n', '\t']);
        let name = command.get(..head.len()).filter(|name| name.eq_ignore_ascii_case(head))?;
        let rest = command[name.len()..].trim_start();
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let step: Option<f64> = rest[..digits].parse().ok();
        Some(step.filter(|&step| step > 0.0).map(|step| step / self.per_unit))
    }
}
