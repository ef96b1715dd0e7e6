//! From cuts, layouts and tabs to pieces as they leave the cutter, before any text is on them.

use super::contour::cut_lines;
use super::draft::Draft;
use super::layout::{Layout, across, best_turn, edge, measured, turn};
use super::marks::{Crease, creases};
use super::mesh::PieceMesh;
use super::options::{Naming, NetOptions};
use super::plugs::{PlugLines, lines_of_piece};
use super::split::Split;
use super::tabs::Placed;
use super::{GlueArea, JointMark, PlacedPanel, Tab, glue};
use glam::{DAffine2, DVec2};
use std::collections::BTreeMap;
use tatamu_core::component::{HingeId, PanelId};
use tatamu_core::geom::polygon;

/// A bounding box may be larger by this factor where the piece then lies straight.
const NEAT_FACTOR: f64 = 1.12;

/// A piece before its texts (packagers call that a blank): all that nesting needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Blank {
    pub(super) name: String,
    pub(super) panels: Vec<PlacedPanel>,
    pub(super) creases: Vec<HingeId>,
    pub(super) tabs: Vec<Tab>,
    pub(super) glue_areas: Vec<GlueArea>,
    pub(super) mesh: PieceMesh,
    pub(super) crease_lines: Vec<Crease>,
    pub(super) outline: Vec<DVec2>,
    pub(super) slits: Vec<Vec<DVec2>>,
    pub(super) plugs: Vec<PlugLines>,
}

impl Blank {
    /// `head 1/2`, or `head` where there is only one.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The outer contour of panels and tabs, counter-clockwise: what nesting has to place.
    pub fn outline(&self) -> &[DVec2] {
        &self.outline
    }
}

/// What texts are made from.
#[derive(Debug, PartialEq)]
pub(super) struct MadeNet {
    pub(super) name: String,
    pub(super) split: Split,
    pub(super) tabs: Vec<Placed>,
    pub(super) blanks: Vec<Blank>,
    pub(super) labels: BTreeMap<HingeId, String>,
    pub(super) joints: Vec<JointMark>,
    pub(super) options: NetOptions,
}

impl MadeNet {
    pub(super) fn new(
        split: Split,
        mut draft: Draft,
        naming: Naming<'_>,
        joints: &[JointMark],
        options: &NetOptions,
    ) -> Self {
        draft.layouts.sort_by_key(|l| std::cmp::Reverse(l.panels.len()));
        let numbered = draft.cut.iter().zip(1..);
        let labels: BTreeMap<HingeId, String> =
            numbered.map(|(&h, number)| (h, format!("{}{number}", naming.prefix))).collect();
        let cutter = Cutter { split: &split, draft: &draft, joints, options, labels: &labels };
        let count = draft.layouts.len();
        let name = |k: usize| match count {
            1 => naming.name.to_owned(),
            _ => format!("{} {}/{count}", naming.name, k + 1),
        };
        let blanks = draft.layouts.iter().enumerate().map(|(k, layout)| cutter.blank(layout, name(k)));
        let blanks = blanks.collect();
        Self {
            name: naming.name.to_owned(),
            split,
            tabs: draft.tabs,
            blanks,
            labels,
            joints: joints.to_vec(),
            options: options.clone(),
        }
    }
}

/// What all pieces of a net are made from.
struct Cutter<'a> {
    split: &'a Split,
    draft: &'a Draft,
    joints: &'a [JointMark],
    options: &'a NetOptions,
    labels: &'a BTreeMap<HingeId, String>,
}

impl Cutter<'_> {
    fn blank(&self, layout: &Layout, name: String) -> Blank {
        let Self { split: Split { set, source }, options, .. } = *self;
        let own = self.own_tabs(layout);
        let mesh = PieceMesh::new(set, layout, &own);
        let hide_below_rad = options.choices.hide_below_rad;
        let points: Vec<DVec2> = mesh.vertices().iter().map(|v| v.at).collect();
        let upright = to_sheet(&points, &creases(set, &mesh, hide_below_rad), options.sheet_mm);
        let at = |p: DVec2| upright.transform_point2(p);
        let mesh = mesh.moved(at);
        let place = |&(panel, place): &(PanelId, DAffine2)| PlacedPanel {
            panel,
            kind: set.panel(panel).kind,
            place: upright * place,
        };
        let mut glue_areas = glue::areas(set, layout, &self.draft.tapes);
        if options.choices.glue_marks {
            glue_areas.extend(glue::areas(set, layout, &self.draft.tabs));
        }
        glue_areas.iter_mut().for_each(|area| area.outline = area.outline.map(at));
        // Faces keep the corners that paper joins; lines have one where corners lie on one another.
        let drawn = mesh.clone().welded();
        let lines = cut_lines(drawn.border());
        let panels: Vec<PlacedPanel> = layout.panels.iter().map(place).collect();
        let plugs = lines_of_piece(self.joints, &panels, source, |p| set.panel(p).outline.clone());
        let mut crease_lines = creases(set, &drawn, hide_below_rad);
        crease_lines.extend(plugs.iter().filter_map(|plug| plug.foot).map(Crease::of_foot));
        Blank {
            name,
            panels,
            plugs,
            creases: layout.creases.clone(),
            tabs: own.iter().map(|(t, outline)| self.tab(t, outline.map(at))).collect(),
            glue_areas,
            crease_lines,
            outline: lines.outline,
            slits: lines.slits,
            mesh,
        }
    }

    /// The tabs on panels of a piece, with their outlines in the layout.
    fn own_tabs(&self, layout: &Layout) -> Vec<(Placed, [DVec2; 4])> {
        let on_panel = |t: &Placed| {
            let side = self.split.set.hinges()[t.hinge.0].sides[t.side];
            let place = layout.place(side.panel)?;
            let outline = t.shape.outline(edge(&self.split.set, side));
            Some((t.clone(), outline.map(|p| place.transform_point2(p))))
        };
        self.draft.tabs.iter().filter_map(on_panel).collect()
    }

    fn tab(&self, placed: &Placed, outline: [DVec2; 4]) -> Tab {
        let set = &self.split.set;
        let side = set.hinges()[placed.hinge.0].sides[placed.side];
        let to_mate = across(set, placed.hinge, placed.side).inverse();
        Tab {
            hinge: placed.hinge,
            side: placed.side,
            outline,
            on_mate: placed.shape.outline(edge(set, side)).map(|p| to_mate.transform_point2(p)),
            label: self.labels.get(&placed.hinge).cloned().unwrap_or_default(),
        }
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
