//! The cutter: machine, medium, port, a picture of the job, and its progress.

use super::super::messages::Problem;
use super::super::planning::{Plan, Planning, Wish};
use super::super::plotting::Plotting;
use super::super::preferences::Preferences;
use super::super::state::Studio;
use super::super::worker::Wake;
use super::machine::{Answer, Questions};
use super::picture::Picture;
use super::profile_choice::ProfileChoice;
use super::strokes;
use super::{focus, look, modal, warnings};
use crate::app::plot::{ANY, hint, usb_cutters};
use eframe::egui::{self, Rect, Sense, Ui};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::export::PltOptions;
use tatamu::front::remedies;

/// The panel of the cutter.
pub struct PlotPanel {
    profiles: ProfileChoice,
    port: String,
    ports: Vec<String>,
    copies: u16,
    /// Number of the sheet to send; none sends all.
    only: Option<usize>,
    shown: usize,
    plan: Option<(Key, Result<Plan, Problem>)>,
    /// The plan that is being made.
    planning: Option<(Key, Planning)>,
    picture: Picture,
    running: Option<Plotting>,
    /// The plan of the test cut that is on its way.
    test: Option<Plan>,
    /// Whether it is asked what becomes of a stopped job.
    is_replacing: bool,
    /// The questions for a machine, while they are asked.
    questions: Option<Questions>,
    /// Whether a profile of the user's own is to be chosen.
    wants_profile: bool,
    /// Why a job that was stopped cannot go on, or why there is no test cut.
    unreadable: Option<String>,
}

/// What a plan is made from.
#[derive(Debug, Clone, PartialEq)]
struct Key {
    version: u64,
    cutter: String,
    media: String,
}

/// Says why there is no plan, with buttons for what can be done.
fn advise(studio: &mut Studio, ui: &mut Ui, problem: &Problem) {
    ui.colored_label(ui.visuals().error_fg_color, &problem.text);
    ui.horizontal_wrapped(|ui| warnings::advised(studio, ui, |now| remedies::of(&problem.remedies, now)));
}

fn port_names() -> Vec<String> {
    let on_usb = (!usb_cutters().is_empty()).then(|| ANY.to_owned());
    let serial = serialport::available_ports().unwrap_or_default();
    on_usb.into_iter().chain(serial.into_iter().map(|port| port.port_name)).collect()
}

impl PlotPanel {
    /// The panel with the machine of the last time.
    pub fn new(preferences: &Preferences) -> Self {
        Self {
            profiles: ProfileChoice::new(preferences),
            port: preferences.port.clone().unwrap_or_default(),
            ports: port_names(),
            copies: 1,
            only: None,
            shown: 0,
            plan: None,
            planning: None,
            picture: Picture::default(),
            running: None,
            test: None,
            is_replacing: false,
            questions: None,
            wants_profile: false,
            unreadable: None,
        }
    }

    /// The cutter, the medium and the port.
    pub fn choice(&self) -> [&str; 3] {
        [self.profiles.cutter(), self.profiles.medium(), self.port.trim()]
    }

    /// Whether a job is on its way.
    pub fn is_running(&self) -> bool {
        self.running.as_ref().is_some_and(Plotting::is_running)
    }

    /// Whether it asks something.
    pub fn asks(&self) -> bool {
        self.questions.is_some() || self.is_replacing
    }

    /// Lifts the tool and stops.
    pub fn stop(&self) {
        self.running.iter().for_each(Plotting::stop);
    }

    /// Whether a file is to be asked for, with a profile of the user's own; once.
    pub fn wants_profile(&mut self) -> bool {
        std::mem::take(&mut self.wants_profile)
    }

    /// The cutter and the medium, to be chosen elsewhere, too.
    pub fn profiles_mut(&mut self) -> &mut ProfileChoice {
        &mut self.profiles
    }

    /// Chooses the port.
    #[cfg(test)]
    pub fn choose(&mut self, cutter: &str, port: &str) {
        self.profiles.set_cutter(cutter.to_owned());
        self.port = port.to_owned();
    }

    /// The job on its way.
    #[cfg(test)]
    pub fn running(&self) -> Option<&Plotting> {
        self.running.as_ref()
    }

