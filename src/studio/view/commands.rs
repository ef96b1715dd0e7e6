//! What the user can do, in one table: menus, keys, tips and the list of commands all read it.

use super::super::book::PAGES;
use super::super::state::Studio;
use super::tour::Tour;
use super::{Mode, Window};
use eframe::egui::{self, Context, Key, KeyboardShortcut, Modifiers, Response, Ui};
use lucide_icons::Icon;

/// The menu that lists a command, and its group there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// File.
    File(u8),
    /// Edit.
    Edit(u8),
    /// View.
    View(u8),
    /// Help.
    Help(u8),
    /// No menu.
    None,
}

/// Something that the user can do.
pub struct Command {
    /// What it is called.
    pub name: &'static str,
    /// Its picture.
    pub icon: Option<Icon>,
    /// What it does, where the name does not say all.
    pub tip: &'static str,
    /// Its keys, the one that is shown first.
    pub keys: &'static [KeyboardShortcut],
    /// Its menu.
    pub place: Place,
    can: fn(&Window) -> bool,
    act: fn(&mut Window, &Context),
}

const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    let modifiers = Modifiers { alt: false, ctrl: false, shift: true, mac_cmd: false, command: true };
    KeyboardShortcut::new(modifiers, key)
}

/// A command without anything special, to say only what is.
const BLANK: Command =
    Command { name: "", icon: None, tip: "", keys: &[], place: Place::None, can: has_file, act: |_, _| {} };

/// Turn of the view for a press of an arrow key, radians.
const STEP_RAD: f64 = 0.12;
/// Turn of a fold direction for a press of a key, degrees.
const TURN_DEG: f64 = 5.0;

fn always(_: &Window) -> bool {
    true
}

fn has_file(window: &Window) -> bool {
    window.studio.document().is_some()
}

fn has_selection(window: &Window) -> bool {
    !window.studio.selection.names().is_empty()
}

fn has_one(window: &Window) -> bool {
    window.studio.selected_index().is_some() && !window.studio.is_drawn()
}

pub static OPEN: Command = Command {
    name: "Open …",
    icon: Some(Icon::FolderOpen),
    tip: "opens a mesh or a project",
    keys: &[ctrl(Key::O)],
    place: Place::File(0),
    can: always,
    act: |w, ctx| w.ask_open(ctx),
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
};

pub static QUIT: Command = Command {
    name: "Quit",
    keys: &[ctrl(Key::Q)],
    place: Place::File(4),
    can: always,
    act: |_, ctx| ctx.send_viewport_cmd(egui::ViewportCommand::Close),
    ..BLANK
};

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
};

static TURN_LEFT: Command = Command {
    name: "Rotate the fold direction to the left",
    tip: "by 5°; the wheel over a selected component does the same",
    keys: &[key(Key::OpenBracket)],
    place: Place::Edit(1),
    can: has_one,
    act: |w, ctx| turn(w, ctx, -TURN_DEG),
    ..BLANK
};

