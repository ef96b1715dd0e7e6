//! What those find who use the keyboard or a screen reader.

use super::*;
use egui_kittest::kittest::NodeT;
use std::collections::BTreeSet;

#[test]
fn every_control_has_a_name_for_those_who_do_not_see_it() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let roles = [
        Role::Button,
        Role::CheckBox,
        Role::ComboBox,
        Role::SpinButton,
        Role::Slider,
        Role::TextInput,
        Role::Tab,
        Role::Image,
    ];
    for mode in ["Model", "Sheets", "Export", "Plot"] {
        desk.get_by_role_and_label(Role::Tab, mode).click();
        desk.run_steps(5);
        let mut count = 0;
        for role in roles {
            for node in desk.query_all_by_role(role) {
                count += 1;
                let tree = node.accesskit_node();
                let name = tree.label().or(tree.value()).unwrap_or_default();
                let is_word = name.chars().any(char::is_alphanumeric);
                assert!(is_word, "{mode}: a {role:?} at {:?} is called {name:?}", node.rect());
            }
        }
        assert!(count > 8, "{mode}: {count} controls");
    }
}

/// Fields that have a value and no name, or a number and no value.
fn unnamed(desk: &Desk, what: &str) -> Vec<String> {
    let roles = [Role::ComboBox, Role::SpinButton, Role::Slider, Role::TextInput];
    let fields =
        roles.into_iter().flat_map(|role| desk.query_all_by_role(role).map(move |node| (role, node)));
    let bad = fields.filter_map(|(role, node)| {
        let tree = node.accesskit_node();
        let is_named = tree.label().is_some_and(|name| name.chars().any(char::is_alphanumeric));
        let is_number = matches!(role, Role::Slider | Role::SpinButton);
        let has_value = !is_number || tree.numeric_value().is_some();
        let words = format!("{what}: {role:?} {:?} {:?} at {:?}", tree.label(), tree.value(), node.rect());
        (!is_named || !has_value).then_some(words)
    });
    bad.collect()
}

/// A list was read as what is chosen in it, and nobody heard what it is about.
#[test]
fn every_field_has_a_name_besides_its_value() {
    let (mut desk, _folder) = open();
    let at = on_component(&desk, PartId(1));
    press(&mut desk, at, Modifiers::NONE);
    let mut bad = Vec::new();
    click(&mut desk, "Whole model");
    click(&mut desk, "Split …");
    desk.key_press(Key::E);
    desk.run_ok();
    bad.extend(unnamed(&desk, "Model"));
    click(&mut desk, "Cancel");
    for section in ["Paper and pieces", "More settings"] {
        click(&mut desk, section);
        bad.extend(unnamed(&desk, section));
    }
    for mode in ["Sheets", "Export", "Plot"] {
        desk.get_by_role_and_label(Role::Tab, mode).click();
        desk.run_steps(5);
        bad.extend(unnamed(&desk, mode));
    }
    for (key, what) in [(Key::O, "open"), (Key::K, "commands")] {
        desk.key_press_modifiers(Modifiers::COMMAND, key);
        desk.run_ok();
        bad.extend(unnamed(&desk, what));
        desk.key_press(Key::Escape);
        desk.run_ok();
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

#[test]
fn values_are_read_out() {
    let (desk, _folder) = open();
    assert!(
        desk.get_by_role_and_label(Role::SpinButton, "Size")
            .value()
            .is_some_and(|value| value.contains("200"))
    );
    assert!(desk.get_by_role_and_label(Role::Slider, "folded").accesskit_node().numeric_value().is_some());
}

#[test]
fn all_is_reached_by_the_tab_key() {
    let (mut desk, _folder) = open();
    let mut seen = BTreeSet::new();
    for _ in 0..120 {
        desk.key_press(Key::Tab);
        desk.run_ok();
        let focused = desk.root().children_recursive().find(|node| node.is_focused());
        seen.extend(focused.and_then(|node| node.accesskit_node().label()));
    }
    for name in ["File", "Model", "Undo", "Size", "Fold", "View from above"] {
        // What cannot be done is left out.
        assert!(seen.contains(name) || name == "Undo", "{name}: {seen:?}");
    }
}

#[test]
fn space_presses_the_button_that_has_the_focus() {
    let (mut desk, _folder) = open();
    desk.get_by_role_and_label(Role::Button, "Names of the components").focus();
    desk.run_ok();
    desk.key_press(Key::Space);
    desk.run_steps(4);
    assert!(!desk.state().space().is_playing());
    assert!(!desk.state().space().shows_names());
}
