//! `tatamu completions` and `tatamu man`: the command line for shells and manuals.

use crate::app::error::AppError;
use crate::app::output;
use crate::app::sources::Sources;
use clap::{Args, Command};
use clap_complete::Shell;
use std::io::Write;
use std::path::PathBuf;

/// Prints a completion script for a shell.
///
/// With bash: tatamu completions bash > ~/.local/share/bash-completion/completions/tatamu
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// Shell to complete commands in
    shell: Shell,
}

/// Writes manual pages: one for the program, one for each command.
///
/// Example: tatamu man ~/.local/share/man/man1, then man tatamu-make
#[derive(Debug, Args)]
pub struct ManArgs {
    /// Existing folder for the pages
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

/// Prints the script for `command`.
pub fn completions(args: &CompletionsArgs, mut command: Command) {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command, "tatamu", &mut script);
    // A closed pipe is no error.
    let _ = std::io::stdout().write_all(&script);
}

/// Writes the pages of `command` and its subcommands.
pub fn man(args: &ManArgs, mut command: Command) -> Result<(), AppError> {
    // Fills in what subcommands inherit, and their full names.
    command.build();
    let commands =
        std::iter::once(&command).chain(command.get_subcommands().filter(|c| c.get_name() != "help"));
    let page = |command: &Command| {
        let name = command.get_display_name().unwrap_or(command.get_name()).to_owned();
        let path = args.folder.join(format!("{name}.1"));
        let mut bytes = Vec::new();
        match clap_mangen::Man::new(command.clone()).render(&mut bytes) {
            Ok(()) => Ok((path, bytes)),
            Err(error) => Err(AppError::Output { path, reason: error.to_string() }),
        }
    };
    let pages = commands.map(page).collect::<Result<Vec<_>, _>>()?;
    let paths: Vec<PathBuf> = pages.iter().map(|p| p.0.clone()).collect();
    output::check_places(&paths, &Sources::none())?;
    output::write(&pages, &Sources::none())
}
