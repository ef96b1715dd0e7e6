//! What a piece looks like on paper.

use super::mesh::EdgeKind;
use super::{FaceKind, LabelKind, Piece};
use crate::component::PanelSet;
use crate::drawing::{Align, Layer, Mark, Polyline, Stroke, Text};
use glam::DVec2;

/// A crease to draw: a hinge that stays joined, or the base of a tab.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Crease {
    ends: [DVec2; 2],
    is_fold: bool,
    deployed_rad: f64,
    /// The panels on both sides, in short.
    between: String,
}

impl Crease {
    pub(crate) fn direction(&self) -> DVec2 {
        (self.ends[1] - self.ends[0]).normalize_or(DVec2::X)
    }

    pub(crate) fn length_mm(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }
}

/// The creases of a piece's mesh.
pub(crate) fn creases(set: &PanelSet, mesh: &super::PieceMesh) -> Vec<Crease> {
    mesh.edges()
        .iter()
        .filter_map(|edge| match edge.kind {
            EdgeKind::Hinge(h) | EdgeKind::Tab(h) => {
                let hinge = set.hinges()[h.0];
                Some(Crease {
                    ends: mesh.segment(edge),
                    is_fold: hinge.is_fold,
                    deployed_rad: hinge.deployed_rad,
                    between: between(set, mesh, &edge.faces),
                })
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

/// What is drawn of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarkOptions {
    /// Creases that are folded by less, when deployed, are not drawn; fold hinges always are.
    pub hide_below_rad: f64,
}

impl Default for MarkOptions {
    fn default() -> Self {
        Self { hide_below_rad: 0.0 }
    }
}

impl Piece {
    /// The piece's marks in its own coordinates: the contour as one closed path, every cut line
    /// once, creases, joint outlines, texts. `stroke_of` gives the look of each layer.
    pub fn marks(&self, options: MarkOptions, stroke_of: impl Fn(Layer) -> Stroke) -> Vec<Mark> {
        let path = |layer: Layer, contour: Polyline, part: String| {
            Mark::path(layer, vec![contour], Some(stroke_of(layer)), None).of_piece(&*self.name).of_part(part)
        };
        let closed = |points: &[DVec2]| Polyline::closed(points.to_vec());
        let mut marks = Vec::new();
        for joint in &self.joints {
            let panel = self.panels.iter().find(|p| p.panel == joint.panel);
            let panel = panel.map_or_else(String::new, |p| p.kind.short_name());
            marks.push(path(Layer::Glue, closed(&joint.outline), panel.clone()));
            marks.push(path(Layer::Glue, closed(&joint.key), format!("{panel} key")));
        }
        for crease in &self.crease_lines {
            let layer = if crease.is_fold { Layer::FoldHinge } else { Layer::Mountain };
            if crease.is_fold || crease.deployed_rad >= options.hide_below_rad {
                marks.push(path(layer, Polyline::open(crease.ends.to_vec()), crease.between.clone()));
            }
        }
        for slit in &self.slits {
            marks.push(path(Layer::Slit, Polyline::open(slit.clone()), "inside".to_owned()));
        }
        marks.push(path(Layer::Cut, closed(&self.outline), "outline".to_owned()));
        for label in &self.labels {
            let layer = if label.kind == LabelKind::Joint { Layer::Glue } else { Layer::Label };
            let text = Text::new(&*label.text, label.anchor, label.cap_height_mm)
                .aligned(Align::Middle)
                .turned(label.angle_rad)
                .coloured(stroke_of(layer).colour);
            marks.push(Mark::text(layer, text).of_piece(&*self.name).of_part(&*label.text));
        }
        marks
    }
}
