//! Three questions that lead to a machine: who made it, which one it is, and what it works on.

use super::profile_choice::Listed;
use super::{look, modal};
use crate::app::catalogue::{MACHINES, Machine, Takes};
use eframe::egui::{self, Ui};

/// The questions, as far as they are answered.
#[derive(Debug, Default)]
pub struct Questions {
    maker: Option<&'static str>,
    machine: Option<&'static Machine>,
}

/// What came of it.
pub enum Answer {
    /// A profile of a cutter, and of a medium.
    Profiles { cutter: &'static str, media: String, is_usb: bool },
    /// A profile of the user's own is to be chosen.
    Own,
    /// The user wants no more.
    Close,
}

impl Questions {
    /// Asks; `media` are all that there are, `file` is the one that is open.
    pub fn show(&mut self, ctx: &egui::Context, media: &[Listed], file: &str) -> Option<Answer> {
        let mut answer = None;
        let shown = modal::new(ctx, "machine").show(ctx, |ui| {
            ui.set_width(420.0);
            ui.heading("Find my machine");
            answer = match (self.maker, self.machine) {
                (None, _) => self.ask_maker(ui),
                (Some(maker), None) => self.ask_machine(ui, maker),
                (_, Some(machine)) => ask_medium(ui, machine, media, file),
            };
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                if self.maker.is_some() && ui.button("Back").clicked() {
                    // One question back, past a question with only one answer.
                    let is_only = self.maker.is_some_and(|maker| of(maker).count() == 1);
                    match self.machine.take() {
                        Some(_) if !is_only => {}
                        _ => self.maker = None,
                    }
                }
                if ui.button("Close").clicked() {
                    answer = Some(Answer::Close);
                }
            });
        });
        answer.or(shown.should_close().then_some(Answer::Close))
    }

    fn ask_maker(&mut self, ui: &mut Ui) -> Option<Answer> {
        ui.strong("1 of 3: Who made it?");
        let mut makers: Vec<&'static str> = MACHINES.iter().map(|machine| machine.maker).collect();
        makers.dedup();
        for (k, maker) in makers.into_iter().enumerate() {
            let button = wide(ui, &look::capital(maker));
            if k == 0 {
                modal::focus_once(ui, &button);
            }
            if button.clicked() {
                self.maker = Some(maker);
                let mut machines = of(maker);
                self.machine = machines.next().filter(|_| machines.next().is_none());
            }
        }
        ui.add_space(6.0);
        ui.weak("It is none of these:");
        let tip = "a profile of a cutter or a medium that you wrote; profiles in the folder for them are in the lists";
        ui.button("Profile of your own …").on_hover_text(tip).clicked().then_some(Answer::Own)
    }

    fn ask_machine(&mut self, ui: &mut Ui, maker: &'static str) -> Option<Answer> {
        ui.strong("2 of 3: Which one is it?");
        for machine in of(maker) {
            if wide(ui, &look::capital(machine.models)).clicked() {
                self.machine = Some(machine);
            }
        }
        None
    }
}

/// The last question; of a machine that takes files of another program, how they are written.
fn ask_medium(ui: &mut Ui, machine: &'static Machine, media: &[Listed], file: &str) -> Option<Answer> {
    let (cutter, is_usb) = match machine.takes {
        Takes::Serial(profile) => (profile, false),
        Takes::Usb(profile) => (profile, true),
        Takes::Program(program) => {
            ui.label("It takes files through a program of its own. This command writes them:");
            let command = format!("tatamu make {file} --for {program}");
            ui.code(&command);
            if ui.button("Copy the command").clicked() {
                ui.copy_text(command);
            }
            return None;
        }
    };
    ui.strong("3 of 3: What does it work on?");
    let chosen = media.iter().find(|medium| wide(ui, &medium.name).clicked());
    chosen.map(|medium| Answer::Profiles { cutter, media: medium.key.clone(), is_usb })
}

/// An answer: buttons of one width are read like a list.
fn wide(ui: &mut Ui, text: &str) -> egui::Response {
    let width = ui.available_width();
    let button = egui::Button::new((text, egui::Atom::grow())).min_size(egui::vec2(width, 0.0));
    let button = ui.add(button);
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, text));
    button
}

fn of(maker: &'static str) -> impl Iterator<Item = &'static Machine> {
    MACHINES.iter().filter(move |machine| machine.maker == maker)
}
