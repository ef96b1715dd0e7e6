//! Defects that were found by using the window for a day; each is mended.

use super::*;
use crate::studio::change::Change;
use tatamu::component::PanelId;
use tatamu::fold::Clash;
use tatamu::project::options::{SIZE, TOP_EDGES};

/// Writes into a field with a number, as a user does.
fn type_into(desk: &mut Desk, label: &str, text: &str) {
    desk.get_by_role_and_label(Role::SpinButton, label).click();
    desk.run_ok();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.event(Event::Text(text.to_owned()));
    desk.run_ok();
    desk.key_press(Key::Enter);
    desk.run_ok();
}

fn size_mm(desk: &Desk) -> f64 {
    desk.state().studio().document().unwrap().options().size_mm
}

#[test]
fn another_file_is_opened_only_after_a_question() {
    let (mut desk, folder) = open();
    let other = folder.path().join("other.toml");
    std::fs::copy(folder.path().join("snowman.toml"), &other).unwrap();
    desk.state_mut().studio_mut().turn(PartId(1), 15.0, 0.0);
    desk.run_ok();
    let text = desk.state().studio().document().unwrap().text().to_owned();
    desk.state_mut().open(&other);
    desk.run_ok();
    assert!(desk.query_by_label("You have unsaved changes.").is_some());
    click(&mut desk, "Cancel");
    assert_eq!(desk.state().studio().document().unwrap().text(), text);
    desk.state_mut().open(&other);
    desk.run_ok();
    click(&mut desk, "Save and open");
    settle(&mut desk, "the other file", |s| s.opened().is_some_and(|o| o.source.ends_with("other.toml")));
    assert_eq!(std::fs::read_to_string(folder.path().join("snowman.toml")).unwrap(), text);
}

#[test]
fn an_error_does_not_hide_what_succeeds_later() {
    let (mut desk, folder) = open();
    let long = folder.path().join(format!("{}.obj", "a-long-name-".repeat(16)));
    desk.state_mut().open(&long);
    settle(&mut desk, "a problem", |s| s.problem().is_some());
    let message = desk.state().studio().problem().unwrap().to_owned();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::S);
    desk.run_ok();
    let saved = desk.state().studio().notice().unwrap().to_owned();
    assert!(saved.contains("saved"));
    assert!(desk.query_by_label(&saved).is_some(), "the success is seen, too");
    // A long message is whole, and beside its button.
    let text = desk.get_by_label(&message).rect();
    let buttons: Vec<_> = desk.get_all_by_label("Dismiss").map(|button| button.rect()).collect();
    assert_eq!(buttons.len(), 2);
    assert!(buttons.iter().all(|button| text.right() <= button.left()), "{text:?} {buttons:?}");
    desk.state_mut().studio_mut().change(&Change::Set { option: &SIZE, value: Some(150.0.into()) }, None);
    desk.run_ok();
    assert!(desk.query_by_label(&saved).is_none(), "it is no more as saved");
    desk.get_all_by_label("Dismiss").next().unwrap().click();
    desk.run_ok();
    assert_eq!(desk.state().studio().problem(), None);
}

#[test]
fn a_clash_is_shown_as_long_as_it_is_there() {
    let (mut desk, _folder) = open();
    let clash = Clash {
        mover: PartId(1),
        from: 0.0,
        to: 1.0,
        parts: [PartId(0), PartId(1)],
        panels: [PanelId(0), PanelId(1)],
        folded: 0.5,
        depth_mm: 1.0,
    };
    let window = desk.state_mut();
    window.space.show_clash(&window.studio, clash);
    assert!(desk.state().space().clash().is_some());
    desk.state_mut().studio_mut().turn(PartId(1), 10.0, 0.0);
    settle(&mut desk, "the new model", |s| s.finished().is_some());
    assert_eq!(desk.state().space().clash(), None);
}

