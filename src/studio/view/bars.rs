//! Menus, the bar of the state, warnings, and what is shown before a file is open.

use super::super::change::Change;
use super::super::words;
use super::{Mode, Window};
use eframe::egui::{self, Color32, RichText, Ui};
use std::path::PathBuf;
use tatamu::fold::Clash;

/// Menus, the choice of what is shown, and the file's name.
pub fn top(window: &mut Window, ui: &mut Ui) {
    egui::Panel::top("menus").show(ui, |ui| {
        egui::MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| file_menu(window, ui));
            ui.menu_button("Edit", |ui| edit_menu(window, ui));
            ui.menu_button("View", |ui| view_menu(window, ui));
            ui.menu_button("Help", |ui| {
                if ui.add(egui::Button::new("Shortcuts …").shortcut_text("F1")).clicked() {
                    window.shows_shortcuts = true;
                    ui.close();
                }
            });
            ui.separator();
            if window.studio.document().is_some() {
                for (mode, name) in Mode::ALL {
                    ui.selectable_value(&mut window.mode, mode, name);
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                if let (Some(opened), Some(document)) = (window.studio.opened(), window.studio.document()) {
                    let path = document.path().unwrap_or(&opened.source);
                    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                    let changed = if document.is_changed() { " *" } else { "" };
                    ui.strong(format!("{name}{changed}")).on_hover_text(path.display().to_string());
                }
            });
        });
    });
}

fn file_menu(window: &mut Window, ui: &mut Ui) {
    if ui.add(egui::Button::new("Open …").shortcut_text("Ctrl+O")).clicked() {
        window.ask_open();
        ui.close();
    }
    ui.menu_button("Open recent", |ui| {
        if let Some(path) = recent(window, ui) {
            window.open(&path);
            ui.close();
        }
    });
    let has_file = window.studio.document().is_some();
    if ui.add_enabled(has_file, egui::Button::new("Save project").shortcut_text("Ctrl+S")).clicked() {
        window.save();
        ui.close();
    }
    if ui.add_enabled(has_file, egui::Button::new("Save project as …")).clicked() {
        window.ask_save();
        ui.close();
    }
    ui.separator();
    if ui.add(egui::Button::new("Quit").shortcut_text("Ctrl+Q")).clicked() {
        ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
    }
}

fn recent(window: &Window, ui: &mut Ui) -> Option<PathBuf> {
    let files = window.studio.recent();
    if files.is_empty() {
        ui.weak("no files yet");
    }
    let clicked = |path: &PathBuf, ui: &mut Ui| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        ui.button(name).on_hover_text(path.display().to_string()).clicked()
    };
    files.into_iter().filter(|path| clicked(path, ui)).last()
}

fn edit_menu(window: &mut Window, ui: &mut Ui) {
    let document = window.studio.document();
    let undo = document.and_then(|d| d.undo_label()).map(str::to_owned);
    let redo = document.and_then(|d| d.redo_label()).map(str::to_owned);
    let text = |word: &str, label: &Option<String>| match label {
        Some(label) => format!("{word}: {label}"),
        None => word.to_owned(),
    };
    if ui
        .add_enabled(undo.is_some(), egui::Button::new(text("Undo", &undo)).shortcut_text("Ctrl+Z"))
        .clicked()
    {
        window.studio.undo();
    }
    if ui
        .add_enabled(redo.is_some(), egui::Button::new(text("Redo", &redo)).shortcut_text("Ctrl+Shift+Z"))
        .clicked()
    {
        window.studio.redo();
    }
    ui.separator();
    let several = window.studio.selection.names().len() > 1;
    if ui.add_enabled(several, egui::Button::new("Merge selected components").shortcut_text("M")).clicked() {
        window.studio.merge_selected();
        ui.close();
    }
}

fn view_menu(window: &mut Window, ui: &mut Ui) {
    let sides =
        [("Front", "1", 0.0, 0.0), ("Side", "2", std::f64::consts::FRAC_PI_2, 0.0), ("Top", "3", 0.0, 1.5)];
    for (name, key, azimuth, elevation) in sides {
        if ui.add(egui::Button::new(name).shortcut_text(key)).clicked() {
            window.space.look_from(azimuth, elevation);
            ui.close();
        }
    }
    if ui.add(egui::Button::new("Fit").shortcut_text("F")).clicked() {
        window.space.fit();
        ui.close();
    }
    ui.separator();
    ui.label("Theme");
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

/// Progress, problems, warnings.
pub fn bottom(window: &mut Window, ui: &mut Ui) {
    egui::Panel::bottom("state").show(ui, |ui| {
        ui.horizontal(|ui| {
            state(window, ui);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| summary(window, ui));
        });
    });
    if window.shows_warnings && window.studio.shown().output().is_some() {
        egui::Panel::bottom("warnings").resizable(true).default_size(130.0).show(ui, |ui| {
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| warnings(window, ui));
        });
    }
}

