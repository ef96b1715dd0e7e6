//! Further defects that were found by using the window: recovery, clashes, pieces and what is remembered.

use super::defects::{drag, grips, on_page, places};
use super::*;
use egui_kittest::kittest::NodeT;

/// A drawn head with two ears so near to each other that they clash in any order.
pub const EARS: &str = "[[component]]\nname = \"head\"\ntop = [[-80, -35], [80, -35], [80, 35], [-80, 35]]\n\
                    profiles = [[[0, 40], [0, 0]]]\n";

pub fn ear(name: &str, at_mm: f64) -> String {
    format!(
        "[[component]]\nname = \"{name}\"\ntop = [[-10, -22], [10, -22], [10, 22], [-10, 22]]\n\
         profiles = [[[0, 30], [0, 0]]]\n[component.joint]\nto = \"head\"\npanel = \"top\"\nat = [{at_mm}, 0]\n"
    )
}

fn turn_by_wheel(desk: &mut Desk) {
    let at = on_component(desk, PartId(1));
    press(desk, at, Modifiers::NONE);
    let at = on_component(desk, PartId(1));
    wheel(desk, at, 1.0);
    desk.run_ok();
}

/// Changes after a mesh was saved as a project were lost when the window was killed, and the message that
/// they are back stayed when they were no more what Undo takes back.
#[test]
fn what_a_killed_window_had_is_back_and_the_message_goes_with_the_next_change() {
    let (mut desk, folder) = open();
    desk.state_mut().open(&folder.path().join("snowman.obj"));
    settle(&mut desk, "the mesh", |s| s.finished().is_some() && !s.opened().unwrap().is_project);
    desk.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    desk.run_ok();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.event(Event::Text("mine.toml".to_owned()));
    desk.run_ok();
    desk.key_press(Key::Enter);
    desk.run_ok();
    assert!(desk.query_by_label("mine.toml").is_some(), "it is saved");
    turn_by_wheel(&mut desk);
    assert!(desk.query_by_label("mine.toml *").is_some());
    let text = desk.state().studio().document().unwrap().text().to_owned();
    drop(desk);
    let mut again = window(folder.path());
    again.run_ok();
    again.state_mut().open(&folder.path().join("mine.toml"));
    settle(&mut again, "the project", |s| s.finished().is_some());
    assert_eq!(again.state().studio().document().unwrap().text(), text);
    assert!(again.query_by_label_contains("recovered unsaved changes").is_some());
    turn_by_wheel(&mut again);
    assert!(again.query_by_label_contains("recovered unsaved changes").is_none());
    // Undo takes back the turn, then what was recovered.
    for _ in 0..2 {
        again.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        again.run_ok();
    }
    assert!(again.query_by_label("mine.toml").is_some());
}

/// Changes were dropped before the other file was read: when it could not be read, they stayed on the screen, but a
/// killed window lost them.
#[test]
fn changes_are_dropped_only_once_another_file_is_read() {
    let (mut desk, folder) = open();
    turn_by_wheel(&mut desk);
    let [project, nonsense] = ["snowman.toml", "nonsense.obj"].map(|name| folder.path().join(name));
    std::fs::write(&nonsense, "hello").unwrap();
    let store = Store::at(&folder.path().join("state"));
    desk.state_mut().open(&nonsense);
    desk.run_ok();
    click(&mut desk, "Open without saving");
    settle(&mut desk, "a problem", |s| s.problem().is_some());
    assert!(desk.query_by_label("snowman.toml *").is_some());
    assert!(store.recovered(&project).is_some(), "they are still kept");
    desk.state_mut().open(&folder.path().join("snowman.obj"));
    desk.run_ok();
    click(&mut desk, "Open without saving");
    settle(&mut desk, "the mesh", |s| s.opened().is_some_and(|opened| !opened.is_project));
    assert_eq!(store.recovered(&project), None);
}

