//! Profiles of cutters and media: those of the user, and those that come with the program.

use super::error::AppError;
use super::files;
use std::path::PathBuf;
use tatamu::export::PltOptions;
use tatamu::plotter::profile::{CUTTERS, MEDIA, Profile};
use tatamu::plotter::{Cutter, Media, ProfileError};

/// The machine of these profiles; without a name the usual one.
pub fn machine(cutter: Option<&str>, media: Option<&str>) -> Result<PltOptions, AppError> {
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

fn wrong(name: &str, error: ProfileError) -> AppError {
    AppError::Profile { name: name.to_owned(), error }
}

/// The text of a profile: a file where there is one of that name, else one of the configuration
/// folder, else one that comes with the program.
pub fn find(name: &str, kind: &str, built_in: &[Profile]) -> Result<String, AppError> {
    let own = folder().map(|folder| folder.join(kind).join(format!("{name}.toml")));
    let looks_like_file = name.ends_with(".toml") || name.contains(std::path::MAIN_SEPARATOR);
    let given = looks_like_file.then(|| PathBuf::from(name));
    if let Some(path) = given.or(own.filter(|path| path.is_file())) {
        return files::read_text(&path, "profile");
    }
    let found = built_in.iter().find(|profile| profile.name == name);
    found.map(|profile| profile.text.to_owned()).ok_or_else(|| {
        let names: Vec<&str> = built_in.iter().map(|profile| profile.name).collect();
        let all = if kind == "cutters" { "; \"tatamu cutters\" says what each machine takes" } else { "" };
        AppError::Options(format!(
            "there is no profile \"{name}\" for {kind}; use one of: {}{all}",
            names.join(", ")
        ))
    })
}

/// The user's folder for profiles.
pub fn folder() -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let home = || set("HOME").map(|home| home.join(".config"));
    let base = if cfg!(windows) { set("APPDATA") } else { set("XDG_CONFIG_HOME").or_else(home) };
    base.map(|base| base.join("tatamu"))
}

/// Names of all cutters and of all media, the user's own last.
pub fn names() -> [Vec<String>; 2] {
    [("cutters", CUTTERS), ("media", MEDIA)].map(|(kind, built_in)| {
        let mut names: Vec<String> = built_in.iter().map(|profile| profile.name.to_owned()).collect();
        names.extend(own(kind));
        names
    })
}

/// Names of the user's own profiles.
pub fn own(kind: &str) -> Vec<String> {
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
