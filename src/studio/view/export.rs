//! The files to write: any format that there is.

use super::super::state::Studio;
use crate::app::output::Target;
use eframe::egui::{self, Ui};
use std::path::PathBuf;
use tatamu::export::{FORMATS, Format, GUIDES};

/// The panel of the files.
pub struct ExportPanel {
    /// The formats, with whether they are wanted.
    rows: Vec<(&'static Format, bool)>,
    /// Folder and stem; none before the user writes another.
    place: Option<(String, String)>,
}

impl Default for ExportPanel {
    fn default() -> Self {
        let names: Vec<&str> = FORMATS.iter().map(|f| f.name).collect();
        let guides = GUIDES.iter().filter(|guide| !names.contains(&guide.name));
        let rows = FORMATS.iter().chain(guides).enumerate().map(|(k, format)| (format, k == 0));
        Self { rows: rows.collect(), place: None }
    }
}

impl ExportPanel {
    /// Draws the panel.
    pub fn show(&mut self, studio: &mut Studio, ui: &mut Ui) {
        let Some(opened) = studio.opened().cloned() else { return };
        let (mut folder, mut stem) = self.place.clone().unwrap_or_else(|| {
            let folder = opened.source.parent().map(std::path::Path::to_owned).unwrap_or_default();
            let folder = std::path::absolute(&folder).unwrap_or(folder);
            (folder.display().to_string(), opened.title())
        });
        ui.heading("Export");
        egui::Grid::new("place").num_columns(2).show(ui, |ui| {
            let label = ui.label("Folder");
            let is_folder_changed = text(ui, &mut folder, label.id);
            ui.end_row();
            let label = ui.label("Name");
            let is_stem_changed = text(ui, &mut stem, label.id);
            ui.end_row();
            if is_folder_changed || is_stem_changed {
                self.place = Some((folder.clone(), stem.clone()));
            }
        });
        ui.add_space(6.0);
        let height = (ui.available_height() - 70.0).max(100.0);
        egui::ScrollArea::vertical().max_height(height).show(ui, |ui| {
            egui::Grid::new("formats").num_columns(2).striped(true).show(ui, |ui| {
                for (format, is_wanted) in &mut self.rows {
                    ui.checkbox(is_wanted, file_name(&stem, format));
                    ui.label(format.description);
                    ui.end_row();
                }
            });
        });
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let count = self.rows.iter().filter(|row| row.1).count();
            let is_ready = studio.finished().is_some() && count > 0 && !stem.trim().is_empty();
            if ui.add_enabled(is_ready, egui::Button::new("Write files")).clicked() {
                self.write(studio, &folder, stem.trim());
            }
            if studio.finished().is_none() {
                ui.weak("available when the model is finished");
            } else if studio.tasks.is_busy() {
                ui.spinner();
            }
        });
        ui.weak(
            "Existing files are replaced. [export] in the project file sets style, resolution and colours.",
        );
    }

    fn write(&self, studio: &mut Studio, folder: &str, stem: &str) {
        let (Some(opened), Some(document)) = (studio.opened().cloned(), studio.document()) else { return };
        let Some(output) = studio.finished().cloned() else { return };
        let wanted = self.rows.iter().filter(|row| row.1);
        let targets = wanted
            .map(|(format, _)| Target { path: PathBuf::from(folder).join(file_name(stem, format)), format })
            .collect();
        let project = document.project().clone();
        studio.tasks.export(opened, &project, output, targets);
    }
}

/// The printed guide shares its extension with the sheets.
fn file_name(stem: &str, format: &Format) -> String {
    let is_other = FORMATS.iter().any(|f| f.name != format.name && f.extensions[0] == format.extensions[0]);
    let suffix = if is_other { format!("-{}", format.name) } else { String::new() };
    format!("{stem}{suffix}.{}", format.extensions[0])
}

fn text(ui: &mut Ui, text: &mut String, label: egui::Id) -> bool {
    ui.add(egui::TextEdit::singleline(text).desired_width(420.0)).labelled_by(label).changed()
}