/// After a crash nothing said which file had changes to recover.
#[test]
fn the_start_page_names_files_with_unsaved_changes() {
    let (mut desk, folder) = open();
    turn_by_wheel(&mut desk);
    drop(desk);
    let mut again = window(folder.path());
    again.run_ok();
    click(&mut again, "snowman.toml (unsaved changes)");
    settle(&mut again, "the project", |s| s.document().is_some_and(|d| d.is_changed()));
}

/// The window said that pieces are arranged though the work was stopped, and only a change began it again.
#[test]
fn work_that_was_stopped_is_begun_again_by_a_button() {
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let mut desk = window(folder.path());
    desk.state_mut().open(&project);
    wait(desk.state_mut().studio_mut(), "the project", |s| s.document().is_some());
    desk.state_mut().studio_mut().cancel();
    desk.run_ok();
    assert!(desk.query_by_label("no sheets yet").is_some());
    click(&mut desk, "Start again");
    settle(&mut desk, "the model", |s| s.finished().is_some());
    assert!(desk.query_by_label("Start again").is_none());
}

/// The text named another part, in words of the command line.
#[test]
fn a_clash_names_the_components_that_it_shows() {
    let (mut desk, folder) = open();
    let project = folder.path().join("ears.toml");
    std::fs::write(&project, [EARS, &ear("left", -14.0), &ear("right", 14.0)].concat()).unwrap();
    desk.state_mut().open(&project);
    settle(&mut desk, "the ears", |s| s.finished().is_some() && s.shown().names()[0] == "head");
    desk.get_by_label_contains("1 warning").click();
    desk.run_ok();
    let told = "left's right panel and right's left panel clash by 6.0 mm when left is three quarters folded; \
                bend one of them aside by hand there, or leave out the part right";
    assert!(desk.query_by_label(told).is_some());
    desk.get_by_role_and_label(Role::Button, "Show clash").click();
    desk.run_ok();
    let clash = desk.state().space().clash().expect("it is shown");
    let names = desk.state().studio().shown().names().to_vec();
    assert_eq!(clash.parts.map(|part| names[part.0].as_str()), ["left", "right"]);
    assert_eq!(desk.state().studio().selection.names(), ["left", "right"]);
    let folded = desk.state().space().folded();
    assert!(folded > 0.0 && folded < 1.0, "the moment of it: {folded}");
}

fn is_red(desk: &Desk) -> bool {
    let red = super::super::look::OVERLAP;
    let is_red =
        |shape: &egui::Shape| matches!(shape, egui::Shape::LineSegment { stroke, .. } if stroke.color == red);
    desk.output().shapes.iter().any(|shape| is_red(&shape.shape))
}

#[test]
fn pieces_that_would_overlap_are_red_while_one_is_dragged() {
    let (mut desk, _folder) = open_sheets();
    let all = grips(&desk, SheetId(0));
    let (from, to) = (on_page(&desk, SheetId(0), all[0].1), on_page(&desk, SheetId(0), all[1].1));
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    assert!(!is_red(&desk));
    desk.event(Event::PointerMoved(from));
    desk.run_steps(1);
    desk.event(button(from, true));
    desk.run_steps(1);
    for share in [0.5, 1.0] {
        desk.event(Event::PointerMoved(from + share * (to - from)));
        desk.run_steps(2);
    }
    assert!(is_red(&desk), "one lies on the other");
    desk.event(button(to, false));
    desk.run_steps(3);
    assert!(!is_red(&desk), "it is back");
}

