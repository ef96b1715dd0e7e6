//! Files: what is opened, read again, saved and printed.

use super::super::book;
use super::super::document::Document;
use super::super::messages::Cause;
use super::super::opened::Opened;
use super::super::watch::Watch;
use super::Studio;
use crate::app::sources::Sources;
use crate::app::{output, project};
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl Studio {
    /// Begins to write the sheets to be printed; then [`Studio::take_printed`] tells where they are.
    pub fn print(&mut self) {
        self.messages.clear(Cause::Export);
        let Some(output) = self.finished().cloned() else { return };
        if let (Some(opened), Some(document)) = (&self.opened, &self.document) {
            self.tasks.print(opened.clone(), document.project(), output);
        }
    }

    /// Sheets that were written to be printed, once.
    pub fn take_printed(&mut self) -> Option<PathBuf> {
        self.printed.take()
    }

    /// Begins to read a file.
    pub fn open(&mut self, path: &Path) {
        self.drops_changes = false;
        self.messages.clear(Cause::Opening);
        self.tasks.open(path);
    }

    /// The same; once the file is read, unsaved changes of the one before are dropped for good.
    pub fn open_and_discard(&mut self, path: &Path) {
        self.open(path);
        self.drops_changes = true;
    }

    /// Shows a file, with its unsaved changes of the last session.
    pub(in super::super) fn show(&mut self, opened: Opened) {
        let path = opened.is_project.then(|| opened.source.clone());
        let mut document = match Document::new(opened.text.clone(), path) {
            Ok(document) => document,
            Err(problem) => return self.messages.warn(Cause::Opening, problem),
        };
        self.messages.clear_all();
        if std::mem::take(&mut self.drops_changes) {
            self.discard();
        }
        let recovered = self.store.recovered(&opened.source).filter(|text| *text != opened.text);
        if recovered.is_some_and(|text| document.replace(text, "recovered changes").is_ok()) {
            let text = "recovered unsaved changes; Undo drops them".to_owned();
            self.messages.tell(Cause::Recovery, text);
        }
        self.store.add_recent(&opened.source);
        self.watch = Some(Watch::new(&opened.mesh_path, self.wake.clone()));
        self.opened = Some(Arc::new(opened));
        self.document = Some(document);
        self.shown.clear();
        (self.selection, self.visibility, self.hover) = Default::default();
        self.session += 1;
        self.start(None);
    }

    /// Reads the mesh again, which another program has changed; a drawn model only where nothing in it
    /// is unsaved.
    pub(super) fn reread(&mut self) {
        let (Some(opened), Some(document)) = (&self.opened, &self.document) else { return };
        if opened.drawn.is_none() {
            self.tasks.reread(&opened.mesh_path);
        } else if document.is_changed() {
            let text =
                "the project file was changed by another program; save under another name, or open it again";
            self.messages.warn(Cause::Mesh, text.to_owned());
        } else {
            self.tasks.open(&opened.source);
        }
    }

    /// Takes the mesh of a file that was read again; the project stays.
    pub(super) fn take_mesh(&mut self, fresh: &Opened) {
        let Some(opened) = self.opened.as_ref().filter(|opened| opened.mesh_path == fresh.mesh_path) else {
            return;
        };
        self.opened = Some(Arc::new(opened.with_mesh(fresh)));
        let name = fresh.mesh_path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.messages.tell(Cause::Mesh, format!("{name} was changed by another program and is read again"));
        self.start(None);
    }

    /// Whether a file has changes that were not saved.
    pub fn has_unsaved(&self, path: &Path) -> bool {
        self.store.recovered(path).is_some()
    }

    /// The full path of the folder for output of a file: beside the file, or the home folder for a sample,
    /// because users do not find the folder of samples.
    pub fn folder_beside(&self, source: &Path) -> PathBuf {
        let home = std::env::home_dir().filter(|_| self.store.is_sample(source));
        let beside = || {
            let whole = std::path::absolute(source).unwrap_or_else(|_| source.to_owned());
            whole.parent().map(Path::to_owned).unwrap_or_default()
        };
        home.unwrap_or_else(beside)
    }

    /// A folder for files that come with the program.
    pub fn samples(&self) -> Option<PathBuf> {
        self.store.samples()
    }

    /// Writes the book that comes with the program; where a page of it is then.
    ///
    /// # Errors
    /// A message where it cannot be written.
    pub fn book(&self, page: usize) -> Result<PathBuf, String> {
        let folder = self.store.book().ok_or("there is no home folder to write the book to")?;
        book::write(&folder)?;
        Ok(book::file(&folder, page))
    }

    /// Whether another program has changed the project file since it was read or written here.
    pub fn is_changed_on_disk(&self) -> bool {
        let project = self.opened.as_ref().filter(|opened| opened.is_project);
        project.is_some_and(|opened| {
            std::fs::read(&opened.source).is_ok_and(|bytes| bytes != opened.text.as_bytes())
        })
    }

    /// Writes the project file. False where it has no name yet: ask for one, then
    /// [`Studio::save_as`].
    pub fn save(&mut self) -> bool {
        match self.document.as_ref().map(|document| document.path().map(Path::to_owned)) {
            Some(Some(path)) => self.save_as(&path),
            Some(None) => return false,
            None => {}
        }
        true
    }

    /// Writes the project file under a name.
    pub fn save_as(&mut self, path: &Path) {
        let (Some(opened), Some(document)) = (&self.opened, &mut self.document) else { return };
        let text = match opened.drawn {
            Some(_) => Ok(document.text().to_owned()),
            None => project::mesh_from(path, &opened.mesh_path)
                .map_err(|error| error.to_string())
                .and_then(|mesh| document.text_with_mesh(&mesh)),
        };
        // Its own project file is no source, and a large mesh would be read for that while the window waits.
        let is_source = opened.drawn.is_none() && document.path() != Some(path);
        let sources = Sources::of(is_source.then_some(opened.mesh_path.as_path()));
        let written = text.and_then(|text| {
            let files = [(path.to_owned(), text.clone().into_bytes())];
            output::check_places(&[path.to_owned()], &sources)
                .and_then(|()| output::write(&files, &sources))
                .map_err(|error| error.to_string())
                .map(|()| text)
        });
        match written {
            Ok(text) => {
                // Unsaved changes of another session in the file are replaced, too.
                [&opened.source, path].into_iter().for_each(|file| self.store.forget(file));
                self.store.add_recent(path);
                document.saved_as(path.to_owned(), text.clone());
                // From now on this file is what is open.
                self.opened = Some(Arc::new(opened.saved_as(path, text)));
                let mesh_path = self.opened.as_ref().map(|opened| opened.mesh_path.clone());
                self.watch = mesh_path.map(|path| Watch::new(&path, self.wake.clone()));
                self.messages.clear(Cause::Recovery);
                if self.is_drawn() {
                    // What another program wrote into the file is replaced.
                    self.messages.clear(Cause::Mesh);
                }
                self.messages.tell(Cause::Saving, format!("saved as {}", path.display()));
            }
            Err(problem) => self.messages.warn(Cause::Saving, problem),
        }
    }

    /// Drops what was not saved, for good.
    pub fn discard(&mut self) {
        if let Some(opened) = &self.opened {
            self.store.forget(&opened.source);
        }
    }
}
