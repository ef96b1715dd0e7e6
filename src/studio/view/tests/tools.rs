//! What a user expects to find.

use super::defects::drag;
use super::*;
use crate::studio::change::Change;
use crate::studio::scene;
use std::collections::BTreeSet;
use tatamu::project::options::SIZE;

#[test]
fn the_title_has_the_file_and_a_star() {
    let (mut desk, _folder) = open();
    assert_eq!(desk.state().title(), "snowman.toml – tatamu");
    desk.state_mut().studio_mut().turn(PartId(0), 5.0, 0.0);
    desk.run_ok();
    assert_eq!(desk.state().title(), "snowman.toml * – tatamu");
}

/// The ring of a component that is hidden was drawn about nothing.
#[test]
fn a_hidden_component_has_no_ring() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let has_ring = |desk: &Desk| desk.query_by_label_contains("Fold direction of").is_some();
    assert!(has_ring(&desk));
    desk.key_press(Key::H);
    desk.run_ok();
    assert!(!has_ring(&desk));
}

#[test]
fn components_are_hidden_isolated_and_shown() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let seen = |desk: &Desk| -> BTreeSet<PartId> {
        let [width, height] = desk.state().space().size_px().unwrap();
        let all = (0..height).step_by(3).flat_map(|y| (0..width).step_by(3).map(move |x| (x, y)));
        all.filter_map(|(x, y)| desk.state().space().tag_at(x, y)).map(|tag| tag.part).collect()
    };
    assert_eq!(seen(&desk).len(), 3);
    desk.key_press(Key::I);
    desk.run_ok();
    assert_eq!(seen(&desk), BTreeSet::from([PartId(1)]));
    desk.key_press_modifiers(Modifiers::SHIFT, Key::H);
    desk.run_ok();
    assert_eq!(seen(&desk).len(), 3, "{:?}", desk.state().studio().visibility);
    desk.key_press(Key::H);
    desk.run_ok();
    assert_eq!(seen(&desk), BTreeSet::from([PartId(0), PartId(2)]));
    let shown = desk.state().studio().shown().part(PartId(1)).unwrap().name.clone();
    desk.get_by_label(&format!("Show {shown}")).scroll_to_me();
    desk.run_ok();
    click(&mut desk, &format!("Show {shown}"));
    assert_eq!(seen(&desk).len(), 3, "{:?}", desk.state().studio().visibility);
}

/// The pages of before were drawn under the outlines of now, and stayed.
#[test]
fn pages_and_outlines_are_of_one_layout() {
    let (mut desk, _folder) = open();
    wait_for(&mut desk, "Sheet 1");
    for size_mm in [170.0, 120.0] {
        let change = Change::Set { option: &SIZE, value: Some(size_mm.into()) };
        desk.state_mut().studio_mut().change(&change, None);
        wait_for_pages(&mut desk);
        let studio = desk.state().studio();
        let (opened, project) = (studio.opened().unwrap(), studio.document().unwrap().project());
        let wanted = crate::studio::pages::drawings(opened, project, studio.finished().unwrap()).unwrap();
        assert!(desk.state().sheets.drawn().unwrap().1 == wanted);
        let pictures = desk.state().sheets.picture_versions();
        assert!(pictures.iter().all(|version| *version == studio.shown().sheets_version()), "{pictures:?}");
    }
}

#[test]
fn what_the_mouse_is_over_is_marked_in_both_views() {
    let (mut desk, _folder) = open();
    wait_for(&mut desk, "Sheet 1");
    let at = on_component(&desk, PartId(1));
    desk.event(Event::PointerMoved(at));
    desk.run_ok();
    let hover = desk.state().studio().hover.clone().expect("over a component");
    assert!(hover.is_on(PartId(1)));
    desk.run_ok();
    // The same from a sheet.
    let output = desk.state().studio().finished().unwrap().clone();
    let outlines = crate::studio::pages::outlines(&output, SheetId(0));
    let (id, outline) = &outlines[0];
    let page = desk.get_by_label("Sheet 1").rect();
    let scale = page.width() / output.layout().options().size_mm().x as f32;
    let edges = outline.windows(2).map(|w| w[0].midpoint(w[1]) + (w[1] - w[0]).perp().normalize() * 1.5);
    let inside =
        edges.into_iter().find(|&at| crate::studio::pages::piece_at(&outlines, at) == Some(*id)).unwrap();
    let at = egui::pos2(page.left() + scale * inside.x as f32, page.bottom() - scale * inside.y as f32);
    desk.event(Event::PointerMoved(at));
    desk.run_ok();
    assert!(desk.state().studio().hover.as_ref().is_some_and(|hover| hover.is_on(id.net)));
}

#[test]
fn the_axes_turn_the_view() {
    let (mut desk, _folder) = open();
    click(&mut desk, "View from above");
    assert!(desk.state().space().orbit().unwrap().elevation_rad > 1.4);
    click(&mut desk, "View from the right");
    let orbit = *desk.state().space().orbit().unwrap();
    assert_eq!((orbit.azimuth_rad, orbit.elevation_rad), (std::f64::consts::FRAC_PI_2, 0.0));
}

