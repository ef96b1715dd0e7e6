//! What is shown, and from where.

use super::super::{Mode, Window};
use super::keys::{ctrl, key, shift};
use super::{BLANK, Command, Place, always, has_file, has_selection, pieces};
use eframe::egui::{Context, Key, KeyboardShortcut, Theme, ThemePreference};
use glam::DVec2;
use lucide_icons::Icon;

/// All of them.
pub(super) static ALL: &[&Command] = &[
    &MODEL, &SHEETS, &EXPORT, &PLOT, &BESIDE, &PLAY, &GHOST, &NAMES, &GRID, &MEASURE, &HIDE, &ISOLATE,
    &SHOW_ALL, &FIT, &FRONT, &SIDE, &TOP, &LEFT, &RIGHT, &UP, &DOWN, &ZOOM_IN, &ZOOM_OUT, &LIGHT, &DARK,
    &SYSTEM,
];

/// Turn of the view for a press of an arrow key, radians.
const STEP_RAD: f64 = 0.12;
/// Move of a piece for one, mm.
const STEP_MM: f64 = 1.0;

pub static MODEL: Command = Command {
    name: "Model",
    icon: Some(Icon::Box),
    tip: "the model, its folding and its sheets",
    keys: &[ctrl(Key::Num1)],
    is_on: Some(|w| w.mode == Mode::Model),
    act: |w, _| w.mode = Mode::Model,
    ..MODE
};

pub static SHEETS: Command = Command {
    name: "Sheets",
    icon: Some(Icon::Files),
    tip: "the sheets alone",
    keys: &[ctrl(Key::Num2)],
    is_on: Some(|w| w.mode == Mode::Sheets),
    act: |w, _| w.mode = Mode::Sheets,
    ..MODE
};

pub static EXPORT: Command = Command {
    name: "Export",
    icon: Some(Icon::FileOutput),
    tip: "writes files to print, cut or show",
    keys: &[ctrl(Key::Num3), ctrl(Key::E)],
    is_on: Some(|w| w.mode == Mode::Export),
    act: |w, _| w.mode = Mode::Export,
    ..MODE
};

pub static PLOT: Command = Command {
    name: "Plot",
    icon: Some(Icon::Scissors),
    tip: "sends sheets to a cutter",
    keys: &[ctrl(Key::Num4)],
    is_on: Some(|w| w.mode == Mode::Plot),
    act: |w, _| w.mode = Mode::Plot,
    ..MODE
};

/// What the middle of the window shows.
const MODE: Command = Command { place: Place::View(0), ..BLANK };

pub static BESIDE: Command = Command {
    name: "Sheets beside the model",
    icon: Some(Icon::Columns2),
    tip: "shows or hides the sheets at the right of the model",
    keys: &[key(Key::B)],
    place: Place::View(1),
    is_on: Some(|w| w.has_sheets_beside),
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
    is_on: Some(|w| w.space.layers().input),
    act: |w, _| w.space.toggle_ghost(),
    ..BLANK
};

pub static NAMES: Command = Command {
    name: "Names of the components",
    icon: Some(Icon::Tag),
    tip: "shows or hides names in the view",
    keys: &[key(Key::N)],
    place: Place::View(2),
    is_on: Some(|w| w.space.shows_names()),
    act: |w, _| w.space.toggle_names(),
    ..BLANK
};

pub static GRID: Command = Command {
    name: "Ground grid",
    icon: Some(Icon::Grid3x3),
    tip: "shows or hides lines on the ground, 10 mm apart or as the size needs",
    place: Place::View(2),
    is_on: Some(|w| w.space.layers().grid),
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
    ..BLANK
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
    is_on: Some(|w| w.space.measure().is_on()),
    act: |w, _| w.space.measure_mut().toggle(),
    ..BLANK
};

static LIGHT: Command = theme("Light theme", Icon::Sun, |_, ctx| ctx.set_theme(Theme::Light));
static DARK: Command = theme("Dark theme", Icon::Moon, |_, ctx| ctx.set_theme(Theme::Dark));
static SYSTEM: Command =
    theme("Theme of the system", Icon::SunMoon, |_, ctx| ctx.set_theme(ThemePreference::System));

/// The menu of the view has a list of its own for them.
const fn theme(name: &'static str, icon: Icon, act: fn(&mut Window, &Context)) -> Command {
    Command { name, icon: Some(icon), can: always, act, ..BLANK }
}

static FRONT: Command = view("View from the front", &[key(Key::Num1)], |w, _| w.space.look_from(0.0, 0.0));
static SIDE: Command =
    view("View from the side", &[key(Key::Num2)], |w, _| w.space.look_from(std::f64::consts::FRAC_PI_2, 0.0));
static TOP: Command = view("View from above", &[key(Key::Num3)], |w, _| w.space.look_from(0.0, 1.5));
static LEFT: Command =
    hidden("Rotate the view to the left, or move the piece by 1 mm", &[key(Key::ArrowLeft)], |w, ctx| {
        step(w, ctx, DVec2::NEG_X)
    });
static RIGHT: Command =
    hidden("Rotate the view to the right, or move the piece by 1 mm", &[key(Key::ArrowRight)], |w, ctx| {
        step(w, ctx, DVec2::X)
    });
static UP: Command =
    hidden("Rotate the view up, or move the piece by 1 mm", &[key(Key::ArrowUp)], |w, ctx| {
        step(w, ctx, DVec2::Y)
    });
static DOWN: Command =
    hidden("Rotate the view down, or move the piece by 1 mm", &[key(Key::ArrowDown)], |w, ctx| {
        step(w, ctx, DVec2::NEG_Y)
    });
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

/// Moves the selected piece; without one, rotates the view.
fn step(window: &mut Window, ctx: &Context, way: DVec2) {
    if pieces::can_push(window) {
        pieces::push(window, ctx, STEP_MM * way);
    } else {
        window.space.nudge(-STEP_RAD * way.x, STEP_RAD * way.y, 1.0);
    }
}