#[test]
fn a_piece_is_put_aside_and_rotated_there_alone() {
    let (mut desk, _folder) = open_sheets();
    let before = places(&desk);
    let (name, grip) = grips(&desk, SheetId(0))[0].clone();
    let at = on_page(&desk, SheetId(0), grip);
    press(&mut desk, at, Modifiers::NONE);
    click(&mut desk, "Put aside");
    wait_for_pages(&mut desk);
    let aside = places(&desk);
    assert!(aside[&name].0 > before.values().map(|place| place.0).max().unwrap());
    click_when_there(&mut desk, "Rotate piece left");
    wait_for_pages(&mut desk);
    let turned = places(&desk);
    assert_eq!(turned[&name].0, aside[&name].0);
    assert!(turned[&name].1.distance(aside[&name].1) > 0.01, "it is rotated");
    for (other, place) in before.iter().filter(|(other, _)| **other != name) {
        assert_eq!(turned[other].0, place.0, "{other}");
        assert!(turned[other].1.distance(place.1) < 0.01, "{other}");
    }
    // Back onto a sheet with others, where there is room, or not at all.
    let from = on_page(&desk, turned[&name].0, grips(&desk, turned[&name].0)[0].1);
    let to = on_page(&desk, SheetId(0), grips(&desk, SheetId(0))[0].1);
    drag(&mut desk, from, to);
    let problem = desk.state().studio().problem();
    assert!(problem.is_some_and(|problem| problem.contains("overlap")), "{problem:?}");
    assert_eq!(places(&desk), turned);
}

#[test]
fn two_fingers_move_the_sheets() {
    let (mut desk, _folder) = open_sheets();
    let at = on_page(&desk, SheetId(0), glam::DVec2::new(60.0, 200.0));
    wheel(&mut desk, at, 3.0);
    let before = desk.get_by_label("Sheet 1").rect();
    desk.run_steps(100);
    desk.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: egui::vec2(20.0, 30.0),
        phase: TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    desk.run_ok();
    let after = desk.get_by_label("Sheet 1").rect();
    assert_eq!(after.size(), before.size(), "nothing is magnified");
    assert!((after.min - before.min - egui::vec2(20.0, 30.0)).length() < 0.5, "{before:?} {after:?}");
}

/// Where the toolkit tells a click twice, as the wheel's button goes down and up.
#[test]
fn a_click_of_an_old_wheel_turns_once() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let before = desk.state().studio().direction_deg(PartId(1)).unwrap();
    let at = on_component(&desk, PartId(1));
    desk.event(Event::PointerMoved(at));
    desk.run_steps(1);
    for _ in 0..2 {
        desk.event(Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: egui::vec2(0.0, 1.0),
            phase: TouchPhase::Move,
            source: egui::MouseWheelSource::Unknown,
            modifiers: Modifiers::NONE,
        });
        desk.run_steps(1);
    }
    let turned = desk.state().studio().direction_deg(PartId(1)).unwrap();
    assert!(((turned - before).rem_euclid(360.0) - 5.0).abs() < 0.2, "{before} {turned}");
}

#[test]
fn the_size_of_the_window_is_remembered() {
    let (desk, folder) = open();
    let store = Store::at(&folder.path().join("state"));
    assert_eq!(store.preferences().window, None, "the tests have no window");
    drop(desk);
    let mut desk = window(folder.path());
    let viewport = egui::ViewportInfo {
        inner_rect: Some(egui::Rect::from_min_size(Pos2::ZERO, egui::vec2(1010.0, 690.0))),
        ..Default::default()
    };
    desk.input_mut().viewports.insert(egui::ViewportId::ROOT, viewport);
    desk.run_ok();
    assert_eq!(store.preferences().window, Some([1010.0, 690.0]));
}

fn right_click(desk: &mut Desk, at: Pos2) {
    desk.event(Event::PointerMoved(at));
    desk.run_ok();
    for pressed in [true, false] {
        let button = egui::PointerButton::Secondary;
        desk.event(Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE });
        desk.run_steps(1);
    }
    desk.run_ok();
}

