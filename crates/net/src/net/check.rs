//! Recomputes from a finished net what it promises. Shares no code with the search, the tabs and
//! the labels.

use super::{FaceKind, LabelKind, Net, Piece, Tab};
use glam::DVec2;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;
use tatamu_core::component::{HingeId, PanelId, PanelSet};
use tatamu_core::geom::polygon::{area, distance, intersect_convex};

/// Polygons that share less than this area touch and do not overlap.
const OVERLAP_MM2: f64 = 1e-5;
/// Rounding of lengths.
const ROUNDING_MM: f64 = 1e-6;
/// Smallest letters, and smallest with a leader line: print of 6 points.
const LEAST_CAP_MM: f64 = 2.0;
const LEAST_LED_CAP_MM: f64 = 1.5;

/// Something that a net promises and does not keep.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NetFault {
    /// Two faces of a piece overlap.
    #[error("{piece}: {a:?} and {b:?} overlap by {area_mm2} mm²")]
    Overlap {
        /// The piece.
        piece: String,
        /// A face.
        a: FaceKind,
        /// Another.
        b: FaceKind,
        /// Common area.
        area_mm2: f64,
    },
    /// A panel is not on exactly one piece.
    #[error("panel {panel:?} is on {count} pieces")]
    Panel {
        /// The panel.
        panel: PanelId,
        /// How often it was found.
        count: usize,
    },
    /// A hinge is neither one crease nor one tab nor taped.
    #[error("hinge {hinge:?} is {creases} creases and {tabs} tabs")]
    Hinge {
        /// The hinge.
        hinge: HingeId,
        /// Pieces in which it is a crease.
        creases: usize,
        /// Tabs on it.
        tabs: usize,
    },
    /// A tab sticks out of its mate.
    #[error("tab {label} sticks out of its mate by {by_mm} mm")]
    OutsideMate {
        /// The tab.
        label: String,
        /// How far.
        by_mm: f64,
    },
    /// Two tabs behind one panel overlap.
    #[error("tabs {a} and {b} overlap behind their mate")]
    TabsBehind {
        /// A tab.
        a: String,
        /// Another.
        b: String,
    },
    /// A text is too small, not on paper, or on another text.
    #[error("{piece}: the text {text:?} {problem}")]
    Text {
        /// The piece.
        piece: String,
        /// The text.
        text: String,
        /// What is wrong.
        problem: &'static str,
    },
    /// A label does not appear twice, placed or listed.
    #[error("label {label} appears {count} times")]
    Label {
        /// The label.
        label: String,
        /// How often.
        count: usize,
    },
    /// A piece's bounding box does not start at the origin or is larger than the sheet.
    #[error("{piece} does not lie on the sheet")]
    OffSheet {
        /// The piece.
        piece: String,
    },
}

/// Everything that is wrong with a net on sheets of the given size; empty for a good one.
pub fn faults(set: &PanelSet, net: &Net, sheet_mm: DVec2) -> Vec<NetFault> {
    let mut out = Vec::new();
    for piece in net.pieces() {
        overlaps(piece, &mut out);
        texts(piece, &mut out);
        let room = sheet_mm + ROUNDING_MM * 2.0;
        let is_on = |p: &DVec2| p.cmpge(DVec2::splat(-ROUNDING_MM)).all() && p.cmple(room).all();
        if !piece.outline().iter().all(is_on) {
            out.push(NetFault::OffSheet { piece: piece.name().to_owned() });
        }
    }
    structure(set, net, &mut out);
    tabs(set, net, &mut out);
    labels(net, &mut out);
    out
}

fn overlaps(piece: &Piece, out: &mut Vec<NetFault>) {
    let faces = piece.mesh().faces();
    let outlines: Vec<Vec<DVec2>> = (0..faces.len()).map(|f| piece.mesh().outline(f)).collect();
    for a in 0..faces.len() {
        for b in 0..a {
            let area_mm2 = area(&intersect_convex(&outlines[a], &outlines[b])).abs();
            if area_mm2 > OVERLAP_MM2 {
                let (a, b) = (faces[b].kind, faces[a].kind);
                out.push(NetFault::Overlap { piece: piece.name().to_owned(), a, b, area_mm2 });
            }
        }
    }
}

fn structure(set: &PanelSet, net: &Net, out: &mut Vec<NetFault>) {
    for panel in (0..set.panels().len()).map(PanelId) {
        let placed = net.pieces().iter().flat_map(Piece::panels);
        let count = placed.filter(|p| p.panel == panel).count();
        if count != 1 {
            out.push(NetFault::Panel { panel, count });
        }
    }
    for hinge in (0..set.hinges().len()).map(HingeId) {
        let creases = net.pieces().iter().filter(|p| p.creases().contains(&hinge)).count();
        let tabs = all_tabs(net).filter(|t| t.hinge == hinge).count();
        let has_place = |piece: &Piece| piece.glue_areas().iter().any(|area| area.hinge == hinge);
        let is_told = net
            .warnings()
            .iter()
            .any(|w| matches!(w, super::NetWarning::NoTab { label } if net.label(hinge) == Some(label)));
        let taped = tabs == 0 && (is_told || net.pieces().iter().any(has_place));
        if creases + tabs + usize::from(taped) != 1 {
            out.push(NetFault::Hinge { hinge, creases, tabs });
        }
    }
}

