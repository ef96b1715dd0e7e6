//! Edges of panels on the sheets, to be cut and glued by hand.

use super::pages::{PieceId, all, on_page};
use glam::DVec2;
use tatamu::component::{HingeId, PanelSet};
use tatamu::geom::polygon;
use tatamu::model::PartId;
use tatamu::net::{EdgeChoice, EdgeName, Net, NetHand, TabSide};
use tatamu::pipeline::Output;
use tatamu::project::Project;
use tatamu::project::change::Change;
use tatamu::sheet::SheetId;

/// An edge between two panels of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EdgeId {
    /// The net, which is that of this component.
    pub net: PartId,
    /// Its name.
    pub name: EdgeName,
}

/// What becomes of an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Joined {
    /// It is a crease.
    Crease,
    /// It is cut, and glued by a tab of this width on this side.
    Glued(TabSide, f64),
    /// It is cut, and held by tape.
    Taped,
}

/// One side of an edge on a sheet; a crease has both sides in one place.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedEdge {
    /// The edge.
    pub id: EdgeId,
    /// The piece that it is on.
    pub piece: PieceId,
    /// Its ends on the page, mm.
    pub ends: [DVec2; 2],
    /// Which side of the edge the panel here is.
    pub side: TabSide,
    /// What becomes of it.
    pub joined: Joined,
    /// The tab, where it is here.
    pub tab: Option<[DVec2; 4]>,
}

const SIDES: [TabSide; 2] = [TabSide::Upper, TabSide::Lower];

/// The edges of the pieces on a sheet.
pub fn edges(output: &Output, sheet: SheetId) -> Vec<PlacedEdge> {
    let on_page = on_page(output);
    let mut found = Vec::new();
    for (piece, own, at) in all(output).filter(|(_, _, at)| at.sheet == sheet) {
        let net = &output.nets()[piece.net.0];
        let set = net.panels();
        for (k, hinge) in set.hinges().iter().enumerate() {
            let Some(name) = EdgeName::of(set, HingeId(k)) else { continue };
            let joined = joined(net, HingeId(k));
            for (side, half) in SIDES.into_iter().zip(hinge.sides) {
                let Some(panel) = own.panels().iter().find(|placed| placed.panel == half.panel) else {
                    continue;
                };
                if joined == Joined::Crease && side == TabSide::Lower {
                    continue;
                }
                let to_page = |p: DVec2| on_page(at.place.transform_point2(p));
                let ends = set.panel(half.panel).edge(half.edge);
                let tab = own.tabs().iter().find(|tab| tab.hinge == HingeId(k) && SIDES[tab.side] == side);
                found.push(PlacedEdge {
                    id: EdgeId { net: piece.net, name },
                    piece,
                    ends: ends.map(|p| to_page(panel.place.transform_point2(p))),
                    side,
                    joined,
                    tab: tab.map(|tab| tab.outline.map(to_page)),
                });
            }
        }
    }
    found
}

fn joined(net: &Net, hinge: HingeId) -> Joined {
    if net.pieces().iter().any(|piece| piece.creases().contains(&hinge)) {
        return Joined::Crease;
    }
    let tab = net.pieces().iter().flat_map(|piece| piece.tabs()).find(|tab| tab.hinge == hinge);
    tab.map_or(Joined::Taped, |tab| Joined::Glued(SIDES[tab.side], tab.width_mm()))
}

/// The edge at a point of a page: the one whose tab is there, else the nearest within a reach.
pub fn edge_at(edges: &[PlacedEdge], at: DVec2, reach_mm: f64) -> Option<&PlacedEdge> {
    let distance = |edge: &&PlacedEdge| polygon::distance_to_segment(at, edge.ends[0], edge.ends[1]);
    let near = edges.iter().filter(|edge| distance(edge) <= reach_mm);
    let has_tab_there = |edge: &&PlacedEdge| edge.tab.is_some_and(|tab| polygon::contains(&tab, at));
    let nearest = near.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.or_else(|| edges.iter().find(has_tab_there))
}

/// The edges of a component, in the order of their names, with what becomes of them.
pub fn of_component(output: &Output, net: PartId) -> Vec<(EdgeId, Joined)> {
    let Some(own) = output.nets().get(net.0) else { return Vec::new() };
    let set: &PanelSet = own.panels();
    let hinges = (0..set.hinges().len()).map(HingeId);
    let named = hinges.filter_map(|hinge| Some((EdgeName::of(set, hinge)?, joined(own, hinge))));
    let mut all: Vec<_> = named.map(|(name, joined)| (EdgeId { net, name }, joined)).collect();
    all.sort_by_key(|(id, _)| id.name);
    all
}

/// What was chosen by hand about an edge.
pub fn choice(output: &Output, project: &Project, id: EdgeId) -> Option<EdgeChoice> {
    hand(output, project, id.net)?.edges().find(|(name, _)| *name == id.name).map(|(_, choice)| choice)
}

/// The number of pieces that was chosen for a component.
pub fn pieces(output: &Output, project: &Project, net: PartId) -> Option<usize> {
    hand(output, project, net)?.pieces()
}

/// Whether anything was chosen by hand about a component.
pub fn is_by_hand(output: &Output, project: &Project, net: PartId) -> bool {
    hand(output, project, net).is_some_and(|own| !own.is_empty())
}

/// The change that sets what is chosen about an edge, or leaves it to tatamu.
pub fn change(output: &Output, id: EdgeId, choice: Option<EdgeChoice>) -> Option<Change> {
    Some(Change::Edge { component: component(output, id.net)?.to_owned(), at: id.name, choice })
}

/// The change that cuts a crease, or makes a crease of what is cut.
pub fn toggled(output: &Output, id: EdgeId, joined: Joined) -> Option<Change> {
    let is_cut = Some(joined == Joined::Crease);
    change(output, id, Some(EdgeChoice { is_cut, ..EdgeChoice::default() }))
}

/// The change that puts the tab on a side, as wide as was chosen, or tape in its place.
pub fn with_tab(output: &Output, project: &Project, id: EdgeId, side: TabSide) -> Option<Change> {
    let now = choice(output, project, id);
    let width_mm = now.and_then(|now| now.width_mm).filter(|_| side != TabSide::Tape);
    change(output, id, Some(EdgeChoice { is_cut: Some(true), tab: Some(side), width_mm }))
}

/// The change that sets the width of a tab, on the side where it is.
pub fn with_width(output: &Output, project: &Project, id: EdgeId, width_mm: f64) -> Option<Change> {
    let tab = choice(output, project, id).and_then(|now| now.tab).filter(|side| *side != TabSide::Tape);
    change(output, id, Some(EdgeChoice { is_cut: Some(true), tab, width_mm: Some(width_mm) }))
}

/// The change that sets the number of pieces of a net, or leaves it to tatamu.
pub fn in_pieces(output: &Output, net: PartId, pieces: Option<usize>) -> Option<Change> {
    Some(Change::Pieces { component: component(output, net)?.to_owned(), pieces })
}

/// The other side of an edge.
pub fn other(side: TabSide) -> TabSide {
    if side == TabSide::Upper { TabSide::Lower } else { TabSide::Upper }
}

/// What was chosen by hand about a net.
fn hand<'p>(output: &Output, project: &'p Project, net: PartId) -> Option<&'p NetHand> {
    let component = component(output, net)?;
    project.nets.iter().find(|table| table.component() == component).map(|table| table.hand())
}

/// Name of a component as it is printed, by which choices about its net go.
fn component(output: &Output, net: PartId) -> Option<&str> {
    output.model().parts().get(net.0).map(|part| part.name.as_str())
}
