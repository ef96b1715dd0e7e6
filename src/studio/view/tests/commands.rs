//! The list of commands.

use super::*;
use egui_kittest::kittest::NodeT;

fn open_list(desk: &mut Desk) {
    desk.key_press_modifiers(Modifiers::COMMAND, Key::K);
    desk.run_ok();
}

/// Opens the list and types some words.
fn find(desk: &mut Desk, words: &str) {
    open_list(desk);
    desk.event(Event::Text(words.to_owned()));
    desk.run_ok();
}

/// Runs the first command that is found by some words.
fn run(desk: &mut Desk, words: &str) {
    find(desk, words);
    desk.key_press(Key::Enter);
    desk.run_ok();
}

#[test]
fn a_command_is_found_by_its_name_and_run() {
    let (mut desk, _folder) = open();
    find(&mut desk, "ghost");
    assert_eq!(desk.query_all_by_label("Ghost of the mesh").count(), 2, "in the list and in the bar");
    desk.key_press(Key::Enter);
    desk.run_ok();
    assert!(desk.state().space().layers().input, "it is run");
    open_list(&mut desk);
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(!desk.state().dialogs.is_open());
}

/// After a search that found little the list had room for two commands.
#[test]
fn the_list_of_commands_is_high_again_after_a_search_and_its_bar_has_room() {
    let (mut desk, _folder) = open();
    let height = |desk: &Desk| {
        desk.ctx.memory(|m| m.area_rect(egui::Id::unique("finder"))).map_or(0.0, |rect| rect.height())
    };
    find(&mut desk, "ghost");
    assert!(height(&desk) < 200.0);
    desk.key_press(Key::Escape);
    desk.run_ok();
    open_list(&mut desk);
    assert!(height(&desk) > 340.0, "{}", height(&desk));
    let field = desk.get_by_label("Find a command").rect();
    let entry = desk.get_by_label("Save project as …").rect();
    let bar = desk.ctx.global_style().spacing.scroll.bar_width;
    assert!(entry.right() <= field.right() - bar, "{entry:?} runs under the bar: {field:?}");
}

/// "sheets" printed them.
#[test]
fn the_command_with_the_name_that_is_typed_is_the_first() {
    let (mut desk, _folder) = open();
    run(&mut desk, "sheets");
    assert_eq!(desk.state().mode, Mode::Sheets);
}

/// A search for "merge" found nothing while less than two components were selected.
#[test]
fn commands_that_cannot_be_done_now_are_found_too() {
    let (mut desk, _folder) = open();
    find(&mut desk, "merge selected");
    let item = desk.get_by_role_and_label(Role::Button, "Merge selected components");
    assert!(item.accesskit_node().is_disabled());
    desk.key_press(Key::Enter);
    desk.run_ok();
    assert!(desk.state().dialogs.is_open(), "Enter does nothing with it");
}

#[test]
fn the_theme_is_a_command() {
    let (mut desk, _folder) = open();
    for (name, theme) in [("dark", egui::Theme::Dark), ("light theme", egui::Theme::Light)] {
        run(&mut desk, name);
        assert_eq!(desk.ctx.theme(), theme);
    }
}

#[test]
fn pages_of_the_book_are_found_among_the_commands() {
    let (mut desk, folder) = open();
    run(&mut desk, "book cutter");
    assert!(folder.path().join("state/book/how-to/cutter.html").is_file());
    assert_eq!(desk.state().studio().problem(), None);
}
