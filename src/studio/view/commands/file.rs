//! Files: what is opened, saved and printed.

use super::keys::{ctrl, ctrl_shift};
use super::{BLANK, Command, Place, always};
use eframe::egui::{Key, ViewportCommand};
use lucide_icons::Icon;

/// All of them.
pub(super) static ALL: &[&Command] = &[&OPEN, &SAVE, &SAVE_AS, &PRINT, &QUIT];

pub static OPEN: Command = Command {
    name: "Open …",
    icon: Some(Icon::FolderOpen),
    tip: "opens a mesh or a project",
    keys: &[ctrl(Key::O)],
    place: Place::File(0),
    can: always,
    act: |w, ctx| w.ask_open(ctx),
    ..BLANK
};

pub static SAVE: Command = Command {
    name: "Save project",
    icon: Some(Icon::Save),
    tip: "writes the project file; the command line reads it, too",
    keys: &[ctrl(Key::S)],
    place: Place::File(2),
    act: |w, ctx| w.save(ctx),
    ..BLANK
};

pub static SAVE_AS: Command = Command {
    name: "Save project as …",
    keys: &[ctrl_shift(Key::S)],
    place: Place::File(2),
    act: |w, ctx| w.ask_save(ctx),
    ..BLANK
};

pub static PRINT: Command = Command {
    name: "Print …",
    icon: Some(Icon::Printer),
    tip: "opens the sheets as PDF in the system's viewer; print them there at their actual size",
    keys: &[ctrl(Key::P)],
    place: Place::File(3),
    can: |w| w.studio.finished().is_some(),
    act: |w, _| w.studio.print(),
    ..BLANK
};

pub static QUIT: Command = Command {
    name: "Quit",
    keys: &[ctrl(Key::Q)],
    place: Place::File(4),
    can: always,
    act: |_, ctx| ctx.send_viewport_cmd(ViewportCommand::Close),
    ..BLANK
};