fn state(window: &mut Window, ui: &mut Ui) {
    if let Some(busy) = window.studio.busy() {
        match busy.fraction {
            Some(done) => drop(ui.add(egui::ProgressBar::new(done as f32).desired_width(90.0))),
            None => drop(ui.spinner()),
        }
        ui.label(busy.stage);
        if ui.small_button("Stop").on_hover_text("Esc").clicked() {
            window.studio.cancel();
        }
    } else if window.studio.tasks.is_busy() {
        ui.spinner();
        ui.label("files");
    }
    let (text, is_problem) = match (window.studio.problem(), window.studio.notice()) {
        (Some(problem), _) => (problem.to_owned(), true),
        (None, Some(notice)) => (notice.to_owned(), false),
        _ => return,
    };
    let colour = if is_problem { ui.visuals().error_fg_color } else { ui.visuals().text_color() };
    let width = (ui.available_width() - 300.0).max(120.0);
    ui.scope(|ui| {
        ui.set_max_width(width);
        ui.add(egui::Label::new(RichText::new(&text).color(colour)).truncate()).on_hover_text(&text);
    });
    if let Some(name) = window.studio.missing().map(str::to_owned)
        && ui
            .small_button(format!("Forget {name}"))
            .on_hover_text("deletes its settings from the project")
            .clicked()
    {
        window.studio.change(&Change::Forget { name }, None);
    }
    if ui.small_button("Dismiss").clicked() {
        window.studio.dismiss();
    }
}

fn summary(window: &mut Window, ui: &mut Ui) {
    let Some(output) = window.studio.shown().output() else { return };
    let count = output.warnings().len();
    let sheets = output.layout().sheet_count();
    let pieces: usize = output.nets().iter().map(|net| net.pieces().len()).sum();
    let parts = output.model().parts().len();
    let text = match count {
        0 if !window.studio.shown().is_folded() => "folding not checked yet".to_owned(),
        0 => "no warnings".to_owned(),
        1 => "1 warning".to_owned(),
        n => format!("{n} warnings"),
    };
    if count > 0 {
        ui.toggle_value(&mut window.shows_warnings, text);
    } else {
        ui.weak(text);
    }
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let counts = [(parts, "component"), (pieces, "piece"), (sheets, "sheet")].map(|(n, what)| count(n, what));
    ui.weak(format!("{} ·", counts.join(" · ")));
}

/// Each warning with a button that goes to the place.
fn warnings(window: &mut Window, ui: &mut Ui) {
    let Some(output) = window.studio.shown().output().cloned() else { return };
    let plan = output.fold_plan();
    for clash in plan.clashes() {
        let is_shown = window.space.clash() == Some(*clash);
        let [a, b] = clash.parts.map(|p| output.model().parts()[p].name.as_str());
        ui.horizontal(|ui| {
            if ui.selectable_label(is_shown, "Show").on_hover_text("shows the model at this moment").clicked()
            {
                show_clash(window, *clash);
            }
            let what = if a == b { format!("{a} touches itself") } else { format!("{a} touches {b}") };
            ui.colored_label(
                Color32::from_rgb(210, 60, 40),
                format!(
                    "{what} at {:.0} % of its folding, {:.2} mm deep",
                    100.0 * clash.folded,
                    clash.depth_mm
                ),
            );
        });
    }
    let names: Vec<(String, String)> = output
        .model()
        .parts()
        .iter()
        .zip(output.shaped().divided().hulls().names())
        .map(|(part, name)| (part.name.clone(), name.clone()))
        .collect();
    for remark in output.remarks() {
        ui.weak(remark);
    }
    for warning in output.warnings() {
        let message = words::warning(warning);
        ui.horizontal_wrapped(|ui| {
            // The longest name that it mentions, so that part-1 is not taken for part-12.
            let about = names.iter().filter(|(shown, _)| message.contains(shown.as_str()));
            if let Some((_, name)) = about.max_by_key(|(shown, _)| shown.len()) {
                if ui.small_button("Go to").on_hover_text("selects the component").clicked() {
                    window.studio.selection.select(name, None, false);
                    window.mode = Mode::Model;
                }
            } else {
                ui.label("•");
            }
            ui.label(&message);
        });
    }
}

fn show_clash(window: &mut Window, clash: Clash) {
    window.mode = Mode::Model;
    window.space.show_clash(&window.studio, clash);
    if let Some(name) = window.studio.shown().names().get(clash.mover).cloned() {
        window.studio.selection.select(&name, None, false);
    }
}

/// Before a file is open.
pub fn welcome(window: &mut Window, ui: &mut Ui) {
    ui.vertical_centered(|ui| {
        ui.add_space(0.14 * ui.available_height());
        ui.heading(RichText::new("tatamu").size(34.0));
        ui.label("turns a mesh into a paper model that folds flat");
        ui.add_space(20.0);
        if window.studio.tasks.is_busy() {
            ui.spinner();
            ui.label("reading …");
        } else if ui.button(RichText::new("Open a mesh or a project …").size(16.0)).clicked() {
            window.ask_open();
        }
        ui.add_space(6.0);
        ui.weak("or drop a file here: OBJ, STL, PLY, OFF, glTF, GLB, 3MF, or a project (TOML)");
        if let Some(problem) = window.studio.problem() {
            ui.add_space(12.0);
            ui.colored_label(ui.visuals().error_fg_color, problem);
        }
        let files = window.studio.recent();
        if !files.is_empty() {
            ui.add_space(24.0);
            ui.strong("Open recent");
            for path in files {
                let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                if ui.link(name).on_hover_text(path.display().to_string()).clicked() {
                    window.open(&path);
                }
            }
        }
        ui.add_space(24.0);
        if ui.link("Shortcuts").clicked() {
            window.shows_shortcuts = true;
        }
    });
}
