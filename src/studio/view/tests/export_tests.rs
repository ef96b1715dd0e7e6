//! Files that are written.

use super::*;

#[test]
fn files_are_replaced_only_after_a_question() {
    let (mut desk, folder) = open();
    let pdf = folder.path().join("snowman.pdf");
    std::fs::write(&pdf, "mine").unwrap();
    click(&mut desk, "Export");
    click(&mut desk, "Write files");
    assert!(desk.query_by_label("Replace files?").is_some());
    click(&mut desk, "Cancel");
    assert_eq!(std::fs::read(&pdf).unwrap(), b"mine");
    click(&mut desk, "Write files");
    click(&mut desk, "Replace");
    settle(&mut desk, "the file", |s| s.notice().is_some() || s.problem().is_some());
    assert!(std::fs::read(&pdf).unwrap().starts_with(b"%PDF"));
    assert!(desk.query_by_label("Open folder").is_some());
}

/// The folder had to be typed, and "Open folder" stood beside the message that there is none.
#[test]
fn the_folder_for_files_is_chosen_in_a_dialog() {
    let (mut desk, folder) = open();
    let sub = folder.path().join("sub");
    std::fs::create_dir(&sub).unwrap();
    click(&mut desk, "Export");
    click(&mut desk, "Choose …");
    assert!(desk.query_by_label("snowman.toml").is_some(), "in the title; the dialog lists folders alone");
    click(&mut desk, "sub/");
    click(&mut desk, "Choose this folder");
    std::fs::remove_dir(&sub).unwrap();
    click(&mut desk, "Write files");
    settle(&mut desk, "a problem", |s| s.problem().is_some());
    assert!(desk.query_by_label("Open folder").is_none());
    std::fs::create_dir(&sub).unwrap();
    click(&mut desk, "Write files");
    settle(&mut desk, "the file", |s| s.notice().is_some() || s.problem().is_some());
    assert!(sub.join("snowman.pdf").is_file() && desk.query_by_label("Open folder").is_some());
}

#[test]
fn options_are_those_of_the_formats_that_are_ticked() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Export");
    assert!(desk.query_by_role_and_label(Role::ComboBox, "Tile").is_some());
    assert!(desk.query_by_role_and_label(Role::SpinButton, "Resolution (dpi)").is_none());
    click(&mut desk, "snowman.pdf");
    click(&mut desk, "snowman.png");
    assert!(desk.query_by_role_and_label(Role::ComboBox, "Tile").is_none());
    assert!(desk.query_by_role_and_label(Role::SpinButton, "Resolution (dpi)").is_some());
}

/// Before files are written their pages are seen, in the style that they are written in.
#[test]
fn pages_are_seen_before_they_are_written() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Export");
    wait_for(&mut desk, "Page as it is written");
    let count = desk.state().studio().finished().unwrap().layout().sheet_count();
    assert!(count > 1 && desk.query_by_label(&format!("Page 1 of {count}")).is_some());
    click(&mut desk, "Next page");
    assert!(desk.query_by_label(&format!("Page 2 of {count}")).is_some());
    click(&mut desk, "snowman.pdf");
    assert!(desk.query_by_label("Page as it is written").is_none(), "nothing with pages is ticked");
}

#[test]
fn the_sheets_are_given_to_a_viewer_that_prints_them() {
    let (mut desk, _folder) = open();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::P);
    let start = Instant::now();
    let opened = |desk: &Desk| {
        desk.output().platform_output.commands.iter().find_map(|command| match command {
            egui::OutputCommand::OpenUrl(open) => Some(open.url.clone()),
            _ => None,
        })
    };
    while opened(&desk).is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "nothing is printed");
        std::thread::sleep(Duration::from_millis(5));
        desk.step();
    }
    let url = opened(&desk).unwrap();
    let path = Path::new(url.strip_prefix("file://").unwrap());
    assert!(std::fs::read(path).unwrap().starts_with(b"%PDF"), "{url}");
    std::fs::remove_dir_all(path.parent().unwrap()).unwrap();
}
