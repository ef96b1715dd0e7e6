//! Options of the pieces.

use clap::Args;
use tatamu::net::NetChoices;
use tatamu::project::{Nets, check_hidden_degrees};

/// What is drawn on pieces, and whether large ones are split.
#[derive(Debug, Clone, Default, Args)]
pub struct NetArgs {
    /// Refuses panels that are larger than the sheet, rather than split them
    ///
    /// The message names the largest --size that needs no splitting. Without it such a panel is
    /// made of parts with tabs and labels, to be glued together first.
    #[arg(long, help_heading = "Pieces", value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    no_split: Option<bool>,

    /// Draws where each tab comes to lie behind its mate
    #[arg(long, help_heading = "Pieces", value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    glue_marks: Option<bool>,

    /// Writes beside each crease, where there is room, by how many degrees it is folded
    ///
    /// The angle is that of the standing model; 0° is flat paper.
    #[arg(long, help_heading = "Pieces", value_name = "BOOL", num_args = 0..=1, default_missing_value = "true", require_equals = true)]
    angles: Option<bool>,

    /// Leaves out creases that are folded by less, in degrees [default: 0]
    ///
    /// The angle is that of the standing model. Creases that fold flat are always drawn.
    /// Example: --hide-below 3
    #[arg(long, help_heading = "Pieces", value_name = "DEGREES", value_parser = degrees)]
    hide_below: Option<f64>,
}

fn degrees(text: &str) -> Result<f64, String> {
    let message = |_| "this must be a number of degrees such as 3".to_owned();
    text.trim().parse().map_err(message).and_then(check_hidden_degrees)
}

impl NetArgs {
    /// Changes `choices` by the project's table, then by the flags.
    pub fn merge(&self, table: Option<&Nets>, choices: &mut NetChoices) {
        let table = table.cloned().unwrap_or_default();
        let may_split = self.no_split.map(|no| !no).or(table.split);
        choices.may_split = may_split.unwrap_or(choices.may_split);
        choices.glue_marks = self.glue_marks.or(table.glue_marks).unwrap_or(choices.glue_marks);
        choices.angles = self.angles.or(table.angles).unwrap_or(choices.angles);
        let hide_below = self.hide_below.or(table.hide_below_deg).map(f64::to_radians);
        choices.hide_below_rad = hide_below.unwrap_or(choices.hide_below_rad);
    }
}