#[test]
fn what_is_typed_into_a_dialog_is_no_command() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(0));
    press(&mut desk, at, Modifiers::NONE);
    let at = on_component(&desk, PartId(2));
    press(&mut desk, at, Modifiers::SHIFT);
    desk.key_press_modifiers(Modifiers::COMMAND, Key::O);
    desk.run_ok();
    assert!(desk.query_by_label("Open a mesh or a project").is_some());
    assert!(desk.get_by_role_and_label(Role::TextInput, "File").is_focused());
    let text = desk.state().studio().document().unwrap().text().to_owned();
    // As if the field had not the focus.
    desk.key_press(Key::Tab);
    desk.key_press(Key::M);
    desk.event(Event::Text("m".to_owned()));
    desk.key_press(Key::CloseBracket);
    desk.run_ok();
    assert_eq!(desk.state().studio().document().unwrap().text(), text);
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.query_by_label("Open a mesh or a project").is_none());
    assert_eq!(desk.state().studio().selection.names().len(), 2, "Escape closed the dialog alone");
}

/// It did nothing: the field had the focus again before anyone saw that the key had taken it.
/// It selected nothing, and the menu stayed open.
#[test]
fn escape_closes_a_menu_before_it_is_a_command() {
    let (mut desk, _folder) = open();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.run_ok();
    click(&mut desk, "Edit");
    assert!(desk.query_by_label("Lay out again").is_some());
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.query_by_label("Lay out again").is_none(), "it is closed");
    assert_eq!(desk.state().studio().selection.names().len(), 3);
}

/// Keys were commands behind this question: Escape selected nothing, and M merged parts.
#[test]
fn keys_are_no_commands_while_files_are_about_to_be_replaced() {
    let (mut desk, folder) = open();
    std::fs::write(folder.path().join("snowman.pdf"), "mine").unwrap();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::A);
    desk.run_ok();
    click(&mut desk, "Export");
    click(&mut desk, "Write files");
    desk.key_press(Key::M);
    desk.run_ok();
    assert!(!desk.state().studio().document().unwrap().is_changed());
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.query_by_label("Replace files?").is_none(), "it is answered");
    assert_eq!(desk.state().studio().selection.names().len(), 3);
}

#[test]
fn the_enter_key_ends_the_dialog_for_files() {
    let (mut desk, folder) = open();
    std::fs::copy(folder.path().join("snowman.toml"), folder.path().join("other.toml")).unwrap();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::O);
    desk.run_ok();
    desk.event(Event::Text("other.toml".to_owned()));
    desk.run_ok();
    desk.key_press(Key::Enter);
    desk.run_ok();
    assert!(desk.query_by_label("Open a mesh or a project").is_none());
    settle(&mut desk, "the other file", |s| s.opened().is_some_and(|o| o.source.ends_with("other.toml")));
}

/// The field behind the dialog kept the focus.
#[test]
fn a_dialog_takes_the_focus_from_a_field_that_is_being_written() {
    let (mut desk, _folder) = open();
    desk.get_by_role_and_label(Role::SpinButton, "Size").click();
    desk.run_ok();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::O);
    desk.run_ok();
    desk.event(Event::Text("77".to_owned()));
    desk.run_ok();
    assert_eq!(desk.get_by_role_and_label(Role::TextInput, "File").value().as_deref(), Some("77"));
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert_eq!(size_mm(&desk), 200.0);
}

#[test]
fn the_hint_for_the_wheel_stands_before_the_picture() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let words = "rotates its fold direction";
    assert!(desk.query_by_label_contains(words).is_some());
    let shapes = &desk.output().shapes;
    let is_hint =
        |shape: &egui::Shape| matches!(shape, egui::Shape::Text(text) if text.galley.text().contains(words));
    let hint = shapes.iter().position(|shape| is_hint(&shape.shape)).expect("it is painted");
    let is_picture = |shape: &egui::Shape| {
        shape.texture_id() != egui::TextureId::default() && shape.visual_bounding_rect().contains(at)
    };
    let picture = shapes.iter().position(|shape| is_picture(&shape.shape)).expect("the model is painted");
    assert!(hint > picture, "{hint} {picture}");
}

