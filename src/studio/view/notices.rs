//! Messages above the status bar, each in full and with its own button to close it.

use super::super::change::Change;
use super::super::messages::{Cause, Message};
use super::{Window, look, warnings};
use eframe::egui::{self, RichText, Ui};
use lucide_icons::Icon;
use tatamu::front::remedies;

/// Most notices that are shown at once.
const MOST: usize = 3;

/// Draws them, the newest first.
pub fn show(window: &mut Window, ui: &mut Ui) {
    let messages: Vec<_> = window.studio.messages().iter().take(MOST).cloned().collect();
    if messages.is_empty() {
        return;
    }
    egui::Panel::bottom("messages").show(ui, |ui| {
        ui.add_space(2.0);
        for message in &messages {
            let (picture, colour) = match message.is_problem {
                true => (look::icon(Icon::CircleAlert), ui.visuals().error_fg_color),
                false => (look::icon(Icon::Info), ui.visuals().text_color()),
            };
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Min), |ui| {
                let close = ui.small_button(look::icon(Icon::X));
                close.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, "Dismiss"));
                if close.on_hover_text("dismisses this message").clicked() {
                    window.studio.messages_mut().clear(message.cause);
                }
                actions(window, ui, message);
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Min), |ui| {
                    ui.label(RichText::new(picture).color(colour).size(16.0));
                    ui.add(egui::Label::new(RichText::new(&message.text).color(colour)).wrap());
                });
            });
        }
    });
}

/// What can be done about it.
fn actions(window: &mut Window, ui: &mut Ui, message: &Message) {
    let &Message { cause, is_problem, .. } = message;
    if warnings::advised(&mut window.studio, ui, |now| remedies::of(&message.remedies, now)) {
        window.studio.messages_mut().clear(cause);
    }
    if cause == Cause::Model && !is_problem && ui.small_button("Start again").clicked() {
        window.studio.resume();
    }
    if cause == Cause::Model
        && let Some(name) = window.studio.missing().map(str::to_owned)
        && ui
            .small_button(format!("Forget {name}"))
            .on_hover_text("deletes its settings from the project")
            .clicked()
    {
        window.studio.change(&Change::Forget { name }, None);
    }
    if cause == Cause::Export
        && !is_problem
        && let Some(folder) = window.export.written_to().map(std::path::Path::to_owned)
        && ui.small_button("Open folder").on_hover_text(folder.display().to_string()).clicked()
    {
        ui.ctx().open_url(egui::OpenUrl::new_tab(format!("file://{}", folder.display())));
    }
    if cause == Cause::Recovery && ui.small_button("Undo").on_hover_text("drops what was recovered").clicked()
    {
        window.studio.undo();
    }
}
