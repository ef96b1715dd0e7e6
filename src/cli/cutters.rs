//! `tatamu profiles`, and the profiles of a cutter and a medium.

use super::error::{CliError, reason};
use super::terminal;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};
use tatamu::export::PltOptions;
use tatamu::plotter::profile::{CUTTERS, MEDIA, Profile};
use tatamu::plotter::{Cutter, Media, ProfileError};

/// The machine of these profiles; without a name the usual one.
pub fn machine(cutter: Option<&str>, media: Option<&str>) -> Result<PltOptions, CliError> {
    let mut choice = PltOptions::default();
    if let Some(name) = cutter {
        let text = find(name, "cutters", CUTTERS)?;
        choice.cutter = Cutter::parse(&text).map_err(|error| wrong(name, error))?;
    }
    if let Some(name) = media {
        let text = find(name, "media", MEDIA)?;
        choice.media = Media::parse(&text).map_err(|error| wrong(name, error))?;
    }
    Ok(choice)
}

fn wrong(name: &str, error: ProfileError) -> CliError {
    CliError::Profile { name: name.to_owned(), error }
}

/// The text of a profile: a file where there is one of that name, else one of the configuration
/// folder, else one that comes with the program.
fn find(name: &str, kind: &str, built_in: &[Profile]) -> Result<String, CliError> {
    let own = folder().map(|folder| folder.join(kind).join(format!("{name}.toml")));
    let looks_like_file = name.ends_with(".toml") || name.contains(std::path::MAIN_SEPARATOR);
    let given = looks_like_file.then(|| PathBuf::from(name));
    if let Some(path) = given.or(own.filter(|path| path.is_file())) {
        return std::fs::read_to_string(&path)
            .map_err(|error| CliError::Input { path: path.clone(), reason: reason(&error) });
    }
    let found = built_in.iter().find(|profile| profile.name == name);
    found.map(|profile| profile.text.to_owned()).ok_or_else(|| {
        let names: Vec<&str> = built_in.iter().map(|profile| profile.name).collect();
        CliError::Options(format!(
            "there is no profile \"{name}\" in {kind}; there are: {}",
            names.join(", ")
        ))
    })
}

/// The user's folder for profiles.
fn folder() -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let home = || set("HOME").map(|home| home.join(".config"));
    let base = if cfg!(windows) { set("APPDATA") } else { set("XDG_CONFIG_HOME").or_else(home) };
    base.map(|base| base.join("tatamu"))
}

/// Lists and shows profiles of cutters and media.
#[derive(Debug, Args)]
pub struct ProfilesArgs {
    #[command(subcommand)]
    command: ProfilesCommand,
}

#[derive(Debug, Subcommand)]
enum ProfilesCommand {
    /// Names all profiles, your own too
    List,
    /// Prints a profile, to read or to begin your own with
    Show {
        /// Name of a cutter or a medium, such as generic-hpgl
        name: String,
    },
    /// Prints the folder for your own profiles
    Path,
}

/// Runs `tatamu profiles`.
pub fn run(args: &ProfilesArgs) -> Result<(), CliError> {
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
                CliError::Options(reason) if kind == "cutters" && !name.contains('.') => {
                    let names: Vec<&str> = MEDIA.iter().map(|profile| profile.name).collect();
                    CliError::Options(format!("{reason}; media are: {}", names.join(", ")))
                }
                error => error,
            };
            terminal::say(find(name, kind, built_in).map_err(other)?.trim_end());
        }
        ProfilesCommand::Path => {
            let folder = folder().ok_or_else(|| {
                CliError::Options("there is no home folder; give a file to --cutter and --media".to_owned())
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
        terminal::say(&format!("  {:<16} {}", profile.name, name.unwrap_or_default()));
    }
    own("cutters").iter().for_each(|name| terminal::say(&format!("  {name:<16} your own")));
    terminal::say("media (--media):");
    for profile in MEDIA {
        let name = Media::parse(profile.text).map(|media| media.name().to_owned());
        terminal::say(&format!("  {:<16} {}", profile.name, name.unwrap_or_default()));
    }
    own("media").iter().for_each(|name| terminal::say(&format!("  {name:<16} your own")));
}

/// Names of all cutters and of all media, the user's own last.
#[cfg(feature = "studio")]
pub fn names() -> [Vec<String>; 2] {
    [("cutters", CUTTERS), ("media", MEDIA)].map(|(kind, built_in)| {
        let mut names: Vec<String> = built_in.iter().map(|profile| profile.name.to_owned()).collect();
        names.extend(own(kind));
        names
    })
}

/// Names of the user's own profiles.
fn own(kind: &str) -> Vec<String> {
    let files = folder().and_then(|folder| std::fs::read_dir(folder.join(kind)).ok());
    let name = |path: PathBuf| {
        let is_profile = path.extension().is_some_and(|e| e == "toml");
        path.file_stem().filter(|_| is_profile).map(|stem| stem.to_string_lossy().into_owned())
    };
    let mut names: Vec<String> =
        files.into_iter().flatten().filter_map(|entry| name(entry.ok()?.path())).collect();
    names.sort();
    names
}
