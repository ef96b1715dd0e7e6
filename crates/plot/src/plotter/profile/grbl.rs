//! What a session with GRBL needs to know beforehand.

use serde::Deserialize;
use std::collections::BTreeMap;

/// How a session with GRBL begins and pauses.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "GrblTable")]
pub struct Grbl {
    homes: bool,
    holds: bool,
    settings: Vec<(u16, i32)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GrblTable {
    home: bool,
    hold: bool,
    #[serde(default)]
    settings: BTreeMap<String, i32>,
}

impl TryFrom<GrblTable> for Grbl {
    type Error = String;

    fn try_from(table: GrblTable) -> Result<Self, String> {
        let number = |(name, value): (String, i32)| {
            let number = name.strip_prefix('$').and_then(|n| n.parse().ok());
            number
                .map(|n| (n, value))
                .ok_or_else(|| format!("\"{name}\" is not a setting; write it as \"$32\""))
        };
        let settings = table.settings.into_iter().map(number).collect::<Result<_, _>>()?;
        Ok(Self { homes: table.home, holds: table.hold, settings })
    }
}

impl Grbl {
    /// Whether the machine homes (`$H`) before each sheet.
    pub(crate) fn homes(&self) -> bool {
        self.homes
    }

    /// Whether a pause stops at once, the tool as it is, instead of lifting it first: right for a laser, whose
    /// beam is off at rest.
    pub fn holds(&self) -> bool {
        self.holds
    }

    /// Settings that the machine must have, or nothing is sent.
    pub fn settings(&self) -> &[(u16, i32)] {
        &self.settings
    }
}
