//! The flows of a user, clicked through without a screen.

use super::super::preferences::Preferences;
use super::super::state::Studio;
use super::super::store::Store;
use super::super::tests::{Known, open_known, snowman, wait};
use super::{Chooser, Mode, Window};
use eframe::egui::accesskit::Role;
use eframe::egui::{self, Event, Key, Modifiers, MouseWheelUnit, Pos2, TouchPhase};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tatamu::model::PartId;
use tatamu::sheet::SheetId;
use tempfile::TempDir;

mod access;
mod advice_tests;
mod commands;
mod defects;
mod export_tests;
mod more_defects;
mod nets;
mod pace_tests;
#[cfg(unix)]
mod plot_tests;
mod reach_tests;
mod room_tests;
mod tools;

type Desk = Harness<'static, Window>;

fn window(folder: &Path) -> Desk {
    let store = Store::at(&folder.join("state"));
    store.set_preferences(&Preferences { has_seen_tour: true, ..store.preferences() });
    desk_with(store)
}

/// A window that remembers what a store has.
fn desk_with(store: Store) -> Desk {
    let preferences = store.preferences();
    let window = Window::new(Studio::new(store, Arc::new(|| {})), Chooser::Own);
    Harness::builder()
        .with_size([1280.0, 720.0])
        .with_max_steps(30)
        .with_step_dt(0.01)
        .with_accessibility_check(false)
        .with_context_setup(move |ctx| {
            super::look::set(ctx);
            super::memory::Memory::new(preferences).set_up(ctx);
        })
        .build_ui_state(|ui, window: &mut Window| window.show(ui), window)
}

/// A window with a model of three components, finished.
fn open() -> (Desk, TempDir) {
    static KNOWN: Known = Known::new();
    let folder = tempfile::tempdir().unwrap();
    let project = snowman(folder.path());
    let mut desk = window(folder.path());
    desk.run_ok();
    assert!(desk.query_by_label("Open a mesh or a project …").is_some(), "nothing is open yet");
    open_known(desk.state_mut().studio_mut(), &project, &KNOWN);
    settle(&mut desk, "a model", |s| s.finished().is_some());
    (desk, folder)
}

/// The same, so small that several pieces share a sheet, with the sheets alone.
fn open_sheets() -> (Desk, TempDir) {
    static KNOWN: Known = Known::new();
    let (mut desk, folder) = open();
    let project = folder.path().join("snowman.toml");
    let text = std::fs::read_to_string(&project).unwrap();
    std::fs::write(&project, format!("size = 110\n{text}")).unwrap();
    open_known(desk.state_mut().studio_mut(), &project, &KNOWN);
    settle(&mut desk, "a small model", |s| s.finished().is_some_and(|o| o.options().size_mm == 110.0));
    click(&mut desk, "Sheets");
    wait_for_pages(&mut desk);
    (desk, folder)
}

fn settle(desk: &mut Desk, what: &str, is_so: impl Fn(&Studio) -> bool) {
    wait(desk.state_mut().studio_mut(), what, is_so);
    desk.run_ok();
}

fn click(desk: &mut Desk, label: &str) {
    desk.get_by_label(label).click();
    desk.run_ok();
}

/// Waits for what appears as soon as something in the background is ready.
fn wait_for(desk: &mut Desk, label: &str) {
    let start = Instant::now();
    while desk.query_by_label(label).is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "\"{label}\" does not come");
        std::thread::sleep(Duration::from_millis(5));
        desk.run_steps(1);
    }
}

/// The pages of what is made by now are on the screen: they are drawn in the background, and pieces on older ones
/// cannot be dragged.
fn wait_for_pages(desk: &mut Desk) {
    settle(desk, "the sheets", |s| s.finished().is_some());
    let start = Instant::now();
    loop {
        let wanted = desk.state().studio().shown().sheets_version();
        if desk.state_mut().sheets.drawn().is_some_and(|(version, _)| version == wanted) {
            break;
        }
        assert!(start.elapsed() < Duration::from_secs(60), "the pages do not come");
        std::thread::sleep(Duration::from_millis(5));
        desk.run_steps(1);
    }
    desk.run_ok();
}

/// Clicks on it.
fn click_when_there(desk: &mut Desk, label: &str) {
    wait_for(desk, label);
    click(desk, label);
}

