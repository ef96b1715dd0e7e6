//! The list of warnings; each leads to what it is about, and to what can be done about it.

use super::super::change::Change;
use super::super::state::Studio;
use super::super::words;
use super::{Mode, Window, focus, look};
use eframe::egui::{self, Ui};
use lucide_icons::Icon;
use tatamu::front::remedies;
use tatamu::project::options::Settings;

/// Buttons that do what is advised for the settings of the document; true where one was clicked.
pub fn advised(
    studio: &mut Studio,
    ui: &mut Ui,
    advice: impl Fn(&Settings) -> Vec<(String, Change)>,
) -> bool {
    let mut changes = studio.document().map(|document| advice(document.settings())).unwrap_or_default();
    if ui.layout().prefer_right_to_left() {
        changes.reverse();
    }
    let mut is_done = false;
    for (label, change) in changes {
        if ui.small_button(label).on_hover_text("does what is advised; Undo takes it back").clicked() {
            studio.change(&change, None);
            is_done = true;
        }
    }
    is_done
}

/// Draws the list.
pub fn show(window: &mut Window, ui: &mut Ui) {
    let Some(output) = window.studio.shown().output().cloned() else { return };
    for remark in output.remarks() {
        ui.weak(remark);
    }
    for note in window.studio.notes() {
        let clash = note.clash.and_then(|index| output.fold_plan().clashes().get(index).copied());
        ui.horizontal_wrapped(|ui| {
            if note.about.is_empty() {
                ui.label(look::icon(Icon::TriangleAlert));
            } else {
                let (word, tip) = match clash {
                    Some(_) => ("Show clash", "shows the model at this moment, with the two panels in red"),
                    None => ("Go to", "selects what it is about"),
                };
                if ui.small_button(word).on_hover_text(tip).clicked() {
                    window.mode = Mode::Model;
                    clash.into_iter().for_each(|clash| window.space.show_clash(&window.studio, clash));
                    window.studio.selection.clear();
                    note.about.iter().for_each(|name| window.studio.selection.select(name, None, true));
                }
            }
            ui.add(egui::Label::new(words::warning(&note.warning)).wrap());
            advised(&mut window.studio, ui, |now| remedies::changes(&note.warning, now));
        });
    }
    focus::follow(ui);
}
