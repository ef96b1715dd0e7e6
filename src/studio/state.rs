//! The studio without its window: what is open, what is shown, and what the user can do.

use super::book;
use super::change::Change;
use super::document::Document;
use super::messages::{Cause, Messages};
use super::opened::Opened;
use super::preferences::Preferences;
use super::results::{Busy, Shown};
use super::selection::{Hover, Selection};
use super::store::Store;
use super::tasks::{Finished, Tasks};
use super::visibility::Visibility;
use super::watch::Watch;
use super::worker::{News, Order, Wake, Worker};
use crate::app::project;
use glam::DVec3;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::front::hand;
use tatamu::front::notes::{self, Note};
use tatamu::front::scene::Seen;
use tatamu::pipeline::Output;
use tatamu::project::options::SIZE;

/// Turns of a component that follow each other within this time are undone together, seconds.
const TURN_PAUSE_S: f64 = 1.0;

/// The studio without its window.
pub struct Studio {
    worker: Worker,
    pub(super) tasks: Tasks,
    store: Store,
    opened: Option<Arc<Opened>>,
    document: Option<Document>,
    shown: Shown,
    busy: Option<Busy>,
    messages: Messages,
    /// The component that the model failed for, as there is none of this name.
    missing: Option<String>,
    /// What is selected.
    pub selection: Selection,
    /// What the mouse is over, in any view.
    pub hover: Option<Hover>,
    /// What is hidden.
    pub visibility: Visibility,
    measures: bool,
    /// Whether the last change was a choice about a net, which is taken back if it cannot be followed.
    is_attempt: bool,
    /// When a component was turned last.
    last_turn_s: f64,
    /// Tells files that were opened apart.
    session: u64,
    wake: Wake,
    watch: Option<Watch>,
    /// Sheets to be shown by a viewer that prints them.
    printed: Option<PathBuf>,
}

impl Studio {
    /// An empty studio; `wake` is called, from other threads, when there is something to
    /// [`Studio::poll`].
    pub fn new(store: Store, wake: Wake) -> Self {
        Self {
            worker: Worker::new(wake.clone()),
            tasks: Tasks::new(wake.clone()),
            store,
            opened: None,
            document: None,
            shown: Shown::default(),
            busy: None,
            messages: Messages::default(),
            missing: None,
            selection: Selection::default(),
            hover: None,
            visibility: Visibility::default(),
            measures: false,
            is_attempt: false,
            last_turn_s: f64::NEG_INFINITY,
            session: 0,
            wake,
            watch: None,
            printed: None,
        }
    }

    /// The file that is open.
    pub fn opened(&self) -> Option<&Arc<Opened>> {
        self.opened.as_ref()
    }

    /// The project that is open.
    pub fn document(&self) -> Option<&Document> {
        self.document.as_ref()
    }

    /// The last good results.
    pub fn shown(&self) -> &Shown {
        &self.shown
    }