static TURN_RIGHT: Command = Command {
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

pub static EDGES: Command = Command {
    name: "Cut and glue edges",
    icon: Some(Icon::ScissorsLineDashed),
    tip: "a click on the sheets cuts a crease, or makes a crease of a cut edge; tabs are dragged to the other side",
    keys: &[key(Key::E)],
    place: Place::Edit(2),
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

static SELECT_NONE: Command = Command {
    name: "Select nothing",
    keys: &[key(Key::Escape)],
    place: Place::Edit(3),
    can: |w| has_selection(w) && w.studio.busy().is_none(),
    act: |w, _| w.studio.selection.clear(),
    ..BLANK
};

static SELECT_ALL: Command = Command {
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

pub static MODEL: Command =
    mode("Model", Icon::Box, "the model, its folding and its sheets", &[ctrl(Key::Num1)], |w, _| {
        w.mode = Mode::Model
    });
pub static SHEETS: Command =
    mode("Sheets", Icon::Files, "the sheets alone", &[ctrl(Key::Num2)], |w, _| w.mode = Mode::Sheets);
pub static EXPORT: Command = mode(
    "Export",
    Icon::FileOutput,
    "writes files to print, cut or show",
    &[ctrl(Key::Num3), ctrl(Key::E)],
    |w, _| w.mode = Mode::Export,
);
pub static PLOT: Command =
    mode("Plot", Icon::Scissors, "sends sheets to a cutter", &[ctrl(Key::Num4)], |w, _| w.mode = Mode::Plot);

const fn mode(
    name: &'static str,
    icon: Icon,
    tip: &'static str,
    keys: &'static [KeyboardShortcut],
    act: fn(&mut Window, &Context),
) -> Command {
    Command { name, icon: Some(icon), tip, keys, place: Place::View(0), act, ..BLANK }
}

pub static BESIDE: Command = Command {
    name: "Sheets beside the model",
    icon: Some(Icon::Columns2),
    tip: "shows or hides the sheets at the right of the model",
    keys: &[key(Key::B)],
    place: Place::View(1),
    can: |w| has_file(w) && w.mode == Mode::Model,
    act: |w, _| w.has_sheets_beside = !w.has_sheets_beside,
};

pub static PLAY: Command = Command {
    name: "Play or pause the folding",
    icon: Some(Icon::Play),
    tip: "folds the components one by one, in the folding order",
    keys: &[key(Key::Space)],
    place: Place::View(1),
    act: |w, _| w.space.play(),
    ..BLANK
};

pub static GHOST: Command = Command {
    name: "Ghost of the mesh",
    icon: Some(Icon::Ghost),
    tip: "shows the mesh half see-through over the components",
    keys: &[key(Key::G)],
    place: Place::View(2),
    act: |w, _| w.space.toggle_ghost(),
    ..BLANK
};

pub static NAMES: Command = Command {
    name: "Names of the components",
    icon: Some(Icon::Tag),
    tip: "shows or hides names in the view",
    keys: &[key(Key::N)],
    place: Place::View(2),
    act: |w, _| w.space.toggle_names(),
    ..BLANK
};

pub static GRID: Command = Command {
    name: "Ground grid",
    icon: Some(Icon::Grid3x3),
    tip: "shows or hides lines on the ground, 10 mm apart or as the size needs",
    place: Place::View(2),
    act: |w, _| w.space.toggle_grid(),
    ..BLANK
};

pub static HIDE: Command = Command {
    name: "Hide selected components",
    icon: Some(Icon::EyeOff),
    keys: &[key(Key::H)],
    place: Place::View(3),
    can: has_selection,
    act: |w, _| {
        let names = w.studio.selection.names().to_vec();
        w.studio.visibility.hide(&names);
    },
    ..BLANK
};

pub static ISOLATE: Command = Command {
    name: "Isolate selected components",
    icon: Some(Icon::SquareDashed),
    tip: "hides all others; a second time shows all",
    keys: &[key(Key::I)],
    place: Place::View(3),
    can: has_selection,
    act: |w, _| {
        let (names, all) = (w.studio.selection.names().to_vec(), w.studio.shown().names().to_vec());
        w.studio.visibility.isolate(&names, &all);
    },
};

pub static SHOW_ALL: Command = Command {
    name: "Show all components",
    icon: Some(Icon::Eye),
    keys: &[shift(Key::H)],
    place: Place::View(3),
    can: |w| w.studio.visibility.hides_some(),
    act: |w, _| w.studio.visibility.show_all(),
    ..BLANK
};

pub static FIT: Command = Command {
    name: "Fit",
    icon: Some(Icon::Maximize),
    tip: "fits the model or the sheets to the window",
    keys: &[key(Key::F)],
    place: Place::View(4),
    act: |w, _| w.fit(),
    ..BLANK
};

pub static MEASURE: Command = Command {
    name: "Measure",
    icon: Some(Icon::Ruler),
    tip: "measures between two corners that you click on",
    keys: &[key(Key::D)],
    place: Place::View(2),
    act: |w, _| w.space.measure_mut().toggle(),
    ..BLANK
};

static FRONT: Command = view("View from the front", &[key(Key::Num1)], |w, _| w.space.look_from(0.0, 0.0));
static SIDE: Command =
    view("View from the side", &[key(Key::Num2)], |w, _| w.space.look_from(std::f64::consts::FRAC_PI_2, 0.0));
static TOP: Command = view("View from above", &[key(Key::Num3)], |w, _| w.space.look_from(0.0, 1.5));
static LEFT: Command =
    hidden("Rotate the view to the left", &[key(Key::ArrowLeft)], |w, _| w.space.nudge(STEP_RAD, 0.0, 1.0));
static RIGHT: Command = hidden("Rotate the view to the right", &[key(Key::ArrowRight)], |w, _| {
    w.space.nudge(-STEP_RAD, 0.0, 1.0)
});
static UP: Command =
    hidden("Rotate the view up", &[key(Key::ArrowUp)], |w, _| w.space.nudge(0.0, STEP_RAD, 1.0));
static DOWN: Command =
    hidden("Rotate the view down", &[key(Key::ArrowDown)], |w, _| w.space.nudge(0.0, -STEP_RAD, 1.0));
static ZOOM_IN: Command =
    hidden("Zoom in", &[key(Key::Plus), key(Key::Equals)], |w, _| w.space.nudge(0.0, 0.0, 1.2));
static ZOOM_OUT: Command = hidden("Zoom out", &[key(Key::Minus)], |w, _| w.space.nudge(0.0, 0.0, 1.0 / 1.2));

const fn view(
    name: &'static str,
    keys: &'static [KeyboardShortcut],
    act: fn(&mut Window, &Context),
) -> Command {
    Command { name, keys, place: Place::View(4), act, ..BLANK }
}

const fn hidden(
    name: &'static str,
    keys: &'static [KeyboardShortcut],
    act: fn(&mut Window, &Context),
) -> Command {
    Command { name, keys, act, ..BLANK }
}

pub static FIND: Command = Command {
    name: "Commands …",
    icon: Some(Icon::Search),
    tip: "finds any command by its name",
    keys: &[ctrl(Key::K)],
    place: Place::Help(0),
    can: always,
    act: |w, _| w.dialogs.find(),
};

pub static SHORTCUTS: Command = Command {
    name: "Shortcuts …",
    icon: Some(Icon::Keyboard),
    tip: "lists what keys and mouse do",
    keys: &[key(Key::F1)],
    place: Place::Help(0),
    can: always,
    act: |w, _| w.dialogs.list_shortcuts(),
};

static TOUR: Command = Command {
    name: "Tour",
    icon: Some(Icon::Signpost),
    tip: "shows the window in five steps",
    place: Place::Help(0),
    act: |w, _| w.tour = Some(Tour::default()),
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

/// A page of the book.
const fn book<const PAGE: usize>() -> Command {
    Command {
        name: PAGES[PAGE].command,
        icon: Some(Icon::BookOpen),
        tip: "opens in the browser; works without a network",
        place: if PAGE == 0 { Place::Help(0) } else { Place::None },
        can: always,
        act: |w, ctx| w.open_book(ctx, PAGE),
        ..BLANK
    }
}

macro_rules! book {
    ($($page:literal)*) => { [$(book::<$page>()),*] };
}

static BOOK: [Command; PAGES.len()] = book!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21);

static OWN: &[&Command] = &[
    &OPEN,
    &SAVE,
    &SAVE_AS,
    &PRINT,
    &QUIT,
    &REDO,
    &UNDO,
    &MERGE,
    &TURN_LEFT,
    &TURN_RIGHT,
    &LAY_OUT,
    &EDGES,
    &SELECT_ALL,
    &STOP,
    &SELECT_NONE,
    &MODEL,
    &SHEETS,
    &EXPORT,
    &PLOT,
    &BESIDE,
    &PLAY,
    &GHOST,
    &NAMES,
    &GRID,
    &MEASURE,
    &HIDE,
    &ISOLATE,
    &SHOW_ALL,
    &FIT,
    &FRONT,
    &SIDE,
    &TOP,
    &LEFT,
    &RIGHT,
    &UP,
    &DOWN,
    &ZOOM_IN,
    &ZOOM_OUT,
    &FIND,
    &SHORTCUTS,
    &TOUR,
    &ABOUT,
];

/// All commands. Of two with one key the first that can be done is.
pub fn all() -> impl Iterator<Item = &'static Command> {
    OWN.iter().copied().chain(&BOOK)
}

impl Command {
    /// Its picture, as a letter of the font of icons; as wide a gap where it has none.
    pub fn picture(&self) -> char {
        self.icon.map_or('\u{2003}', char::from)
    }

    /// Whether it can be done now.
    pub fn can(&self, window: &Window) -> bool {
        (self.can)(window)
    }

    /// Does it, if it can be done.
    pub fn run(&self, window: &mut Window, ctx: &Context) {
        if self.can(window) {
            (self.act)(window, ctx);
        }
    }

    /// Its first key, as the system writes it.
    pub fn key_text(&self, ctx: &Context) -> String {
        self.keys.first().map_or(String::new(), |keys| key_text(ctx, keys))
    }

    /// What it does, with its key.
    pub fn hover_text(&self, ctx: &Context) -> String {
        let what = if self.tip.is_empty() { self.name } else { self.tip };
        let key = self.key_text(ctx);
        if key.is_empty() { what.to_owned() } else { format!("{what} ({key})") }
    }

    /// What menus call it: with what would be undone.
    pub fn label(&self, studio: &Studio) -> String {
        let document = studio.document();
        let of = match self {
            _ if std::ptr::eq(self, &UNDO) => document.and_then(|d| d.undo_label()),
            _ if std::ptr::eq(self, &REDO) => document.and_then(|d| d.redo_label()),
            _ => None,
        };
        of.map_or(self.name.to_owned(), |of| format!("{}: {of}", self.name))
    }

    /// A button with its picture alone; its name is for those who do not see it.
    pub fn button(&self, window: &mut Window, ui: &mut Ui, is_on: bool) -> Response {
        let text = egui::RichText::new(self.picture()).size(16.0);
        let is_enabled = self.can(window);
        let button = egui::Button::selectable(is_on, text).min_size(egui::vec2(28.0, 26.0));
        let response = ui.add_enabled(is_enabled, button);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_enabled, self.name));
        let tip = self.hover_text(ui.ctx());
        let response = response.on_hover_text(tip.clone()).on_disabled_hover_text(tip);
        if response.clicked() {
            self.run(window, ui.ctx());
        }
        response
    }

    /// A line of a menu.
    pub fn menu_item(&self, window: &mut Window, ui: &mut Ui) {
        let text = format!("{}  {}", self.picture(), self.label(&window.studio));
        let button = egui::Button::new(text).shortcut_text(self.key_text(ui.ctx()));
        let is_enabled = self.can(window);
        let response = ui.add_enabled(is_enabled, button);
        let name = self.label(&window.studio);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_enabled, &name));
        let response = if self.tip.is_empty() { response } else { response.on_hover_text(self.tip) };
        if response.clicked() {
            self.run(window, ui.ctx());
            ui.close();
        }
    }
}

