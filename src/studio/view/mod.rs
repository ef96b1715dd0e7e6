//! The window: panels that show the studio's state and pass on what the user does.

mod bars;
mod browser;
mod canvas;
mod command_line;
mod commands;
mod context;
mod dialogs;
mod dials;
mod edges;
mod export;
mod finder;
mod focus;
mod look;
mod machine;
mod measure;
mod memory;
mod modal;
mod notices;
mod parts;
mod picture;
mod plot;
mod profile_choice;
mod ring;
mod selected_piece;
mod sheets;
mod space;
mod space_marks;
mod strokes;
#[cfg(all(test, feature = "studio-test"))]
mod tests;
mod tour;
mod values;
mod warnings;
mod welcome;
mod wheel;

use super::messages::Cause;
use super::state::Studio;
use browser::Purpose;
use command_line::Named;
pub use dialogs::Chooser;
use dialogs::{Dialogs, Leave, Outcome, Parting, Work};
use eframe::egui::{self, Rect};
use export::ExportPanel;
use focus::FocusRing;
use memory::Memory;
use plot::PlotPanel;
use sheets::SheetsPanel;
use space::Space;
use std::path::Path;
use tour::{Spot, Tour};

/// Points that the model and the files keep beside the sheets, however narrow the window is.
const LEAST_BESIDE: [f32; 2] = [280.0, 540.0];
/// Points that sheets need.
const LEAST_SHEETS: [f32; 2] = [220.0, 160.0];

/// What the middle of the window shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// The model in space, perhaps with its sheets beside it.
    Model,
    /// The sheets alone.
    Sheets,
    /// The files to write.
    Export,
    /// The cutter.
    Plot,
}

/// Where parts of the window are.
#[derive(Debug, Clone, Copy, Default)]
struct Places {
    modes: Option<Rect>,
    settings: Option<Rect>,
    model: Option<Rect>,
    folding: Option<Rect>,
    sheets: Option<Rect>,
}

/// The window.
pub struct Window {
    studio: Studio,
    mode: Mode,
    space: Space,
    sheets: SheetsPanel,
    has_sheets_beside: bool,
    /// The share of the room that the sheets have beside the model, and the points of that room.
    sheets_share: f32,
    room_beside: f32,
    export: ExportPanel,
    plot: PlotPanel,
    parts: parts::PartsPanel,
    dialogs: Dialogs,
    tour: Option<Tour>,
    shows_warnings: bool,
    may_close: bool,
    /// The session of the studio that the panels show.
    session: u64,
    places: Places,
    title: String,
    memory: Memory,
    focus: FocusRing,
    /// Pictures of the page before a file is open.
    samples: welcome::Pictures,
}

impl Window {
    /// A window on a studio.
    pub fn new(studio: Studio, chooser: Chooser) -> Self {
        let preferences = studio.preferences();
        Self {
            mode: Mode::Model,
            space: Space::default(),
            sheets: SheetsPanel::default(),
            has_sheets_beside: preferences.has_sheets_beside.unwrap_or(true),
            sheets_share: 0.42,
            room_beside: 0.0,
            export: ExportPanel::default(),
            plot: PlotPanel::new(&preferences),
            parts: parts::PartsPanel::default(),
            dialogs: Dialogs::new(chooser),
            tour: (!preferences.has_seen_tour).then(Tour::default),
            shows_warnings: false,
            may_close: false,
            session: 0,
            places: Places::default(),
            title: String::new(),
            memory: Memory::new(preferences),
            focus: FocusRing::default(),
            samples: welcome::Pictures::default(),
            studio,
        }
    }

