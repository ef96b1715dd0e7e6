//! What dialogs have in common.

use eframe::egui::{self, Context, Frame, Id, Key, Modal, Ui};

/// Room between a dialog's edge and its content, points.
const MARGIN: i8 = 16;

/// A dialog of this name, with room at its edges.
pub fn new(ctx: &Context, name: &str) -> Modal {
    let id = Id::unique(name);
    // A long list has all of the window, not the height of a small dialog.
    let area = Modal::default_area(id).default_height(ctx.content_rect().height());
    Modal::new(id).area(area).frame(Frame::popup(&ctx.global_style()).inner_margin(MARGIN))
}

/// Points that a question is wide.
const WIDTH: f32 = 420.0;

/// Asks a question: the number of the answer, which is the last one where the dialog is closed.
pub fn ask(ctx: &Context, name: &str, [heading, text]: [&str; 2], answers: &[&str]) -> Option<usize> {
    let mut chosen = None;
    let shown = new(ctx, name).show(ctx, |ui| {
        ui.set_width(WIDTH);
        ui.heading(heading);
        ui.label(text);
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            for (k, answer) in answers.iter().enumerate() {
                let button = ui.button(*answer);
                if k == 0 {
                    focus_once(ui, &button);
                }
                if button.clicked() {
                    chosen = Some(k);
                }
            }
        });
    });
    chosen.or(shown.should_close().then(|| answers.len() - 1))
}

/// Points that an arrow key scrolls.
const STEP: f32 = 48.0;

/// Scrolls the list that is drawn, where nothing in it takes the keyboard.
pub fn scroll_by_keys(ui: &Ui) {
    let page = 0.9 * ui.clip_rect().height();
    let keys = [(Key::ArrowDown, STEP), (Key::ArrowUp, -STEP), (Key::PageDown, page), (Key::PageUp, -page)];
    let by: f32 = ui.input(|i| keys.iter().filter(|(key, _)| i.key_pressed(*key)).map(|(_, by)| by).sum());
    if by != 0.0 {
        ui.scroll_with_delta(egui::vec2(0.0, -by));
    }
}

/// Gives a widget of a dialog the focus as the dialog opens.
pub fn focus_once(ui: &Ui, response: &egui::Response) {
    if ui.ctx().memory(|memory| memory.focused().is_none()) {
        response.request_focus();
    }
}