#[test]
fn lines_on_the_ground_are_round_numbers_apart() {
    for (diagonal_mm, step_mm) in [(200.0, 10.0), (210.0, 20.0), (1000.0, 50.0), (37.0, 2.0)] {
        assert_eq!(scene::grid_mm(diagonal_mm), step_mm, "{diagonal_mm}");
    }
}

#[test]
fn a_sample_opens_from_the_start_page() {
    let folder = tempfile::tempdir().unwrap();
    let mut desk = window(folder.path());
    desk.run_ok();
    click(&mut desk, "Sample: Gift box");
    settle(&mut desk, "the sample", |s| s.finished().is_some() || s.problem().is_some());
    assert_eq!(desk.state().studio().problem(), None);
    assert_eq!(desk.state().studio().shown().names().len(), 3);
}

#[test]
fn the_tour_is_shown_once() {
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let store = Store::at(&folder.path().join("state"));
    let mut desk = desk_with(store.clone());
    desk.state_mut().open(&project);
    settle(&mut desk, "a model", |s| s.finished().is_some());
    for step in 1..=5 {
        assert!(desk.query_by_label(&format!("{step} of 5")).is_some(), "step {step}");
        click(&mut desk, if step < 5 { "Next" } else { "Done" });
    }
    assert!(desk.state().tour.is_none());
    desk.run_ok();
    assert!(store.preferences().has_seen_tour);
}

/// The last step was half outside of the window, and no key led through the tour.
#[test]
fn keys_lead_through_the_tour() {
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let mut desk = desk_with(Store::at(&folder.path().join("state")));
    desk.state_mut().open(&project);
    settle(&mut desk, "a model", |s| s.finished().is_some());
    wait_for_pages(&mut desk);
    for _ in 1..5 {
        desk.key_press(Key::Enter);
        desk.run_ok();
    }
    desk.run_steps(3);
    let step = desk.get_by_label("5 of 5").rect();
    assert!(step.right() < desk.get_by_label("Sheet 1").rect().left(), "beside the sheets: {step}");
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.state().tour.is_none());
}

#[test]
fn a_mesh_that_another_program_changes_is_read_again() {
    let (mut desk, folder) = open();
    let before = desk.state().studio().opened().unwrap().engine.mesh().faces().len();
    desk.state_mut().studio_mut().turn(PartId(1), 10.0, 0.0);
    let text = desk.state().studio().document().unwrap().text().to_owned();
    let mesh = include_bytes!("../../../../samples/rabbit.obj");
    std::fs::write(folder.path().join("snowman.obj"), mesh).unwrap();
    settle(&mut desk, "the mesh", |s| s.opened().unwrap().engine.mesh().faces().len() != before);
    assert!(desk.state().studio().notice().is_some_and(|notice| notice.contains("snowman.obj")));
    assert_eq!(desk.state().studio().document().unwrap().text(), text, "the project stays");
}

#[test]
fn the_handle_on_the_ring_turns_the_fold_direction_as_one_step() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let name = desk.state().studio().shown().part(PartId(1)).unwrap().name.clone();
    let handle = format!("Fold direction of {name}");
    let direction = |desk: &Desk| desk.state().studio().direction_deg(PartId(1)).unwrap();
    let before = direction(&desk);
    let from = desk.get_by_label(&handle).rect().center();
    // About the component, by almost a radian.
    let arm = from - at;
    let by = arm.length() * egui::Vec2::angled(arm.angle() + 0.9) - arm;
    drag(&mut desk, from, from + by);
    settle(&mut desk, "the turned model", |s| s.finished().is_some());
    let after = direction(&desk);
    assert!((after - before).abs() > 5.0, "{before}° {after}°");
    let now = desk.get_by_label(&handle).rect().center();
    assert!(now.distance(from) > 10.0, "the handle is where the direction is");
    click(&mut desk, "Undo");
    settle(&mut desk, "the model before", |s| s.finished().is_some());
    assert_eq!(direction(&desk), before, "one step");
}

#[test]
fn the_ring_tells_how_other_directions_are_while_the_work_rests() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let start = Instant::now();
    let known =
        |desk: &Desk| desk.state().space().ring().survey().map(|s| s.looks().iter().flatten().count());
    while known(&desk).is_none_or(|count| count < 12) {
        assert!(start.elapsed() < Duration::from_secs(120), "{:?}", known(&desk));
        std::thread::sleep(Duration::from_millis(5));
        desk.run_steps(2);
    }
    // The direction that was found is one in which nothing clashes.
    assert!(desk.state().studio().finished().unwrap().fold_plan().is_free());
    let looks: Vec<_> =
        desk.state().space().ring().survey().unwrap().looks().iter().flatten().copied().collect();
    assert!(
        looks.iter().any(|look| look.is_free) && looks.iter().all(|look| look.error_mm > 0.0),
        "{looks:?}"
    );
    press(&mut desk, Pos2::new(at.x, 90.0), Modifiers::NONE);
    assert!(known(&desk).is_none(), "nothing is selected");
}

