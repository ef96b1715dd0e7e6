//! What is open and what was made of it. One stage is made at a time, so that between two the page is heard.

use glam::DVec3;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::fold::Clash;
use tatamu::front::opened::Opened;
use tatamu::front::results::Shown;
use tatamu::front::scene::{self, Layers, Seen, Setting, Tag};
use tatamu::front::selection::{Hover, Selection};
use tatamu::front::visibility::Visibility;
use tatamu::front::{hand, words};
use tatamu::pipeline::{Error, Output, Shaped, shape_drawn};
use tatamu::progress::Progress;
use tatamu::project::change::Change;
use tatamu::project::document::{Document, History};
use tatamu::project::options::SIZE;
use tatamu::render::zbuffer::Solids;

/// What is open and what was made of it.
pub struct Desk {
    pub(crate) opened: Opened,
    pub(crate) document: Document,
    pub(crate) shown: Shown,
    pub(crate) selection: Selection,
    /// Nothing is hidden on the page.
    visibility: Visibility,
    next: Option<Stage>,
}

/// What is to be made next.
enum Stage {
    /// The component that the user turns, before all others.
    Ahead(usize),
    Shape,
    LayOut(Shaped),
    Fold(Output),
}

/// What the page wants to see in space.
pub struct Sight {
    /// How far the model is folded, 0 to 1.
    pub folded: f64,
    /// Number of what the pointer is over.
    pub hover: Option<u32>,
    /// Whether the mesh is seen in the colours of its parts instead of the components.
    pub is_mesh: bool,
    /// Index of the clash that is shown.
    pub clash: Option<usize>,
    /// The axis and the share of a plane at which the selected part would be split.
    pub split: Option<(usize, f64)>,
}

impl Desk {
    /// Opens a mesh, a project or drawings; `files` are all that the user gave, by name.
    ///
    /// # Errors
    /// A message that says what is wrong with which file.
    pub fn open(files: BTreeMap<String, Vec<u8>>, name: &str) -> Result<Self, String> {
        let fetch = move |path: &Path| {
            let found = path.file_name().and_then(|name| files.get(name.to_str()?));
            found.cloned().ok_or_else(|| ErrorKind::NotFound.into())
        };
        let opened = Opened::read(Arc::new(fetch), Path::new(name))?;
        let path = opened.is_project.then(|| PathBuf::from(name));
        let document = Document::new(opened.text.clone(), path)?;
        let (shown, selection, visibility) = Default::default();
        Ok(Self { opened, document, shown, selection, visibility, next: Some(Stage::Shape) })
    }

    /// Goes on where another desk was, with the same file; nothing is made until the next change.
    ///
    /// # Errors
    /// A message where its history is none of projects.
    pub fn go_on(&mut self, history: History, selected: &[String]) -> Result<(), String> {
        self.document = Document::of_history(history, self.document.path().map(Path::to_owned))?;
        selected.iter().for_each(|key| self.selection.select(key, None, true));
        self.stop();
        Ok(())
    }

    /// Makes no more stages until the next change; what is shown stays.
    pub fn stop(&mut self) {
        self.next = None;
    }

    /// Whether something is to be made.
    pub fn is_busy(&self) -> bool {
        self.next.is_some()
    }

    /// Makes the next stage.
    ///
    /// # Errors
    /// A message where there is no result. A stage that was stopped is none, and is made again.
    pub fn work(&mut self, progress: &dyn Progress) -> Result<(), String> {
        let Some(stage) = self.next.take() else { return Ok(()) };
        match self.make(stage, progress) {
            Ok(next) => self.next = next,
            Err(Error::Cancelled(_)) => self.next = Some(Stage::Shape),
            Err(error) => return Err(words::failure(&error)),
        }
        Ok(())
    }

    fn make(&mut self, stage: Stage, progress: &dyn Progress) -> Result<Option<Stage>, Error> {
        let (engine, options) = (&self.opened.engine, self.document.options());
        match stage {
            Stage::Ahead(part) => {
                // What fails here fails in the next stage, too, which says so.
                if let Ok(component) = engine.component(options, part, progress) {
                    self.shown.show_component(part, component);
                }
                Ok(Some(Stage::Shape))
            }
            Stage::Shape => {
                let size_mm = self.document.project().has(&SIZE).then_some(options.size_mm);
                let shaped = match &self.opened.drawn {
                    None => engine.shape(options, progress)?,
                    Some(sketches) => shape_drawn(sketches, size_mm, options, progress)?,
                };
                self.shown.show_shaped(shaped.clone());
                self.selection.keep(self.shown.names());
                Ok(Some(Stage::LayOut(shaped)))
            }
            Stage::LayOut(shaped) => {
                let laid = engine.lay_out(shaped, progress)?;
                self.shown.show_output(laid.clone(), false);
                Ok(Some(Stage::Fold(laid)))
            }
            Stage::Fold(laid) => {
                self.shown.show_output(engine.fold(laid, progress)?, true);
                Ok(None)
            }
        }
    }

