//! What the studio remembers between runs: files that were open, and changes that were not saved.

use super::preferences::Preferences;
use crate::app::output;
use crate::app::sources::Sources;
use std::path::{Path, PathBuf};

/// Number of recent files that are kept.
const MOST_RECENT: usize = 10;

/// The studio's folder.
#[derive(Debug, Clone)]
pub struct Store {
    folder: Option<PathBuf>,
}

impl Store {
    /// The store of the user; without a home folder nothing is remembered.
    pub fn of_user() -> Self {
        let set = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let home = || set("HOME").map(|home| home.join(".local/state"));
        let base = if cfg!(windows) { set("LOCALAPPDATA") } else { set("XDG_STATE_HOME").or_else(home) };
        Self { folder: base.map(|base| base.join("tatamu")) }
    }

    /// A store in a folder.
    #[cfg(test)]
    pub fn at(folder: &Path) -> Self {
        Self { folder: Some(folder.to_owned()) }
    }

    /// Files that were open, the last one first, as far as they are still there.
    pub fn recent(&self) -> Vec<PathBuf> {
        let text =
            self.folder.as_ref().and_then(|folder| std::fs::read_to_string(folder.join("recent")).ok());
        let lines = text.iter().flat_map(|text| text.lines()).map(PathBuf::from);
        lines.filter(|path| path.is_file()).take(MOST_RECENT).collect()
    }

    /// Puts a file at the head of the list.
    pub fn add_recent(&self, path: &Path) {
        let path = full(path);
        let mut list = self.recent();
        list.retain(|other| *other != path);
        list.insert(0, path);
        let lines: Vec<String> = list.iter().take(MOST_RECENT).map(|p| p.display().to_string()).collect();
        self.write("recent", lines.join("\n") + "\n");
    }

    /// What the window remembers.
    pub fn preferences(&self) -> Preferences {
        let text =
            self.folder.as_ref().and_then(|folder| std::fs::read_to_string(folder.join("window.toml")).ok());
        text.map_or_else(Preferences::default, |text| Preferences::parse(&text))
    }

    /// Remembers it.
    pub fn set_preferences(&self, preferences: &Preferences) {
        self.write("window.toml", preferences.text());
    }

    /// A folder of its own for files that come with the program, made if need be.
    pub fn samples(&self) -> Option<PathBuf> {
        let folder = self.folder.as_ref()?.join("samples");
        std::fs::create_dir_all(&folder).ok().map(|()| folder)
    }

    /// Whether a file is one that came with the program.
    pub fn is_sample(&self, file: &Path) -> bool {
        self.folder.as_ref().is_some_and(|folder| file.starts_with(folder.join("samples")))
    }

    /// The folder of the book, which [`super::book::write`] makes.
    pub fn book(&self) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join("book"))
    }

    /// Changes to a file that were not saved.
    pub fn recovered(&self, file: &Path) -> Option<String> {
        std::fs::read_to_string(self.folder.as_ref()?.join(unsaved(file))).ok()
    }

    /// Keeps changes to a file until they are saved.
    pub fn keep(&self, file: &Path, text: &str) {
        self.write(&unsaved(file), text.to_owned());
    }

    /// Forgets the changes to a file.
    pub fn forget(&self, file: &Path) {
        if let Some(folder) = &self.folder {
            let _ = std::fs::remove_file(folder.join(unsaved(file)));
        }
    }

    /// An entry that cannot be written does not stop the work.
    fn write(&self, name: &str, text: String) {
        if let Some(folder) = &self.folder {
            let path = folder.join(name);
            let made = path.parent().map(std::fs::create_dir_all);
            if matches!(made, Some(Ok(()))) {
                let _ = output::write(&[(path, text.into_bytes())], &Sources::none());
            }
        }
    }
}

fn full(path: &Path) -> PathBuf {
    path.canonicalize().or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_owned())
}

/// A file's whole name in one: letters, digits, `.` and `-` stay, all else is written in hex.
fn unsaved(file: &Path) -> String {
    let mut name = String::from("unsaved/");
    for byte in full(file).as_os_str().as_encoded_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'.' | b'-' => name.push(char::from(*byte)),
            b'/' => name.push('_'),
            other => name += &format!("%{other:02x}"),
        }
    }
    // File systems allow 255 bytes; the end tells files apart.
    let from = name.len().saturating_sub(200).max("unsaved/".len());
    format!("unsaved/{}", &name[from..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_file_is_the_first_of_the_list() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::at(&folder.path().join("state"));
        assert!(store.recent().is_empty());
        let files = ["a.obj", "b.obj", "c.obj"].map(|name| folder.path().join(name));
        for file in &files {
            std::fs::write(file, "x").unwrap();
            store.add_recent(file);
        }
        store.add_recent(&files[0]);
        std::fs::remove_file(&files[1]).unwrap();
        let names: Vec<_> = store.recent().iter().map(|p| p.file_name().unwrap().to_owned()).collect();
        assert_eq!(names, ["a.obj", "c.obj"]);
    }

    #[test]
    fn unsaved_changes_are_kept_by_file() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::at(folder.path());
        let files = [Path::new("/x/y z.toml"), Path::new("/x_y z.toml")];
        files.iter().for_each(|file| store.keep(file, &file.display().to_string()));
        assert_eq!(store.recovered(files[0]).as_deref(), Some("/x/y z.toml"));
        store.forget(files[0]);
        assert_eq!(store.recovered(files[0]), None);
        assert_eq!(store.recovered(Path::new("/other.toml")), None);
    }
}
