//! What the user changes, and takes back.

use super::super::change::Change;
use super::super::document::Document;
use super::super::messages::Cause;
use super::Studio;
use glam::DVec3;
use tatamu::front::hand;
use tatamu::model::PartId;

/// Turns and moves that follow each other within this time are undone together, seconds.
const PAUSE_S: f64 = 1.0;

impl Studio {
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
                if is_new {
                    // Undo takes back this change now.
                    self.messages.clear(Cause::Recovery);
                }
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

    pub(super) fn changed(&mut self, first: Option<PartId>) {
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

    /// A step of a turn or a move, at a time of the window's clock; after a pause it is undone alone.
    pub fn begin_step(&mut self, now_s: f64) {
        if now_s - self.last_step_s > PAUSE_S {
            self.end_gesture();
        }
        self.last_step_s = now_s;
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

    /// Turns the fold direction of a component, as the wheel does, at a time of the window's clock. Turns
    /// that follow each other quickly are one step.
    pub fn turn(&mut self, part: PartId, degrees: f64, now_s: f64) {
        self.begin_step(now_s);
        let Some(document) = &self.document else { return };
        if let Some((change, gesture)) = hand::turned(&self.shown, document.project(), part, degrees) {
            self.change(&change, Some(&gesture));
        }
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
    pub fn split(&mut self, part: PartId, point: DVec3, normal: DVec3) {
        if let Some(change) = hand::split(&self.shown, part, point, normal) {
            self.change(&change, None);
        }
    }
}
