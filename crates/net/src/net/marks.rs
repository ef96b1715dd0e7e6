//! What a piece looks like on paper.

use super::mesh::EdgeKind;
use super::split::is_seam;
use super::{FaceKind, Label, LabelKind, Piece};
use glam::DVec2;
use std::f64::consts::FRAC_PI_4;
use tatamu_core::component::PanelSet;
use tatamu_draw::drawing::{Align, Layer, Mark, Polyline, Stroke, Text};

/// How a crease is folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fold {
    /// Away from the viewer outside, and back.
    Back,
    /// Towards the viewer outside.
    Forth,
    /// Away from the viewer by 180°.
    Flat,
    /// Not at all: the seam of a split panel, behind which its other part is glued.
    Seam,
}

/// A crease to draw: a hinge that stays joined, or the base of a tab or of a plug.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Crease {
    ends: [DVec2; 2],
    fold: Fold,
    is_drawn: bool,
    /// The panels on both sides, in short.
    between: String,
}

impl Crease {
    /// The foot of a plug's tab, which is folded out.
    pub(crate) fn of_foot(ends: [DVec2; 2]) -> Self {
        Self { ends, fold: Fold::Forth, is_drawn: true, between: "plug".to_owned() }
    }

    pub(crate) fn direction(&self) -> DVec2 {
        (self.ends[1] - self.ends[0]).normalize_or(DVec2::X)
    }

    pub(crate) fn length_mm(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }
}

/// The creases of a piece's mesh. Those that fold by less than `hide_below_rad` when deployed are
/// not drawn.
pub(crate) fn creases(set: &PanelSet, mesh: &super::PieceMesh, hide_below_rad: f64) -> Vec<Crease> {
    mesh.edges()
        .iter()
        .filter_map(|edge| match edge.kind {
            EdgeKind::Hinge(h) | EdgeKind::Tab(h) => {
                let hinge = set.hinges()[h.0];
                let fold = match hinge {
                    _ if is_seam(set, h) => Fold::Seam,
                    _ if hinge.is_valley() => Fold::Forth,
                    _ if hinge.is_fold => Fold::Flat,
                    _ => Fold::Back,
                };
                let is_plain = !hinge.is_fold && fold != Fold::Seam;
                let is_drawn = !is_plain || hinge.deployed_rad.abs() >= hide_below_rad;
                let between = between(set, mesh, &edge.faces);
                Some(Crease { ends: mesh.segment(edge), fold, is_drawn, between })
            }
            _ => None,
        })
        .collect()
}

/// The faces at an edge, in short: `chain2.1 chain2.2`.
fn between(set: &PanelSet, mesh: &super::PieceMesh, faces: &[usize]) -> String {
    let name = |&face: &usize| match mesh.faces()[face].kind {
        FaceKind::Panel(panel) => set.panel(panel).kind.short_name(),
        FaceKind::Tab(_) => "tab".to_owned(),
    };
    faces.iter().map(name).collect::<Vec<_>>().join(" ")
}

/// The side of the paper that is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// What can be seen of the model.
    #[default]
    Outside,
    /// What cannot: pieces are mirrored and creases fold towards the viewer.
    Inside,
}

/// Size of the dot at the end of a leader line, mm.
const DOT_MM: f64 = 0.35;

impl Piece {
    /// The piece's marks in its own coordinates, seen from outside: the contour as one closed
    /// path, every cut line once, creases, joint outlines, texts. `stroke_of` gives the look of
    /// each layer, `side` the layer of creases.
    pub fn marks(&self, side: Side, stroke_of: impl Fn(Layer) -> Stroke) -> Vec<Mark> {
        let path = |layer: Layer, contour: Polyline, part: String| {
            Mark::path(layer, vec![contour], Some(stroke_of(layer)), None).of_part(part)
        };
        let closed = |points: &[DVec2]| Polyline::closed(points.to_vec());
        let mut marks = Vec::new();
        for joint in &self.joints {
            let panel = self.blank.panels.iter().find(|p| p.panel == joint.panel);
            let panel = panel.map_or_else(String::new, |p| p.kind.short_name());
            if joint.is_glued {
                marks.push(path(Layer::Glue, closed(&joint.outline), panel.clone()));
            }
            marks.push(path(Layer::Glue, closed(&joint.key), format!("{panel} key")));
        }
        for area in &self.blank.glue_areas {
            let [start, end, far, near] = area.outline;
            marks.push(path(Layer::Glue, Polyline::open(vec![end, far, near, start]), "tab".to_owned()));
            if area.is_outside {
                marks.push(path(Layer::Glue, Polyline::open(vec![start, far]), "tape outside".to_owned()));
            }
        }
        for crease in self.blank.crease_lines.iter().filter(|c| c.is_drawn) {
            let line = Polyline::open(crease.ends.to_vec());
            marks.push(path(crease.layer(side), line, crease.between.clone()));
        }
        for slit in &self.blank.slits {
            marks.push(path(Layer::Slit, Polyline::open(slit.clone()), "inside".to_owned()));
        }
        for cut in self.blank.plugs.iter().flat_map(|plug| &plug.cuts) {
            marks.push(path(Layer::Slit, Polyline::open(cut.clone()), "plug".to_owned()));
        }
        marks.push(path(Layer::Cut, closed(&self.blank.outline), "outline".to_owned()));
        for leader in &self.leaders {
            let line = Polyline::open(vec![leader.from, leader.to]);
            marks.push(path(Layer::Label, line, "leader".to_owned()));
            let dot = (0..8).map(|k| leader.to + DVec2::from_angle(f64::from(k) * FRAC_PI_4) * DOT_MM);
            let dot = Mark::filled(Layer::Label, dot.collect(), stroke_of(Layer::Label).colour);
            marks.push(dot.of_part("leader"));
        }
        marks.extend(self.labels.iter().map(|label| label_mark(label, &stroke_of)));
        marks.into_iter().map(|mark| mark.of_piece(self.name())).collect()
    }
}

impl Crease {
    fn layer(&self, side: Side) -> Layer {
        match (self.fold, side) {
            (Fold::Flat, _) => Layer::FoldHinge,
            (Fold::Seam, _) => Layer::Glue,
            (Fold::Back, Side::Outside) | (Fold::Forth, Side::Inside) => Layer::Mountain,
            (Fold::Back, Side::Inside) | (Fold::Forth, Side::Outside) => Layer::Valley,
        }
    }
}

fn label_mark(label: &Label, stroke_of: &impl Fn(Layer) -> Stroke) -> Mark {
    let layer = if label.kind == LabelKind::Joint { Layer::Glue } else { Layer::Label };
    let text = Text::new(&label.text, label.anchor, label.cap_height_mm)
        .aligned(Align::Middle)
        .turned(label.angle_rad)
        .coloured(stroke_of(layer).colour);
    Mark::text(layer, text).of_part(&*label.text)
}
