//! How soon the window shows what was done, and how seldom it draws for nothing.

use super::*;

/// A window with a selected component, and a point where it is seen.
fn selected() -> (Desk, TempDir, Pos2) {
    let (mut desk, folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    (desk, folder, at)
}

fn click_wheel(desk: &mut Desk) {
    desk.event(Event::MouseWheel {
        unit: MouseWheelUnit::Line,
        delta: egui::vec2(0.0, 5.0),
        phase: TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    desk.step();
}

#[test]
fn the_picture_after_a_click_of_the_wheel_shows_the_new_component() {
    let (mut desk, _folder, _) = selected();
    let before = desk.state().studio().shown().part(PartId(1)).unwrap().component.clone();
    click_wheel(&mut desk);
    let studio = desk.state().studio();
    assert_eq!(studio.shown().ahead(), Some(PartId(1)));
    assert_ne!(studio.shown().part(PartId(1)).unwrap().component, before);
}

/// Pictures without anything new took the cores from the component and from the model.
#[test]
fn few_pictures_are_drawn_while_the_model_is_made() {
    let (mut desk, _folder, _) = selected();
    click_wheel(&mut desk);
    loop {
        desk.step();
        assert!(desk.state().studio().busy().is_some(), "one picture follows the other while it works");
        if desk.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay >= Duration::from_millis(100)
        {
            break;
        }
    }
}

#[test]
fn a_wheel_that_turns_a_component_does_not_scroll() {
    let (mut desk, _folder, at) = selected();
    let scrolls = |desk: &Desk| desk.ctx.options(|o| o.input_options.line_scroll_speed > 0.0);
    assert!(!scrolls(&desk));
    desk.event(Event::PointerMoved(egui::pos2(60.0, at.y)));
    desk.step();
    assert!(scrolls(&desk), "the list of settings does");
}
