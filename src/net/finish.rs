//! From cuts, layouts and tabs to finished pieces with texts.

use super::contour::cut_lines;
use super::develop::{Draft, Naming, NetOptions};
use super::labels::Placer;
use super::layout::{Layout, across, best_turn, edge, measured, turn};
use super::marks::{Crease, creases};
use super::mesh::{EdgeKind, PieceMesh};
use super::tabs::{Placed, USEFUL_WIDTH_MM};
use super::{JointMark, Net, NetWarning, Piece, PlacedPanel, Tab};
use crate::component::{HingeId, PanelSet};
use crate::geom::polygon;
use glam::{DAffine2, DVec2};
use std::collections::BTreeMap;

/// A bounding box may be larger by this factor where the piece then lies straight.
const NEAT_FACTOR: f64 = 1.12;

/// The pieces of a draft, with their texts.
pub(super) fn finish(
    set: &PanelSet,
    draft: Draft,
    naming: Naming<'_>,
    joints: &[JointMark],
    options: &NetOptions,
) -> Net {
    let Draft { mut layouts, cut, tabs } = draft;
    layouts.sort_by_key(|l| std::cmp::Reverse(l.panels.len()));
    let labels: BTreeMap<HingeId, String> =
        cut.iter().zip(1..).map(|(&h, number)| (h, format!("{}{number}", naming.prefix))).collect();
    let count = layouts.len();
    let pieces: Vec<Piece> = layouts
        .into_iter()
        .enumerate()
        .map(|(k, layout)| {
            let name = match count {
                1 => naming.name.to_owned(),
                _ => format!("{} {}/{count}", naming.name, k + 1),
            };
            let own: Vec<Placed> = tabs
                .iter()
                .filter(|t| layout.place(set.hinges()[t.hinge.0].sides[t.side].panel).is_some())
                .cloned()
                .collect();
            piece(set, &layout, &own, name, joints, options.sheet_mm, &labels)
        })
        .collect();
    let warnings = warnings(set, &tabs, &pieces, &labels);
    Net { pieces, warnings, labels }
}

fn piece(
    set: &PanelSet,
    layout: &Layout,
    own: &[Placed],
    name: String,
    joints: &[JointMark],
    sheet_mm: DVec2,
    labels: &BTreeMap<HingeId, String>,
) -> Piece {
    let on_panel: Vec<(Placed, [DVec2; 4])> = own
        .iter()
        .filter_map(|t| {
            let side = set.hinges()[t.hinge.0].sides[t.side];
            let place = layout.place(side.panel)?;
            let outline = t.shape.outline(edge(set, side));
            Some((t.clone(), outline.map(|p| place.transform_point2(p))))
        })
        .collect();
    let mesh = PieceMesh::new(set, layout, &on_panel);
    let points: Vec<DVec2> = mesh.vertices().iter().map(|v| v.at).collect();
    let upright = to_sheet(&points, &creases(set, &mesh), sheet_mm);
    let mesh = mesh.moved(|p| upright.transform_point2(p));
    let tabs: Vec<Tab> = on_panel
        .iter()
        .map(|(t, outline)| {
            let side = set.hinges()[t.hinge.0].sides[t.side];
            let to_mate = across(set, t.hinge, t.side).inverse();
            Tab {
                hinge: t.hinge,
                side: t.side,
                outline: outline.map(|p| upright.transform_point2(p)),
                on_mate: t.shape.outline(edge(set, side)).map(|p| to_mate.transform_point2(p)),
                label: labels.get(&t.hinge).cloned().unwrap_or_default(),
            }
        })
        .collect();
    let panels: Vec<PlacedPanel> = layout
        .panels
        .iter()
        .map(|&(panel, place)| PlacedPanel { panel, kind: set.panel(panel).kind, place: upright * place })
        .collect();
    let mut placer = Placer::new(&mesh);
    let place_of = |id| panels.iter().find(|p| p.panel == id).map(|p| p.place);
    let joints = placer.joints(joints, place_of);
    placer.glued(&tabs, |kind| match kind {
        EdgeKind::Tab(h) | EdgeKind::Mate(h) => labels.get(h).cloned(),
        _ => None,
    });
    placer.name(&name);
    let (labels, unplaced_labels) = placer.finish();
    let lines = cut_lines(mesh.border());
    Piece {
        name,
        panels,
        creases: layout.creases.clone(),
        tabs,
        joints,
        labels,
        unplaced_labels,
        crease_lines: creases(set, &mesh),
        outline: lines.outline,
        slits: lines.slits,
        mesh,
    }
}

/// The rigid motion that turns a piece as it fits the sheet, its bounding box at the origin: with
/// a crease upright or level where that costs little, else with the smallest box.
fn to_sheet(points: &[DVec2], creases: &[Crease], sheet_mm: DVec2) -> DAffine2 {
    let best = best_turn(points, sheet_mm);
    let most = best.size_mm.element_product() * NEAT_FACTOR;
    let neat = creases
        .iter()
        .flat_map(|c| [c.direction(), c.direction().perp()])
        .map(|d| measured(points, DVec2::new(d.x, -d.y), sheet_mm))
        .filter(|turn| turn.fits() && turn.size_mm.element_product() <= most)
        .reduce(|a, b| if b.beats(&a) { b } else { a });
    let rotation = turn(neat.unwrap_or(best).unit);
    let (lo, _) = polygon::bounds(points.iter().map(|&p| rotation * p)).unwrap_or_default();
    DAffine2::from_mat2_translation(rotation, -lo)
}

fn warnings(
    set: &PanelSet,
    tabs: &[Placed],
    pieces: &[Piece],
    labels: &BTreeMap<HingeId, String>,
) -> Vec<NetWarning> {
    let mut out = Vec::new();
    for (&hinge, label) in labels {
        let label = label.clone();
        if set.hinges()[hinge.0].is_fold {
            out.push(NetWarning::CutFoldHinge { label: label.clone() });
        }
        match tabs.iter().find(|t| t.hinge == hinge).map(Placed::width_mm) {
            None => out.push(NetWarning::NoTab { label }),
            Some(width_mm) if width_mm < USEFUL_WIDTH_MM => {
                out.push(NetWarning::NarrowTab { label, width_mm });
            }
            Some(_) => {}
        }
    }
    for piece in pieces {
        for text in &piece.unplaced_labels {
            let (piece, text) = (piece.name.clone(), text.clone());
            out.push(NetWarning::UnplacedLabel { piece, text });
        }
    }
    out
}
