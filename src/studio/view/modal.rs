//! What dialogs have in common.

use eframe::egui::{self, Context, Frame, Id, Modal, Ui};

/// Room between a dialog's edge and its content, points.
const MARGIN: i8 = 16;

/// A dialog of this name, with room at its edges.
pub fn new(ctx: &Context, name: &str) -> Modal {
    Modal::new(Id::unique(name)).frame(Frame::popup(&ctx.global_style()).inner_margin(MARGIN))
}

/// Gives a widget of a dialog the focus as the dialog opens.
pub fn focus_once(ui: &Ui, response: &egui::Response) {
    if ui.ctx().memory(|memory| memory.focused().is_none()) {
        response.request_focus();
    }
}
