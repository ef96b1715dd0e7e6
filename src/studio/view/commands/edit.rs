//! What changes the project, and what is selected.

use super::super::Window;
use super::keys::{ctrl, ctrl_shift, key};
use super::{BLANK, Command, Place, has_file, has_selection};
use eframe::egui::{Context, Key};
use lucide_icons::Icon;

/// All of them.
pub(super) static ALL: &[&Command] = &[
    &UNDO,
    &REDO,
    &MERGE,
    &RENAME,
    &TURN_LEFT,
    &TURN_RIGHT,
    &LAY_OUT,
    &FIT_SHEETS,
    &EDGES,
    &SELECT_ALL,
    &STOP,
    &SELECT_NONE,
];

/// Turn of a fold direction for a press of a key, degrees.
const TURN_DEG: f64 = 5.0;

pub static UNDO: Command = Command {
    name: "Undo",
    icon: Some(Icon::Undo2),
    keys: &[ctrl(Key::Z)],
    place: Place::Edit(0),
    can: |w| w.studio.document().is_some_and(|d| d.undo_label().is_some()),
    act: |w, _| w.studio.undo(),
    ..BLANK
};

pub static REDO: Command = Command {
    name: "Redo",
    icon: Some(Icon::Redo2),
    keys: &[ctrl_shift(Key::Z), ctrl(Key::Y)],
    place: Place::Edit(0),
    can: |w| w.studio.document().is_some_and(|d| d.redo_label().is_some()),
    act: |w, _| w.studio.redo(),
    ..BLANK
};

pub static MERGE: Command = Command {
    name: "Merge selected components",
    icon: Some(Icon::Merge),
    tip: "makes one part of several; select them with Shift and click",
    keys: &[key(Key::M)],
    place: Place::Edit(1),
    can: |w| w.studio.selection.names().len() > 1 && !w.studio.is_drawn(),
    act: |w, _| w.studio.merge_selected(),
    ..BLANK
};

pub static RENAME: Command = Command {
    name: "Rename the selected component",
    icon: Some(Icon::TextCursorInput),
    tip: "its name is printed on the pieces",
    keys: &[key(Key::F2)],
    place: Place::Edit(1),
    can: has_one,
    act: |w, _| w.parts.rename(),
    ..BLANK
};

pub static TURN_LEFT: Command = Command {
    name: "Rotate the fold direction to the left",
    tip: "by 5°; the wheel over a selected component does the same",
    keys: &[key(Key::OpenBracket)],
    place: Place::Edit(1),
    can: has_one,
    act: |w, ctx| turn(w, ctx, -TURN_DEG),
    ..BLANK
};

pub static TURN_RIGHT: Command = Command {
    name: "Rotate the fold direction to the right",
    tip: "by 5°; the wheel over a selected component does the same",
    keys: &[key(Key::CloseBracket)],
    place: Place::Edit(1),
    can: has_one,
    act: |w, ctx| turn(w, ctx, TURN_DEG),
    ..BLANK
};

pub static LAY_OUT: Command = Command {
    name: "Lay out again",
    icon: Some(Icon::LayoutGrid),
    tip: "unpins all pieces and arranges them on as few sheets as possible",
    place: Place::Edit(2),
    can: |w| w.studio.document().is_some_and(|d| !d.project().pins.is_empty()),
    act: |w, _| w.studio.lay_out_again(),
    ..BLANK
};

pub static FIT_SHEETS: Command = Command {
    name: "Fit the size to the sheets",
    icon: Some(Icon::Shrink),
    tip: "makes the model smaller, in steps of 5 mm, until it takes no more sheets than \u{201c}Sheets max\u{201d}",
    place: Place::Edit(2),
    can: |w| w.studio.exceeded_sheets().is_some() && w.studio.busy().is_none(),
    act: |w, _| w.studio.fit_sheets(),
    ..BLANK
};

pub static EDGES: Command = Command {
    name: "Cut and glue edges",
    icon: Some(Icon::ScissorsLineDashed),
    tip: "a click on the sheets cuts a crease, or makes a crease of a cut edge; tabs are dragged to the other side",
    keys: &[key(Key::E)],
    place: Place::Edit(2),
    is_on: Some(|w| w.sheets.edges().is_on()),
    can: |w| has_file(w) && w.shows_sheets(),
    act: |w, _| w.sheets.edges_mut().toggle(),
};

static STOP: Command = Command {
    name: "Stop the calculation",
    icon: Some(Icon::CircleStop),
    tip: "what is shown stays",
    keys: &[key(Key::Escape)],
    can: |w| w.studio.busy().is_some(),
    act: |w, _| w.studio.cancel(),
    ..BLANK
};

pub static SELECT_NONE: Command = Command {
    name: "Select nothing",
    keys: &[key(Key::Escape)],
    place: Place::Edit(3),
    can: |w| has_selection(w) && w.studio.busy().is_none(),
    act: |w, _| w.studio.selection.clear(),
    ..BLANK
};

pub static SELECT_ALL: Command = Command {
    name: "Select all components",
    keys: &[ctrl(Key::A)],
    place: Place::Edit(3),
    act: |w, _| {
        let names = w.studio.shown().names().to_vec();
        w.studio.selection.clear();
        names.iter().for_each(|name| w.studio.selection.select(name, None, true));
    },
    ..BLANK
};

fn has_one(window: &Window) -> bool {
    window.studio.selected_index().is_some() && !window.studio.is_drawn()
}

fn turn(window: &mut Window, ctx: &Context, degrees: f64) {
    if let Some(part) = window.studio.selected_index() {
        let now_s = ctx.input(|i| i.time);
        window.studio.turn(part, degrees, now_s);
    }
}