    /// Draws the panel.
    pub fn show(&mut self, studio: &mut Studio, ui: &mut Ui) {
        egui::Panel::right("plot").resizable(true).default_size(300.0).show(ui, |ui| {
            egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                self.dials(studio, ui);
                focus::follow(ui);
            });
        });
        egui::CentralPanel::default().show(ui, |ui| self.preview(ui));
    }

    fn dials(&mut self, studio: &mut Studio, ui: &mut Ui) {
        let is_running = self.is_running();
        if !is_running {
            self.test = None;
        }
        ui.heading("Plot");
        ui.add_enabled_ui(!is_running, |ui| self.choices(ui));
        self.ask(studio, ui.ctx());
        self.ask_replace(studio, ui.ctx());
        self.refresh(studio, ui.ctx());
        ui.separator();
        if let Some((_, planning)) = &self.planning {
            ui.label("planning the job …");
            ui.add(egui::ProgressBar::new(planning.share()));
            if ui.button("Cancel").on_hover_text("a change of the machine or the model plans again").clicked()
            {
                self.cancel();
            }
        }
        match &self.plan {
            None if self.planning.is_some() => {}
            None => drop(ui.weak("available when the model is finished")),
            Some((_, Err(problem))) => advise(studio, ui, problem),
            Some((_, Ok(_))) => self.sheets(ui),
        }
        ui.separator();
        if is_running {
            self.progress(ui)
        } else {
            self.start(studio, ui)
        }
        let Some(running) = &self.running else { return };
        let state = running.state();
        match &state.end {
            Some(Ok(())) => drop(ui.label("Done.")),
            Some(Err(problem)) => drop(ui.colored_label(ui.visuals().error_fg_color, problem)),
            None => {}
        }
        state.notes.iter().for_each(|note| drop(ui.label(note)));
    }

    /// Lists the sheets, with what there is to know about the one that is seen.
    fn sheets(&mut self, ui: &mut Ui) {
        let Some(Seen { plan, sheet: shown, .. }) = seen(&self.plan, &self.test, self.shown) else { return };
        let mut clicked = None;
        for (k, sheet) in plan.sheets.iter().enumerate() {
            if ui.selectable_label(shown == k, sheet.name()).clicked() {
                clicked = Some(k);
            }
        }
        if let Some(sheet) = plan.sheets.get(shown) {
            ui.add_space(4.0);
            ui.label(sheet.summary(&plan.machine.cutter));
            ui.add_space(4.0);
            strokes::key(ui, &plan.strokes[shown]);
            if self.is_running() {
                strokes::key_of_done(ui);
            }
            sheet.notes().iter().for_each(|note| drop(ui.label(note)));
        }
        self.shown = clicked.unwrap_or(self.shown);
    }

    /// Asks for the machine.
    fn ask(&mut self, studio: &Studio, ctx: &egui::Context) {
        let Some(questions) = &mut self.questions else { return };
        let file = studio.opened().and_then(|opened| opened.source.file_name());
        let file = file.unwrap_or_default().to_string_lossy();
        match questions.show(ctx, self.profiles.media(), &file) {
            None => return,
            Some(Answer::Close) => {}
            Some(Answer::Own) => self.wants_profile = true,
            Some(Answer::Profiles { cutter, media, is_usb }) => {
                self.profiles.set_cutter(cutter.to_owned());
                self.profiles.set_medium(media);
                if is_usb {
                    self.port = ANY.to_owned();
                }
            }
        }
        self.questions = None;
    }

    fn choices(&mut self, ui: &mut Ui) {
        if ui.button("Find my machine …").on_hover_text("three questions choose cutter and medium").clicked()
        {
            self.questions = Some(Questions::default());
        }
        egui::Grid::new("machine").num_columns(2).show(ui, |ui| {
            self.profiles.rows(ui);
            let label = ui.label("Port");
            ui.horizontal(|ui| {
                ui.add(egui::TextEdit::singleline(&mut self.port).desired_width(140.0)).labelled_by(label.id);
                ui.menu_button("Choose", |ui| {
                    for port in &self.ports {
                        if ui.button(format!("{port}{}", hint(port))).clicked() {
                            self.port.clone_from(port);
                            ui.close();
                        }
                    }
                    if ui.button("Refresh").clicked() {
                        self.ports = port_names();
                    }
                });
            });
            ui.end_row();
            let label = ui.label("Copies");
            ui.add(egui::DragValue::new(&mut self.copies).range(1..=1000)).labelled_by(label.id);
            ui.end_row();
            ui.label("Sheets");
            let mut all = self.only.is_none();
            if ui
                .checkbox(&mut all, "all sheets")
                .on_hover_text("off: only the sheet that is shown")
                .changed()
            {
                self.only = (!all).then_some(self.shown);
            }
            ui.end_row();
        });
        if self.only.is_some() {
            self.only = Some(self.shown);
        }
    }

    /// Plans the job in the background when the model or the machine has changed.
    fn refresh(&mut self, studio: &Studio, ctx: &egui::Context) {
        if let Some(plan) = self.planning.as_ref().and_then(|(_, planning)| planning.made()) {
            let count = plan.as_ref().map_or(0, |plan| plan.sheets.len());
            self.shown = self.shown.min(count.saturating_sub(1));
            self.plan = self.planning.take().map(|(key, _)| (key, plan));
            self.picture = Picture::default();
        }
        let Some(output) = studio.finished() else { return };
        let (Some(opened), Some(document)) = (studio.opened(), studio.document()) else { return };
        let version = studio.shown().version();
        let (cutter, media) = (self.profiles.cutter().to_owned(), self.profiles.medium().to_owned());
        let key = Key { version, cutter: cutter.clone(), media: media.clone() };
        let is_known = self.plan.as_ref().is_some_and(|(old, _)| *old == key);
        let is_begun = self.planning.as_ref().is_some_and(|(begun, _)| *begun == key);
        if is_known || is_begun || self.is_running() {
            return;
        }
        let (opened, project) = (opened.clone(), document.project().clone());
        let wish = Wish { opened, project, output: output.clone(), cutter, media };
        self.plan = None;
        self.planning = Some((key, Planning::start(wish, wake(ctx))));
    }

    /// Stops the planning.
    fn cancel(&mut self) {
        let stopped = self.planning.take();
        self.plan = stopped.map(|(key, _)| (key, Err("planning was cancelled".to_owned().into())));
    }

    fn start(&mut self, studio: &Studio, ui: &mut Ui) {
        self.offer_rest(studio, ui);
        let Some((_, Ok(plan))) = &self.plan else { return };
        let has_port = !self.port.trim().is_empty();
        let is_ready = has_port && studio.finished().is_some();
        let (starts, tests) = ui
            .horizontal(|ui| {
                let start = ui.add_enabled(is_ready, look::primary(ui.visuals(), "Start")).clicked();
                let button = look::tall("Test cut");
                let tip = "a square of 10 mm with a triangle in it and two creases, to find the right force";
                (start, ui.add_enabled(has_port, button).on_hover_text(tip).clicked())
            })
            .inner;
        if !has_port {
            ui.weak("enter or choose the machine's port");
        }
        let machine = plan.machine.clone();
        if let Some(opened) = studio.opened().filter(|_| tests) {
            return self.test_cut(&machine, &opened.source, wake(ui.ctx()));
        }
        let Some(opened) = studio.opened().filter(|_| starts) else { return };
        let journal = journal(&opened.source);
        if journal.is_file() {
            self.is_replacing = true;
        } else {
            self.send(journal, wake(ui.ctx()));
        }
    }

    /// Asks before a new job drops the rest of a stopped one.
    fn ask_replace(&mut self, studio: &Studio, ctx: &egui::Context) {
        let Some(opened) = studio.opened().filter(|_| self.is_replacing) else { return };
        let text = ["A job was stopped", "Resume cuts the rest of it. A new job drops the rest."];
        let answers = ["Resume", "New job", "Cancel"];
        let Some(answer) = modal::ask(ctx, "stopped job", text, &answers) else { return };
        self.is_replacing = false;
        let (journal, wake) = (journal(&opened.source), wake(ctx));
        match answer {
            0 => self.resume(journal, wake),
            1 => self.send(journal, wake),
            _ => {}
        }
    }

    /// Begins to send the sheets.
    fn send(&mut self, journal: PathBuf, wake: Wake) {
        let Some((_, Ok(plan))) = &self.plan else { return };
        let sheets = match self.only {
            Some(k) => &plan.sheets[k..=k],
            None => &plan.sheets,
        };
        let (cutter, port) = (&plan.machine.cutter, self.port.trim());
        self.running = Some(Plotting::start(cutter, port, self.copies, sheets, journal, wake));
        self.test = None;
    }

    /// Cuts a small figure.
    fn test_cut(&mut self, machine: &PltOptions, source: &Path, wake: Wake) {
        match Plan::of_test_cut(machine) {
            Ok(test) => {
                let journal = journal(&source.with_file_name("test-cut"));
                let port = self.port.trim();
                self.running = Some(Plotting::start(&machine.cutter, port, 1, &test.sheets, journal, wake));
                (self.test, self.unreadable) = (Some(test), None);
            }
            Err(problem) => self.unreadable = Some(problem.text),
        }
    }

    /// Goes on with a job that was stopped.
    fn resume(&mut self, journal: PathBuf, wake: Wake) {
        match Plotting::resume(journal, self.port.trim(), wake) {
            Ok(running) => (self.running, self.test, self.unreadable) = (Some(running), None, None),
            Err(problem) => self.unreadable = Some(problem),
        }
    }

    /// Offers to go on with a job that was stopped.
    fn offer_rest(&mut self, studio: &Studio, ui: &mut Ui) {
        let Some(journal) = studio.opened().map(|opened| journal(&opened.source)) else { return };
        let tip = format!("sends the rest of the job in {}", journal.display());
        if journal.is_file() && ui.button("Continue the stopped job").on_hover_text(tip).clicked() {
            self.resume(journal, wake(ui.ctx()));
        }
        if let Some(problem) = &self.unreadable {
            ui.colored_label(ui.visuals().error_fg_color, problem);
        }
    }

    fn progress(&mut self, ui: &mut Ui) {
        let Some(running) = &self.running else { return };
        let state = running.state();
        if let Some(wish) = &state.wants_sheet {
            ui.strong(wish);
            if ui.button("Sheet loaded").clicked() {
                running.loaded();
            }
        } else {
            ui.add(egui::ProgressBar::new(state.share));
            ui.label(&state.text);
        }
        ui.horizontal(|ui| {
            let word = if state.is_paused { "Continue" } else { "Pause" };
            if ui.add(look::tall(word)).on_hover_text("lifts the tool").clicked() {
                running.pause();
            }
            if ui.add(look::stop("Stop")).on_hover_text("lifts the tool and ends the job").clicked() {
                running.stop();
            }
        });
    }

    /// Draws the sheet as the machine works on it.
    fn preview(&mut self, ui: &mut Ui) {
        let at = self.running.as_ref().and_then(|running| running.state().at);
        if let Some((name, _)) = at.as_ref().filter(|_| self.is_running()) {
            self.follow(name);
        }
        let Some(Seen { plan, sheet: shown, version }) = seen(&self.plan, &self.test, self.shown) else {
            return;
        };
        let Some(drawing) = plan.previews.get(shown) else { return };
        let room = ui.available_size();
        let page = egui::vec2(drawing.size_mm.x as f32, drawing.size_mm.y as f32);
        let scale = (room.x / page.x).min(room.y / page.y).max(0.1);
        let rect = Rect::from_center_size(ui.available_rect_before_wrap().center(), scale * page);
        let response = ui.allocate_rect(rect, Sense::hover());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Preview of the job"));
        let pixels_per_mm = f64::from(scale * ui.ctx().pixels_per_point());
        if let Some(texture) = self.picture.texture(ui.ctx(), drawing, version, pixels_per_mm) {
            look::paint(ui.painter(), texture, rect);
        }
        // What the machine has done stands out.
        let done = at.filter(|(name, _)| plan.sheets[shown].name() == name).map_or(0, |(_, done)| done);
        strokes::draw(ui.painter(), (rect, scale), &plan.strokes[shown], done);
    }

    /// Shows the sheet of this name.
    fn follow(&mut self, name: &str) {
        let Some((_, Ok(plan))) = &self.plan else { return };
        let sheet = plan.sheets.iter().position(|sheet| sheet.name() == name);
        self.shown = sheet.unwrap_or(self.shown);
    }
}

/// The plan that is seen.
struct Seen<'a> {
    plan: &'a Plan,
    /// Number of its sheet.
    sheet: usize,
    /// Differs for each picture.
    version: u64,
}

/// The plan of the test cut while it is on its way, else that of the model.
fn seen<'a>(
    plan: &'a Option<(Key, Result<Plan, Problem>)>,
    test: &'a Option<Plan>,
    shown: usize,
) -> Option<Seen<'a>> {
    if let Some(plan) = test {
        return Some(Seen { plan, sheet: 0, version: u64::MAX });
    }
    let (key, plan) = plan.as_ref()?;
    Some(Seen { plan: plan.as_ref().ok()?, sheet: shown, version: key.version * 1000 + shown as u64 })
}

/// Where the journal of a file's jobs is.
fn journal(source: &Path) -> PathBuf {
    source.with_extension("tatamu-job")
}

/// Draws the window again when a thread has something to tell.
fn wake(ctx: &egui::Context) -> Wake {
    let ctx = ctx.clone();
    Arc::new(move || ctx.request_repaint())
}