/// The middle of the view in space, and a point of it where a component is seen.
fn on_component(desk: &Desk, part: PartId) -> Pos2 {
    let rect = desk.get_by_label("Model in space").rect();
    let [width, height] = desk.state().space().size_px().unwrap();
    let tags = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let own: Vec<(usize, usize)> = tags
        .filter(|&(x, y)| desk.state().space().tag_at(x, y).is_some_and(|tag| tag.part == part))
        .collect();
    assert!(!own.is_empty(), "{part:?} is seen");
    let (x, y) = own[own.len() / 2];
    rect.min + egui::vec2(x as f32 + 0.5, y as f32 + 0.5) / desk.ctx.pixels_per_point()
}

fn press(desk: &mut Desk, at: Pos2, modifiers: Modifiers) {
    desk.event(Event::PointerMoved(at));
    desk.run_ok();
    for pressed in [true, false] {
        desk.event_modifiers(
            Event::PointerButton { pos: at, button: egui::PointerButton::Primary, pressed, modifiers },
            modifiers,
        );
        desk.run_ok();
    }
}

fn wheel(desk: &mut Desk, at: Pos2, notches: f32) {
    desk.event(Event::PointerMoved(at));
    desk.run_ok();
    desk.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: egui::vec2(0.0, notches),
        phase: TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    desk.run_ok();
}

#[test]
fn a_component_is_selected_turned_by_the_wheel_and_turned_back() {
    let (mut desk, _folder) = open();
    let names = desk.state().studio().shown().names().to_vec();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    assert_eq!(desk.state().studio().selection.names(), [names[1].clone()]);
    assert!(desk.query_by_label("Direction").is_some(), "its dials are shown");
    let before = desk.state().studio().direction_deg(PartId(1)).unwrap();
    wheel(&mut desk, at, 2.0);
    // The component may be elsewhere now.
    let at = on_component(&desk, PartId(1));
    wheel(&mut desk, at, 1.0);
    let turned = desk.state().studio().direction_deg(PartId(1)).unwrap();
    assert!(((turned - before).rem_euclid(360.0) - 15.0).abs() < 0.11, "{before} {turned}");
    settle(&mut desk, "the model", |s| s.finished().is_some());
    desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    desk.run_ok();
    assert!(!desk.state().studio().document().unwrap().is_changed(), "one gesture is one step");
    settle(&mut desk, "the direction of before", |s| s.direction_deg(PartId(1)) == Some(before));
    desk.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    desk.run_ok();
    assert_eq!(desk.state().studio().direction_deg(PartId(1)), Some(turned));
}

#[test]
fn the_wheel_beside_the_selection_magnifies() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(0));
    let text = desk.state().studio().document().unwrap().text().to_owned();
    wheel(&mut desk, at, 3.0);
    assert_eq!(desk.state().studio().document().unwrap().text(), text);
}

#[test]
fn two_components_are_merged_by_the_keyboard() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(0));
    press(&mut desk, at, Modifiers::NONE);
    let at = on_component(&desk, PartId(2));
    press(&mut desk, at, Modifiers::SHIFT);
    assert_eq!(desk.state().studio().selection.names().len(), 2);
    desk.key_press(Key::M);
    desk.run_ok();
    settle(&mut desk, "two components", |s| s.finished().is_some() || s.problem().is_some());
    assert_eq!(desk.state().studio().shown().names().len(), 2);
}

#[test]
fn sheets_and_space_select_the_same() {
    let (mut desk, _folder) = open_sheets();
    assert!(desk.state().mode == Mode::Sheets);
    let output = desk.state().studio().finished().unwrap().clone();
    let page = desk.get_by_label("Sheet 1").rect();
    let outlines = super::super::pages::outlines(&output, SheetId(0));
    let (id, outline) = &outlines[0];
    let size = output.layout().options().size_mm();
    let scale = page.width() / size.x as f32;
    // A point inside of the piece: a bit inwards of its outline.
    let inside = outline.windows(2).find_map(|w| {
        let edge = w[1] - w[0];
        let at = w[0].midpoint(w[1]) + edge.perp().normalize() * 1.5;
        (super::super::pages::piece_at(&outlines, at) == Some(*id)).then_some(at)
    });
    let inside = inside.unwrap();
    let at = egui::pos2(page.left() + scale * inside.x as f32, page.bottom() - scale * inside.y as f32);
    press(&mut desk, at, Modifiers::NONE);
    let selection = desk.state().studio().selection.clone();
    let names = desk.state().studio().shown().names();
    assert_eq!(selection.names(), [names[id.net.0].clone()]);
    assert_eq!(selection.piece(), Some(output.nets()[id.net.0].pieces()[id.piece].name()));
}

