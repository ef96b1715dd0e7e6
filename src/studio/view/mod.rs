//! The window: panels that show the studio's state and pass on what the user does.

mod bars;
mod browser;
mod dials;
mod export;
mod parts;
mod picture;
mod plot;
mod sheets;
mod shortcuts;
mod space;
#[cfg(all(test, feature = "studio-test"))]
mod tests;
mod values;
mod wheel;

use super::state::Studio;
use browser::{Browser, Purpose};
use eframe::egui;
use export::ExportPanel;
use plot::PlotPanel;
use sheets::SheetsPanel;
use space::Space;
use std::path::Path;

/// What the middle of the window shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The model in space.
    Model,
    /// Its sheets.
    Sheets,
    /// The files to write.
    Export,
    /// The cutter.
    Plot,
}

impl Mode {
    const ALL: [(Self, &'static str); 4] =
        [(Self::Model, "Model"), (Self::Sheets, "Sheets"), (Self::Export, "Export"), (Self::Plot, "Plot")];
}

/// What the user is asked before a file is closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Question {
    /// The window is to be closed with changes that are not saved.
    Close,
}

/// The window.
pub struct Window {
    studio: Studio,
    mode: Mode,
    space: Space,
    sheets: SheetsPanel,
    export: ExportPanel,
    plot: PlotPanel,
    browser: Option<Browser>,
    shows_shortcuts: bool,
    shows_warnings: bool,
    question: Option<Question>,
    may_close: bool,
    parts: parts::PartsPanel,
    /// The file that the panels show.
    source: Option<std::path::PathBuf>,
}

impl Window {
    /// A window on a studio.
    pub fn new(studio: Studio) -> Self {
        Self {
            studio,
            mode: Mode::Model,
            space: Space::default(),
            sheets: SheetsPanel::default(),
            export: ExportPanel::default(),
            plot: PlotPanel::default(),
            browser: None,
            shows_shortcuts: false,
            shows_warnings: false,
            question: None,
            may_close: false,
            parts: parts::PartsPanel::default(),
            source: None,
        }
    }

    /// The state behind the window.
    #[cfg(test)]
    pub fn studio(&self) -> &Studio {
        &self.studio
    }

    /// The state behind the window, to be changed by tests.
    #[cfg(test)]
    pub fn studio_mut(&mut self) -> &mut Studio {
        &mut self.studio
    }

    /// The view in space.
    #[cfg(test)]
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The panel of the cutter.
    #[cfg(test)]
    pub fn plot_mut(&mut self) -> &mut PlotPanel {
        &mut self.plot
    }

    /// Opens a file.
    pub fn open(&mut self, path: &Path) {
        self.studio.open(path);
    }

    /// Draws everything, and heeds what the user did.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        self.studio.poll();
        self.follow_file();
        let ctx = ui.ctx().clone();
        let dropped: Vec<_> =
            ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
        if let Some(path) = dropped.first() {
            self.open(path);
        }
        shortcuts::heed(self, &ctx);
        bars::top(self, ui);
        bars::bottom(self, ui);
        if self.studio.document().is_none() {
            egui::CentralPanel::default().show(ui, |ui| bars::welcome(self, ui));
        } else {
            egui::Panel::left("parts").resizable(true).default_size(270.0).show(ui, |ui| {
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    parts::show(&mut self.parts, &mut self.studio, &mut self.space, ui);
                });
            });
            self.middle(ui);
        }
        self.dialogs(&ctx);
    }

    /// Panels begin anew with another file.
    fn follow_file(&mut self) {
        let source = self.studio.opened().map(|opened| opened.source.clone());
        if source != self.source {
            self.source = source;
            self.space.reset();
            (self.sheets, self.export) = (SheetsPanel::default(), ExportPanel::default());
            self.parts = parts::PartsPanel::default();
        }
    }

    fn middle(&mut self, ui: &mut egui::Ui) {
        match self.mode {
            Mode::Model => {
                egui::Panel::bottom("folding")
                    .show(ui, |ui| space::folding_bar(&mut self.space, &mut self.studio, ui));
                egui::CentralPanel::no_frame().show(ui, |ui| self.space.show(&mut self.studio, ui));
            }
            Mode::Sheets => {
                egui::CentralPanel::default().show(ui, |ui| self.sheets.show(&mut self.studio, ui));
            }
            Mode::Export => {
                egui::CentralPanel::default().show(ui, |ui| self.export.show(&mut self.studio, ui));
            }
            Mode::Plot => {
                egui::CentralPanel::default().show(ui, |ui| self.plot.show(&mut self.studio, ui));
            }
        }
    }

    fn dialogs(&mut self, ctx: &egui::Context) {
        if let Some(browser) = &mut self.browser {
            match browser.show(ctx) {
                browser::Answer::Open => {}
                browser::Answer::Cancelled => self.browser = None,
                browser::Answer::Chosen(path) => {
                    let purpose = browser.purpose();
                    self.browser = None;
                    match purpose {
                        Purpose::Open => self.open(&path),
                        Purpose::Save => self.studio.save_as(&path),
                    }
                }
            }
        }
        if self.shows_shortcuts {
            shortcuts::window(ctx, &mut self.shows_shortcuts);
        }
        self.closing(ctx);
    }

    /// Asks before changes are lost.
    fn closing(&mut self, ctx: &egui::Context) {
        let is_changed = self.studio.document().is_some_and(|d| d.is_changed());
        let is_cutting = self.plot.is_running();
        if ctx.input(|i| i.viewport().close_requested()) && !self.may_close && (is_changed || is_cutting) {
            ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            self.question = Some(Question::Close);
        }
        let Some(Question::Close) = self.question else { return };
        let mut close = false;
        egui::Modal::new(egui::Id::unique("close")).show(ctx, |ui| {
            if is_cutting {
                ui.label("A job is running. Closing stops it and lifts the tool.");
            }
            if is_changed {
                ui.label("You have unsaved changes.");
            }
            ui.horizontal(|ui| {
                if is_changed && ui.button("Save and close").clicked() {
                    if self.studio.save() {
                        close = !self.studio.document().is_some_and(|d| d.is_changed());
                    } else {
                        self.ask_save();
                    }
                    self.question = None;
                }
                if ui.button("Close without saving").clicked() {
                    self.studio.discard();
                    close = true;
                }
                if ui.button("Cancel").clicked() {
                    self.question = None;
                }
            });
        });
        if close {
            self.plot.stop();
            self.may_close = true;
            self.question = None;
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
    }

    /// Asks for a file to open.
    fn ask_open(&mut self) {
        let folder = self.studio.opened().and_then(|o| o.source.parent().map(Path::to_owned));
        self.browser = Some(Browser::new(Purpose::Open, folder, ""));
    }

    /// Asks for the name of the project file.
    fn ask_save(&mut self) {
        let Some(opened) = self.studio.opened() else { return };
        let name = format!("{}.toml", opened.title());
        self.browser = Some(Browser::new(Purpose::Save, opened.source.parent().map(Path::to_owned), &name));
    }

    /// Saves, and asks for a name where there is none.
    fn save(&mut self) {
        if !self.studio.save() {
            self.ask_save();
        }
    }
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }
}
