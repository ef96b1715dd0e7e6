//! All that the command line can do is in the window, or named there; and the keyboard reaches all of it.

use super::super::command_line::COMMANDS;
use super::*;
use crate::cli;
use crate::studio::change::Change;
use std::collections::BTreeSet;
use tatamu::front::dials;
use tatamu::project::options::{
    self, CARD, CONCAVE, CUTTER, DIRECTION, Entry, JOINT, MEDIA, METHOD, RENAME, ROOT, SHEETS_MAX, Settings,
};

/// The words of a command after the program's name, for a file.
fn words(command: &str) -> Vec<String> {
    let command = command.replace("{file}", "teddy.obj").replace("{name}", "teddy");
    command.split_whitespace().map(str::to_owned).collect()
}

#[test]
fn commands_to_copy_are_those_of_the_command_line() {
    for (what, command) in COMMANDS {
        let parsed = cli::command().try_get_matches_from(words(command));
        assert!(parsed.is_ok(), "{what}: {}", parsed.unwrap_err());
    }
}

/// Whether an option has a control in the window.
fn is_in_window(option: &Entry) -> bool {
    let method = options::Given::of_flag(&METHOD, "sdf").unwrap();
    let sdf = tatamu::project::choose(None, &[method]).unwrap();
    let of_model = [Settings::standard(), &sdf].into_iter().any(|s| dials::model(s, false).contains(&option));
    let of_parts = [&RENAME, &DIRECTION, &CONCAVE, &JOINT, &CARD, &ROOT].contains(&option);
    let of_machine = [&CUTTER, &MEDIA].contains(&option);
    // The panel of the files has a test that it has all of its own.
    let of_files = option.key.is_some_and(|key| key.table == "export") && option.name() != "for";
    let of_paper = dials::PAPER_AND_PIECES.contains(&option) || dials::RARE.contains(&option);
    of_model || of_parts || of_machine || of_files || of_paper
}

#[test]
fn every_flag_is_in_the_window_or_in_a_command_to_copy() {
    let named: BTreeSet<String> = COMMANDS.iter().flat_map(|(_, command)| words(command)).collect();
    // What the window does by other means: dialogs, questions, messages.
    let by_other_means = [
        "output", "guide", "yes", "force", "quiet", "help", "port", "copies", "test-cut", "resume", "stage",
        "report",
    ];
    let mut count = 0;
    for name in ["make", "plot", "show", "segment"] {
        let command = cli::command().find_subcommand(name).unwrap().clone();
        for flag in command.get_arguments().filter_map(|argument| argument.get_long()) {
            let option = options::all().find(|option| option.flag.is_some_and(|own| own.name == flag));
            let is_reached = option.is_some_and(is_in_window)
                || named.contains(&format!("--{flag}"))
                || by_other_means.contains(&flag);
            assert!(is_reached, "{name} --{flag} is neither in the window nor among the commands");
            count += 1;
        }
    }
    assert!(count > 80, "only {count} flags");
}

#[test]
fn what_the_window_has_not_is_listed_with_a_command_to_copy() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Export");
    click(&mut desk, "On the command line …");
    let command = "tatamu make snowman.toml --for cricut";
    desk.get_by_label(&format!("Copy {command}")).click();
    let is_copied = |desk: &Desk| {
        let done = &desk.output().platform_output.commands;
        done.iter().any(|done| matches!(done, egui::OutputCommand::CopyText(text) if text == command))
    };
    let copied = (0..10).any(|_| {
        desk.step();
        is_copied(&desk)
    });
    assert!(copied, "the command is on the clipboard");
    assert!(desk.query_by_label(command).is_some());
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.query_by_label(command).is_none());
}

#[test]
fn the_size_is_fitted_to_a_number_of_sheets() {
    let (mut desk, _folder) = open();
    wait_for(&mut desk, "Sheet 1");
    let sheets = |s: &Studio| s.finished().map(|output| output.layout().sheet_count());
    let before = sheets(desk.state().studio()).unwrap();
    assert!(before > 2, "{before} sheets");
    let name = "Fit the size to the sheets";
    assert!(desk.query_by_label(name).is_none(), "any number is right");
    let change = Change::Set { option: &SHEETS_MAX, value: Some(2.into()) };
    desk.state_mut().studio_mut().change(&change, None);
    settle(&mut desk, "the model", |s| s.busy().is_none() && s.finished().is_some());
    click(&mut desk, name);
    settle(&mut desk, "a smaller model", |s| sheets(s).is_some_and(|n| n <= 2) || s.problem().is_some());
    let studio = desk.state().studio();
    let size_mm = studio.finished().unwrap().options().size_mm;
    assert!(size_mm < 200.0 && size_mm > 50.0 && size_mm % 5.0 == 0.0, "{size_mm}");
    assert_eq!(studio.notice(), Some(format!("the size is {size_mm} mm now; Undo takes it back").as_str()));
    assert!(desk.query_by_label(name).is_none(), "it fits");
    click(&mut desk, "Undo");
    settle(&mut desk, "the model before", |s| sheets(s) == Some(before));
}

