//! What keys and mouse do.

use super::super::Window;
use super::all;
use eframe::egui::{Context, Key, KeyboardShortcut, Modifiers, Popup};

pub(super) const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

pub(super) const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

pub(super) const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

pub(super) const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    let modifiers = Modifiers { alt: false, ctrl: false, shift: true, mac_cmd: false, command: true };
    KeyboardShortcut::new(modifiers, key)
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

/// Handles the keys, unless the user is typing text. While a widget has the focus, the keys that it uses are its own.
pub fn handle_keys(window: &mut Window, ctx: &Context) {
    let writes = ctx.text_edit_focused();
    let is_focused = ctx.memory(|memory| memory.focused().is_some());
    // Shift+H is not H: keys with Shift come first.
    let keys = |has_shift: bool| {
        let all = all().flat_map(|command| command.keys.iter().map(move |keys| (command, keys)));
        all.filter(move |(_, keys)| keys.modifiers.shift == has_shift)
    };
    for (command, keys) in keys(true).chain(keys(false)) {
        let is_plain = !keys.modifiers.command;
        // A text that is being written has its own undo.
        let is_of_text = matches!(keys.logical_key, Key::Z | Key::Y | Key::A);
        // It closes a menu first.
        let is_of_menu = keys.logical_key == Key::Escape && Popup::is_any_open(ctx);
        let is_of_widgets = is_plain
            && matches!(
                keys.logical_key,
                Key::Space | Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp | Key::ArrowDown
            );
        let is_taken = (writes && (is_plain || is_of_text)) || (is_focused && is_of_widgets) || is_of_menu;
        if is_taken || !command.can(window) {
            continue;
        }
        if ctx.input_mut(|i| i.consume_shortcut(keys)) {
            // A menu does not stay behind what the command opens.
            Popup::close_all(ctx);
            command.run(window, ctx);
        }
    }
}

/// What the mouse does.
pub const MOUSE: [(&str, &str); 12] = [
    ("drag", "rotate the view; move the sheets"),
    ("right or middle button, or Shift and drag", "move the view"),
    ("wheel", "zoom at the pointer"),
    ("click", "select a component and a panel, or a piece"),
    ("Shift and click", "select several components"),
    ("right click", "open a menu for what is under the mouse"),
    ("two fingers on a trackpad", "move the view or the sheets; pinch to zoom"),
    ("wheel over a selected component", "rotate its fold direction by 5° per click, with Shift by 1°"),
    ("drag the handle on the ring", "rotate the fold direction; green folds without a clash, red clashes"),
    ("drag a piece", "move it alone; comma and full stop rotate it meanwhile"),
    ("drop a piece beside the sheets", "put it on a sheet of its own"),
    ("drop a file", "open it"),
];
