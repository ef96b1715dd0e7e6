//! `tatamu profiles`

use super::terminal;
use crate::app::error::AppError;
use crate::app::profiles::{find, folder, own};
use clap::{Args, Subcommand};
use std::path::Path;
use tatamu::plotter::profile::{CUTTERS, MEDIA};
use tatamu::plotter::{Cutter, Media};

/// Lists and prints the profiles of cutters and media.
#[derive(Debug, Args)]
pub struct ProfilesArgs {
    #[command(subcommand)]
    command: ProfilesCommand,
}

#[derive(Debug, Subcommand)]
enum ProfilesCommand {
    /// Lists all profiles, including your own
    List,
    /// Prints a profile, to read or as a start for your own
    Show {
        /// Name of a cutter or a medium, such as generic-hpgl
        name: String,
    },
    /// Prints the folders for your own profiles
    Path,
}

/// Runs `tatamu profiles`.
pub fn run(args: &ProfilesArgs) -> Result<(), AppError> {
    match &args.command {
        ProfilesCommand::List => list(),
        ProfilesCommand::Show { name } => {
            let is_media = MEDIA.iter().any(|profile| profile.name == *name);
            let has_own = |folder: &Path| folder.join("media").join(format!("{name}.toml")).is_file();
            let (kind, built_in) = match is_media || folder().is_some_and(|folder| has_own(&folder)) {
                true => ("media", MEDIA),
                false => ("cutters", CUTTERS),
            };
            let other = |error| match error {
                AppError::Options(reason) if kind == "cutters" && !name.contains('.') => {
                    let names: Vec<&str> = MEDIA.iter().map(|profile| profile.name).collect();
                    AppError::Options(format!("{reason}; or one for media: {}", names.join(", ")))
                }
                error => error,
            };
            terminal::say(find(name, kind, built_in).map_err(other)?.trim_end());
        }
        ProfilesCommand::Path => {
            let folder = folder().ok_or_else(|| {
                AppError::Options("found no home folder; give files to --cutter and --media".to_owned())
            })?;
            terminal::say(&format!("{}", folder.join("cutters").display()));
            terminal::say(&format!("{}", folder.join("media").display()));
        }
    }
    Ok(())
}

fn list() {
    terminal::say("cutters (--cutter):");
    for profile in CUTTERS {
        let name = Cutter::parse(profile.text).map(|cutter| cutter.name().to_owned());
        terminal::say(&format!("  {:<19} {}", profile.name, name.unwrap_or_default()));
    }
    own("cutters").iter().for_each(|name| terminal::say(&format!("  {name:<19} (yours)")));
    terminal::say("media (--media):");
    for profile in MEDIA {
        let name = Media::parse(profile.text).map(|media| media.name().to_owned());
        terminal::say(&format!("  {:<19} {}", profile.name, name.unwrap_or_default()));
    }
    own("media").iter().for_each(|name| terminal::say(&format!("  {name:<19} (yours)")));
}
