//! What is open and what was made of it. One stage is made at a time, so that the page can answer between
//! two.

use glam::DVec3;
use std::collections::BTreeMap;
use std::io::Error as IoError;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::app::choice::Choice;
use tatamu::app::error::AppError;
use tatamu::app::fit::fitting_size_mm;
use tatamu::app::locale;
use tatamu::fold::Clash;
use tatamu::front::opened::Opened;
use tatamu::front::results::{Shown, exceeded_sheets};
use tatamu::front::scene::{self, Layers, Seen, Setting, Tag};
use tatamu::front::selection::{Hover, Selection};
use tatamu::front::visibility::Visibility;
use tatamu::front::{hand, words};
use tatamu::model::PartId;
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
    Ahead(PartId),
    /// The largest size in which the model takes no more sheets than its project allows.
    Size,
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
    /// Opens a mesh, a project or drawings; `files` are all that the user gave, by name. A mesh begins on the
    /// usual paper of the locale.
    ///
    /// # Errors
    /// A message that says what is wrong with which file.
    pub fn open(files: BTreeMap<String, Vec<u8>>, name: &str, locale: &str) -> Result<Self, String> {
        let fetch = move |path: &Path| {
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            let found = files.get(name);
            // There are no files here but those that were chosen.
            found.cloned().ok_or_else(|| IoError::other("choose that file as well"))
        };
        let opened = Opened::read_with(Arc::new(fetch), Path::new(name), &locale::settings_of(locale))?;
        let path = opened.is_project.then(|| PathBuf::from(name));
        let document = Document::new(opened.text.clone(), path)?;
        let (shown, selection, visibility) = Default::default();
        Ok(Self { opened, document, shown, selection, visibility, next: Some(Stage::Shape) })
    }

    /// Goes on where another desk was, with the same file.
    ///
    /// # Errors
    /// A message where its history is none of projects.
    pub fn go_on(&mut self, history: History, selected: &[String]) -> Result<(), String> {
        self.document = Document::of_history(history, self.document.path().map(Path::to_owned))?;
        selected.iter().for_each(|key| self.selection.select(key, None, true));
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
            Err(AppError::Pipeline(Error::Cancelled(_))) => self.next = Some(Stage::Shape),
            Err(error) => return Err(words::error(&error)),
        }
        Ok(())
    }

    /// The sheets that the model may take, where it takes more.
    pub fn exceeded_sheets(&self) -> Option<usize> {
        exceeded_sheets(self.document.settings(), self.laid()?)
    }

    /// Makes the model smaller next, until it takes no more sheets than its project allows.
    pub fn fit_sheets(&mut self) {
        self.next = Some(Stage::Size);
    }

    fn make(&mut self, stage: Stage, progress: &dyn Progress) -> Result<Option<Stage>, AppError> {
        let (engine, options) = (&self.opened.engine, self.document.options());
        match stage {
            Stage::Ahead(part) => {
                // What fails here fails in the next stage, too, which says so.
                if let Ok(component) = engine.component(options, part, progress) {
                    self.shown.show_component(part, component);
                }
                Ok(Some(Stage::Shape))
            }
            Stage::Size => {
                let sketches = self.opened.drawn.as_deref().map(Vec::as_slice);
                let choice = Choice::new(Some(self.document.project()), &[])?;
                let size_mm = fitting_size_mm(engine, sketches, choice, progress)?;
                let change = Change::Set { option: &SIZE, value: Some(size_mm.into()) };
                self.document.change(&change, None).map_err(AppError::Options)?;
                Ok(Some(Stage::Shape))
            }
            Stage::Shape => {
                let size_mm = self.document.project().has(&SIZE).then_some(options.size_mm);
                let shaped = match &self.opened.drawn {
                    None => engine.shape(options, progress),
                    Some(sketches) => shape_drawn(sketches, size_mm, options, progress),
                };
                let shaped = shaped.map_err(AppError::Pipeline)?;
                self.shown.show_shaped(shaped.clone());
                self.selection.keep(self.shown.names());
                Ok(Some(Stage::LayOut(shaped)))
            }
            Stage::LayOut(shaped) => {
                let laid = engine.lay_out(shaped, progress).map_err(AppError::Pipeline)?;
                self.shown.show_output(laid.clone(), false);
                Ok(Some(Stage::Fold(laid)))
            }
            Stage::Fold(laid) => {
                let folded = engine.fold(laid, progress).map_err(AppError::Pipeline)?;
                self.shown.show_output(folded, true);
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

    fn start(&mut self, turned: Option<PartId>) {
        let ahead = turned.filter(|_| self.opened.drawn.is_none());
        self.next = Some(ahead.map_or(Stage::Shape, Stage::Ahead));
    }

    /// The next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.document.end_gesture();
    }

    /// The text of the project, which is in a file of this name from now on.
    pub fn save(&mut self, name: &str) -> String {
        let text = self.document.text().to_owned();
        self.document.saved_as(PathBuf::from(name), text.clone());
        text
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
    pub fn turn(&mut self, part: PartId, degrees: f64) -> Result<(), String> {
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

    fn plane(&self, axis: usize, share: f64) -> Option<(PartId, (DVec3, DVec3))> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::progress::Silent;
    use tatamu::project::options::{Entry, SHEETS_MAX};

    fn opened(name: &str, text: &[u8], locale: &str) -> Desk {
        let mesh = ("box.obj".to_owned(), include_bytes!("../../samples/box.obj").to_vec());
        Desk::open([mesh, (name.to_owned(), text.to_vec())].into(), name, locale).unwrap()
    }

    fn a_box(locale: &str) -> Desk {
        opened("cube.obj", include_bytes!("../../samples/box.obj"), locale)
    }

    fn finish(desk: &mut Desk) {
        while desk.is_busy() {
            desk.work(&Silent).unwrap();
        }
    }

    fn set(desk: &mut Desk, option: &'static Entry, value: f64) {
        let value = if *option == SHEETS_MAX { (value as i64).into() } else { value.into() };
        desk.change(&Change::Set { option, value: Some(value) }, None).unwrap();
    }

    #[test]
    fn a_mesh_begins_on_the_paper_of_the_browsers_language() {
        for (language, paper) in [("en-US", "letter"), ("es-MX", "letter"), ("en-GB", "a4"), ("de", "a4")] {
            assert_eq!(a_box(language).document.options().paper.name(), paper, "{language}");
        }
        let project = a_box("en-US").document.text().to_owned();
        assert!(project.contains("size = \"letter\""), "{project}");
    }

    #[test]
    fn a_project_has_the_same_paper_in_every_language() {
        let desk = opened("a.toml", b"mesh = \"box.obj\"\n", "en-US");
        assert_eq!(desk.document.options().paper.name(), "a4");
    }

    #[test]
    fn a_file_that_is_missing_is_asked_for() {
        let told =
            Desk::open([("a.toml".to_owned(), b"mesh = \"box.obj\"\n".to_vec())].into(), "a.toml", "de");
        let told = told.err().unwrap();
        assert!(told.contains("box.obj") && told.ends_with("choose that file as well"), "{told}");
    }

    #[test]
    fn what_is_in_a_project_file_is_not_unsaved() {
        let mut desk = a_box("de");
        assert!(!desk.document.is_changed());
        set(&mut desk, &SIZE, 150.0);
        assert!(desk.document.is_changed());
        assert_eq!(desk.save("cube.toml"), desk.document.text());
        assert!(!desk.document.is_changed());
        desk.undo();
        assert!(desk.document.is_changed());
    }

    #[test]
    fn the_size_is_fitted_to_the_sheets_in_one_step_of_undo() {
        let mut desk = a_box("de");
        set(&mut desk, &SIZE, 300.0);
        finish(&mut desk);
        let sheets = desk.finished().unwrap().layout().sheet_count();
        assert!(sheets > 1, "{sheets}");
        set(&mut desk, &SHEETS_MAX, 1.0);
        finish(&mut desk);
        assert_eq!(desk.exceeded_sheets(), Some(1));
        desk.fit_sheets();
        finish(&mut desk);
        assert_eq!(desk.finished().unwrap().layout().sheet_count(), 1);
        assert_eq!(desk.exceeded_sheets(), None);
        let fitted_mm = desk.document.options().size_mm;
        assert!(fitted_mm < 300.0 && fitted_mm % 5.0 == 0.0, "{fitted_mm}");
        desk.undo();
        assert_eq!(desk.document.options().size_mm, 300.0);
    }

    #[test]
    fn a_model_with_too_many_sheets_at_every_size_stays_as_it_is_and_says_so() {
        let mut desk = opened("snowman.obj", include_bytes!("../../samples/snowman.obj"), "de");
        finish(&mut desk);
        // Each card has sheets of its own.
        let cards = desk.shown.names().iter().cloned().zip(["white", "brown"].map(str::to_owned));
        desk.change(&Change::Cards { cards: cards.collect() }, None).unwrap();
        set(&mut desk, &SHEETS_MAX, 1.0);
        finish(&mut desk);
        let before = desk.document.text().to_owned();
        desk.fit_sheets();
        let told = desk.work(&Silent).unwrap_err();
        assert!(told.ends_with("allow more with \u{201c}Sheets max\u{201d}"), "{told}");
        assert_eq!(desk.document.text(), before);
        assert!(desk.finished().is_some() && !desk.is_busy());
    }
}
