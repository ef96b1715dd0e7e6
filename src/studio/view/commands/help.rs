//! What helps: the list of commands, keys, the tour, the book.

use super::super::super::book::PAGES;
use super::super::Mode;
use super::super::tour::Tour;
use super::keys::{ctrl, key};
use super::{BLANK, Command, Place, always};
use eframe::egui::Key;
use lucide_icons::Icon;

/// All of them but the pages of the book.
pub(super) static ALL: &[&Command] = &[&FIND, &SHORTCUTS, &COMMAND_LINE, &TOUR, &ABOUT];

pub static FIND: Command = Command {
    name: "Commands …",
    icon: Some(Icon::Search),
    tip: "finds any command by its name",
    keys: &[ctrl(Key::K)],
    place: Place::Help(0),
    can: always,
    act: |w, _| w.dialogs.find(),
    ..BLANK
};

pub static SHORTCUTS: Command = Command {
    name: "Shortcuts …",
    icon: Some(Icon::Keyboard),
    tip: "lists what keys and mouse do",
    keys: &[key(Key::F1)],
    place: Place::Help(0),
    can: always,
    act: |w, _| w.dialogs.list_shortcuts(),
    ..BLANK
};

pub static COMMAND_LINE: Command = Command {
    name: "On the command line …",
    icon: Some(Icon::Terminal),
    tip: "lists what the window has no settings for, with commands to copy",
    place: Place::Help(0),
    act: |w, _| w.dialogs.list_command_line(),
    ..BLANK
};

static TOUR: Command = Command {
    name: "Tour",
    icon: Some(Icon::Signpost),
    tip: "shows the window in five steps",
    place: Place::Help(0),
    act: |w, _| (w.mode, w.tour) = (Mode::Model, Some(Tour::default())),
    ..BLANK
};

static ABOUT: Command = Command {
    name: "About tatamu",
    icon: Some(Icon::Info),
    place: Place::Help(1),
    can: always,
    act: |w, _| w.dialogs.about(),
    ..BLANK
};

/// What a page of the book does.
pub const BOOK_TIP: &str = "opens in the browser; works without a network";

/// A page of the book.
const fn book<const PAGE: usize>() -> Command {
    Command {
        name: PAGES[PAGE].command,
        icon: Some(Icon::BookOpen),
        tip: BOOK_TIP,
        place: if PAGE == 0 { Place::Help(0) } else { Place::None },
        can: always,
        act: |w, ctx| w.open_book(ctx, PAGE),
        ..BLANK
    }
}

macro_rules! book {
    ($($page:literal)*) => { [$(book::<$page>()),*] };
}

pub(super) static BOOK: [Command; PAGES.len()] =
    book!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22);

/// The page of the book that names the libraries.
pub fn libraries() -> &'static Command {
    let page = PAGES.iter().position(|page| page.path == "reference/libraries.md");
    &BOOK[page.expect("a test compares the pages with the files")]
}
