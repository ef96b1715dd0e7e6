//! The project that is open, with what it was before.

use super::change::Change;
use super::options::Settings;
use super::{Project, ProjectError, Refusal, choose};
use crate::pipeline::Options;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The project that is open.
///
/// # Guarantees
/// The text is a project file that `tatamu make` accepts: a change that would break it is refused.
#[derive(Debug)]
pub struct Document {
    text: String,
    project: Project,
    settings: Settings,
    /// The project file, once there is one.
    path: Option<PathBuf>,
    /// What is in the file, or what the project began with.
    saved: String,
    undo: Vec<Step>,
    redo: Vec<Step>,
    /// The gesture that goes on: further changes of it are undone together.
    gesture: Option<String>,
}

/// The text of a document with its steps of undo and redo, to continue elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct History {
    text: String,
    saved: String,
    undo: Vec<Step>,
    redo: Vec<Step>,
}

/// A text to go back or forth to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Step {
    text: String,
    label: String,
}

impl Document {
    /// A document with the text of a project file.
    ///
    /// # Errors
    /// A message where that is none.
    pub fn new(text: String, path: Option<PathBuf>) -> Result<Self, String> {
        let (project, settings) = read(&text)?;
        let saved = text.clone();
        Ok(Self { text, project, settings, path, saved, undo: Vec::new(), redo: Vec::new(), gesture: None })
    }

    /// A document that continues with the history of another one.
    ///
    /// # Errors
    /// A message where a text is no project file.
    pub fn of_history(history: History, path: Option<PathBuf>) -> Result<Self, String> {
        let History { text, saved, undo, redo } = history;
        undo.iter().chain(&redo).try_for_each(|step| read(&step.text).map(drop))?;
        Ok(Self { saved, undo, redo, ..Self::new(text, path)? })
    }

    /// All that it was, is, and can be again.
    pub fn history(&self) -> History {
        let (text, saved) = (self.text.clone(), self.saved.clone());
        History { text, saved, undo: self.undo.clone(), redo: self.redo.clone() }
    }

    /// The text of the file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The project.
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// All that the project asks for.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What the project asks for in the model.
    pub fn options(&self) -> &Options {
        &self.settings.model
    }

    /// The project file, once there is one.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Whether there is something that is not in the file.
    pub fn is_changed(&self) -> bool {
        self.text != self.saved
    }

    /// Makes a change. Changes of one gesture, which have the same name, become one step.
    ///
    /// # Errors
    /// A message where the project would not be valid; it stays as it is. The message quotes no line, because who
    /// clicks or drags does not see the file.
    pub fn change(&mut self, change: &Change, gesture: Option<&str>) -> Result<(), String> {
        let text = change.apply(&self.text)?;
        let (project, settings) = parse(&text, ProjectError::without_line, |refusal| refusal.of_settings())?;
        if text == self.text {
            return Ok(());
        }
        let goes_on = gesture.is_some() && self.gesture.as_deref() == gesture && !self.undo.is_empty();
        let before = std::mem::replace(&mut self.text, text);
        if !goes_on {
            self.undo.push(Step { text: before, label: change.label() });
        }
        self.redo.clear();
        self.gesture = gesture.map(str::to_owned);
        (self.project, self.settings) = (project, settings);
        Ok(())
    }

    /// The next change is a step of its own.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// Replaces the text by another one, as one step.
    ///
    /// # Errors
    /// A message where it is no project file.
    pub fn replace(&mut self, text: String, label: &str) -> Result<(), String> {
        (self.project, self.settings) = read(&text)?;
        let before = std::mem::replace(&mut self.text, text);
        self.undo.push(Step { text: before, label: label.to_owned() });
        self.redo.clear();
        self.gesture = None;
        Ok(())
    }

    /// What would be undone.
    pub fn undo_label(&self) -> Option<&str> {
        self.undo.last().map(|step| step.label.as_str())
    }

    /// What would be done again.
    pub fn redo_label(&self) -> Option<&str> {
        self.redo.last().map(|step| step.label.as_str())
    }

    /// Goes a step back; false where there is none.
    pub fn undo(&mut self) -> bool {
        let Some(step) = self.undo.pop() else { return false };
        let now = self.go_to(step);
        self.redo.push(now);
        true
    }

    /// Goes a step forth; false where there is none.
    pub fn redo(&mut self) -> bool {
        let Some(step) = self.redo.pop() else { return false };
        let now = self.go_to(step);
        self.undo.push(now);
        true
    }

    fn go_to(&mut self, step: Step) -> Step {
        self.gesture = None;
        // A text that was one before is one again.
        if let Ok((project, settings)) = read(&step.text) {
            (self.project, self.settings) = (project, settings);
        }
        Step { text: std::mem::replace(&mut self.text, step.text), label: step.label }
    }