fn all_tabs(net: &Net) -> impl Iterator<Item = &Tab> {
    net.pieces().iter().flat_map(Piece::tabs)
}

/// A tab behind its mate, found by folding it over the hinge: what was outside its own panel's
/// edge is as far inside the mate's.
fn behind(set: &PanelSet, tab: &Tab) -> Vec<DVec2> {
    let mate = set.hinges()[tab.hinge.0].sides[1 - tab.side];
    let [from, to] = set.panel(mate.panel).edge(mate.edge);
    let mate_along = (to - from).normalize();
    let base = (tab.outline[1] - tab.outline[0]).normalize();
    tab.outline
        .iter()
        .map(|&p| {
            let (along, out) = (base.dot(p - tab.outline[0]), base.perp_dot(p - tab.outline[0]));
            from + mate_along * along + DVec2::from_angle(FRAC_PI_2).rotate(mate_along) * out
        })
        .collect()
}

fn tabs(set: &PanelSet, net: &Net, out: &mut Vec<NetFault>) {
    let mut behind_panel: BTreeMap<PanelId, Vec<(&Tab, Vec<DVec2>)>> = BTreeMap::new();
    for tab in all_tabs(net) {
        let mate = set.hinges()[tab.hinge.0].sides[1 - tab.side].panel;
        let here = behind(set, tab);
        let outline = &set.panel(mate).outline;
        let by_mm = here.iter().map(|p| distance(outline, *p)).fold(0.0, f64::max);
        let moved = here.iter().zip(&tab.on_mate).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        if by_mm.max(moved) > ROUNDING_MM {
            out.push(NetFault::OutsideMate { label: tab.label.clone(), by_mm: by_mm.max(moved) });
        }
        let others = behind_panel.entry(mate).or_default();
        for (other, there) in others.iter() {
            if area(&intersect_convex(&here, there)).abs() > OVERLAP_MM2 {
                let (a, b) = (other.label.clone(), tab.label.clone());
                out.push(NetFault::TabsBehind { a, b });
            }
        }
        others.push((tab, here));
    }
}

fn texts(piece: &Piece, out: &mut Vec<NetFault>) {
    let faces: Vec<Vec<DVec2>> = (0..piece.mesh().faces().len()).map(|f| piece.mesh().outline(f)).collect();
    let mut before: Vec<[DVec2; 4]> = Vec::new();
    for (index, label) in piece.labels().iter().enumerate() {
        let is_led = piece.leaders().iter().any(|leader| leader.label == index);
        let least_cap_mm = if is_led { LEAST_LED_CAP_MM } else { LEAST_CAP_MM };
        let along = DVec2::from_angle(label.angle_rad);
        let (start, up) = (label.anchor - along * label.width_mm / 2.0, along.perp() * label.cap_height_mm);
        let end = start + along * label.width_mm;
        let letters = [start, end, end + up, start + up];
        let is_on_one = faces.iter().any(|f| letters.iter().all(|&p| distance(f, p) < ROUNDING_MM));
        let is_on_text = before.iter().any(|b| area(&intersect_convex(b, &letters)).abs() > OVERLAP_MM2);
        let problems = [
            (label.cap_height_mm < least_cap_mm, "is too small"),
            (!is_on_one, "is not within one panel or tab"),
            (is_on_text, "lies on another text"),
            (label.angle_rad.abs() > FRAC_PI_2 + 1e-6, "is upside down"),
        ];
        for (_, problem) in problems.into_iter().filter(|p| p.0) {
            let (piece, text) = (piece.name().to_owned(), label.text.clone());
            out.push(NetFault::Text { piece, text, problem });
        }
        before.push(letters);
    }
}

fn labels(net: &Net, out: &mut Vec<NetFault>) {
    let placed = net
        .pieces()
        .iter()
        .flat_map(Piece::labels)
        .filter(|l| matches!(l.kind, LabelKind::Tab | LabelKind::Mate))
        .map(|l| &l.text);
    let listed = net.pieces().iter().flat_map(Piece::unplaced_labels);
    let texts: Vec<&String> = placed.chain(listed).collect();
    for tab in all_tabs(net) {
        let count = texts.iter().filter(|t| ***t == tab.label).count();
        if count != 2 {
            out.push(NetFault::Label { label: tab.label.clone(), count });
        }
    }
}