#[test]
fn files_are_exported() {
    let (mut desk, folder) = open();
    click(&mut desk, "Export");
    click(&mut desk, "snowman.svg");
    click(&mut desk, "Write files");
    wait(desk.state_mut().studio_mut(), "files", |s| s.notice().is_some() || s.problem().is_some());
    assert_eq!(desk.state().studio().problem(), None);
    let pdf = std::fs::read(folder.path().join("snowman.pdf")).unwrap();
    assert!(pdf.starts_with(b"%PDF"));
    let has_svg = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.is_ok_and(|e| e.file_name().to_string_lossy().ends_with(".svg"))
    };
    assert!(std::fs::read_dir(folder.path()).unwrap().any(has_svg));
    assert!(desk.state().studio().notice().unwrap().contains("snowman.pdf"));
}

#[test]
fn the_project_is_saved_and_changes_show_in_the_title() {
    let (mut desk, folder) = open();
    // Room for what opens below.
    click(&mut desk, "Whole model");
    click(&mut desk, "Paper and pieces");
    desk.run_ok();
    assert!(desk.query_by_label("snowman.toml").is_some());
    click(&mut desk, "Glue marks");
    assert!(desk.query_by_label("snowman.toml *").is_some());
    desk.key_press_modifiers(Modifiers::COMMAND, Key::S);
    desk.run_ok();
    let text = std::fs::read_to_string(folder.path().join("snowman.toml")).unwrap();
    assert!(text.contains("glue_marks = true"), "{text}");
    assert!(desk.query_by_label("snowman.toml").is_some());
}

#[test]
fn the_list_of_shortcuts_is_shown() {
    let (mut desk, _folder) = open();
    desk.key_press(Key::F1);
    desk.run_ok();
    assert!(desk.query_by_label("wheel").is_some());
    desk.key_press(Key::Escape);
    desk.run_ok();
    assert!(desk.query_by_label("wheel").is_none());
}

#[test]
fn folding_is_played_and_scrubbed() {
    let (mut desk, _folder) = open();
    desk.key_press(Key::Space);
    desk.run_steps(10);
    let folded = desk.state().space().folded();
    assert!(folded > 0.0 && folded < 1.0, "{folded}");
    desk.key_press(Key::Space);
    desk.run_steps(2);
    let stopped = desk.state().space().folded();
    desk.run_steps(5);
    assert_eq!(desk.state().space().folded(), stopped);
}

#[test]
fn a_piece_that_is_dragged_is_pinned() {
    let (mut desk, _folder) = open();
    click(&mut desk, "Sheets");
    wait_for(&mut desk, "Sheet 1");
    let output = desk.state().studio().finished().unwrap().clone();
    let page = desk.get_by_label("Sheet 1").rect();
    let size = output.layout().options().size_mm();
    let scale = page.width() / size.x as f32;
    let outlines = super::super::pages::outlines(&output, SheetId(0));
    let (id, outline) = &outlines[0];
    let edges = outline.windows(2).map(|w| w[0].midpoint(w[1]) + (w[1] - w[0]).perp().normalize() * 1.5);
    let inside =
        edges.into_iter().find(|&at| super::super::pages::piece_at(&outlines, at) == Some(*id)).unwrap();
    let at = egui::pos2(page.left() + scale * inside.x as f32, page.bottom() - scale * inside.y as f32);
    let by = egui::vec2(12.0, -8.0) * scale;
    defects::drag(&mut desk, at, at + by);
    let pins = &desk.state().studio().document().unwrap().project().pins;
    let name = output.nets()[id.net.0].pieces()[id.piece].name();
    let all: usize = output.nets().iter().map(|net| net.pieces().len()).sum();
    assert_eq!(
        pins.len(),
        all,
        "the others are pinned where they lie: {:?}",
        desk.state().studio().problem()
    );
    assert_eq!(pins[0].piece(), name);
    settle(&mut desk, "the layout", |s| s.finished().is_some());
}