#[test]
fn a_right_click_opens_a_menu_for_what_is_under_the_mouse() {
    let (mut desk, _folder) = open_sheets();
    let at = on_page(&desk, SheetId(0), grips(&desk, SheetId(0))[0].1);
    right_click(&mut desk, at);
    let piece = desk.state().studio().selection.piece().expect("it is selected").to_owned();
    assert_eq!(piece, grips(&desk, SheetId(0))[0].0);
    let sheet = places(&desk)[&piece].0;
    desk.get_all_by_role_and_label(Role::Button, "Put aside").last().expect("in the menu").click();
    desk.run_ok();
    settle(&mut desk, "the layout", |s| s.finished().is_some());
    assert!(places(&desk)[&piece].0 > sheet);
    desk.key_press(Key::Escape);
    desk.run_ok();
    // In space.
    click(&mut desk, "Model");
    wait_for(&mut desk, "Model in space");
    desk.run_ok();
    let at = on_component(&desk, PartId(1));
    right_click(&mut desk, at);
    let name = desk.state().studio().shown().names()[1].clone();
    assert_eq!(desk.state().studio().selection.names(), std::slice::from_ref(&name));
    click(&mut desk, "Hide selected components");
    assert!(desk.state().studio().visibility.is_hidden(&name));
    assert!(desk.query_by_label("Hide selected components").is_none(), "the menu is closed");
    // In the list of components.
    let at = desk.get_by_role_and_label(Role::Button, &name).rect().center();
    right_click(&mut desk, at);
    click(&mut desk, "Show all components");
    assert!(!desk.state().studio().visibility.is_hidden(&name));
}

/// Ctrl+S replaced what another program had written into the project file without a word.
#[test]
fn a_project_that_another_program_changed_is_overwritten_only_after_a_question() {
    let (mut desk, folder) = open();
    let project = folder.path().join("snowman.toml");
    let read = || std::fs::read_to_string(&project).unwrap();
    let asks =
        |desk: &Desk| desk.query_by_label("snowman.toml changed on disk since you opened it").is_some();
    let save = |desk: &mut Desk| {
        desk.key_press_modifiers(Modifiers::COMMAND, Key::S);
        desk.run_ok();
    };
    turn_by_wheel(&mut desk);
    save(&mut desk);
    turn_by_wheel(&mut desk);
    save(&mut desk);
    assert!(!asks(&desk), "what the window wrote itself is known");
    let change = |text: &str| std::fs::write(&project, format!("{}# {text}\n", read())).unwrap();
    change("first");
    turn_by_wheel(&mut desk);
    save(&mut desk);
    assert!(asks(&desk));
    click(&mut desk, "Cancel");
    assert!(read().ends_with("# first\n") && desk.query_by_label("snowman.toml *").is_some());
    save(&mut desk);
    click(&mut desk, "Overwrite");
    assert!(!read().contains("# first") && desk.query_by_label("snowman.toml").is_some());
    change("second");
    turn_by_wheel(&mut desk);
    save(&mut desk);
    click(&mut desk, "Reload");
    settle(&mut desk, "what is on disk", |s| s.document().is_some_and(|d| d.text().ends_with("# second\n")));
    assert!(desk.query_by_label("snowman.toml").is_some());
    // It asks before it leaves, too, and leaves then.
    change("third");
    settle(&mut desk, "the model", |s| s.finished().is_some());
    turn_by_wheel(&mut desk);
    desk.state_mut().open(&folder.path().join("snowman.obj"));
    desk.run_ok();
    click(&mut desk, "Save and open");
    assert!(asks(&desk));
    click(&mut desk, "Overwrite");
    settle(&mut desk, "the mesh", |s| s.opened().is_some_and(|opened| !opened.is_project));
    assert!(!read().contains("# third"));
}

/// "a and b and c" was said.
#[test]
fn the_tip_of_merge_lists_many_components_with_one_and() {
    let (mut desk, _folder) = open();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.run_ok();
    let names = desk.state().studio().shown().names().to_vec();
    desk.get_by_role_and_label(Role::Button, "Merge").hover();
    desk.run_steps(100);
    let tip = format!("makes one part of {}, {} and {} (M)", names[0], names[1], names[2]);
    assert!(desk.query_by_label(&tip).is_some(), "{tip}");
}

