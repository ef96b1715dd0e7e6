//! From cuts, layouts and tabs to finished pieces with texts.

use super::contour::cut_lines;
use super::develop::{Draft, Naming, NetOptions};
use super::glue;
use super::labels::{Placer, Texts};
use super::layout::{Layout, across, best_turn, edge, measured, turn};
use super::marks::{Crease, creases};
use super::mesh::{EdgeKind, PieceMesh};
use super::split::Split;
use super::tabs::{Placed, USEFUL_WIDTH_MM};
use super::{JointMark, Net, NetWarning, Piece, PlacedPanel, Tab};
use crate::component::{HingeId, PanelId, PanelSet};
use crate::geom::polygon::{self, intersect_convex};
use glam::{DAffine2, DVec2};
use std::collections::BTreeMap;

/// A bounding box may be larger by this factor where the piece then lies straight.
const NEAT_FACTOR: f64 = 1.12;
/// The least area of a joint on a part of a split panel that is worth a mark, mm².
const LEAST_MARK_MM2: f64 = 4.0;

/// The pieces of a draft, with their texts.
pub(super) fn finish(
    split: Split,
    mut draft: Draft,
    naming: Naming<'_>,
    joints: &[JointMark],
    options: &NetOptions,
) -> Net {
    draft.layouts.sort_by_key(|l| std::cmp::Reverse(l.panels.len()));
    let numbered = draft.cut.iter().zip(1..);
    let labels: BTreeMap<HingeId, String> =
        numbered.map(|(&h, number)| (h, format!("{}{number}", naming.prefix))).collect();
    let joints = joints_of_parts(&split, joints);
    let finisher = Finisher { set: &split.set, draft: &draft, joints: &joints, options, labels: &labels };
    let count = draft.layouts.len();
    let pieces: Vec<Piece> = (0..count)
        .map(|k| {
            let name = match count {
                1 => naming.name.to_owned(),
                _ => format!("{} {}/{count}", naming.name, k + 1),
            };
            finisher.piece(&draft.layouts[k], name)
        })
        .collect();
    let warnings = warnings(&split, naming.name, &draft.tabs, &pieces, &labels);
    Net { pieces, warnings, labels, set: split.set, source: split.source }
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

/// What all pieces of a net are made from.
struct Finisher<'a> {
    set: &'a PanelSet,
    draft: &'a Draft,
    joints: &'a [JointMark],
    options: &'a NetOptions,
    labels: &'a BTreeMap<HingeId, String>,
}

impl Finisher<'_> {
    fn piece(&self, layout: &Layout, name: String) -> Piece {
        let Self { set, options, .. } = *self;
        let own = self.own_tabs(layout);
        let mesh = PieceMesh::new(set, layout, &own);
        let hide_below_rad = options.choices.hide_below_rad;
        let points: Vec<DVec2> = mesh.vertices().iter().map(|v| v.at).collect();
        let upright = to_sheet(&points, &creases(set, &mesh, hide_below_rad), options.sheet_mm);
        let at = |p: DVec2| upright.transform_point2(p);
        let mesh = mesh.moved(at);
        let tabs: Vec<Tab> = own.iter().map(|(t, outline)| self.tab(t, outline.map(at))).collect();
        let place = |&(panel, place): &(PanelId, DAffine2)| PlacedPanel {
            panel,
            kind: set.panel(panel).kind,
            place: upright * place,
        };
        let panels: Vec<PlacedPanel> = layout.panels.iter().map(place).collect();
        let mut glue_areas = glue::areas(set, layout, &self.draft.tapes);
        if options.choices.glue_marks {
            glue_areas.extend(glue::areas(set, layout, &self.draft.tabs));
        }
        glue_areas.iter_mut().for_each(|area| area.outline = area.outline.map(at));
        let mut placer = Placer::new(&mesh);
        placer.avoid(glue_areas.iter().flat_map(|a| polygon::edges(&a.outline).map(|(p, q)| [p, q])));
        let place_of = |id| panels.iter().find(|p| p.panel == id).map(|p| p.place);
        let joints = placer.joints(self.joints, place_of);
        placer.glued(&tabs, |kind| match kind {
            EdgeKind::Tab(h) | EdgeKind::Mate(h) => self.labels.get(h).cloned(),
            _ => None,
        });
        placer.name(&name);
        placer.lead();
        if options.choices.angles {
            placer.angles(|kind| self.angle(kind));
        }
        let Texts { labels, leaders, unplaced } = placer.finish();
        let lines = cut_lines(mesh.border());
        Piece {
            name,
            panels,
            creases: layout.creases.clone(),
            tabs,
            joints,
            labels,
            leaders,
            glue_areas,
            unplaced_labels: unplaced,
            crease_lines: creases(set, &mesh, hide_below_rad),
            outline: lines.outline,
            slits: lines.slits,
            mesh,
        }
    }

    /// The tabs on panels of a piece, with their outlines in the layout.
    fn own_tabs(&self, layout: &Layout) -> Vec<(Placed, [DVec2; 4])> {
        let on_panel = |t: &Placed| {
            let side = self.set.hinges()[t.hinge.0].sides[t.side];
            let place = layout.place(side.panel)?;
            let outline = t.shape.outline(edge(self.set, side));
            Some((t.clone(), outline.map(|p| place.transform_point2(p))))
        };
        self.draft.tabs.iter().filter_map(on_panel).collect()
    }

    fn tab(&self, placed: &Placed, outline: [DVec2; 4]) -> Tab {
        let side = self.set.hinges()[placed.hinge.0].sides[placed.side];
        let to_mate = across(self.set, placed.hinge, placed.side).inverse();
        Tab {
            hinge: placed.hinge,
            side: placed.side,
            outline,
            on_mate: placed.shape.outline(edge(self.set, side)).map(|p| to_mate.transform_point2(p)),
            label: self.labels.get(&placed.hinge).cloned().unwrap_or_default(),
        }
    }

    /// The angle that is written beside a crease, if one is.
    fn angle(&self, kind: &EdgeKind) -> Option<String> {
        let EdgeKind::Hinge(h) = kind else { return None };
        let hinge = self.set.hinges()[h.0];
        let is_drawn = hinge.is_fold || hinge.deployed_rad.abs() >= self.options.choices.hide_below_rad;
        is_drawn.then(|| format!("{:.0}°", hinge.deployed_rad.to_degrees()))
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
    split: &Split,
    name: &str,
    tabs: &[Placed],
    pieces: &[Piece],
    labels: &BTreeMap<HingeId, String>,
) -> Vec<NetWarning> {
    let mut out = Vec::new();
    for whole in (0..split.source.len()).map(PanelId) {
        let parts = split.source.iter().filter(|s| **s == whole).count();
        if parts > 1 {
            out.push(NetWarning::SplitPanel { name: name.to_owned(), parts });
        }
    }
    let set = &split.set;
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