    /// The sheets of the project as it is now.
    pub fn laid(&self) -> Option<&Output> {
        self.shown.laid(self.document.options(), self.opened.drawn.is_some())
    }

    /// The results of the project as it is now, where they are whole.
    pub fn finished(&self) -> Option<&Output> {
        self.laid().filter(|_| self.shown.is_folded())
    }

    /// Makes a change. Changes of one gesture are undone together.
    ///
    /// # Errors
    /// A message where the project would be none; it stays as it is.
    pub fn change(&mut self, change: &Change, gesture: Option<&str>) -> Result<(), String> {
        if self.opened.drawn.is_some() && change.is_of_parts() {
            return Err(hand::DRAWN.to_owned());
        }
        self.document.change(change, gesture)?;
        let turned = match change {
            Change::Component { name, .. } | Change::Reset { name } => self.shown.index_of(name),
            _ => None,
        };
        self.start(turned);
        Ok(())
    }

    fn start(&mut self, turned: Option<usize>) {
        let ahead = turned.filter(|_| self.opened.drawn.is_none());
        self.next = Some(ahead.map_or(Stage::Shape, Stage::Ahead));
    }

    /// The next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.document.end_gesture();
    }

    /// Goes a step back.
    pub fn undo(&mut self) {
        if self.document.undo() {
            self.start(self.seen().selected_index());
        }
    }

    /// Goes a step forth.
    pub fn redo(&mut self) {
        if self.document.redo() {
            self.start(self.seen().selected_index());
        }
    }

    /// Turns the fold direction of a component.
    ///
    /// # Errors
    /// As [`Desk::change`].
    pub fn turn(&mut self, part: usize, degrees: f64) -> Result<(), String> {
        match hand::turned(&self.shown, self.document.project(), part, degrees) {
            Some((change, gesture)) => self.change(&change, Some(&gesture)),
            None => Ok(()),
        }
    }

    /// Gives each component the card that is most like the mesh's colours on it.
    ///
    /// # Errors
    /// As [`Desk::change`]; a message where the mesh has no colours.
    pub fn take_cards(&mut self) -> Result<(), String> {
        let change = hand::cards(&self.shown, &self.opened.painting()?);
        change.map_or(Ok(()), |change| self.change(&change, None))
    }

    /// Makes one part of those that are selected.
    ///
    /// # Errors
    /// As [`Desk::change`].
    pub fn merge(&mut self) -> Result<(), String> {
        match self.selection.names().to_vec() {
            names if names.len() > 1 => self.change(&Change::Merge { names }, None),
            _ => Ok(()),
        }
    }

    /// Divides the selected part by a plane across an axis of [`hand::AXES`].
    ///
    /// # Errors
    /// As [`Desk::change`].
    pub fn split(&mut self, axis: usize, share: f64) -> Result<(), String> {
        let change = self
            .plane(axis, share)
            .and_then(|(part, (point, normal))| hand::split(&self.shown, part, point, normal));
        change.map_or(Ok(()), |change| self.change(&change, None))
    }

    fn plane(&self, axis: usize, share: f64) -> Option<(usize, (DVec3, DVec3))> {
        let part = self.seen().selected_index()?;
        Some((part, hand::plane(&self.shown, part, axis, share)?))
    }

    /// What the scene is made of.
    pub fn seen(&self) -> Seen<'_> {
        let mesh = Some((self.opened.engine.mesh(), self.document.options()));
        Seen { shown: &self.shown, selection: &self.selection, visibility: &self.visibility, mesh }
    }

    fn clash(&self, index: usize) -> Option<Clash> {
        self.shown.output()?.fold_plan().clashes().get(index).copied()
    }

    /// The scene.
    pub fn scene(&self, sight: &Sight) -> Solids {
        let layers = match sight.is_mesh {
            true => Layers { segments: true, components: false, ..Layers::COMPONENTS },
            false => Layers::COMPONENTS,
        };
        let setting = Setting {
            layers,
            folded: sight.folded,
            hover: sight.hover.and_then(Tag::of_number).map(|tag| match tag.panel {
                Some(panel) => Hover::panels(tag.part, vec![panel]),
                None => Hover::part(tag.part),
            }),
            clash: sight.clash.and_then(|index| self.clash(index)),
            split: sight.split.and_then(|(axis, share)| self.plane(axis, share)).map(|(_, plane)| plane),
        };
        scene::scene(&self.seen(), &setting)
    }

    /// How far the model is folded when a clash happens.
    pub fn moment(&self, clash: usize) -> Option<f64> {
        scene::moment(&self.shown, &self.clash(clash)?)
    }
}
