//! Nets by hand: clicks and drags on the sheets.

use super::defects::drag;
use super::*;
use tatamu::front::edges::{self, Joined, PlacedEdge};

/// A window with the sheets alone, and the tool for edges taken up.
fn open_edges() -> (Desk, TempDir) {
    let (mut desk, folder) = open_sheets();
    click(&mut desk, "Cut and glue edges");
    (desk, folder)
}

/// The edges on the first sheet.
fn on_first_sheet(desk: &Desk) -> Vec<PlacedEdge> {
    edges::edges(desk.state().studio().finished().unwrap(), SheetId(0))
}

/// Where the middle of an edge is on the screen.
fn middle(desk: &Desk, edge: &PlacedEdge) -> Pos2 {
    let page = desk.get_by_label("Sheet 1").rect();
    let size = desk.state().studio().finished().unwrap().layout().options().size_mm();
    let scale = page.width() / size.x as f32;
    let at = edge.ends[0].midpoint(edge.ends[1]);
    egui::pos2(page.left() + scale * at.x as f32, page.bottom() - scale * at.y as f32)
}

fn joined(desk: &Desk, edge: &PlacedEdge) -> Joined {
    let all = edges::of_component(desk.state().studio().finished().unwrap(), edge.id.net);
    all.iter().find(|(id, _)| *id == edge.id).unwrap().1
}

#[test]
fn a_click_cuts_a_crease_and_undo_joins_it_again() {
    let (mut desk, _folder) = open_edges();
    let before = desk.state().studio().document().unwrap().text().to_owned();
    let creases = on_first_sheet(&desk).into_iter().filter(|edge| edge.joined == Joined::Crease);
    for crease in creases.collect::<Vec<_>>() {
        wait_for_pages(&mut desk);
        let at = middle(&desk, &crease);
        press(&mut desk, at, Modifiers::NONE);
        wait_for_pages(&mut desk);
        if desk.state().studio().problem().is_some() {
            assert_eq!(
                desk.state().studio().document().unwrap().text(),
                before,
                "what is refused is taken back"
            );
            continue;
        }
        assert_ne!(joined(&desk, &crease), Joined::Crease);
        let text = desk.state().studio().document().unwrap().text().to_owned();
        assert!(text.contains(&format!("{{ at = \"{}\", cut = true }}", crease.id.name)), "{text}");
        desk.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        desk.run_ok();
        wait_for_pages(&mut desk);
        assert_eq!(joined(&desk, &crease), Joined::Crease);
        assert_eq!(desk.state().studio().document().unwrap().text(), before);
        return;
    }
    panic!("no crease could be cut");
}

#[test]
fn a_tab_is_dragged_to_the_other_side() {
    let (mut desk, _folder) = open_edges();
    wait_for_pages(&mut desk);
    let all = on_first_sheet(&desk);
    let mut tried = 0;
    for from in all.iter().filter(|edge| edge.tab.is_some()) {
        let Joined::Glued(side, _) = from.joined else { continue };
        let Some(to) = all.iter().find(|to| to.id == from.id && to.side == edges::other(side)) else {
            continue;
        };
        wait_for_pages(&mut desk);
        let (at, goal) = (middle(&desk, from), middle(&desk, to));
        drag(&mut desk, at, goal);
        let text = desk.state().studio().document().unwrap().text().to_owned();
        assert!(text.contains(&format!(
            "at = \"{}\", tab = \"{}\"",
            from.id.name,
            edges::other(side).name()
        )));
        wait_for_pages(&mut desk);
        tried += 1;
        if desk.state().studio().problem().is_none() {
            assert!(matches!(joined(&desk, from), Joined::Glued(now, _) if now == edges::other(side)));
            assert!(
                desk.state().studio().document().unwrap().project().pins.is_empty(),
                "no piece was moved"
            );
            return;
        }
    }
    panic!("{tried} tabs were dragged, and none stayed there");
}

#[test]
fn a_choice_that_cannot_be_followed_is_refused_in_words() {
    let (mut desk, _folder) = open_edges();
    let before = desk.state().studio().document().unwrap().text().to_owned();
    let output = desk.state().studio().finished().unwrap().clone();
    let glued =
        on_first_sheet(&desk).into_iter().find(|edge| matches!(edge.joined, Joined::Glued(..))).unwrap();
    let project = desk.state().studio().document().unwrap().project().clone();
    let change = edges::with_width(&output, &project, glued.id, 50.0).unwrap();
    desk.state_mut().studio_mut().change(&change, None);
    settle(&mut desk, "a refusal", |s| s.problem().is_some());
    wait_for_pages(&mut desk);
    let problem = desk.state().studio().problem().unwrap();
    assert!(problem.contains(&format!("edge {}", glued.id.name)) && problem.contains("room"), "{problem}");
    assert!(problem.ends_with("the net stays as it was"), "{problem}");
    assert_eq!(desk.state().studio().document().unwrap().text(), before);
}

/// Without a mouse: the bar has all edges of the selected component.
#[test]
fn the_bar_changes_the_net_of_the_selected_component() {
    let (mut desk, _folder) = open_edges();
    let name = desk.state().studio().shown().names()[0].clone();
    desk.state_mut().studio_mut().selection.select(&name, None, false);
    desk.run_ok();
    click(&mut desk, "Pieces");
    click(&mut desk, "2");
    wait_for_pages(&mut desk);
    let output = desk.state().studio().finished().unwrap();
    assert_eq!(output.nets()[0].pieces().len(), 2);
    let (id, joined) =
        edges::of_component(output, PartId(0)).into_iter().find(|(_, j)| *j == Joined::Crease).unwrap();
    assert_eq!(joined, Joined::Crease);
    click(&mut desk, "Edge");
    click(&mut desk, &format!("{}, crease", id.name));
    assert!(desk.query_by_label("Cut and glue").is_some(), "the bar tells what can be done");
}
