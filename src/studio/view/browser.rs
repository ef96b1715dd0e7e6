//! A dialog for files, where the system has none.

use super::{focus, modal};
use eframe::egui::{self, Context, Key, Ui};
use std::path::{Path, PathBuf};

/// What a file is wanted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// To open it.
    Open,
    /// To save the project in it.
    Save,
    /// To take the profile of a cutter or a medium from it.
    Profile,
    /// To write files in it: it is a folder.
    Folder,
}

impl Purpose {
    /// What the dialog is called.
    pub fn title(self) -> &'static str {
        match self {
            Purpose::Open => "Open a mesh or a project",
            Purpose::Save => "Save the project",
            Purpose::Profile => "Open the profile of a cutter or a medium",
            Purpose::Folder => "Choose a folder",
        }
    }
}

/// What the user did.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Answer {
    /// Nothing yet.
    Open,
    /// Chose a file.
    Chosen(PathBuf),
    /// Chose none.
    Cancelled,
}

/// Files that can be opened, by extension.
pub const KNOWN: [&str; 8] = ["toml", "obj", "stl", "ply", "off", "gltf", "glb", "3mf"];

/// The dialog.
#[derive(Debug)]
pub struct Browser {
    purpose: Purpose,
    folder: PathBuf,
    name: String,
    shows_all: bool,
    entries: Result<Vec<FolderEntry>, String>,
    /// The user was asked whether this file may be replaced.
    replaces: Option<PathBuf>,
}

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct FolderEntry {
    is_file: bool,
    name: String,
}

impl Browser {
    /// A dialog that begins in a folder, with a name.
    pub fn new(purpose: Purpose, folder: Option<PathBuf>, name: &str) -> Self {
        let folder =
            folder.filter(|f| f.is_dir()).or_else(|| std::env::current_dir().ok()).unwrap_or_default();
        let folder = std::path::absolute(&folder).unwrap_or(folder);
        let entries = entries(&folder);
        Self { purpose, folder, name: name.to_owned(), shows_all: false, entries, replaces: None }
    }

    /// What the file is wanted for.
    pub fn purpose(&self) -> Purpose {
        self.purpose
    }

    /// Draws the dialog.
    pub fn show(&mut self, ctx: &Context) -> Answer {
        let mut answer = Answer::Open;
        let shown = modal::new(ctx, "files").show(ctx, |ui| {
            ui.set_width(520.0);
            ui.heading(self.purpose.title());
            answer = self.content(ui);
        });
        if shown.should_close() { Answer::Cancelled } else { answer }
    }

    fn content(&mut self, ui: &mut Ui) -> Answer {
        ui.horizontal(|ui| {
            let parent = self.folder.parent().map(Path::to_owned);
            if ui
                .add_enabled(parent.is_some(), egui::Button::new("Up"))
                .on_hover_text("parent folder")
                .clicked()
            {
                parent.into_iter().for_each(|parent| self.go_to(parent));
            }
            ui.add(egui::Label::new(self.folder.display().to_string()).truncate());
        });
        let mut answer = Answer::Open;
        let height = (ui.ctx().content_rect().height() - 260.0).clamp(120.0, 300.0);
        egui::ScrollArea::vertical().max_height(height).auto_shrink(false).show(ui, |ui| {
            if let Some(chosen) = self.list(ui) {
                answer = self.choose(chosen);
            }
            focus::follow(ui);
        });
        ui.separator();
        if self.purpose == Purpose::Folder {
            return self.choose_folder(ui);
        }
        let mut is_done = false;
        ui.horizontal(|ui| {
            let label = ui.label("File");
            let field =
                ui.add(egui::TextEdit::singleline(&mut self.name).desired_width(260.0)).labelled_by(label.id);
            // The Enter key takes the focus, which comes back where the dialog stays.
            is_done |= field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            modal::focus_once(ui, &field);
            if field.changed() {
                self.replaces = None;
            }
            let word = match (self.purpose, &self.replaces) {
                (Purpose::Open | Purpose::Profile | Purpose::Folder, _) => "Open",
                (Purpose::Save, None) => "Save",
                (Purpose::Save, Some(_)) => "Replace",
            };
            is_done |= ui.add_enabled(!self.name.trim().is_empty(), egui::Button::new(word)).clicked();
            if ui.button("Cancel").clicked() {
                answer = Answer::Cancelled;
            }
            if self.purpose == Purpose::Open {
                ui.checkbox(&mut self.shows_all, "all files");
            }
        });
        if self.replaces.is_some() {
            ui.colored_label(ui.visuals().warn_fg_color, "A file with this name exists.");
        }
        if is_done && !self.name.trim().is_empty() {
            // A whole path may be written, too.
            answer = self.choose(self.folder.join(self.name.trim()));
        }
        answer
    }

