//! What a sheet is made of, and how hard and fast it is worked.

use super::fields::{Dashes, Overcut, Passes, Percent, Positive};
use super::{ProfileError, check_unverified};
use crate::toolpath::{Operation, Tooling, ToolingError};
use serde::Deserialize;

/// How one operation is done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Work {
    force_g: Option<f64>,
    speed_mm_s: Option<f64>,
    power_percent: Option<f64>,
    /// Passes, overcut and perforation; the blade is the machine's.
    tooling: Tooling,
}

impl Work {
    /// Force on the tool, grams.
    pub(crate) fn force_g(&self) -> Option<f64> {
        self.force_g
    }

    /// Speed with the tool down, mm/s.
    pub fn speed_mm_s(&self) -> Option<f64> {
        self.speed_mm_s
    }

    /// Power of a laser, percent of its most.
    pub fn power_percent(&self) -> Option<f64> {
        self.power_percent
    }

    /// Overcut, passes and perforation.
    pub fn tooling(&self) -> &Tooling {
        &self.tooling
    }
}

/// A medium.
#[derive(Debug, Clone, PartialEq)]
pub struct Media {
    name: String,
    description: String,
    unverified: Vec<String>,
    work: [Work; Operation::ALL.len()],
}

impl Media {
    /// Reads a profile.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn parse(text: &str) -> Result<Self, ProfileError> {
        let file: MediaFile = toml::from_str(text)?;
        check_unverified(text, &file.unverified)?;
        let work = [file.pen.0, file.crease.0, file.fold_hinge.0, file.cut.0];
        Ok(Self { name: file.name, description: file.description, unverified: file.unverified, work })
    }

    /// Name for people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What it is and what to mind.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Fields that nobody has tried on a machine.
    pub fn unverified(&self) -> &[String] {
        &self.unverified
    }

    /// How an operation is done.
    pub fn work(&self, operation: Operation) -> &Work {
        &self.work[operation as usize]
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct MediaFile {
    name: String,
    description: String,
    #[serde(default)]
    unverified: Vec<String>,
    pen: WorkField,
    crease: WorkField,
    fold_hinge: WorkField,
    cut: WorkField,
}

#[derive(Deserialize)]
#[serde(try_from = "WorkTable")]
struct WorkField(Work);

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WorkTable {
    force_g: Option<Positive>,
    speed_mm_s: Option<Positive>,
    power_percent: Option<Percent>,
    #[serde(default)]
    passes: Passes,
    #[serde(default)]
    overcut_mm: Overcut,
    perforation_mm: Option<Dashes>,
}

impl TryFrom<WorkTable> for WorkField {
    type Error = ToolingError;

    fn try_from(table: WorkTable) -> Result<Self, ToolingError> {
        let mut tooling = Tooling::new(0.0, table.overcut_mm.0, table.passes.0)?;
        if let Some(dashes) = table.perforation_mm {
            tooling = tooling.perforating(dashes.0);
        }
        let number = |value: Option<Positive>| value.map(|v| v.0);
        let (force_g, speed_mm_s) = (number(table.force_g), number(table.speed_mm_s));
        let power_percent = table.power_percent.map(|percent| percent.0);
        Ok(Self(Work { force_g, speed_mm_s, power_percent, tooling }))
    }
}