/// Controls that had the keyboard looked like those under the mouse.
#[test]
fn the_control_that_has_the_keyboard_has_a_ring() {
    let (mut desk, _folder) = open();
    assert_eq!(desk.state().focus.around(), None);
    desk.key_press(Key::Tab);
    desk.run_ok();
    let first = desk.state().focus.around().expect("a ring");
    desk.key_press(Key::Tab);
    desk.run_ok();
    let second = desk.state().focus.around().expect("a ring");
    assert!(first != second && second.width() > 8.0 && second.height() > 8.0, "{first} {second}");
    press(&mut desk, Pos2::new(640.0, 700.0), Modifiers::NONE);
    assert_eq!(desk.state().focus.around(), None, "the mouse needs none");
}

/// A button that had the focus took all keys, so that N and H did nothing after a press of Tab.
#[test]
fn keys_work_while_a_button_has_the_focus() {
    let (mut desk, _folder) = open();
    let before = desk.state().space().shows_names();
    desk.key_press(Key::Tab);
    desk.run_ok();
    desk.key_press(Key::N);
    desk.run_ok();
    assert_ne!(desk.state().space().shows_names(), before);
}

/// Controls below the edge of a panel that scrolls got the keyboard and were not seen.
#[test]
fn the_control_that_has_the_keyboard_is_scrolled_into_view() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let most = desk.get_by_label("ready").rect().top();
    let is_last = |desk: &Desk| desk.get_by_label("More settings").is_focused();
    for _ in 0..120 {
        desk.key_press(Key::Tab);
        desk.run_ok();
        if is_last(&desk) {
            break;
        }
    }
    assert!(is_last(&desk));
    desk.run_steps(30);
    let last = desk.get_by_label("More settings").rect();
    assert!(last.bottom() <= most, "{last} is below {most}");
}

/// Pieces were selected by the mouse alone.
#[test]
fn pieces_are_selected_one_after_the_other_by_keys() {
    let (mut desk, _folder) = open_sheets();
    let count: usize =
        desk.state().studio().finished().unwrap().nets().iter().map(|net| net.pieces().len()).sum();
    let piece = |desk: &Desk| desk.state().studio().selection.piece().unwrap().to_owned();
    let mut seen = BTreeSet::new();
    for _ in 0..count {
        desk.key_press(Key::P);
        desk.run_ok();
        seen.insert(piece(&desk));
    }
    assert_eq!(seen.len(), count);
    let last = piece(&desk);
    desk.key_press(Key::P);
    desk.run_ok();
    assert_ne!(piece(&desk), last);
    desk.key_press_modifiers(Modifiers::SHIFT, Key::P);
    desk.run_ok();
    assert_eq!(piece(&desk), last);
    assert!(desk.query_by_role_and_label(Role::Button, "Put aside").is_some());
}

#[test]
fn the_selected_component_is_renamed_by_a_key() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    desk.key_press(Key::F2);
    desk.run_ok();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.event(Event::Text("hat".to_owned()));
    desk.run_ok();
    desk.key_press(Key::Enter);
    desk.run_ok();
    settle(&mut desk, "the name", |s| s.shown().part(PartId(1)).is_some_and(|part| part.name == "hat"));
}

/// The list of keys was 400 points high in any window, and no key scrolled it.
#[test]
fn a_long_list_of_keys_has_all_of_the_window() {
    let (mut desk, _folder) = open();
    desk.set_size(egui::vec2(1280.0, 1400.0));
    desk.key_press(Key::F1);
    desk.run_steps(5);
    let close = desk.get_by_role_and_label(Role::Button, "Close").rect();
    assert!(close.top() < 250.0, "{close}");
    desk.set_size(egui::vec2(1280.0, 500.0));
    desk.run_ok();
    let before = desk.get_by_label("wheel").rect().top();
    desk.key_press(Key::PageDown);
    desk.run_steps(30);
    let after = desk.get_by_label("wheel").rect().top();
    assert!(after < before - 100.0, "{before} {after}");
}

/// In a small window the files that were open before were below its edge.
#[test]
fn recent_files_are_reached_in_a_small_window() {
    let (desk, folder) = open();
    drop(desk);
    let mut desk = window(folder.path());
    desk.set_size(egui::vec2(800.0, 450.0));
    desk.run_ok();
    for _ in 0..40 {
        desk.key_press(Key::Tab);
        desk.run_ok();
        if desk.get_by_label("snowman.toml").is_focused() {
            break;
        }
    }
    desk.run_steps(30);
    let link = desk.get_by_label("snowman.toml");
    assert!(link.is_focused() && link.rect().bottom() < 450.0, "{}", link.rect());
}
