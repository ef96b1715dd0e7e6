//! Where the window has room for what it shows.

use super::*;

/// In a window made narrow the model was 40 points wide, and the formats had one letter a line.
#[test]
fn a_narrow_window_has_room_for_the_model_and_for_the_files() {
    let (mut desk, _folder) = open();
    wait_for_pages(&mut desk);
    desk.set_size(egui::vec2(800.0, 500.0));
    desk.run_ok();
    let model = desk.get_by_label("Model in space").rect();
    assert!(model.width() > 250.0 && model.right() < desk.get_by_label("Sheet 1").rect().left(), "{model}");
    let told = desk.get_by_label_contains("sheets of A4").rect();
    let edges = desk.get_by_role_and_label(Role::Button, "Cut and glue edges").rect();
    assert!(told.right() <= edges.left(), "{told} is under {edges}");
    let [fold, slider, show, measure] =
        [(Role::Button, "Fold"), (Role::Slider, "folded"), (Role::Button, "Show"), (Role::Button, "Measure")]
            .map(|(role, name)| desk.get_by_role_and_label(role, name).rect());
    for (one, other) in [(fold, show), (fold, slider), (slider, measure), (show, measure)] {
        assert!(!one.intersects(other), "{one} is under {other}");
    }
    click(&mut desk, "Export");
    let told = desk.get_by_label("PDF at exactly 1:1, one page per sheet, for printing").rect();
    assert!(told.width() > 100.0, "{told}");
    assert!(desk.query_by_label("Page as it is written").is_none(), "there is no room for it");
}

/// The list moved under the mouse, so that the next click took another component.
#[test]
fn the_list_stays_where_it_is_when_a_component_in_it_is_clicked() {
    let (mut desk, _folder) = open();
    let names = desk.state().studio().shown().names().to_vec();
    let place = |desk: &Desk| desk.get_by_role_and_label(Role::Button, &format!("Hide {}", names[0])).rect();
    desk.set_size(egui::vec2(1280.0, 640.0));
    desk.run_ok();
    let before = place(&desk);
    let row = before.center() + egui::vec2(50.0, 0.0);
    press(&mut desk, row, Modifiers::NONE);
    desk.run_steps(30);
    assert_eq!(desk.state().studio().selection.names(), [names[0].clone()]);
    assert_eq!(place(&desk), before);
}

/// The sheets kept their points, so that they were tiny in a window that became large.
#[test]
fn the_sheets_keep_their_share_of_the_window() {
    let (mut desk, _folder) = open();
    let share = |desk: &Desk| {
        let [sheets, model] =
            [desk.state().places.sheets, desk.state().places.model].map(|rect| rect.unwrap());
        sheets.width() / (sheets.width() + model.width())
    };
    let before = share(&desk);
    for size in [[1000.0, 600.0], [800.0, 500.0], [1900.0, 1000.0]] {
        desk.set_size(size.into());
        desk.run_ok();
        // They do not become narrower than their buttons.
        assert!((share(&desk) - before).abs() < 0.03, "{size:?}: {before} {}", share(&desk));
    }
    assert!((share(&desk) - before).abs() < 0.01, "{before} {}", share(&desk));
}

/// Also where a window is moved from one screen to another.
#[test]
fn a_dense_screen_shows_the_model_in_all_its_pixels_and_clicks_hit() {
    let (mut desk, _folder) = open();
    let names = desk.state().studio().shown().names().to_vec();
    for pixels_per_point in [1.0, 2.0, 1.25] {
        desk.set_pixels_per_point(pixels_per_point);
        desk.run_ok();
        let room = desk.get_by_label("Model in space").rect().size() * pixels_per_point;
        let size_px = desk.state().space().size_px().unwrap();
        assert_eq!(size_px, [room.x, room.y].map(|n| n.round() as usize), "{pixels_per_point}");
        for part in [PartId(1), PartId(0)] {
            let at = on_component(&desk, part);
            press(&mut desk, at, Modifiers::NONE);
            let selected = desk.state().studio().selection.names().to_vec();
            assert_eq!(selected, [names[part.0].clone()], "{pixels_per_point}");
        }
    }
}
