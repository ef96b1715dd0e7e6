//! Advice, tips and the tour: what is said, and buttons that do it.

use super::more_defects::{EARS, ear};
use super::*;
use crate::studio::change::Change;
use tatamu::project::options::{MIN_PANEL_WIDTH, SHEETS_MAX, SIDE, SPLIT, TAB_WIDTH};

/// Opens the snowman with a project that has these keys and tables, too.
fn open_with([top, tables]: [&str; 2], is_there: impl Fn(&Studio) -> bool) -> (Desk, TempDir) {
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let own = std::fs::read_to_string(&project).unwrap();
    std::fs::write(&project, format!("{top}\n{own}{tables}")).unwrap();
    let mut desk = window(folder.path());
    desk.state_mut().open(&project);
    settle(&mut desk, "the project", is_there);
    (desk, folder)
}

/// Warnings had buttons for what is advised, errors had not.
#[test]
fn an_error_has_a_button_for_each_change_that_it_advises() {
    let (mut desk, _folder) = open_with(["size = 900", "[nets]\nsplit = false\n"], |s| s.problem().is_some());
    let told = desk.state().studio().problem().unwrap().to_owned();
    assert!(told.ends_with("or choose \u{201c}Split large panels\u{201d}"), "{told}");
    assert!(desk.query_by_label("Paper a3").is_some());
    assert!(desk.query_by_label_contains("Size ").is_some());
    click(&mut desk, &SPLIT.label());
    assert_eq!(desk.state().studio().problem(), None);
    settle(&mut desk, "the model", |s| s.finished().is_some());
    desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    desk.run_ok();
    settle(&mut desk, "the error again", |s| s.problem().is_some());
}

/// The size was searched for in vain, and nothing led to more sheets.
#[test]
fn where_no_size_fits_a_button_allows_another_sheet() {
    let (mut desk, _folder) = open_with(["size = 100\nsheets_max = 1", ""], |s| s.finished().is_some());
    let problem = crate::app::error::AppError::ManySheets { most: 1 };
    desk.state_mut().studio_mut().messages_mut().warn(super::super::Cause::Change, problem);
    desk.run_ok();
    click(&mut desk, "Sheets max 2");
    let document = desk.state().studio().document().unwrap();
    assert_eq!(document.settings().most_sheets, Some(2));
    assert_eq!(document.undo_label(), Some("sheets max"));
    assert_eq!(desk.state().studio().problem(), None);
}

/// It said "Undo: min panel width mm".
#[test]
fn undo_names_a_setting_as_its_row_does() {
    let (mut desk, _folder) = open();
    let value = Some(4.0.into());
    desk.state_mut().studio_mut().change(&Change::Set { option: &MIN_PANEL_WIDTH, value }, None);
    click(&mut desk, "Edit");
    assert!(desk.query_by_label("Undo: least panel width").is_some());
}

/// It was "--tab-width is 150 mm".
#[test]
fn a_width_beyond_the_sheet_is_refused_with_the_name_of_its_setting() {
    let (mut desk, _folder) = open();
    let value = Some(150.0.into());
    desk.state_mut().studio_mut().change(&Change::Set { option: &TAB_WIDTH, value }, None);
    desk.run_ok();
    let told = desk.state().studio().problem().unwrap();
    assert!(told.starts_with("\u{201c}Tab width\u{201d} is 150 mm"), "{told}");
}

/// The tip said "the colours of --color", and that of the sheets what the command line does.
#[test]
fn tips_name_settings() {
    let (mut desk, _folder) = open();
    for section in ["Whole model", "Components", "Paper and pieces"] {
        click(&mut desk, section);
    }
    for (option, words) in [(&SIDE, "if they are printed"), (&SHEETS_MAX, "a button makes it smaller")] {
        if *option == SHEETS_MAX {
            click(&mut desk, "Paper and pieces");
            click(&mut desk, "More settings");
        }
        desk.get_by_role_and_label(Role::Label, &option.label()).hover();
        desk.run_steps(100);
        assert!(desk.query_by_label_contains(words).is_some(), "{}", option.name());
        assert!(desk.query_by_label_contains("--").is_none(), "{}", option.name());
    }
}

/// It stayed over the list of files, with a frame where the model had been.
#[test]
fn the_tour_waits_while_something_else_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let mut desk = desk_with(Store::at(&folder.path().join("state")));
    desk.state_mut().open(&project);
    settle(&mut desk, "a model", |s| s.finished().is_some());
    assert!(desk.query_by_label("1 of 5").is_some());
    click(&mut desk, "Export");
    assert!(desk.query_by_label("1 of 5").is_none());
    click(&mut desk, "Model");
    click(&mut desk, "Skip the tour");
    // From the menu it begins beside the model.
    click(&mut desk, "Plot");
    click(&mut desk, "Help");
    click(&mut desk, "Tour");
    assert!(desk.state().mode == Mode::Model && desk.query_by_label("1 of 5").is_some());
    // Escape closes a menu, and then ends the tour.
    click(&mut desk, "View");
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.query_by_label("1 of 5").is_some());
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.query_by_label("1 of 5").is_none());
}

/// It was still there behind the list.
#[test]
fn a_menu_is_closed_by_the_key_of_a_command() {
    let (mut desk, _folder) = open();
    click(&mut desk, "View");
    let theme = |desk: &Desk| desk.query_by_role_and_label(Role::RadioButton, "Dark").is_some();
    assert!(theme(&desk));
    desk.key_press(Key::F1);
    desk.run_ok();
    assert!(desk.query_by_label("Shortcuts").is_some());
    assert!(!theme(&desk));
}

/// A single warning had an empty panel of 130 points.
#[test]
fn the_list_of_warnings_is_as_high_as_it_needs() {
    let (mut desk, folder) = open();
    let project = folder.path().join("ears.toml");
    std::fs::write(&project, [EARS, &ear("left", -14.0), &ear("right", 14.0)].concat()).unwrap();
    desk.state_mut().open(&project);
    settle(&mut desk, "the ears", |s| s.finished().is_some() && s.shown().names()[0] == "head");
    let count = desk.state().studio().notes().len();
    let before = desk.get_by_label("Model in space").rect().height();
    desk.get_by_label_contains(" warning").click();
    desk.run_ok();
    let lost = before - desk.get_by_label("Model in space").rect().height();
    assert!(lost > 20.0 && lost < 60.0 * count as f32, "{count} warnings take {lost}");
}