    /// Takes the folder whose content is listed.
    fn choose_folder(&self, ui: &mut Ui) -> Answer {
        ui.horizontal(|ui| {
            let choose = ui.button("Choose this folder");
            modal::focus_once(ui, &choose);
            match (choose.clicked(), ui.button("Cancel").clicked()) {
                (true, _) => Answer::Chosen(self.folder.clone()),
                (_, true) => Answer::Cancelled,
                _ => Answer::Open,
            }
        })
        .inner
    }

    /// The folder's content; what was clicked.
    fn list(&mut self, ui: &mut Ui) -> Option<PathBuf> {
        let entries = match &self.entries {
            Ok(entries) => entries.clone(),
            Err(problem) => {
                ui.colored_label(ui.visuals().error_fg_color, problem);
                return None;
            }
        };
        let mut chosen = None;
        let listed: Vec<FolderEntry> = entries.into_iter().filter(|entry| self.is_listed(entry)).collect();
        if listed.is_empty() {
            ui.weak(if self.purpose == Purpose::Folder {
                "no folders in it"
            } else {
                "nothing to choose in it"
            });
        }
        for entry in &listed {
            let text = if entry.is_file { entry.name.clone() } else { format!("{}/", entry.name) };
            let response = ui.selectable_label(entry.is_file && self.name == entry.name, text);
            if response.clicked() {
                if entry.is_file {
                    (self.name, self.replaces) = (entry.name.clone(), None);
                } else {
                    chosen = Some(self.folder.join(&entry.name));
                }
            }
            if response.double_clicked() {
                chosen = Some(self.folder.join(&entry.name));
            }
        }
        chosen
    }

    fn is_listed(&self, entry: &FolderEntry) -> bool {
        let extension = Path::new(&entry.name).extension().map(|e| e.to_ascii_lowercase());
        let among = match self.purpose {
            Purpose::Open => &KNOWN[..],
            Purpose::Save | Purpose::Profile => &KNOWN[..1],
            Purpose::Folder => &[],
        };
        let is_known = extension.is_some_and(|e| among.iter().any(|known| e == *known));
        !entry.name.starts_with('.') && (!entry.is_file || self.shows_all || is_known)
    }

    fn choose(&mut self, path: PathBuf) -> Answer {
        if path.is_dir() {
            self.go_to(path);
            return Answer::Open;
        }
        if self.purpose == Purpose::Save {
            let path = if path.extension().is_none() { path.with_extension("toml") } else { path };
            if path.exists() && self.replaces.as_ref() != Some(&path) {
                self.replaces = Some(path);
                return Answer::Open;
            }
            return Answer::Chosen(path);
        }
        Answer::Chosen(path)
    }

    fn go_to(&mut self, folder: PathBuf) {
        self.entries = entries(&folder);
        if self.purpose == Purpose::Open {
            self.name.clear();
        }
        (self.folder, self.replaces) = (folder, None);
    }
}

/// Folders first, then files, by name.
fn entries(folder: &Path) -> Result<Vec<FolderEntry>, String> {
    let list = std::fs::read_dir(folder).map_err(|error| format!("cannot read this folder: {error}"))?;
    let entry = |entry: std::io::Result<std::fs::DirEntry>| {
        let entry = entry.ok()?;
        Some(FolderEntry { is_file: !entry.path().is_dir(), name: entry.file_name().into_string().ok()? })
    };
    let mut entries: Vec<FolderEntry> = list.filter_map(entry).collect();
    entries.sort();
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_only_when_asked_twice() {
        let folder = tempfile::tempdir().unwrap();
        let old = folder.path().join("a.toml");
        std::fs::write(&old, "x").unwrap();
        let mut browser = Browser::new(Purpose::Save, Some(folder.path().to_owned()), "a.toml");
        assert_eq!(browser.choose(old.clone()), Answer::Open);
        assert_eq!(browser.choose(old.clone()), Answer::Chosen(old));
        let new = folder.path().join("b");
        assert_eq!(browser.choose(new.clone()), Answer::Chosen(new.with_extension("toml")));
    }

    #[test]
    fn only_what_can_be_opened_is_listed() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.OBJ", "a.txt", ".hidden.obj", "c.toml"] {
            std::fs::write(folder.path().join(name), "x").unwrap();
        }
        std::fs::create_dir(folder.path().join("z")).unwrap();
        let browser = Browser::new(Purpose::Open, Some(folder.path().to_owned()), "");
        let entries = browser.entries.clone().unwrap();
        let listed: Vec<&str> =
            entries.iter().filter(|e| browser.is_listed(e)).map(|e| e.name.as_str()).collect();
        assert_eq!(listed, ["z", "b.OBJ", "c.toml"]);
    }
}
