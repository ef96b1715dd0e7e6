//! The studio without its window: what is open, what is shown, and what the user can do.

use super::change::Change;
use super::document::Document;
use super::opened::Opened;
use super::results::{Busy, Shown};
use super::selection::Selection;
use super::store::Store;
use super::tasks::{Finished, Tasks};
use super::worker::{News, Order, Wake, Worker};
use crate::app::project;
use glam::DVec3;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::front::hand;
use tatamu::front::scene::Seen;
use tatamu::pipeline::Output;
use tatamu::project::options::SIZE;

/// The studio without its window.
pub struct Studio {
    worker: Worker,
    pub(super) tasks: Tasks,
    store: Store,
    opened: Option<Arc<Opened>>,
    document: Option<Document>,
    shown: Shown,
    busy: Option<Busy>,
    problem: Option<String>,
    /// The component that the problem is about, if it is no more.
    missing: Option<String>,
    notice: Option<String>,
    /// What is selected.
    pub selection: Selection,
    measures: bool,
}

impl Studio {
    /// An empty studio; `wake` is called, from other threads, when there is something to
    /// [`Studio::poll`].
    pub fn new(store: Store, wake: Wake) -> Self {
        Self {
            worker: Worker::new(wake.clone()),
            tasks: Tasks::new(wake),
            store,
            opened: None,
            document: None,
            shown: Shown::default(),
            busy: None,
            problem: None,
            missing: None,
            notice: None,
            selection: Selection::default(),
            measures: false,
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
        Seen { shown: &self.shown, selection: &self.selection, mesh }
    }

    /// The work that goes on.
    pub fn busy(&self) -> Option<Busy> {
        self.busy
    }

    /// Why there is no newer result.
    pub fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// The component that there is no more, though something is set for it.
    pub fn missing(&self) -> Option<&str> {
        self.missing.as_deref().filter(|_| self.problem.is_some())
    }

    /// Something to tell the user.
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_deref()
    }

    /// The user has read it.
    pub fn dismiss(&mut self) {
        (self.notice, self.problem) = (None, None);
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

    /// Whether the components are drawn in the project file: then they change there alone.
    pub fn is_drawn(&self) -> bool {
        self.opened.as_ref().is_some_and(|opened| opened.drawn.is_some())
    }

    /// Begins to read a file.
    pub fn open(&mut self, path: &Path) {
        self.problem = None;
        self.tasks.open(path);
    }

    /// Takes what came from other threads; true where something changed.
    pub fn poll(&mut self) -> bool {
        let mut is_changed = false;
        while let Some(finished) = self.tasks.finished() {
            is_changed = true;
            match finished {
                Finished::Opened(Ok(opened)) => self.show(*opened),
                Finished::Exported(Ok(files)) => self.notice = Some(format!("written: {}", files.join(", "))),
                Finished::Opened(Err(problem)) | Finished::Exported(Err(problem)) => {
                    self.problem = Some(problem);
                }
            }
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
            }
            News::Measured(distances) => self.shown.show_distances(distances),
            News::Laid(output) => self.shown.show_output(*output, false),
            News::Done(output) => {
                self.shown.show_output(*output, true);
                self.busy = None;
            }
            News::Failed(problem, missing) => {
                (self.busy, self.problem, self.missing) = (None, Some(problem), missing);
            }
        }
    }

    /// Shows a file, with what was not saved the last time.
    fn show(&mut self, opened: Opened) {
        let path = opened.is_project.then(|| opened.source.clone());
        let mut document = match Document::new(opened.text.clone(), path) {
            Ok(document) => document,
            Err(problem) => return self.problem = Some(problem),
        };
        self.notice = None;
        let recovered = self.store.recovered(&opened.source).filter(|text| *text != opened.text);
        if recovered.is_some_and(|text| document.replace(text, "recovered changes").is_ok()) {
            self.notice = Some("recovered unsaved changes; Undo drops them".to_owned());
        }
        self.store.add_recent(&opened.source);
        self.opened = Some(Arc::new(opened));
        self.document = Some(document);
        self.shown.clear();
        self.selection = Selection::default();
        self.start(None);
    }

    fn start(&mut self, first: Option<usize>) {
        let (Some(opened), Some(document)) = (&self.opened, &self.document) else { return };
        (self.problem, self.missing) = (None, None);
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
            self.notice = Some("stopped; the next change starts it again".to_owned());
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
            self.notice = Some("these components are drawn; edit their shape in the project file".to_owned());
            return;
        }
        let Some(document) = &mut self.document else { return };
        match document.change(change, gesture) {
            Ok(()) => {
                let first = match change {
                    Change::Component { name, .. } | Change::Reset { name } => self.index_of(name),
                    _ => None,
                };
                self.changed(first);
            }
            Err(problem) => self.problem = Some(problem),
        }
    }

    fn changed(&mut self, first: Option<usize>) {
        if let (Some(opened), Some(document)) = (&self.opened, &self.document) {
            if document.is_changed() {
                self.store.keep(&opened.source, document.text());
            } else {
                self.store.forget(&opened.source);
            }
        }
        self.start(first);
    }

    /// The gesture is over; the next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.document.iter_mut().for_each(Document::end_gesture);
    }

    /// Goes a step back.
    pub fn undo(&mut self) {
        if self.document.as_mut().is_some_and(Document::undo) {
            self.changed(self.selected_index());
        }
    }

    /// Goes a step forth.
    pub fn redo(&mut self) {
        if self.document.as_mut().is_some_and(Document::redo) {
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

    /// Direction of a component's fold axis in degrees: as chosen, else as found.
    pub fn direction_deg(&self, part: usize) -> Option<f64> {
        hand::direction_deg(&self.shown, self.document.as_ref()?.project(), part)
    }

    /// Turns the fold direction of a component, as the wheel does.
    pub fn turn(&mut self, part: usize, degrees: f64) {
        let Some(document) = &self.document else { return };
        if let Some((change, gesture)) = hand::turned(&self.shown, document.project(), part, degrees) {
            self.change(&change, Some(&gesture));
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
                self.notice = Some(format!("saved as {}", path.display()));
            }
            Err(problem) => self.problem = Some(problem),
        }
    }

    /// Drops what was not saved, for good.
    pub fn discard(&mut self) {
        if let Some(opened) = &self.opened {
            self.store.forget(&opened.source);
        }
    }
}