    /// All that the scene is made of.
    pub fn seen(&self) -> Seen<'_> {
        let opened = self.opened.as_ref().map(|opened| opened.engine.mesh());
        let mesh = opened.zip(self.document.as_ref().map(Document::options));
        Seen { shown: &self.shown, selection: &self.selection, visibility: &self.visibility, mesh }
    }

    /// The work that goes on.
    pub fn busy(&self) -> Option<Busy> {
        self.busy
    }

    /// What the user is told.
    pub fn messages(&self) -> &Messages {
        &self.messages
    }

    /// Tells something about what the user did.
    pub fn messages_mut(&mut self) -> &mut Messages {
        &mut self.messages
    }

    /// The newest problem.
    #[cfg(test)]
    pub fn problem(&self) -> Option<&str> {
        self.messages.iter().find(|message| message.is_problem).map(|message| message.text.as_str())
    }

    /// The newest message that is no problem.
    #[cfg(test)]
    pub fn notice(&self) -> Option<&str> {
        self.messages.iter().find(|message| !message.is_problem).map(|message| message.text.as_str())
    }

    /// The component that there is no more, though something is set for it.
    pub fn missing(&self) -> Option<&str> {
        self.missing.as_deref()
    }

    /// Differs for each file that was opened.
    pub fn session(&self) -> u64 {
        self.session
    }

    /// What the window remembers between runs.
    pub fn preferences(&self) -> Preferences {
        self.store.preferences()
    }

    /// Remembers it.
    pub fn remember(&self, preferences: &Preferences) {
        self.store.set_preferences(preferences);
    }

    /// Files that were open before.
    pub fn recent(&self) -> Vec<PathBuf> {
        self.store.recent()
    }

    /// The results, where they are those of the project as it is now, and whole.
    pub fn finished(&self) -> Option<&Output> {
        self.laid().filter(|_| self.shown.is_folded())
    }

    /// The sheets of the project as it is now; perhaps it is not known yet how the model folds.
    pub fn laid(&self) -> Option<&Output> {
        let (opened, document) = (self.opened.as_ref()?, self.document.as_ref()?);
        self.shown.laid(document.options(), opened.drawn.is_some())
    }

    /// What there is to know about the mesh and the model that is shown.
    pub fn notes(&self) -> Vec<Note> {
        let Some(opened) = &self.opened else { return Vec::new() };
        notes::notes(&opened.repairs, self.shown.output())
    }

    /// Whether the components are drawn in the project file: then they change there alone.
    pub fn is_drawn(&self) -> bool {
        self.opened.as_ref().is_some_and(|opened| opened.drawn.is_some())
    }

    /// Calls the window when something happened in another thread.
    pub fn wake(&self) -> Wake {
        self.wake.clone()
    }

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
        self.messages.clear(Cause::Opening);
        self.tasks.open(path);
    }

    /// Takes what came from other threads; true where something changed.
    pub fn poll(&mut self) -> bool {
        let mut is_changed = false;
        while let Some(finished) = self.tasks.finished() {
            is_changed = true;
            match finished {
                Finished::Opened(Ok(opened)) => self.show(*opened),
                Finished::Opened(Err(problem)) => self.messages.warn(Cause::Opening, problem),
                Finished::Reread(Ok(opened)) => self.take_mesh(&opened),
                // Half of it may be written; the next change of the file is read again.
                Finished::Reread(Err(problem)) => self.messages.warn(Cause::Mesh, problem),
                Finished::Exported(Ok(files)) => {
                    self.messages.tell(Cause::Export, format!("written: {}", files.join(", ")));
                }
                Finished::Exported(Err(problem)) | Finished::Printable(Err(problem)) => {
                    self.messages.warn(Cause::Export, problem);
                }
                Finished::Printable(Ok(path)) => self.printed = Some(path),
            }
        }
        if self.watch.as_ref().is_some_and(Watch::is_changed) {
            self.reread();
        }
        while let Some(news) = self.worker.news() {
            is_changed = true;
            self.take(news);
        }
        is_changed
    }

    fn take(&mut self, news: News) {
        match news {
            News::Stage(stage) => self.busy = Some(Busy { stage, fraction: None }),
            News::Fraction(done) => {
                self.busy = self.busy.map(|busy| Busy { fraction: Some(done), ..busy });
            }
            News::Component(part, component) => self.shown.show_component(part, *component),
            News::Shaped(shaped) => {
                self.shown.show_shaped(shaped);
                self.selection.keep(self.shown.names());
                self.visibility.keep(self.shown.names());
            }
            News::Measured(distances) => self.shown.show_distances(distances),
            News::Laid(output) => self.shown.show_output(*output, false),
            News::Done(output) => {
                self.shown.show_output(*output, true);
                self.busy = None;
            }
            News::Failed(problem, _) if self.is_attempt => {
                self.undo();
                self.messages.warn(Cause::Change, format!("{problem}; the net stays as it was"));
            }
            News::Failed(problem, missing) => {
                (self.busy, self.missing) = (None, missing);
                self.messages.warn(Cause::Model, problem);
            }
        }
    }

    /// Shows a file, with what was not saved the last time.
    fn show(&mut self, opened: Opened) {
        let path = opened.is_project.then(|| opened.source.clone());
        let mut document = match Document::new(opened.text.clone(), path) {
            Ok(document) => document,
            Err(problem) => return self.messages.warn(Cause::Opening, problem),
        };
        self.messages.clear_all();
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
    fn reread(&mut self) {
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
    fn take_mesh(&mut self, fresh: &Opened) {
        let Some(opened) = self.opened.as_ref().filter(|opened| opened.mesh_path == fresh.mesh_path) else {
            return;
        };
        self.opened = Some(Arc::new(opened.with_mesh(fresh)));
        let name = fresh.mesh_path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.messages.tell(Cause::Mesh, format!("{name} was changed by another program and is read again"));
        self.start(None);
    }

    fn start(&mut self, first: Option<usize>) {
        let (Some(opened), Some(document)) = (&self.opened, &self.document) else { return };
        (self.missing, self.is_attempt) = (None, false);
        self.messages.clear(Cause::Model);
        self.busy = Some(Busy { stage: "starting", fraction: None });
        let (engine, options) = (opened.engine.clone(), document.options().clone());
        let is_sized = document.project().has(&SIZE);
        let size_mm = is_sized.then_some(document.options().size_mm);
        let drawn = opened.drawn.clone().map(|sketches| (sketches, size_mm));
        self.worker.start(Order { engine, drawn, options, first, measures: self.measures });
    }

    /// Stops the work; what is shown stays.
    pub fn cancel(&mut self) {
        self.worker.cancel();
        if self.busy.take().is_some() {
            self.messages.tell(Cause::Model, "stopped; the next change starts it again".to_owned());
        }
    }

    /// Whether distances between surface and components are measured.
    pub fn measure(&mut self, measures: bool) {
        if self.measures != measures {
            self.measures = measures;
            if measures && self.shown.distances().is_none() {
                self.start(None);
            }
        }
    }

    /// Changes the project. Changes of one gesture are undone together.
    pub fn change(&mut self, change: &Change, gesture: Option<&str>) {
        if self.is_drawn() && change.is_of_parts() {
            self.messages.tell(Cause::Change, hand::DRAWN.to_owned());
            return;
        }
        self.messages.clear(Cause::Change);
        let Some(document) = &mut self.document else { return };
        let before = document.text().to_owned();
        match document.change(change, gesture) {
            Ok(()) => {
                let is_new = document.text() != before;
                let first = match change {
                    Change::Component { name, .. } | Change::Reset { name } => self.index_of(name),
                    _ => None,
                };
                self.changed(first);
                self.is_attempt = is_new && matches!(change, Change::Edge { .. } | Change::Pieces { .. });
            }
            Err(problem) => self.messages.warn(Cause::Change, problem),
        }
    }

    fn changed(&mut self, first: Option<usize>) {
        self.messages.clear(Cause::Saving);
        // The work begins before the file is written.
        self.start(first);
        if let (Some(opened), Some(document)) = (&self.opened, &self.document) {
            if document.is_changed() {
                self.store.keep(&opened.source, document.text());
            } else {
                self.store.forget(&opened.source);
            }
        }
    }

    /// The gesture is over; the next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.document.iter_mut().for_each(Document::end_gesture);
    }

    /// Goes a step back.
    pub fn undo(&mut self) {
        if self.document.as_mut().is_some_and(Document::undo) {
            self.messages.clear(Cause::Recovery);
            self.changed(self.selected_index());
        }
    }

    /// Goes a step forth.
    pub fn redo(&mut self) {
        if self.document.as_mut().is_some_and(Document::redo) {
            self.messages.clear(Cause::Recovery);
            self.changed(self.selected_index());
        }
    }

    /// Index of a component by the name that options go by.
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.shown.index_of(name)
    }

    /// The component that was selected last.
    pub fn selected_index(&self) -> Option<usize> {
        self.selection.last().and_then(|name| self.index_of(name))
    }

    /// Whether a component is selected.
    pub fn is_selected(&self, part: usize) -> bool {
        self.shown.names().get(part).is_some_and(|name| self.selection.has(name))
    }

    /// Direction of a component's fold axis in degrees: as chosen, else as found.
    pub fn direction_deg(&self, part: usize) -> Option<f64> {
        hand::direction_deg(&self.shown, self.document.as_ref()?.project(), part)
    }

    /// Turns the fold direction of a component, as the wheel does, at a time of the window's clock. Turns
    /// that follow each other quickly are one step.
    pub fn turn(&mut self, part: usize, degrees: f64, now_s: f64) {
        if now_s - self.last_turn_s > TURN_PAUSE_S {
            self.end_gesture();
        }
        self.last_turn_s = now_s;
        let Some(document) = &self.document else { return };
        if let Some((change, gesture)) = hand::turned(&self.shown, document.project(), part, degrees) {
            self.change(&change, Some(&gesture));
        }
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

    /// Lets the layout place all pieces.
    pub fn lay_out_again(&mut self) {
        self.change(&Change::Pins { pins: Vec::new() }, None);
    }

    /// Gives each component the card that is most like the mesh's colours on it.
    pub fn take_cards(&mut self) {
        let Some(opened) = &self.opened else { return };
        match opened.painting() {
            Ok(painting) => {
                if let Some(change) = hand::cards(&self.shown, &painting) {
                    self.change(&change, None);
                }
            }
            Err(problem) => self.messages.warn(Cause::Change, problem),
        }
    }

    /// Makes one part of those that are selected.
    pub fn merge_selected(&mut self) {
        let names = self.selection.names().to_vec();
        if names.len() > 1 {
            self.change(&Change::Merge { names }, None);
        }
    }

    /// Divides a part by a plane in the model's coordinates.
    pub fn split(&mut self, part: usize, point: DVec3, normal: DVec3) {
        if let Some(change) = hand::split(&self.shown, part, point, normal) {
            self.change(&change, None);
        }
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
        let mesh: &[&Path] = if opened.drawn.is_some() { &[] } else { &[&opened.mesh_path] };
        let written = text.and_then(|text| {
            let files = [(path.to_owned(), text.clone().into_bytes())];
            crate::app::output::check_places(&[path.to_owned()], mesh)
                .and_then(|()| crate::app::output::write(&files))
                .map_err(|error| error.to_string())
                .map(|()| text)
        });
        match written {
            Ok(text) => {
                self.store.forget(&opened.source);
                self.store.add_recent(path);
                document.saved_as(path.to_owned(), text);
                // From now on this file is what is open.
                self.opened = Some(Arc::new(opened.saved_as(path)));
                let mesh_path = self.opened.as_ref().map(|opened| opened.mesh_path.clone());
                self.watch = mesh_path.map(|path| Watch::new(&path, self.wake.clone()));
                self.messages.clear(Cause::Recovery);
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