/// Where the pieces lie, by name.
pub(super) fn places(desk: &Desk) -> BTreeMap<String, (SheetId, glam::DVec2)> {
    let output = desk.state().studio().shown().output().unwrap();
    let all = output.model().ids().zip(output.nets());
    all.flat_map(|(net, own)| {
        own.pieces().iter().zip(output.layout().places(net)).map(|(piece, at)| {
            let pin = tatamu::sheet::Pin::of_place(piece.outline(), at);
            (piece.name().to_owned(), (at.sheet, pin.at_mm))
        })
    })
    .collect()
}

/// A page of the sheets, and a way from a point of it to the screen.
pub(super) fn on_page(desk: &Desk, sheet: SheetId, at: glam::DVec2) -> Pos2 {
    let page = desk.get_by_label(&format!("Sheet {}", sheet.number())).rect();
    let size = desk.state().studio().shown().output().unwrap().layout().options().size_mm();
    let scale = page.width() / size.x as f32;
    egui::pos2(page.left() + scale * at.x as f32, page.bottom() - scale * at.y as f32)
}

/// A point in the middle of each piece of a sheet that is in the piece, too.
pub(super) fn grips(desk: &Desk, sheet: SheetId) -> Vec<(String, glam::DVec2)> {
    let output = desk.state().studio().shown().output().unwrap();
    let outlines = crate::studio::pages::outlines(output, sheet);
    let grip = |(id, outline): &(crate::studio::pages::PieceId, Vec<glam::DVec2>)| {
        let (low, high) = tatamu::geom::polygon::bounds(outline.iter().copied()).unwrap();
        let tried =
            (1..40).flat_map(|x| (1..40).map(move |y| glam::DVec2::new(f64::from(x), f64::from(y)) / 40.0));
        let inside = tried.map(|share| low + share * (high - low)).find(|&at| {
            tatamu::geom::polygon::distance_to_edges(outline, at) > 2.0
                && crate::studio::pages::piece_at(&outlines, at) == Some(*id)
        });
        let name = crate::studio::pages::piece(output, *id).unwrap().name().to_owned();
        inside.map(|at| (name, at))
    };
    outlines.iter().filter_map(grip).collect()
}

pub(super) fn drag(desk: &mut Desk, from: Pos2, to: Pos2) {
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    desk.event(Event::PointerMoved(from));
    desk.run_steps(1);
    desk.event(button(from, true));
    desk.run_steps(1);
    for share in [0.3, 0.6, 1.0] {
        desk.event(Event::PointerMoved(from + share * (to - from)));
        desk.run_steps(1);
    }
    desk.event(button(to, false));
    desk.run_steps(3);
}

#[test]
fn a_piece_that_is_dragged_moves_alone() {
    let (mut desk, _folder) = open_sheets();
    let before = places(&desk);
    let (name, grip) = grips(&desk, SheetId(0))[0].clone();
    // To a sheet of its own, beside the pages.
    let beside = desk.get_by_label("Sheet 1").rect().left_top() - egui::vec2(6.0, -40.0);
    let from = on_page(&desk, SheetId(0), grip);
    drag(&mut desk, from, beside);
    settle(&mut desk, "the layout", |s| s.finished().is_some());
    let after = places(&desk);
    let last = before.values().map(|place| place.0).max().unwrap();
    assert_eq!(
        after[&name].0,
        SheetId(last.0 + 1),
        "it has a sheet of its own: {:?}",
        desk.state().studio().problem()
    );
    for (other, place) in before.iter().filter(|(other, _)| **other != name) {
        assert_eq!(after[other].0, place.0, "{other}");
        assert!(after[other].1.distance(place.1) < 0.01, "{other}: {place:?} {:?}", after[other]);
    }
    assert!(desk.state().studio().finished().unwrap().layout().pin_warnings().is_empty());
    desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    desk.run_ok();
    settle(&mut desk, "the layout of before", |s| s.finished().is_some());
    assert_eq!(places(&desk), before);
}

