//! What the user can do, in one table: menus, keys, tips and the list of commands all read it.

mod edit;
mod file;
mod help;
mod keys;
mod pieces;
mod view;

use super::super::state::Studio;
use super::Window;
pub use edit::{
    EDGES, FIT_SHEETS, LAY_OUT, MERGE, REDO, RENAME, SELECT_ALL, SELECT_NONE, TURN_LEFT, TURN_RIGHT, UNDO,
};
use eframe::egui::{self, Context, KeyboardShortcut, Response, Ui};
pub use file::{OPEN, SAVE};
pub use help::{BOOK_TIP, COMMAND_LINE, FIND, SHORTCUTS, libraries};
pub use keys::{MOUSE, handle_keys, key_text};
use lucide_icons::Icon;
pub use pieces::{PIECE_LEFT, PIECE_RIGHT, PUT_ASIDE, UNPIN};
pub use view::{
    BESIDE, EXPORT, FIT, GHOST, HIDE, ISOLATE, MEASURE, MODEL, NAMES, PLAY, PLOT, SHEETS, SHOW_ALL,
};

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
    /// Whether what it turns on and off is on.
    is_on: Option<fn(&Window) -> bool>,
    can: fn(&Window) -> bool,
    act: fn(&mut Window, &Context),
}

/// A command without anything special, to say only what is.
const BLANK: Command = Command {
    name: "",
    icon: None,
    tip: "",
    keys: &[],
    place: Place::None,
    is_on: None,
    can: has_file,
    act: |_, _| {},
};

fn always(_: &Window) -> bool {
    true
}

fn has_file(window: &Window) -> bool {
    window.studio.document().is_some()
}

fn has_selection(window: &Window) -> bool {
    !window.studio.selection.names().is_empty()
}

/// All commands. If two share a key, it runs the first one that can be done.
pub fn all() -> impl Iterator<Item = &'static Command> {
    [file::ALL, edit::ALL, pieces::ALL, view::ALL, help::ALL].concat().into_iter().chain(&help::BOOK)
}

impl Command {
    /// Its picture, as a letter of the font of icons; as wide a gap where it has none.
    pub fn picture(&self) -> char {
        self.icon.map_or('\u{2003}', char::from)
    }

    /// Whether what it switches is on; `None` if it is not a switch.
    fn is_on(&self, window: &Window) -> Option<bool> {
        self.is_on.map(|is_on| is_on(window))
    }

    /// What screen readers say of it.
    fn info(&self, window: &Window, name: &str) -> egui::WidgetInfo {
        let can = self.can(window);
        match self.is_on(window) {
            Some(is_on) => egui::WidgetInfo::selected(egui::Role::Button, can, is_on, name),
            None => egui::WidgetInfo::labeled(egui::Role::Button, can, name),
        }
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
    pub fn button(&self, window: &mut Window, ui: &mut Ui) -> Response {
        let text = egui::RichText::new(self.picture()).size(16.0);
        let is_enabled = self.can(window);
        let is_on = self.is_on(window) == Some(true);
        let button = egui::Button::selectable(is_on, text).min_size(egui::vec2(28.0, 26.0));
        let response = ui.add_enabled(is_enabled, button);
        response.widget_info(|| self.info(window, self.name));
        let tip = self.hover_text(ui.ctx());
        let response = response.on_hover_text(tip.clone()).on_disabled_hover_text(tip);
        if response.clicked() {
            self.run(window, ui.ctx());
        }
        response
    }

    /// A line of a menu, with a tick in place of the picture where it is on.
    pub fn menu_item(&self, window: &mut Window, ui: &mut Ui) {
        let is_on = self.is_on(window) == Some(true);
        let picture = if is_on { char::from(Icon::Check) } else { self.picture() };
        let text = format!("{picture}  {}", self.label(&window.studio));
        let button = egui::Button::new(text).shortcut_text(self.key_text(ui.ctx()));
        let is_enabled = self.can(window);
        let response = ui.add_enabled(is_enabled, button);
        let name = self.label(&window.studio);
        response.widget_info(|| self.info(window, &name));
        let response = if self.tip.is_empty() { response } else { response.on_hover_text(self.tip) };
        if response.clicked() {
            self.run(window, ui.ctx());
            ui.close();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::Key;

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
