//! `tatamu studio`, with or without the window.

use crate::app::error::AppError;
use clap::Args;
use std::path::PathBuf;

/// Opens a window to change settings and see the model change.
///
/// It shows the model in 3D, its folding and its sheets, exports files, and drives the cutter. It
/// reads and writes the same project files as the command line.
#[derive(Debug, Args)]
pub struct StudioArgs {
    /// Mesh or project file to open
    #[arg(value_name = "INPUT")]
    input: Option<PathBuf>,
}

/// Runs the command.
#[cfg(feature = "studio")]
pub fn run(args: &StudioArgs) -> Result<(), AppError> {
    crate::studio::run(args.input.clone())
}

/// Says how to get a program with the window.
#[cfg(not(feature = "studio"))]
pub fn run(args: &StudioArgs) -> Result<(), AppError> {
    let input = args.input.as_deref().map(|path| format!(" {}", path.display())).unwrap_or_default();
    Err(AppError::Options(format!(
        "this build has no studio; build it with: cargo run --release --features studio -- studio{input}"
    )))
}
