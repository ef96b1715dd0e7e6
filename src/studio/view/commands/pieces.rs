//! What can be done with the piece that is selected, and the choice of it.

use super::super::sheets::pieces::{self, Hand};
use super::keys::{key, shift};
use super::{BLANK, Command, Place};
use eframe::egui::Key;
use lucide_icons::Icon;

/// All of them.
pub(super) static ALL: &[&Command] = &[&NEXT, &PREVIOUS, &PIECE_LEFT, &PIECE_RIGHT, &PUT_ASIDE, &UNPIN];

const TIP: &str = "rotates the piece by 15°; while you drag it, press , or .";

static NEXT: Command = Command {
    name: "Select the next piece",
    tip: "goes through the pieces sheet by sheet",
    keys: &[key(Key::P)],
    can: |w| w.shows_sheets() && w.studio.laid().is_some(),
    act: |w, _| pieces::step(&mut w.studio, true),
    ..BLANK
};

static PREVIOUS: Command = Command {
    name: "Select the previous piece",
    keys: &[shift(Key::P)],
    can: |w| w.shows_sheets() && w.studio.laid().is_some(),
    act: |w, _| pieces::step(&mut w.studio, false),
    ..BLANK
};

pub static PIECE_LEFT: Command = Command {
    name: "Rotate piece left",
    icon: Some(Icon::RotateCcw),
    tip: TIP,
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && pieces::can(&w.studio, Hand::Left),
    act: |w, _| pieces::act(&mut w.studio, Hand::Left),
    ..BLANK
};

pub static PIECE_RIGHT: Command = Command {
    name: "Rotate piece right",
    icon: Some(Icon::RotateCw),
    tip: TIP,
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && pieces::can(&w.studio, Hand::Right),
    act: |w, _| pieces::act(&mut w.studio, Hand::Right),
    ..BLANK
};

pub static PUT_ASIDE: Command = Command {
    name: "Put aside",
    icon: Some(Icon::FilePlus),
    tip: "puts the piece on a sheet of its own",
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && pieces::can(&w.studio, Hand::Aside),
    act: |w, _| pieces::act(&mut w.studio, Hand::Aside),
    ..BLANK
};

pub static UNPIN: Command = Command {
    name: "Unpin",
    icon: Some(Icon::PinOff),
    tip: "lets the layout place the piece again",
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && pieces::can(&w.studio, Hand::Unpin),
    act: |w, _| pieces::act(&mut w.studio, Hand::Unpin),
    ..BLANK
};