#[test]
fn a_piece_is_not_laid_on_another() {
    let (mut desk, _folder) = open_sheets();
    let all = grips(&desk, SheetId(0));
    assert!(all.len() > 1, "two pieces are on the first sheet");
    let before = places(&desk);
    let (from, to) = (on_page(&desk, SheetId(0), all[0].1), on_page(&desk, SheetId(0), all[1].1));
    drag(&mut desk, from, to);
    assert!(desk.state().studio().problem().is_some_and(|problem| problem.contains("overlap")));
    assert_eq!(places(&desk), before);
    assert!(!desk.state().studio().document().unwrap().is_changed());
}

#[test]
fn all_pieces_are_laid_out_again_on_demand() {
    let (mut desk, _folder) = open_sheets();
    let (_, grip) = grips(&desk, SheetId(0))[0].clone();
    let at = on_page(&desk, SheetId(0), grip);
    press(&mut desk, at, Modifiers::NONE);
    click(&mut desk, "Put aside");
    settle(&mut desk, "the layout", |s| s.finished().is_some());
    assert!(!desk.state().studio().document().unwrap().project().pins.is_empty());
    click(&mut desk, "Lay out again");
    settle(&mut desk, "the layout", |s| s.finished().is_some());
    assert!(desk.state().studio().document().unwrap().project().pins.is_empty());
}

#[test]
fn sheets_are_magnified_at_the_pointer_and_moved() {
    let (mut desk, _folder) = open_sheets();
    let mark = glam::DVec2::new(60.0, 200.0);
    let at = on_page(&desk, SheetId(0), mark);
    let before = desk.get_by_label("Sheet 1").rect();
    wheel(&mut desk, at, 3.0);
    let after = desk.get_by_label("Sheet 1").rect();
    assert!(after.width() > 1.2 * before.width());
    assert!(on_page(&desk, SheetId(0), mark).distance(at) < 0.5, "what is under the pointer stays there");
    let middle = |pressed| Event::PointerButton {
        pos: at,
        button: egui::PointerButton::Middle,
        pressed,
        modifiers: Modifiers::NONE,
    };
    desk.event(middle(true));
    desk.run_steps(1);
    desk.event(Event::PointerMoved(at + egui::vec2(30.0, 20.0)));
    desk.run_steps(2);
    desk.event(middle(false));
    desk.run_ok();
    let moved = desk.get_by_label("Sheet 1").rect();
    assert!((moved.min - after.min - egui::vec2(30.0, 20.0)).length() < 0.5, "{after:?} {moved:?}");
}

#[test]
fn lengths_are_written_with_their_units_and_refused_in_words() {
    let (mut desk, _folder) = open();
    for (text, mm) in [("30cm", 300.0), ("8in", 203.2), ("150", 150.0), ("180 mm", 180.0)] {
        type_into(&mut desk, "Size", text);
        assert_eq!(size_mm(&desk), mm, "{text}");
        assert_eq!(desk.state().studio().problem(), None, "{text}");
    }
    for text in ["0", "abc", "-5", "1e9"] {
        type_into(&mut desk, "Size", text);
        assert_eq!(size_mm(&desk), 180.0, "{text}");
        assert!(desk.state().studio().problem().is_some(), "{text} is refused in words");
    }
    type_into(&mut desk, "Parts", "100000");
    assert_eq!(desk.state().studio().document().unwrap().options().segmentation.parts, Some(3));
    assert!(desk.state().studio().problem().is_some());
}

#[test]
fn presses_that_are_far_apart_are_undone_one_by_one() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let before = desk.state().studio().direction_deg(PartId(1));
    desk.key_press(Key::CloseBracket);
    desk.run_ok();
    let once = desk.state().studio().direction_deg(PartId(1));
    desk.run_steps(200);
    desk.key_press(Key::CloseBracket);
    desk.run_ok();
    desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    desk.run_ok();
    assert_eq!(desk.state().studio().direction_deg(PartId(1)), once);
    desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    desk.run_ok();
    settle(&mut desk, "the direction of before", |s| s.direction_deg(PartId(1)) == before);
    assert!(!desk.state().studio().document().unwrap().is_changed());
}

