//! Options of the sheets.

use clap::Args;
use tatamu::net::Side;
use tatamu::project::{Sheets, check_effort, parse_marks, parse_side};
use tatamu::sheet::fit::Rotation;
use tatamu::sheet::{Calibration, Registration, SheetChoices};
use tatamu::units::parse_length_or_zero_mm;

/// How sheets are filled and printed.
#[derive(Debug, Clone, Default, Args)]
pub struct SheetArgs {
    /// Printed side of the paper: outside or inside [default: outside]
    ///
    /// Printed on the inside, pieces are mirrored, no line can be seen on the finished model, and
    /// creases fold towards you. Example: --side inside
    #[arg(long, help_heading = "Sheets", value_name = "SIDE", value_parser = parse_side)]
    side: Option<Side>,

    /// Turns pieces by multiples of 90 degrees only, for paper with a grain
    #[arg(long, help_heading = "Sheets", value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    grain: Option<bool>,

    /// Least distance between pieces [default: 2mm]
    ///
    /// Example: --spacing 4mm
    #[arg(long, help_heading = "Sheets", value_name = "LENGTH", value_parser = parse_length_or_zero_mm)]
    spacing: Option<f64>,

    /// How long to look for fewer sheets: pieces placed in trials [default: 2000]
    ///
    /// Ten times the number takes ten times as long and saves a sheet now and then; 0 is quick.
    /// The same number gives the same sheets on any machine. Example: --effort 20000
    #[arg(long, help_heading = "Sheets", value_name = "N", value_parser = effort)]
    effort: Option<usize>,

    /// Registration marks for a cutter: none, silhouette or corners [default: none]
    ///
    /// silhouette: the square and the two corners that Silhouette cutters look for; the border
    /// grows to 18 mm. corners: four corners to align by eye. Example: --marks silhouette
    #[arg(long, help_heading = "Sheets", value_name = "KIND", value_parser = marks)]
    marks: Option<Marks>,

    /// Corrects a printer's scale: the measured lengths of the two bars of 100 mm
    ///
    /// Print a page, measure the level bar (X) and the upright bar in the left margin (Y), and
    /// print again with what you found. Example: --calibrate X:97.3,Y:100.1
    #[arg(long, help_heading = "Sheets", value_name = "X:MM,Y:MM", value_parser = Calibration::parse)]
    calibrate: Option<Calibration>,
}

/// The registration marks that were chosen; a type of its own, since clap reads an `Option` as a
/// flag that may be absent.
#[derive(Debug, Clone, Copy)]
struct Marks(Option<Registration>);

fn marks(text: &str) -> Result<Marks, String> {
    parse_marks(text).map(Marks)
}

fn effort(text: &str) -> Result<usize, String> {
    let message = |_| "this must be a whole number such as 20000".to_owned();
    text.trim().parse().map_err(message).and_then(check_effort)
}

impl SheetArgs {
    /// Changes `choices` by the project's table, then by the flags.
    pub fn merge(&self, table: Option<&Sheets>, choices: &mut SheetChoices) {
        let table = table.cloned().unwrap_or_default();
        choices.side = self.side.or(table.side).unwrap_or(choices.side);
        choices.spacing_mm = self.spacing.or(table.spacing_mm).unwrap_or(choices.spacing_mm);
        choices.effort = self.effort.or(table.effort).unwrap_or(choices.effort);
        let registration = self.marks.map(|m| m.0).or(table.marks);
        choices.registration = registration.unwrap_or(choices.registration);
        choices.calibration = self.calibrate.or(table.calibrate).unwrap_or(choices.calibration);
        choices.rotation = match self.grain.or(table.grain) {
            Some(true) => Rotation::QuarterTurns,
            Some(false) => Rotation::Free,
            None => choices.rotation,
        };
    }
}
