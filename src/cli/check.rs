//! `tatamu check`

use super::terminal;
use crate::app::error::AppError;
use crate::app::files;
use crate::app::text::printable;
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;
use tatamu::check::{self, Limits, Verdict};
use tatamu::units::parse_length_or_zero_mm;

/// Checks a FOLD file: folds it again from its own numbers and measures the result.
///
/// It checks that panels stay rigid in every state, that labelled edges meet, that chains close
/// without a gap, and that nothing overlaps in the crease pattern or in the flat layers. It prints a
/// table; the exit code is 1 if a check fails.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// FOLD file from "tatamu make -o FILE.fold"
    #[arg(value_name = "FILE.fold")]
    file: PathBuf,

    /// Least width and height of side panels that passes [default: 3mm]
    ///
    /// 0mm accepts all. Example: --min-panel-width 4mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_length_or_zero_mm)]
    min_panel_width: Option<f64>,

    /// Prints failed checks only
    #[arg(short, long)]
    quiet: bool,
}

/// Runs the command.
pub fn run(args: &CheckArgs) -> Result<ExitCode, AppError> {
    let path = args.file.clone();
    let bytes = files::read_file(&args.file)?;
    let report = check::fold(&bytes).map_err(|error| AppError::Check { path, error })?;
    let limits = Limits::default();
    let least = args.min_panel_width.unwrap_or(limits.min_panel_mm);
    let verdicts = report.verdicts(&Limits { min_panel_mm: least, ..limits });
    let failed = verdicts.iter().filter(|v| !v.passes).count();
    for verdict in verdicts.iter().filter(|v| !args.quiet || !v.passes) {
        terminal::say(&line(verdict));
    }
    if !args.quiet {
        terminal::say(&match failed {
            0 => "all checks passed".to_owned(),
            n => format!("{n} of {} checks failed", verdicts.len()),
        });
    }
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn line(verdict: &Verdict) -> String {
    let word = if verdict.passes { "ok  " } else { "FAIL" };
    let found = printable(&verdict.found);
    format!("{word}  {:<24}{found:<28}{}", verdict.name, verdict.allowed)
}
