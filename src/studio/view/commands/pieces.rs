//! What can be done with the piece that is selected, and the choice of it.

use super::super::Window;
use super::super::selected_piece::{self, Hand};
use super::keys::{key, shift};
use super::{BLANK, Command, Place};
use eframe::egui::{Context, Key, KeyboardShortcut};
use glam::DVec2;
use lucide_icons::Icon;

/// All of them.
pub(super) static ALL: &[&Command] = &[
    &NEXT,
    &PREVIOUS,
    &FAR_LEFT,
    &FAR_RIGHT,
    &FAR_UP,
    &FAR_DOWN,
    &PIECE_LEFT,
    &PIECE_RIGHT,
    &PUT_ASIDE,
    &UNPIN,
];

/// How far a press of an arrow key with Shift moves a piece, mm.
const FAR_MM: f64 = 10.0;

const TIP: &str = "rotates the piece by 15°; while you drag it, press , or .";

static NEXT: Command = Command {
    name: "Select the next piece",
    tip: "goes through the pieces sheet by sheet",
    keys: &[key(Key::P)],
    can: |w| w.shows_sheets() && w.studio.laid().is_some(),
    act: |w, _| selected_piece::step(&mut w.studio, true),
    ..BLANK
};

static PREVIOUS: Command = Command {
    name: "Select the previous piece",
    keys: &[shift(Key::P)],
    can: |w| w.shows_sheets() && w.studio.laid().is_some(),
    act: |w, _| selected_piece::step(&mut w.studio, false),
    ..BLANK
};

static FAR_LEFT: Command = far("Move the piece to the left by 10 mm", &[shift(Key::ArrowLeft)], |w, ctx| {
    push(w, ctx, FAR_MM * DVec2::NEG_X)
});
static FAR_RIGHT: Command =
    far("Move the piece to the right by 10 mm", &[shift(Key::ArrowRight)], |w, ctx| {
        push(w, ctx, FAR_MM * DVec2::X)
    });
static FAR_UP: Command =
    far("Move the piece up by 10 mm", &[shift(Key::ArrowUp)], |w, ctx| push(w, ctx, FAR_MM * DVec2::Y));
static FAR_DOWN: Command = far("Move the piece down by 10 mm", &[shift(Key::ArrowDown)], |w, ctx| {
    push(w, ctx, FAR_MM * DVec2::NEG_Y)
});

const fn far(
    name: &'static str,
    keys: &'static [KeyboardShortcut],
    act: fn(&mut Window, &Context),
) -> Command {
    Command { name, keys, can: can_push, act, ..BLANK }
}

/// Whether a piece is selected, and seen.
pub(super) fn can_push(window: &Window) -> bool {
    window.shows_sheets() && selected_piece::is_selected(&window.studio)
}

/// Moves it on its page.
pub(super) fn push(window: &mut Window, ctx: &Context, by_mm: DVec2) {
    let now_s = ctx.input(|i| i.time);
    window.sheets.push(&mut window.studio, by_mm, now_s);
}

pub static PIECE_LEFT: Command = Command {
    name: "Rotate piece left",
    icon: Some(Icon::RotateCcw),
    tip: TIP,
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && selected_piece::can(&w.studio, Hand::Left),
    act: |w, _| selected_piece::act(&mut w.studio, Hand::Left),
    ..BLANK
};

pub static PIECE_RIGHT: Command = Command {
    name: "Rotate piece right",
    icon: Some(Icon::RotateCw),
    tip: TIP,
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && selected_piece::can(&w.studio, Hand::Right),
    act: |w, _| selected_piece::act(&mut w.studio, Hand::Right),
    ..BLANK
};

pub static PUT_ASIDE: Command = Command {
    name: "Put aside",
    icon: Some(Icon::FilePlus),
    tip: "puts the piece on a sheet of its own",
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && selected_piece::can(&w.studio, Hand::Aside),
    act: |w, _| selected_piece::act(&mut w.studio, Hand::Aside),
    ..BLANK
};

pub static UNPIN: Command = Command {
    name: "Unpin",
    icon: Some(Icon::PinOff),
    tip: "lets the layout place the piece again",
    place: Place::Edit(2),
    can: |w| w.shows_sheets() && selected_piece::can(&w.studio, Hand::Unpin),
    act: |w, _| selected_piece::act(&mut w.studio, Hand::Unpin),
    ..BLANK
};