#[test]
fn two_corners_that_are_clicked_are_measured() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Measure");
    assert!(desk.query_by_label("click on a corner to measure from").is_some());
    for part in [1, 2].map(PartId) {
        let at = on_component(&desk, part);
        press(&mut desk, at, Modifiers::NONE);
    }
    let hint = desk.query_all_by_label_contains("click: measures to its nearest corner");
    assert_eq!(hint.count(), 1, "the hint told of selecting");
    let mm = desk.state().space().measure().length_mm().unwrap();
    let whole_mm = desk.state().studio().shown().shaped().unwrap().source().mesh().diagonal_mm();
    assert!(mm > 1.0 && mm < whole_mm, "{mm} mm");
    assert!(desk.query_by_label(&format!("{mm:.1} mm")).is_some());
    assert!(desk.state().studio().selection.names().is_empty(), "a click is for the measure alone");
    desk.key_press(Key::D);
    desk.run_ok();
    assert!(desk.state().space().measure().length_mm().is_none());
}

/// Remedies were words in the window, and buttons on the page alone.
#[test]
fn what_a_warning_advises_is_one_click() {
    let (mut desk, folder) = open();
    let project = folder.path().join("snowman.toml");
    let text = std::fs::read_to_string(&project).unwrap();
    std::fs::write(&project, format!("size = 40\n{text}")).unwrap();
    desk.state_mut().open(&project);
    settle(&mut desk, "a tiny model", |s| s.finished().is_some_and(|o| o.options().size_mm == 40.0));
    let count = desk.state().studio().notes().len();
    assert!(count > 0, "so small a model has warnings");
    click(&mut desk, &if count == 1 { "1 warning".to_owned() } else { format!("{count} warnings") });
    let larger = desk.query_all_by_label("Size 50 mm").next().expect("the warning advises a larger size");
    larger.click();
    desk.run_ok();
    settle(&mut desk, "the larger model", |s| s.finished().is_some_and(|o| o.options().size_mm == 50.0));
}

#[test]
fn three_questions_lead_to_a_machine() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Plot");
    click(&mut desk, "Find my machine …");
    let press = |desk: &mut Desk, label: &str| {
        desk.get_by_role_and_label(Role::Button, label).click();
        desk.run_ok();
    };
    ["Roland", "Cardstock, 200 g/m²"].iter().for_each(|label| press(&mut desk, label));
    assert_eq!(desk.state_mut().plot_mut().choice()[..2], ["roland-camm-1", "cardstock-200"]);
    assert!(desk.query_by_label("Find my machine").is_none(), "all is answered");
    click(&mut desk, "Find my machine …");
    ["HP", "7550A", "Back", "7475A", "Any paper, drawn"].iter().for_each(|label| press(&mut desk, label));
    assert_eq!(desk.state_mut().plot_mut().choice()[..2], ["hp-7475a", "pen"]);
    // One that takes files of another program.
    click(&mut desk, "Find my machine …");
    click(&mut desk, "Cricut");
    assert!(desk.query_by_label("tatamu make snowman.toml --for cricut").is_some());
    click(&mut desk, "Close");
    assert_eq!(desk.state_mut().plot_mut().choice()[0], "hp-7475a");
}

#[test]
fn a_profile_of_the_users_own_is_taken_from_a_file() {
    let (mut desk, folder) = open();
    let profile = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let built_in = |list: &[tatamu::plotter::profile::Profile]| list[0].text.to_owned();
    let cutter = profile("mine.toml", &built_in(tatamu::plotter::profile::CUTTERS));
    let card = profile("card.toml", &built_in(tatamu::plotter::profile::MEDIA));
    let wrong = profile("wrong.toml", "name = 3\n");
    click(&mut desk, "Plot");
    click(&mut desk, "Find my machine …");
    click(&mut desk, "Profile of your own …");
    wait_for(&mut desk, "Open the profile of a cutter or a medium");
    desk.get_by_role_and_label(Role::TextInput, "File").type_text(&cutter.display().to_string());
    desk.run_ok();
    desk.get_by_role_and_label(Role::Button, "Open").click();
    desk.run_ok();
    assert_eq!(desk.state_mut().plot_mut().choice()[0], cutter.display().to_string());
    let plot = desk.state_mut().plot_mut();
    plot.profiles_mut().take(&card).unwrap();
    assert_eq!(plot.choice()[1], card.display().to_string());
    assert!(plot.profiles_mut().take(&wrong).unwrap_err().contains("wrong.toml"));
    assert_eq!(plot.choice()[0], cutter.display().to_string(), "what is no profile changes nothing");
}
