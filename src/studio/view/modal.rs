//! What dialogs have in common.

use eframe::egui::{self, Ui};

/// Gives a widget of a dialog the focus as the dialog opens.
pub fn focus_once(ui: &Ui, response: &egui::Response) {
    if ui.ctx().memory(|memory| memory.focused().is_none()) {
        response.request_focus();
    }
}
