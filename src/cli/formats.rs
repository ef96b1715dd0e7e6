//! `tatamu formats`

use super::terminal;
use crate::app::choice::style_names;
use clap::Args;
use tatamu::export::FORMATS;

/// Lists the output formats and line styles.
#[derive(Debug, Args)]
pub struct FormatsArgs {}

/// Runs `tatamu formats`.
pub fn run(_: &FormatsArgs) {
    terminal::say(&list());
    terminal::say(&format!("Line styles of --style: {}, or a file", style_names()));
}

/// One line for each format: extensions and description.
pub fn list() -> String {
    let lines = FORMATS.iter().map(|format| {
        let extensions = format.extensions.join(", .");
        format!("  .{extensions:<8} {}\n", format.description)
    });
    format!("Formats of -o, chosen by the extension:\n{}", lines.collect::<String>())
}