/// Keys as they stand on the keyboard.
pub fn key_text(ctx: &Context, keys: &KeyboardShortcut) -> String {
    let key = match keys.logical_key {
        Key::OpenBracket => "[",
        Key::CloseBracket => "]",
        Key::Plus => "+",
        Key::Equals => "=",
        Key::Minus => "-",
        Key::Escape => "Esc",
        _ => return ctx.format_shortcut(keys),
    };
    key.to_owned()
}

fn turn(window: &mut Window, ctx: &Context, degrees: f64) {
    if let Some(part) = window.studio.selected_index() {
        let now_s = ctx.input(|i| i.time);
        window.studio.turn(part, degrees, now_s);
    }
}

/// Heeds the keys, unless a text is being written. Keys that widgets know are theirs while one has the focus.
pub fn heed(window: &mut Window, ctx: &Context) {
    let writes = ctx.egui_wants_keyboard_input();
    let is_focused = ctx.memory(|memory| memory.focused().is_some());
    // Shift and H is no H: those with Shift come first.
    let keys = |has_shift: bool| {
        let all = all().flat_map(|command| command.keys.iter().map(move |keys| (command, keys)));
        all.filter(move |(_, keys)| keys.modifiers.shift == has_shift)
    };
    for (command, keys) in keys(true).chain(keys(false)) {
        let is_plain = !keys.modifiers.command;
        // A text that is being written has its own undo.
        let is_of_text = matches!(keys.logical_key, Key::Z | Key::Y | Key::A);
        let is_of_widgets = is_plain
            && matches!(
                keys.logical_key,
                Key::Space | Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp | Key::ArrowDown
            );
        if (writes && (is_plain || is_of_text)) || (is_focused && is_of_widgets) || !command.can(window) {
            continue;
        }
        if ctx.input_mut(|i| i.consume_shortcut(keys)) {
            command.run(window, ctx);
        }
    }
}