#[test]
fn the_wheel_goes_on_turning_a_component_that_unfolds_under_it() {
    let (mut desk, _folder) = open();
    let name = desk.state().studio().shown().names()[1].clone();
    desk.state_mut().studio_mut().selection.select(&name, None, false);
    desk.state_mut().space.fold_to(1.0);
    desk.run_ok();
    let at = on_component(&desk, PartId(1));
    let before = desk.state().studio().direction_deg(PartId(1)).unwrap();
    let zoom = desk.state().space().orbit().unwrap().zoom;
    for _ in 0..4 {
        wheel(&mut desk, at, 1.0);
        desk.run_steps(40);
    }
    let turned = desk.state().studio().direction_deg(PartId(1)).unwrap();
    assert!(((turned - before).rem_euclid(360.0) - 20.0).abs() < 0.2, "{before} {turned}");
    assert_eq!(desk.state().space().orbit().unwrap().zoom, zoom);
}

#[test]
fn the_view_follows_a_change_of_size() {
    let (mut desk, _folder) = open();
    let seen = |desk: &Desk| {
        let [width, height] = desk.state().space().size_px().unwrap();
        let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        all.filter(|&(x, y)| desk.state().space().tag_at(x, y).is_some()).count() as f64
    };
    let before = seen(&desk);
    desk.state_mut().studio_mut().change(&Change::Set { option: &SIZE, value: Some(400.0.into()) }, None);
    settle(&mut desk, "the larger model", |s| s.finished().is_some());
    let after = seen(&desk);
    assert!((after / before - 1.0).abs() < 0.1, "{before} {after}");
}

#[test]
fn colours_stay_with_their_owners_after_a_merge() {
    let (mut desk, _folder) = open();
    let names = desk.state().studio().shown().names().to_vec();
    let colours: Vec<_> = (0..3).map(|k| desk.state().studio().shown().colour(PartId(k))).collect();
    let studio = desk.state_mut().studio_mut();
    studio.selection.select(&names[0], None, false);
    studio.selection.select(&names[1], None, true);
    studio.merge_selected();
    settle(&mut desk, "two components", |s| s.shown().names().len() == 2);
    let last = desk.state().studio().index_of(&names[2]).unwrap();
    assert_eq!(desk.state().studio().shown().colour(last), colours[2]);
}

#[test]
fn theme_cutter_and_layout_are_remembered() {
    let (mut desk, folder) = open();
    desk.ctx.set_theme(egui::ThemePreference::Dark);
    desk.state_mut().plot_mut().choose("generic-hpgl", "/dev/ttyUSB7");
    desk.key_press(Key::B);
    desk.run_ok();
    drop(desk);
    let mut again = window(folder.path());
    again.run_ok();
    assert_eq!(again.ctx.options(|options| options.theme_preference), egui::ThemePreference::Dark);
    let choice = again.state_mut().plot_mut().choice().map(str::to_owned);
    assert_eq!((choice[0].as_str(), choice[2].as_str()), ("generic-hpgl", "/dev/ttyUSB7"));
    assert!(!again.state().has_sheets_beside);
}

#[test]
fn a_change_that_is_refused_says_so_until_the_next() {
    let (mut desk, _folder) = open();
    let wrong = Change::Set { option: &SIZE, value: Some((-1.0).into()) };
    desk.state_mut().studio_mut().change(&wrong, None);
    assert!(desk.state().studio().problem().is_some());
    let right = Change::Set { option: &TOP_EDGES, value: Some(5.into()) };
    desk.state_mut().studio_mut().change(&right, None);
    assert_eq!(desk.state().studio().problem(), None);
}
