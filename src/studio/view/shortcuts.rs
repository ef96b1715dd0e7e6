//! Keys, in one list: what is listed is what works.

use super::{Mode, Window};
use eframe::egui::{self, Context, Key, Modifiers};

/// What a key does.
type Act = fn(&mut Window, &Context);

/// Keys, what they are called, what they do, and how.
struct Shortcut {
    modifiers: Modifiers,
    key: Key,
    what: &'static str,
    act: Act,
}

const fn plain(key: Key, what: &'static str, act: Act) -> Shortcut {
    Shortcut { modifiers: Modifiers::NONE, key, what, act }
}

const fn command(key: Key, what: &'static str, act: Act) -> Shortcut {
    Shortcut { modifiers: Modifiers::COMMAND, key, what, act }
}

/// Turn of the view for a press of an arrow key, radians.
const STEP_RAD: f64 = 0.12;

/// Those with more modifiers come first.
const LIST: &[Shortcut] = &[
    Shortcut {
        modifiers: Modifiers { alt: false, ctrl: false, shift: true, mac_cmd: false, command: true },
        key: Key::Z,
        what: "redo",
        act: |w, _| w.studio.redo(),
    },
    command(Key::Z, "undo", |w, _| w.studio.undo()),
    command(Key::Y, "redo", |w, _| w.studio.redo()),
    command(Key::O, "open a file", |w, _| w.ask_open()),
    command(Key::S, "save the project", |w, _| w.save()),
    command(Key::Q, "quit", |_, ctx| ctx.send_viewport_cmd(egui::ViewportCommand::Close)),
    command(Key::Num1, "model", |w, _| w.mode = Mode::Model),
    command(Key::Num2, "sheets", |w, _| w.mode = Mode::Sheets),
    command(Key::Num3, "export", |w, _| w.mode = Mode::Export),
    command(Key::Num4, "plot", |w, _| w.mode = Mode::Plot),
    plain(Key::F1, "this list", |w, _| w.shows_shortcuts = !w.shows_shortcuts),
    plain(Key::Escape, "stop the calculation, or clear the selection", |w, _| {
        if w.browser.take().is_some() || std::mem::take(&mut w.shows_shortcuts) {
        } else if w.studio.busy().is_some() {
            w.studio.cancel();
        } else {
            w.studio.selection.clear();
        }
    }),
    plain(Key::Space, "play or pause the folding", |w, _| w.space.play()),
    plain(Key::F, "fit the model to the window", |w, _| w.space.fit()),
    plain(Key::M, "merge the selected components", |w, _| w.studio.merge_selected()),
    plain(Key::OpenBracket, "rotate the fold direction to the left", |w, _| turn(w, -5.0)),
    plain(Key::CloseBracket, "rotate the fold direction to the right", |w, _| turn(w, 5.0)),
    plain(Key::Num1, "view from the front", |w, _| w.space.look_from(0.0, 0.0)),
    plain(Key::Num2, "view from the side", |w, _| w.space.look_from(std::f64::consts::FRAC_PI_2, 0.0)),
    plain(Key::Num3, "view from above", |w, _| w.space.look_from(0.0, 1.5)),
    plain(Key::ArrowLeft, "rotate the view", |w, _| w.space.nudge(STEP_RAD, 0.0, 1.0)),
    plain(Key::ArrowRight, "rotate the view", |w, _| w.space.nudge(-STEP_RAD, 0.0, 1.0)),
    plain(Key::ArrowUp, "rotate the view", |w, _| w.space.nudge(0.0, STEP_RAD, 1.0)),
    plain(Key::ArrowDown, "rotate the view", |w, _| w.space.nudge(0.0, -STEP_RAD, 1.0)),
    plain(Key::Plus, "zoom in", |w, _| w.space.nudge(0.0, 0.0, 1.2)),
    plain(Key::Equals, "zoom in", |w, _| w.space.nudge(0.0, 0.0, 1.2)),
    plain(Key::Minus, "zoom out", |w, _| w.space.nudge(0.0, 0.0, 1.0 / 1.2)),
];

/// What the mouse does.
const MOUSE: [(&str, &str); 8] = [
    ("drag", "rotate the view"),
    ("right or middle button, or Shift and drag", "move the view"),
    ("wheel", "zoom"),
    ("click", "select a component and a panel"),
    ("Shift and click", "select several components"),
    ("two fingers on a trackpad", "move the view; pinch to zoom"),
    ("wheel over a selected component", "rotate its fold direction by 5° per click, with Shift by 1°"),
    ("drop a file", "open it"),
];

fn turn(window: &mut Window, degrees: f64) {
    if let Some(part) = window.studio.selected_index() {
        window.studio.turn(part, degrees);
    }
}

/// Heeds the keys, unless a text is being written.
pub fn heed(window: &mut Window, ctx: &Context) {
    let writes = ctx.egui_wants_keyboard_input();
    for shortcut in LIST {
        let is_command = shortcut.modifiers.command;
        // A text that is being written has its own undo.
        let is_of_text = matches!(shortcut.key, Key::Z | Key::Y);
        if writes && (!is_command || is_of_text) {
            continue;
        }
        if ctx.input_mut(|i| i.consume_key(shortcut.modifiers, shortcut.key)) {
            (shortcut.act)(window, ctx);
        }
    }
}

/// The list of all.
pub fn window(ctx: &Context, is_open: &mut bool) {
    egui::Window::new("Shortcuts").open(is_open).collapsible(false).default_width(430.0).show(ctx, |ui| {
        egui::ScrollArea::vertical().max_height(460.0).show(ui, |ui| {
            egui::Grid::new("shortcuts").num_columns(2).striped(true).show(ui, |ui| {
                for (what, effect) in MOUSE {
                    ui.label(what);
                    ui.label(effect);
                    ui.end_row();
                }
                for shortcut in LIST {
                    let keys = egui::KeyboardShortcut::new(shortcut.modifiers, shortcut.key);
                    ui.monospace(ctx.format_shortcut(&keys));
                    ui.label(shortcut.what);
                    ui.end_row();
                }
            });
        });
    });
}