    /// The text with the mesh by another name, for a file in another folder.
    ///
    /// # Errors
    /// As [`Change::apply`].
    pub fn text_with_mesh(&self, mesh: &str) -> Result<String, String> {
        if self.project.mesh.as_deref() == Some(mesh) {
            return Ok(self.text.clone());
        }
        Change::Mesh { file: mesh.to_owned() }.apply(&self.text)
    }

    /// The text is in a file now.
    pub fn saved_as(&mut self, path: PathBuf, text: String) {
        if let Ok((project, settings)) = read(&text) {
            (self.project, self.settings) = (project, settings);
            self.text.clone_from(&text);
        }
        self.saved = text;
        self.path = Some(path);
    }
}

/// Reads the text of a file, of which a message quotes the line that is wrong.
fn read(text: &str) -> Result<(Project, Settings), String> {
    parse(text, |error| error.to_string(), |refusal| refusal.to_string())
}

fn parse(
    text: &str,
    say: fn(ProjectError) -> String,
    refuse: fn(Refusal) -> String,
) -> Result<(Project, Settings), String> {
    let project = Project::parse(text).map_err(say)?;
    let settings = choose(Some(&project), &[]).map_err(refuse)?;
    Ok((project, settings))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::options::{DIRECTION, MARGIN, SHEETS_MAX, SIZE};

    fn turn(degrees: f64) -> Change {
        Change::Component { name: "head".to_owned(), option: &DIRECTION, value: Some(degrees.into()) }
    }

    fn direction(document: &Document) -> Option<f64> {
        document.project().components.first().and_then(|c| c.direction_deg)
    }

    #[test]
    fn every_change_can_be_undone_and_done_again() {
        let mut document = Document::new("mesh = 'a.obj'\n".to_owned(), None).unwrap();
        assert!(!document.is_changed() && !document.undo());
        for degrees in [10.0, 20.0, 30.0] {
            document.change(&turn(degrees), None).unwrap();
        }
        assert_eq!(document.undo_label(), Some("direction of head"));
        assert!(document.undo() && document.undo());
        assert_eq!(direction(&document), Some(10.0));
        assert!(document.redo());
        assert_eq!(direction(&document), Some(20.0));
        document.change(&turn(5.0), None).unwrap();
        assert!(!document.redo(), "a new change ends what was undone");
        assert!(document.undo() && document.undo() && document.undo() && !document.undo());
        assert!(!document.is_changed());
    }

    #[test]
    fn a_document_goes_on_where_another_one_was() {
        let mut before = Document::new("mesh = 'a.obj'\n".to_owned(), None).unwrap();
        for degrees in [10.0, 20.0, 30.0] {
            before.change(&turn(degrees), None).unwrap();
        }
        before.undo();
        let told = serde_json::to_string(&before.history()).unwrap();
        let mut after = Document::of_history(serde_json::from_str(&told).unwrap(), None).unwrap();
        assert_eq!(after.history(), before.history());
        assert!(after.is_changed() && after.redo());
        assert_eq!(direction(&after), Some(30.0));
        assert!(after.undo() && after.undo() && after.undo() && !after.undo() && !after.is_changed());
        let wrong = told.replacen("a.obj", "a.obj' '", 2);
        assert!(Document::of_history(serde_json::from_str(&wrong).unwrap(), None).is_err());
    }

    #[test]
    fn a_gesture_is_one_step() {
        let mut document = Document::new("mesh = 'a.obj'\n".to_owned(), None).unwrap();
        for degrees in [10.0, 20.0, 30.0] {
            document.change(&turn(degrees), Some("turn head")).unwrap();
        }
        document.end_gesture();
        document.change(&turn(40.0), Some("turn head")).unwrap();
        assert!(document.undo());
        assert_eq!(direction(&document), Some(30.0));
        assert!(document.undo());
        assert_eq!(direction(&document), None);
    }

    #[test]
    fn what_would_break_the_project_is_refused() {
        let mut document = Document::new("mesh = 'a.obj'\n".to_owned(), None).unwrap();
        let wrong = Change::Set { option: &MARGIN, value: Some(400.0.into()) };
        assert!(document.change(&wrong, None).unwrap_err().contains("margin"));
        let wrong = Change::Set { option: &SIZE, value: Some((-1.0).into()) };
        assert!(document.change(&wrong, None).is_err());
        let wrong = Change::Set { option: &SHEETS_MAX, value: Some(0.into()) };
        let told = document.change(&wrong, None).unwrap_err();
        assert!(told.contains("from 1") && !told.contains('\n') && !told.contains("TOML"), "{told}");
        assert!(!document.is_changed() && document.undo_label().is_none());
    }
}
