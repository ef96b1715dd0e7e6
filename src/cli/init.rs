//! `tatamu init`

use super::flags::{Flags, OfModel};
use super::progress::TerminalProgress;
use super::terminal;
use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::fit::fitted;
use crate::app::make::Timed;
use crate::app::project::{components, mesh_from, project_text};
use crate::app::sources::Sources;
use crate::app::{input, names, output};
use clap::Args;
use std::path::PathBuf;

/// Writes a project file for a mesh; edit it, then run "make" on it.
///
/// The file has all keys with comments, and a table for each component. Options on this command
/// line become its values.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct InitArgs {
    /// Mesh (OBJ, STL, PLY, OFF, glTF, GLB, 3MF)
    ///
    /// tatamu divides it into components, so that the project file can list them by name.
    #[arg(value_name = "MESH")]
    mesh: PathBuf,

    /// Project file to write [default: the mesh's name with .toml]
    ///
    /// Only --force replaces an existing file. Example: -o projects/teddy.toml
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,

    /// Replaces an existing project file
    #[arg(long)]
    force: bool,

    #[command(flatten)]
    model: Flags<OfModel>,

    /// Prints warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  tatamu init teddy.obj
  tatamu init teddy.obj --parts 6 --size 30cm -o projects/teddy.toml
  tatamu make projects/teddy.toml";

/// Runs the command.
pub fn run(args: &InitArgs) -> Result<(), AppError> {
    let path = match &args.output {
        Some(path) => path.clone(),
        None => names::default(&args.mesh, "toml"),
    };
    let sources = Sources::of([args.mesh.as_path()]);
    output::check_places(std::slice::from_ref(&path), &sources)?;
    if path.is_file() && !args.force {
        return Err(AppError::Output { path, reason: "it exists; use --force to replace it".to_owned() });
    }
    let input = input::read(&args.mesh)?;
    if input.project.is_some() {
        return Err(AppError::Options(format!(
            "{0} is already a project file; edit it, then run: tatamu make {0}",
            args.mesh.display()
        )));
    }
    let choice = Choice::of_input(&input, args.model.given())?;
    let progress = TerminalProgress::new(args.quiet);
    // The project keeps the size and the limit of sheets; "make" finds the size that fits.
    let (carded, result) = fitted(&input, choice.clone().of_any_sheets(), &progress)?;
    progress.finish();
    let components = components(&result, carded.options());
    let mesh = mesh_from(&path, &input.mesh_path)?;
    let text = project_text(&mesh, choice.settings(), result.merges(), &components);
    output::write(&[(path.clone(), text.into_bytes())], &sources)?;
    if !args.quiet {
        let line = format!("wrote {}; edit it, then run: tatamu make {0}", path.display());
        terminal::say_of_files(std::iter::once(path.as_path()), &line);
    }
    Ok(())
}