/// What the mouse does.
pub const MOUSE: [(&str, &str); 11] = [
    ("drag", "rotate the view; move the sheets"),
    ("right or middle button, or Shift and drag", "move the view"),
    ("wheel", "zoom at the pointer"),
    ("click", "select a component and a panel, or a piece"),
    ("Shift and click", "select several components"),
    ("two fingers on a trackpad", "move the view or the sheets; pinch to zoom"),
    ("wheel over a selected component", "rotate its fold direction by 5° per click, with Shift by 1°"),
    (
        "drag the handle on the ring",
        "rotate the fold direction; green directions fold without a clash, red ones clash",
    ),
    ("drag a piece", "move it; all other pieces stay. Comma and full stop rotate it meanwhile"),
    ("drop a piece beside the sheets", "put it on a sheet of its own"),
    ("drop a file", "open it"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart_and_keys_have_one_meaning() {
        for (k, command) in all().enumerate() {
            assert!(!command.name.is_empty());
            for other in all().take(k) {
                assert_ne!(command.name, other.name);
                let both = command.keys.iter().any(|keys| other.keys.contains(keys));
                // Escape stops a calculation, or else selects nothing.
                assert!(
                    !both || command.keys[0].logical_key == Key::Escape,
                    "{} and {}",
                    command.name,
                    other.name
                );
            }
        }
    }
}