    /// Gives the window its look; once, before it is shown.
    pub fn set_up(&self, ctx: &egui::Context) {
        look::set(ctx);
        self.memory.set_up(ctx);
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

    /// The title of the window.
    #[cfg(test)]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Opens a file; asks first where another one has changes that are not saved.
    pub fn open(&mut self, path: &Path) {
        if self.work().is_changed {
            self.dialogs.ask_leave(Leave::Open(path.to_owned()));
        } else {
            self.studio.open(path);
        }
    }

    /// Draws everything, and handles what the user did.
    pub fn show(&mut self, ui: &mut egui::Ui) {
        self.studio.poll();
        self.follow_file();
        let ctx = ui.ctx().clone();
        wheel::let_scroll(&ctx);
        let dropped: Vec<_> =
            ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_owned()).collect());
        if let Some(path) = dropped.first() {
            self.open(path);
        }
        self.set_title(&ctx);
        if let Some(path) = self.studio.take_printed() {
            // The viewer's own dialog prints it.
            ctx.open_url(egui::OpenUrl::new_tab(format!("file://{}", path.display())));
        }
        if !self.is_asking() {
            if self.is_touring() && self.tour.as_mut().is_some_and(|tour| !tour.handle_keys(&ctx)) {
                self.tour = None;
            }
            commands::handle_keys(self, &ctx);
        }
        let hover = self.studio.hover.take();
        self.space.set_hover(hover.clone());
        self.sheets.set_hover(hover.clone());
        bars::top(self, ui);
        bars::bottom(self, ui);
        if self.studio.document().is_none() {
            egui::CentralPanel::default().show(ui, |ui| welcome::show(self, ui));
        } else {
            self.samples.clear();
            let panel = egui::Panel::left("parts").resizable(true).default_size(290.0).show(ui, |ui| {
                egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                    parts::show(&mut self.parts, &mut self.studio, &mut self.space, ui);
                    focus::follow(ui);
                });
            });
            self.places.settings = Some(panel.response.rect);
            context::of_names(self, ui, &panel.response);
            self.middle(ui);
        }
        if self.studio.hover != hover {
            ctx.request_repaint();
        }
        self.show_tour(&ctx);
        self.show_dialogs(&ctx);
        self.focus.show(&ctx);
        self.memory.keep(&self.studio, &ctx, &self.plot, self.has_sheets_beside, self.tour.is_none());
    }

    /// Whether something is asked over the window, so that keys are no commands.
    fn is_asking(&self) -> bool {
        self.dialogs.is_open()
            || self.mode == Mode::Plot && self.plot.asks()
            || self.mode == Mode::Export && self.export.asks()
    }

    /// Resets the panels when another file is open.
    fn follow_file(&mut self) {
        if self.studio.session() != self.session {
            self.session = self.studio.session();
            self.space.reset();
            (self.sheets, self.export) = (SheetsPanel::default(), ExportPanel::default());
            self.parts = parts::PartsPanel::default();
        }
    }

    /// The name of the file that is open, with a star where something is not saved.
    fn file_name(&self) -> Option<String> {
        let (opened, document) = (self.studio.opened()?, self.studio.document()?);
        let name = document.path().unwrap_or(&opened.source).file_name().unwrap_or_default();
        Some(format!("{}{}", name.to_string_lossy(), if document.is_changed() { " *" } else { "" }))
    }

    fn set_title(&mut self, ctx: &egui::Context) {
        let title = self.file_name().map_or("tatamu".to_owned(), |name| format!("{name} – tatamu"));
        if title != self.title {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    fn middle(&mut self, ui: &mut egui::Ui) {
        match self.mode {
            Mode::Model => self.model(ui),
            Mode::Sheets => {
                let panel =
                    egui::CentralPanel::default().show(ui, |ui| self.sheets.show(&mut self.studio, ui));
                self.places.sheets = Some(panel.response.rect);
                context::of_pieces(self, ui, &panel.response);
            }
            Mode::Export => {
                let room = ui.available_width() - LEAST_BESIDE[1];
                if self.export.has_pages() && room >= LEAST_SHEETS[1] {
                    let panel = egui::Panel::right("preview").resizable(true).default_size(300.0);
                    let panel = panel.size_range(LEAST_SHEETS[1]..=room);
                    panel.show(ui, |ui| self.sheets.preview(&self.studio, ui));
                }
                let panel = egui::CentralPanel::default()
                    .show(ui, |ui| self.export.show(&mut self.studio, self.plot.profiles_mut(), ui));
                if panel.inner {
                    self.dialogs.list_command_line();
                }
                if let Some(folder) = self.export.wants_folder(&self.studio) {
                    self.dialogs.ask_file(ui.ctx(), Purpose::Folder, Some(folder), "");
                }
            }
            Mode::Plot => {
                egui::CentralPanel::default().show(ui, |ui| self.plot.show(&mut self.studio, ui));
                if self.plot.wants_profile() {
                    let folder = crate::app::profiles::folder().map(|folder| folder.join("cutters"));
                    self.dialogs.ask_file(ui.ctx(), Purpose::Profile, folder, "");
                }
            }
        }
    }

    /// The model, with its sheets beside it.
    fn model(&mut self, ui: &mut egui::Ui) {
        self.places.sheets = None;
        if self.has_sheets_beside {
            let room = ui.available_width();
            let most = (room - LEAST_BESIDE[0]).max(LEAST_SHEETS[0]);
            // In a window of another size the sheets keep their share of it.
            let is_new = std::mem::replace(&mut self.room_beside, room) != room;
            let width = (self.sheets_share * room).clamp(LEAST_SHEETS[0], most);
            let sizes = if is_new { width..=width } else { LEAST_SHEETS[0]..=most };
            let panel = egui::Panel::right("sheets").resizable(true).default_size(width).size_range(sizes);
            let panel = panel.show(ui, |ui| self.sheets.show(&mut self.studio, ui));
            let dragged_to = panel.response.rect.width();
            if !is_new && (dragged_to - width).abs() > 1.0 {
                self.sheets_share = dragged_to / room;
            }
            self.places.sheets = Some(panel.response.rect);
            context::of_pieces(self, ui, &panel.response);
        }
        let panel = egui::Panel::bottom("folding").show(ui, |ui| space_marks::folding_bar(self, ui));
        self.places.folding = Some(panel.response.rect);
        let panel = egui::CentralPanel::no_frame().show(ui, |ui| self.space.show(&mut self.studio, ui));
        self.places.model = Some(panel.response.rect);
        context::of_components(self, ui, &panel.response);
    }

    /// Whether the sheets are to be seen.
    fn shows_sheets(&self) -> bool {
        self.mode == Mode::Sheets || self.mode == Mode::Model && self.has_sheets_beside
    }

    /// Fits what is shown to the window.
    fn fit(&mut self) {
        self.space.fit();
        self.sheets.fit();
    }

    /// Whether the tour is to be seen: what it is about is there.
    fn is_touring(&self) -> bool {
        let is_made = self.studio.shown().output().is_some();
        self.tour.is_some() && is_made && self.mode == Mode::Model && !self.dialogs.is_open()
    }

    fn show_tour(&mut self, ctx: &egui::Context) {
        if !self.is_touring() {
            return;
        }
        let Some(tour) = &mut self.tour else { return };
        let places = self.places;
        let place = |spot| match spot {
            Spot::Settings => places.settings,
            Spot::Model => places.model,
            Spot::Folding => places.folding,
            Spot::Sheets => places.sheets.or(places.modes),
        };
        if !tour.show(ctx, place) {
            self.tour = None;
        }
    }

    fn work(&self) -> Work {
        Work {
            is_changed: self.studio.document().is_some_and(|d| d.is_changed()),
            is_cutting: self.plot.is_running(),
        }
    }

    fn show_dialogs(&mut self, ctx: &egui::Context) {
        let work = self.work();
        let is_lost = work.is_changed || work.is_cutting;
        if ctx.input(|i| i.viewport().close_requested()) && !self.may_close && is_lost {
            ctx.send_viewport_cmd(egui::ViewportCommand::CancelClose);
            self.dialogs.ask_leave(Leave::Close);
        }
        let commands: Vec<_> = match self.dialogs.is_finding() {
            true => commands::all().map(|command| (command, command.can(self))).collect(),
            false => Vec::new(),
        };
        let path = self.studio.document().and_then(|document| document.path());
        let path = path.or(self.studio.opened().map(|opened| opened.source.as_path()));
        let file = path.and_then(Path::file_name).unwrap_or_default().to_string_lossy().into_owned();
        let named = Named { file: &file, is_whole: !work.is_changed };
        let outcome = self.dialogs.show(ctx, &commands, work, &named);
        match outcome {
            None => {}
            Some(Outcome::Open(path)) => self.open(&path),
            Some(Outcome::Folder(path)) => {
                self.export.set_folder(&path, &self.studio);
            }
            Some(Outcome::Profile(path)) => {
                self.studio.messages_mut().clear(Cause::Opening);
                if let Err(problem) = self.plot.profiles_mut().take(&path) {
                    self.studio.messages_mut().warn(Cause::Opening, problem);
                }
            }
            Some(Outcome::Save(path)) => {
                self.studio.save_as(&path);
                self.leave_if_saved(ctx);
            }
            Some(Outcome::Overwrite) => {
                self.studio.save();
                self.leave_if_saved(ctx);
            }
            Some(Outcome::Reload) => {
                self.dialogs.take_leave();
                self.reload();
            }
            Some(Outcome::Parted(leave, Parting::Save)) => {
                self.dialogs.leave_after_saving(leave);
                self.save(ctx);
                if !self.dialogs.is_open() {
                    self.leave_if_saved(ctx);
                }
            }
            Some(Outcome::Parted(Leave::Open(path), Parting::Discard)) => {
                self.studio.open_and_discard(&path);
            }
            Some(Outcome::Parted(Leave::Close, Parting::Discard)) => {
                self.studio.discard();
                self.leave(ctx, Leave::Close);
            }
            Some(Outcome::Parted(_, Parting::Stay)) => {}
            Some(Outcome::Run(command)) => command.run(self, ctx),
        }
    }

    /// Leaves as was asked for before the project was saved; stays where that failed.
    fn leave_if_saved(&mut self, ctx: &egui::Context) {
        if let Some(leave) = self.dialogs.take_leave().filter(|_| !self.work().is_changed) {
            self.leave(ctx, leave);
        }
    }

    /// Reads the file that is open again, and drops what is not saved.
    fn reload(&mut self) {
        if let Some(source) = self.studio.opened().map(|opened| opened.source.clone()) {
            self.studio.open_and_discard(&source);
        }
    }

    /// Closes the window, or goes on to another file.
    fn leave(&mut self, ctx: &egui::Context, leave: Leave) {
        match leave {
            Leave::Close => {
                self.plot.stop();
                self.may_close = true;
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
            Leave::Open(path) => self.studio.open(&path),
        }
    }

    /// Opens a page of the book in the browser.
    fn open_book(&mut self, ctx: &egui::Context, page: usize) {
        self.studio.messages_mut().clear(Cause::Opening);
        match self.studio.book(page) {
            Ok(path) => ctx.open_url(egui::OpenUrl::new_tab(format!("file://{}", path.display()))),
            Err(problem) => self.studio.messages_mut().warn(Cause::Opening, problem),
        }
    }

    /// Asks for a file to open.
    fn ask_open(&mut self, ctx: &egui::Context) {
        let folder = self.studio.opened().map(|opened| self.studio.folder_beside(&opened.source));
        self.dialogs.ask_file(ctx, Purpose::Open, folder, "");
    }

    /// Asks for the name of the project file.
    fn ask_save(&mut self, ctx: &egui::Context) {
        let Some(opened) = self.studio.opened() else { return };
        let (name, folder) = (format!("{}.toml", opened.title()), self.studio.folder_beside(&opened.source));
        self.dialogs.ask_file(ctx, Purpose::Save, Some(folder), &name);
    }

    /// Saves; asks for a name where there is none, and before changes of another program are lost.
    fn save(&mut self, ctx: &egui::Context) {
        if self.studio.is_changed_on_disk() {
            self.dialogs.ask_overwrite();
        } else if !self.studio.save() {
            self.ask_save(ctx);
        }
    }
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        self.show(ui);
    }

    /// Where a panel has not its height yet, for one picture: a black strip was seen.
    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }
}
