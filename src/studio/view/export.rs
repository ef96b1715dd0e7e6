//! The files to write: any format that there is, with its own options.

use super::super::messages::Cause;
use super::super::opened::Opened;
use super::super::state::Studio;
use super::profile_choice::ProfileChoice;
use super::values::Dialled;
use super::{commands, focus, look, modal};
use crate::app::output::{Target, place};
use eframe::egui::{self, Ui};
use lucide_icons::Icon;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::export::{FORMATS, Format, GUIDES};
use tatamu::project::options::{self, Entry};

/// Options by the formats that read them.
const OPTIONS: [(&str, &[&str]); 13] = [
    ("style", &["pdf", "svg", "dxf", "png"]),
    ("tabs", &["pdf", "svg", "png"]),
    ("color", &["pdf", "svg", "png", "glb", "obj", "html", "guide"]),
    ("tile", &["pdf"]),
    ("overview", &["pdf"]),
    ("text", &["svg"]),
    ("stroke", &["svg"]),
    ("dxf_version", &["dxf"]),
    ("dxf_sheets", &["dxf"]),
    ("dpi", &["png"]),
    ("static", &["glb"]),
    ("fold_pieces", &["fold"]),
    ("guide_language", &["html", "guide"]),
];

/// Formats that show the sheets as they are drawn.
const PAGES: [&str; 4] = ["pdf", "svg", "dxf", "png"];

/// The panel of the files.
pub struct ExportPanel {
    /// The formats, with whether they are wanted.
    rows: Vec<(&'static Format, bool)>,
    /// Folder and stem; none before the user writes another.
    place: Option<(String, String)>,
    /// Files that are there already, while the user is asked whether they may be replaced.
    replaces: Vec<PathBuf>,
    written_to: Option<PathBuf>,
    /// Whether the folder is to be chosen in a dialog.
    wants_folder: bool,
}

impl Default for ExportPanel {
    fn default() -> Self {
        let names: Vec<&str> = FORMATS.iter().map(|f| f.name).collect();
        let guides = GUIDES.iter().filter(|guide| !names.contains(&guide.name));
        let rows = FORMATS.iter().chain(guides).enumerate().map(|(k, format)| (format, k == 0));
        Self {
            rows: rows.collect(),
            place: None,
            replaces: Vec::new(),
            written_to: None,
            wants_folder: false,
        }
    }
}

impl ExportPanel {
    /// The folder that files were written to last.
    pub fn written_to(&self) -> Option<&Path> {
        self.written_to.as_deref()
    }

    /// The folder from which another one is to be chosen in a dialog; once.
    pub fn wants_folder(&mut self, studio: &Studio) -> Option<PathBuf> {
        std::mem::take(&mut self.wants_folder).then(|| PathBuf::from(self.place_of(studio).0))
    }

    /// Writes into this folder.
    pub fn set_folder(&mut self, folder: &Path, studio: &Studio) {
        self.place = Some((folder.display().to_string(), self.place_of(studio).1));
    }

    /// Folder and stem.
    fn place_of(&self, studio: &Studio) -> (String, String) {
        let of_file = |opened: &Arc<Opened>| {
            (studio.folder_beside(&opened.source).display().to_string(), opened.title())
        };
        self.place.clone().or_else(|| studio.opened().map(of_file)).unwrap_or_default()
    }

    /// Whether it asks something.
    pub fn asks(&self) -> bool {
        !self.replaces.is_empty()
    }

    /// Whether a format with pages is ticked.
    pub fn has_pages(&self) -> bool {
        self.wanted().any(|format| PAGES.contains(&format.name))
    }

