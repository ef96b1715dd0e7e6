//! The studio without its window: what is open, what is shown, and what the user can do.

mod edits;
mod files;
mod fitting;

use super::document::Document;
use super::messages::{Cause, Messages};
use super::opened::Opened;
use super::preferences::Preferences;
use super::results::{Busy, Shown};
use super::selection::{Hover, Selection};
use super::store::Store;
use super::tasks::{Finished, Stop, Tasks};
use super::visibility::Visibility;
use super::watch::Watch;
use super::worker::{News, Order, Wake, Worker};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tatamu::front::hand;
use tatamu::front::notes::{self, Note};
use tatamu::front::scene::Seen;
use tatamu::model::PartId;
use tatamu::pipeline::Output;
use tatamu::project::options::SIZE;

/// A picture waits this long for the component that is turned, because one of the old component takes as long, and the
/// cores. Tests wait on busy machines, too.
const WAIT: Duration = if cfg!(test) { Duration::from_secs(60) } else { Duration::from_millis(80) };

/// The studio without its window.
pub struct Studio {
    worker: Worker,
    pub(super) tasks: Tasks,
    store: Store,
    opened: Option<Arc<Opened>>,
    document: Option<Document>,
    shown: Shown,
    busy: Option<Busy>,
    /// Until when a picture waits for the component that is made first.
    first_by: Option<Instant>,
    messages: Messages,
    /// The name of a component that does not exist, for which the model failed.
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
    /// When something was turned or moved last by a step.
    last_step_s: f64,
    /// Whether unsaved changes are dropped once another file is read.
    drops_changes: bool,
    /// Tells files that were opened apart.
    session: u64,
    wake: Wake,
    watch: Option<Watch>,
    /// Sheets to be shown by a viewer that prints them.
    printed: Option<PathBuf>,
    /// The search for a size that goes on.
    sizing: Option<Stop>,
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
            first_by: None,
            messages: Messages::default(),
            missing: None,
            selection: Selection::default(),
            hover: None,
            visibility: Visibility::default(),
            measures: false,
            is_attempt: false,
            last_step_s: f64::NEG_INFINITY,
            drops_changes: false,
            session: 0,
            wake,
            watch: None,
            printed: None,
            sizing: None,
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
        let sizing = self.sizing.as_ref().map(|_| Busy { stage: "looking for the size", fraction: None });
        self.busy.or(sizing)
    }

    /// Messages for the user.
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

    /// The component that no longer exists, although the project has settings for it.
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

    /// The notes about the mesh and the model that is shown.
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
                Finished::Sized(size) => self.take_size(size),
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

    /// Waits a little for a component that was asked for, so that the next picture shows it.
    pub fn await_first(&mut self) {
        if let Some(news) = self.first_by.take().and_then(|then| self.worker.news_by(then)) {
            self.take(news);
        }
    }

    fn take(&mut self, news: News) {
        self.first_by = None;
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
                self.messages.warn(Cause::Change, format!("{}; the net stays as it was", problem.text));
            }
            News::Failed(problem, missing) => {
                (self.busy, self.missing) = (None, missing);
                self.messages.warn(Cause::Model, problem);
            }
        }
    }

    fn start(&mut self, first: Option<PartId>) {
        self.stop_sizing();
        let (Some(opened), Some(document)) = (&self.opened, &self.document) else { return };
        (self.missing, self.is_attempt) = (None, false);
        self.messages.clear(Cause::Model);
        self.busy = Some(Busy { stage: "starting", fraction: None });
        let (engine, options) = (opened.engine.clone(), document.options().clone());
        let is_sized = document.project().has(&SIZE);
        let size_mm = is_sized.then_some(document.options().size_mm);
        let drawn = opened.drawn.clone().map(|sketches| (sketches, size_mm));
        self.first_by = first.filter(|_| drawn.is_none()).map(|_| Instant::now() + WAIT);
        self.worker.start(Order { engine, drawn, options, first, measures: self.measures });
    }

    /// Begins the work again that was stopped.
    pub fn resume(&mut self) {
        self.start(None);
    }

    /// Stops the work; what is shown stays.
    pub fn cancel(&mut self) {
        if self.stop_sizing() {
            return;
        }
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

    /// Id of a component by the name that options go by.
    pub fn index_of(&self, name: &str) -> Option<PartId> {
        self.shown.index_of(name)
    }

    /// The component that was selected last.
    pub fn selected_index(&self) -> Option<PartId> {
        self.selection.last().and_then(|name| self.index_of(name))
    }

    /// Whether a component is selected.
    pub fn is_selected(&self, part: PartId) -> bool {
        self.shown.names().get(part.0).is_some_and(|name| self.selection.has(name))
    }

    /// Direction of a component's fold axis in degrees: as chosen, else as found.
    pub fn direction_deg(&self, part: PartId) -> Option<f64> {
        hand::direction_deg(&self.shown, self.document.as_ref()?.project(), part)
    }
}
