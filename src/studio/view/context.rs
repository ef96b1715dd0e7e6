//! The menu of the right mouse button: what can be done with what is under the mouse.

use super::Window;
use super::commands::{self, Command};
use eframe::egui::{PointerButton, Popup, Response, SetOpenCommand, Ui};
use tatamu::model::PartId;

/// What can be done with components, in groups.
const OF_COMPONENTS: [&[&Command]; 3] = [
    &[&commands::TURN_LEFT, &commands::TURN_RIGHT, &commands::RENAME, &commands::MERGE],
    &[&commands::HIDE, &commands::ISOLATE, &commands::SHOW_ALL],
    &[&commands::SELECT_ALL, &commands::SELECT_NONE, &commands::FIT],
];

/// What can be done with pieces.
const OF_PIECES: [&[&Command]; 3] = [
    &[&commands::PIECE_LEFT, &commands::PIECE_RIGHT, &commands::PUT_ASIDE, &commands::UNPIN],
    &[&commands::EDGES, &commands::LAY_OUT, &commands::FIT_SHEETS],
    &[&commands::FIT],
];

/// The menu over the model.
pub fn of_components(window: &mut Window, ui: &Ui, place: &Response) {
    show(window, ui, place, true, &OF_COMPONENTS);
}

/// The menu over the names of components in a panel with other things.
pub fn of_names(window: &mut Window, ui: &Ui, place: &Response) {
    let is_on_name = window.studio.hover.is_some();
    show(window, ui, place, is_on_name, &OF_COMPONENTS);
}

/// The menu over the sheets.
pub fn of_pieces(window: &mut Window, ui: &Ui, place: &Response) {
    show(window, ui, place, true, &OF_PIECES);
}

fn show(window: &mut Window, ui: &Ui, place: &Response, can_open: bool, groups: &[&[&Command]]) {
    let is_asked = can_open
        && ui.input(|i| i.pointer.button_clicked(PointerButton::Secondary))
        && ui.rect_contains_pointer(place.rect)
        && !window.dialogs.is_open();
    if is_asked {
        select(window);
    }
    let popup = Popup::menu(place).open_memory(is_asked.then_some(SetOpenCommand::Bool(true)));
    popup.at_pointer_fixed().show(|ui| {
        let mut is_first = true;
        for group in groups {
            let can: Vec<&&Command> = group.iter().filter(|command| command.can(window)).collect();
            if !can.is_empty() && !std::mem::take(&mut is_first) {
                ui.separator();
            }
            can.into_iter().for_each(|command| command.menu_item(window, ui));
        }
    });
}

/// What is under the mouse is selected, unless it is already.
fn select(window: &mut Window) {
    let Some(hover) = window.studio.hover.clone() else { return };
    let names = window.studio.shown().names();
    let name =
        names.iter().enumerate().find(|(part, _)| hover.is_on(PartId(*part))).map(|(_, name)| name.clone());
    if let Some(name) = name.filter(|name| !window.studio.selection.has(name)) {
        window.studio.selection.select(&name, None, false);
    }
}
