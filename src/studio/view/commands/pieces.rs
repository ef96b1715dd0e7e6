//! What can be done with the piece that is selected.

use super::super::sheets::pieces::{self, Hand};
use super::{BLANK, Command, Place};
use lucide_icons::Icon;

/// All of them.
pub(super) static ALL: &[&Command] = &[&PIECE_LEFT, &PIECE_RIGHT, &PUT_ASIDE, &UNPIN];

const TIP: &str = "rotates the piece by 15°; while you drag it, press , or .";

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