    /// Draws the panel; whether what is on the command line alone is to be listed.
    pub fn show(&mut self, studio: &mut Studio, profiles: &mut ProfileChoice, ui: &mut Ui) -> bool {
        let mut is_more_wanted = false;
        if studio.opened().is_none() {
            return false;
        }
        let (mut folder, mut stem) = self.place_of(studio);
        ui.heading("Export");
        egui::Grid::new("place").num_columns(2).show(ui, |ui| {
            let label = ui.label("Folder");
            let is_folder_changed = ui
                .horizontal(|ui| {
                    let button = ui.spacing().interact_size.x + 60.0;
                    let is_changed = text(ui, &mut folder, label.id, ui.available_width() - button);
                    self.wants_folder |= ui.button("Choose …").on_hover_text("chooses a folder").clicked();
                    is_changed
                })
                .inner;
            ui.end_row();
            let label = ui.label("Name");
            let is_stem_changed = text(ui, &mut stem, label.id, f32::INFINITY);
            ui.end_row();
            if is_folder_changed || is_stem_changed {
                self.place = Some((folder.clone(), stem.clone()));
            }
        });
        ui.add_space(6.0);
        let height = (ui.available_height() - 60.0).max(100.0);
        ui.allocate_ui(egui::vec2(ui.available_width(), height), |ui| {
            ui.horizontal_top(|ui| {
                let width = 0.62 * ui.available_width();
                ui.allocate_ui(egui::vec2(width, height), |ui| self.formats(ui, &stem));
                ui.separator();
                ui.vertical(|ui| self.options(studio, profiles, ui));
            });
        });
        ui.add_space(6.0);
        ui.horizontal(|ui| {
            let is_ready =
                studio.finished().is_some() && self.wanted().next().is_some() && !stem.trim().is_empty();
            let text = format!("{}  Write files", look::icon(Icon::FileOutput));
            let button = ui.add_enabled(is_ready, look::primary(ui.visuals(), &text));
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_ready, "Write files"));
            if button.clicked() {
                self.replaces =
                    self.paths(&folder, stem.trim()).into_iter().filter(|path| path.exists()).collect();
                if self.replaces.is_empty() {
                    self.write(studio, profiles, &folder, stem.trim());
                }
            }
            if studio.finished().is_none() {
                ui.weak("available when the model is finished");
            } else if studio.tasks.is_busy() {
                look::spinner(ui);
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let name = commands::COMMAND_LINE.name;
                let more = ui.link(name).on_hover_text(commands::COMMAND_LINE.tip);
                is_more_wanted = more.clicked();
            });
        });
        self.ask(studio, profiles, ui.ctx(), &folder, stem.trim());
        is_more_wanted
    }

    fn formats(&mut self, ui: &mut Ui, stem: &str) {
        egui::ScrollArea::vertical().id_salt("formats").auto_shrink(false).show(ui, |ui| {
            egui::Grid::new("formats").num_columns(2).striped(true).show(ui, |ui| {
                for (format, is_wanted) in &mut self.rows {
                    ui.checkbox(is_wanted, file_name(stem, format));
                    ui.add(egui::Label::new(format.description).wrap());
                    ui.end_row();
                }
            });
            focus::follow(ui);
        });
    }

    /// The options of the formats that are ticked.
    fn options(&self, studio: &mut Studio, profiles: &mut ProfileChoice, ui: &mut Ui) {
        ui.strong("Options");
        let names: Vec<&str> = self.wanted().map(|format| format.name).collect();
        let is_read = |entry: &&Entry| {
            OPTIONS
                .iter()
                .any(|(name, formats)| *name == entry.name() && formats.iter().any(|f| names.contains(f)))
        };
        let wanted: Vec<&'static Entry> = options::of_table("export").filter(is_read).collect();
        let is_for_cutter = self.wanted().any(Format::is_job);
        if wanted.is_empty() && !is_for_cutter {
            ui.weak("the ticked formats have none");
        }
        egui::ScrollArea::vertical().id_salt("options").show(ui, |ui| {
            egui::Grid::new("options").num_columns(2).show(ui, |ui| {
                if is_for_cutter {
                    profiles.rows(ui);
                    let misfits = self.wanted().filter_map(|format| profiles.misfit(format));
                    misfits.for_each(|problem| {
                        ui.label("");
                        let text = egui::RichText::new(problem).color(ui.visuals().error_fg_color);
                        ui.add(egui::Label::new(text).wrap());
                        ui.end_row();
                    });
                }
                for entry in wanted {
                    let Some(settings) = studio.document().map(|d| d.settings().clone()) else { return };
                    Dialled::new(entry).row(studio, ui, &settings);
                }
            });
        });
    }

    /// Asks before files are replaced.
    fn ask(
        &mut self,
        studio: &mut Studio,
        profiles: &ProfileChoice,
        ctx: &egui::Context,
        folder: &str,
        stem: &str,
    ) {
        if self.replaces.is_empty() {
            return;
        }
        let mut answer = None;
        let shown = modal::new(ctx, "replace").show(ctx, |ui| {
            ui.set_width(420.0);
            ui.heading("Replace files?");
            for path in &self.replaces {
                ui.label(path.file_name().unwrap_or_default().to_string_lossy());
            }
            ui.weak(format!("in {folder}"));
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                let replace = ui.button("Replace");
                modal::focus_once(ui, &replace);
                if replace.clicked() {
                    answer = Some(true);
                }
                if ui.button("Cancel").clicked() {
                    answer = Some(false);
                }
            });
        });
        match answer.or(shown.should_close().then_some(false)) {
            None => return,
            Some(true) => self.write(studio, profiles, folder, stem),
            Some(false) => {}
        }
        self.replaces.clear();
    }

    fn wanted(&self) -> impl Iterator<Item = &'static Format> + '_ {
        self.rows.iter().filter(|row| row.1).map(|row| row.0)
    }

    /// The files that would be written, as far as their names are known before.
    fn paths(&self, folder: &str, stem: &str) -> Vec<PathBuf> {
        self.wanted().map(|format| PathBuf::from(folder).join(file_name(stem, format))).collect()
    }

    fn write(&mut self, studio: &mut Studio, profiles: &ProfileChoice, folder: &str, stem: &str) {
        let (Some(opened), Some(document)) = (studio.opened().cloned(), studio.document()) else { return };
        let Some(output) = studio.finished().cloned() else { return };
        let targets =
            self.wanted().zip(self.paths(folder, stem)).map(|(format, path)| Target { path, format });
        let project = document.project().clone();
        studio.messages_mut().clear(Cause::Export);
        let machine = [profiles.cutter(), profiles.medium()].map(str::to_owned);
        studio.tasks.export(opened, &project, output, machine, targets.collect());
        self.written_to = place(&PathBuf::from(folder).join(stem)).parent().map(Path::to_owned);
    }
}

/// The printed guide shares its extension with the sheets.
fn file_name(stem: &str, format: &Format) -> String {
    let is_other = FORMATS.iter().any(|f| f.name != format.name && f.extensions[0] == format.extensions[0]);
    let suffix = if is_other { format!("-{}", format.name) } else { String::new() };
    format!("{stem}{suffix}.{}", format.extensions[0])
}

fn text(ui: &mut Ui, text: &mut String, label: egui::Id, most: f32) -> bool {
    ui.add(egui::TextEdit::singleline(text).desired_width(most.min(420.0))).labelled_by(label).changed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_option_of_files_is_read_by_a_format_that_there_is() {
        let known: Vec<&str> = FORMATS.iter().chain(GUIDES).map(|format| format.name).collect();
        for (option, formats) in OPTIONS {
            assert!(options::of_table("export").any(|entry| entry.name() == option), "{option}");
            assert!(!formats.is_empty() && formats.iter().all(|name| known.contains(name)), "{option}");
        }
        // What the files are for chooses formats and options itself.
        for entry in options::of_table("export").filter(|entry| entry.name() != "for") {
            assert!(
                OPTIONS.iter().any(|(option, _)| *option == entry.name()),
                "{} has no format",
                entry.name()
            );
        }
    }
}
