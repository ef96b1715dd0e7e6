//! Menus, tools, and the bar of the state.

use super::commands::{self, Command, Place};
use super::{Mode, Window, look};
use crate::app::text::counted;
use eframe::egui::{self, Ui};
use lucide_icons::Icon;
use std::path::PathBuf;

/// Menus, tools, the choice of what is shown, and the file's name.
pub fn top(window: &mut Window, ui: &mut Ui) {
    let bar = egui::Panel::top("menus").show(ui, |ui| {
        egui::MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| {
                menu(window, ui, |place| if let Place::File(group) = place { Some(group) } else { None });
            });
            ui.menu_button("Edit", |ui| {
                menu(window, ui, |place| if let Place::Edit(group) = place { Some(group) } else { None });
            });
            ui.menu_button("View", |ui| {
                menu(window, ui, |place| if let Place::View(group) = place { Some(group) } else { None });
                ui.separator();
                themes(ui);
            });
            ui.menu_button("Help", |ui| {
                menu(window, ui, |place| if let Place::Help(group) = place { Some(group) } else { None });
            });
            ui.separator();
            for command in [&commands::OPEN, &commands::SAVE, &commands::UNDO, &commands::REDO] {
                command.button(window, ui);
            }
            if window.studio.document().is_some() {
                ui.separator();
                for (mode, command) in MODES {
                    tab(window, ui, mode, command);
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                commands::FIND.button(window, ui);
                if let (Some(name), Some(document)) = (window.file_name(), window.studio.document()) {
                    let path =
                        document.path().or(window.studio.opened().map(|opened| opened.source.as_path()));
                    let path = path.map_or(String::new(), |path| path.display().to_string());
                    ui.add(egui::Label::new(egui::RichText::new(name).strong()).truncate())
                        .on_hover_text(path);
                }
            });
        });
    });
    window.places.modes = Some(bar.response.rect);
}

const MODES: [(Mode, &Command); 4] = [
    (Mode::Model, &commands::MODEL),
    (Mode::Sheets, &commands::SHEETS),
    (Mode::Export, &commands::EXPORT),
    (Mode::Plot, &commands::PLOT),
];

fn tab(window: &mut Window, ui: &mut Ui, mode: Mode, command: &Command) {
    let text = format!("{}  {}", command.picture(), command.name);
    let is_on = window.mode == mode;
    let tab = ui.selectable_label(is_on, text);
    tab.widget_info(|| egui::WidgetInfo::selected(egui::Role::Tab, true, is_on, command.name));
    if tab.on_hover_text(command.hover_text(ui.ctx())).clicked() {
        command.run(window, ui.ctx());
    }
}

/// The commands of a menu, group by group.
fn menu(window: &mut Window, ui: &mut Ui, group_of: impl Fn(Place) -> Option<u8>) {
    let mut last = None;
    for command in commands::all() {
        let Some(group) = group_of(command.place) else { continue };
        if last.is_some_and(|last| last != group) {
            ui.separator();
        }
        last = Some(group);
        command.menu_item(window, ui);
        if std::ptr::eq(command, &commands::OPEN) {
            recent(window, ui);
        }
    }
}

fn recent(window: &mut Window, ui: &mut Ui) {
    ui.menu_button(format!("{}  Open recent", look::icon(Icon::History)), |ui| {
        let files = window.studio.recent();
        if files.is_empty() {
            ui.weak("no files yet");
        }
        let clicked = |path: &PathBuf, ui: &mut Ui| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            ui.button(name).on_hover_text(path.display().to_string()).clicked()
        };
        if let Some(path) = files.into_iter().filter(|path| clicked(path, ui)).last() {
            window.open(&path);
            ui.close();
        }
    });
}

fn themes(ui: &mut Ui) {
    ui.weak("Theme");
    let mut theme = ui.ctx().options(|o| o.theme_preference);
    for (name, value) in [
        ("System", egui::ThemePreference::System),
        ("Light", egui::ThemePreference::Light),
        ("Dark", egui::ThemePreference::Dark),
    ] {
        ui.radio_value(&mut theme, value, name);
    }
    ui.ctx().set_theme(theme);
}

/// Warnings that are seen without scrolling, and the points that each takes.
const MOST_LINES: usize = 5;
const LINE: f32 = 27.0;

/// Progress, and what the model comes to.
pub fn bottom(window: &mut Window, ui: &mut Ui) {
    egui::Panel::bottom("state").show(ui, |ui| {
        ui.horizontal(|ui| {
            state(window, ui);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| summary(window, ui));
        });
    });
    super::notices::show(window, ui);
    if window.shows_warnings && window.studio.shown().output().is_some() {
        // As high as a short list needs, of which one is in two lines.
        let lines = window.studio.notes().len().min(MOST_LINES);
        let panel = egui::Panel::bottom(egui::Id::unique("warnings").with(lines)).resizable(true);
        panel.default_size(LINE * (lines + 1) as f32).show(ui, |ui| {
            let list = egui::ScrollArea::vertical().auto_shrink(false).min_scrolled_height(0.0);
            list.show(ui, |ui| super::warnings::show(window, ui));
        });
    }
}

fn state(window: &mut Window, ui: &mut Ui) {
    if let Some(busy) = window.studio.busy() {
        match busy.fraction {
            Some(done) => {
                let bar = ui.add(egui::ProgressBar::new(done as f32).desired_width(90.0));
                bar.widget_info(|| {
                    egui::WidgetInfo::labeled(egui::Role::ProgressIndicator, true, busy.stage)
                });
            }
            None => look::spinner(ui),
        }
        // Progress calls nobody.
        ui.ctx().request_repaint_after(look::TICK);
        ui.label(busy.stage);
        if ui.small_button("Stop").on_hover_text("stops the calculation (Esc)").clicked() {
            window.studio.cancel();
        }
    } else if window.studio.tasks.is_busy() {
        look::spinner(ui);
        ui.label("reading or writing files …");
    } else if window.studio.document().is_some() {
        ui.weak("ready");
    }
}

fn summary(window: &mut Window, ui: &mut Ui) {
    let Some(output) = window.studio.shown().output() else { return };
    let count = window.studio.notes().len();
    let sheets = output.layout().sheet_count();
    let pieces: usize = output.nets().iter().map(|net| net.pieces().len()).sum();
    let parts = output.model().parts().len();
    let text = match count {
        0 if !window.studio.shown().is_folded() => "folding not checked yet".to_owned(),
        0 => "no warnings".to_owned(),
        n => counted(n, "warning"),
    };
    if count > 0 {
        let is_on = window.shows_warnings;
        let button = ui
            .toggle_value(&mut window.shows_warnings, format!("{}  {text}", look::icon(Icon::TriangleAlert)));
        button.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, is_on, &text));
    } else {
        ui.weak(text);
    }
    let counts =
        [(parts, "component"), (pieces, "piece"), (sheets, "sheet")].map(|(n, what)| counted(n, what));
    ui.weak(format!("{} ·", counts.join(" · ")));
}