/// Whether a line of the menu "View" has a tick, for screen readers too.
fn is_ticked(desk: &mut Desk, label: &str) -> bool {
    click(desk, "View");
    let tick = format!("{}  {label}", char::from(lucide_icons::Icon::Check));
    let has_tick = desk.output().shapes.iter().any(|shape| match &shape.shape {
        egui::Shape::Text(text) => text.galley.text() == tick,
        _ => false,
    });
    for line in desk.get_all_by_role_and_label(Role::Button, label) {
        let is_on = line.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True);
        assert_eq!(is_on, has_tick, "{label}");
    }
    desk.key_press(Key::Escape);
    desk.run_ok();
    has_tick
}

/// Nothing in the menu said what is on.
#[test]
fn the_menu_of_the_view_ticks_what_is_on() {
    let (mut desk, _folder) = open();
    for (label, key) in [
        ("Ghost of the mesh", Key::G),
        ("Names of the components", Key::N),
        ("Sheets beside the model", Key::B),
        ("Measure", Key::D),
    ] {
        let before = is_ticked(&mut desk, label);
        desk.key_press(key);
        desk.run_ok();
        assert_eq!(is_ticked(&mut desk, label), !before, "{label}");
    }
    assert!(is_ticked(&mut desk, "Model") && !is_ticked(&mut desk, "Plot") && !is_ticked(&mut desk, "Fit"));
}

/// The middle of a piece on its page, mm.
fn middle(desk: &Desk, name: &str) -> glam::DVec2 {
    let output = desk.state().studio().shown().output().unwrap();
    let outlines =
        output.layout().sheet_ids().flat_map(|sheet| crate::studio::pages::outlines(output, sheet));
    let is_own = |id| crate::studio::pages::piece(output, id).unwrap().name() == name;
    let (_, outline) = outlines.into_iter().find(|(id, _)| is_own(*id)).expect("it is on a sheet");
    let (low, high) = tatamu::geom::polygon::bounds(outline).unwrap();
    low.midpoint(high)
}

/// Pieces were rotated and put aside by keys, but moved by the mouse alone.
#[test]
fn arrow_keys_move_the_selected_piece_in_one_step_of_undo() {
    let (mut desk, _folder) = open_sheets();
    desk.key_press(Key::P);
    desk.run_ok();
    let name = desk.state().studio().selection.piece().unwrap().to_owned();
    // Alone on its sheet nothing is in its way.
    click(&mut desk, "Put aside");
    wait_for_pages(&mut desk);
    let (text, before) = (desk.state().studio().document().unwrap().text().to_owned(), middle(&desk, &name));
    let corner = places(&desk)[&name].1;
    let height = desk.state().studio().shown().output().unwrap().layout().options().size_mm().y;
    let (key, up_mm) = if before.y < height / 2.0 { (Key::ArrowUp, 10.0) } else { (Key::ArrowDown, -10.0) };
    for _ in 0..3 {
        desk.key_press(Key::ArrowRight);
        desk.run_steps(2);
    }
    desk.key_press_modifiers(Modifiers::SHIFT, key);
    desk.run_steps(2);
    wait_for_pages(&mut desk);
    let moved = middle(&desk, &name) - before;
    assert!(
        moved.distance(glam::DVec2::new(3.0, up_mm)) < 0.6,
        "cells of the layout are 0.8 mm wide: {moved}"
    );
    let pin = desk.state().studio().document().unwrap().project().pins[0].clone();
    assert_eq!(pin.piece(), name);
    let by = (pin.pin().at_mm - corner).abs();
    assert!(by.distance(glam::DVec2::new(3.0, 10.0)) < 1e-3, "{by}");
    desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    desk.run_ok();
    assert_eq!(desk.state().studio().document().unwrap().text(), text, "one step");
    // Without a piece they rotate the view.
    desk.state_mut().studio_mut().selection.clear();
    desk.key_press(Key::ArrowRight);
    desk.run_ok();
    assert_eq!(desk.state().studio().document().unwrap().text(), text);
}
