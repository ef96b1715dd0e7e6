//! The texts of pieces, and the warnings about a net.

use super::blank::{Blank, MadeNet};
use super::hand::EdgeName;
use super::labels::{Placer, Texts};
use super::mesh::EdgeKind;
use super::plugs::PlugLines;
use super::split::Split;
use super::tabs::{Placed, USEFUL_WIDTH_MM};
use super::{JointMark, Net, NetWarning, Piece};
use tatamu_core::component::{HingeId, PanelId, PanelKind};
use tatamu_core::geom::polygon::{self, intersect_convex};

/// The least area of a joint on a part of a split panel that is worth a mark, mm².
const LEAST_MARK_MM2: f64 = 4.0;

/// A net with its texts.
pub(super) fn net(made: &MadeNet) -> Net {
    let joints = joints_of_parts(&made.split, &made.joints);
    let pieces: Vec<Piece> = made.blanks.iter().map(|blank| piece(made, blank, &joints)).collect();
    let Split { set, source } = made.split.clone();
    Net { warnings: warnings(made, &pieces), pieces, labels: made.labels.clone(), set, source }
}

fn piece(made: &MadeNet, blank: &Blank, joints: &[JointMark]) -> Piece {
    let mut placer = Placer::new(&blank.mesh);
    placer.avoid(blank.glue_areas.iter().flat_map(|a| polygon::edges(&a.outline).map(|(p, q)| [p, q])));
    placer.avoid(blank.plugs.iter().flat_map(PlugLines::segments));
    let place_of = |id| blank.panels.iter().find(|p| p.panel == id).map(|p| p.place);
    let joints = placer.joints(joints, place_of);
    placer.glued(&blank.tabs, |kind| match kind {
        EdgeKind::Tab(h) | EdgeKind::Mate(h) => made.labels.get(h).cloned(),
        _ => None,
    });
    placer.joint_texts();
    placer.lead();
    let top = blank.panels.iter().find(|p| p.kind == PanelKind::Top).map(|p| p.panel);
    let afar = top.filter(|&top| !placer.push(top));
    placer.name(&blank.name);
    if let Some(top) = afar {
        placer.push_from_afar(top);
    }
    placer.angles(|kind| angle(made, kind));
    let Texts { labels, leaders, unplaced } = placer.finish();
    Piece { blank: blank.clone(), joints, labels, leaders, unplaced_labels: unplaced }
}

/// What is written beside a crease: its name or its angle when unfolded, if that was asked for, else 180° at
/// those that fold flat, so that one finds them. Names are at glued edges, too.
fn angle(made: &MadeNet, kind: &EdgeKind) -> Option<String> {
    let name = |h: HingeId| EdgeName::of(&made.split.set, h).map(|name| name.to_string());
    let h = match kind {
        EdgeKind::Hinge(h) | EdgeKind::Tab(h) | EdgeKind::Mate(h) if made.options.choices.edge_names => {
            return name(*h);
        }
        EdgeKind::Hinge(h) => h,
        _ => return None,
    };
    let hinge = made.split.set.hinges()[h.0];
    if !made.options.choices.angles {
        return hinge.is_fold.then(|| "180°".to_owned());
    }
    let is_drawn = hinge.is_fold || hinge.deployed_rad.abs() >= made.options.choices.hide_below_rad;
    is_drawn.then(|| format!("{:.0}°", hinge.deployed_rad.to_degrees()))
}

/// The marks of a split panel, on each of its parts that they reach.
fn joints_of_parts(split: &Split, joints: &[JointMark]) -> Vec<JointMark> {
    let mut out = Vec::new();
    for mark in joints {
        let parts = (0..split.source.len()).map(PanelId).filter(|p| split.source[p.0] == mark.panel);
        let reached = |p: &PanelId| {
            let common = intersect_convex(&split.set.panel(*p).outline, &mark.outline);
            polygon::area(&common) > LEAST_MARK_MM2
        };
        let found: Vec<PanelId> = parts.filter(reached).collect();
        let panels = if found.is_empty() { vec![mark.panel] } else { found };
        out.extend(panels.into_iter().map(|panel| JointMark { panel, ..mark.clone() }));
    }
    out
}

fn warnings(made: &MadeNet, pieces: &[Piece]) -> Vec<NetWarning> {
    let MadeNet { name, split, tabs, labels, .. } = made;
    let mut out = Vec::new();
    for whole in (0..split.source.len()).map(PanelId) {
        let parts = split.source.iter().filter(|s| **s == whole).count();
        if parts > 1 {
            let panel = split.set.panel(whole).kind;
            out.push(NetWarning::SplitPanel { name: name.clone(), panel, parts });
        }
    }
    let set = &split.set;
    for (&hinge, label) in labels {
        let label = label.clone();
        if set.hinges()[hinge.0].is_fold {
            out.push(NetWarning::CutFoldHinge { label: label.clone() });
        }
        match tabs.iter().find(|t| t.hinge == hinge).map(Placed::width_mm) {
            None if made.options.hand.is_taped(set, hinge) => {}
            None => out.push(NetWarning::NoTab { label }),
            Some(width_mm) if width_mm < USEFUL_WIDTH_MM => {
                out.push(NetWarning::NarrowTab { label, width_mm });
            }
            Some(_) => {}
        }
    }
    for piece in pieces {
        for text in piece.unplaced_labels() {
            let (piece, text) = (piece.name().to_owned(), text.clone());
            out.push(NetWarning::UnplacedLabel { piece, text });
        }
    }
    out
}
