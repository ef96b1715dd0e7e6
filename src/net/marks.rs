//! What a piece looks like on paper.

use super::mesh::EdgeKind;
use super::split::is_seam;
use super::{Label, LabelKind, Piece};
use crate::component::PanelSet;
use crate::drawing::{Align, Layer, Mark, Stroke, Text};
use glam::DVec2;
use std::f64::consts::FRAC_PI_4;

/// How a crease is folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fold {
    /// Away from the viewer outside, and back.
    Back,
    /// By 180°.
    Flat,
    /// Not at all: the seam of a split panel, behind which its other part is glued.
    Seam,
}

/// A crease to draw: a hinge that stays joined, or the base of a tab.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Crease {
    ends: [DVec2; 2],
    fold: Fold,
    is_drawn: bool,
}

impl Crease {
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
                    _ if hinge.is_fold => Fold::Flat,
                    _ if is_seam(set, h) => Fold::Seam,
                    _ => Fold::Back,
                };
                let is_drawn = fold != Fold::Back || hinge.deployed_rad >= hide_below_rad;
                Some(Crease { ends: mesh.segment(edge), fold, is_drawn })
            }
            _ => None,
        })
        .collect()
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
        let line = |layer: Layer, points: Vec<DVec2>| Mark::polyline(layer, points, &stroke_of(layer));
        let ring = |layer: Layer, points: Vec<DVec2>| Mark::polygon(layer, points, &stroke_of(layer));
        let mut marks = Vec::new();
        for joint in &self.joints {
            marks.push(ring(Layer::Glue, joint.outline.clone()));
            marks.push(ring(Layer::Glue, joint.key.to_vec()));
        }
        for area in &self.glue_areas {
            let [start, end, far, near] = area.outline;
            marks.push(line(Layer::Glue, vec![end, far, near, start]));
        }
        for crease in self.crease_lines.iter().filter(|c| c.is_drawn) {
            marks.push(line(crease.layer(side), crease.ends.to_vec()));
        }
        marks.extend(self.slits.iter().map(|slit| line(Layer::Slit, slit.clone())));
        marks.push(ring(Layer::Cut, self.outline.clone()));
        for leader in &self.leaders {
            marks.push(line(Layer::Label, vec![leader.from, leader.to]));
            let dot = (0..8).map(|k| leader.to + DVec2::from_angle(f64::from(k) * FRAC_PI_4) * DOT_MM);
            marks.push(Mark::filled(Layer::Label, dot.collect(), stroke_of(Layer::Label).colour));
        }
        marks.extend(self.labels.iter().map(|label| label_mark(label, &stroke_of)));
        marks.into_iter().map(|mark| mark.of_piece(&self.name)).collect()
    }
}

impl Crease {
    fn layer(&self, side: Side) -> Layer {
        match (self.fold, side) {
            (Fold::Flat, _) => Layer::FoldHinge,
            (Fold::Seam, _) => Layer::Glue,
            (Fold::Back, Side::Outside) => Layer::Mountain,
            (Fold::Back, Side::Inside) => Layer::Valley,
        }
    }
}

fn label_mark(label: &Label, stroke_of: &impl Fn(Layer) -> Stroke) -> Mark {
    let layer = if label.kind == LabelKind::Joint { Layer::Glue } else { Layer::Label };
    let text = Text::new(&label.text, label.anchor, label.cap_height_mm)
        .aligned(Align::Middle)
        .turned(label.angle_rad)
        .coloured(stroke_of(layer).colour);
    Mark::text(layer, text)
}
