//! What a piece looks like on paper.

use super::mesh::EdgeKind;
use super::{LabelKind, Piece};
use crate::component::PanelSet;
use crate::drawing::{Align, Layer, Mark, Polyline, Shape, Stroke, Text};
use glam::DVec2;

/// A crease to draw: a hinge that stays joined, or the base of a tab.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Crease {
    ends: [DVec2; 2],
    is_fold: bool,
    deployed_rad: f64,
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
                })
            }
            _ => None,
        })
        .collect()
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
        let path = |layer: Layer, contours: Vec<Polyline>| Mark {
            layer,
            piece: Some(self.name.clone()),
            shape: Shape::Path { contours, stroke: Some(stroke_of(layer)), fill: None },
        };
        let closed = |points: &[DVec2]| Polyline { points: points.to_vec(), is_closed: true };
        let mut marks = Vec::new();
        for joint in &self.joints {
            marks.push(path(Layer::Glue, vec![closed(&joint.outline)]));
            marks.push(path(Layer::Glue, vec![closed(&joint.key)]));
        }
        for crease in &self.crease_lines {
            let layer = if crease.is_fold { Layer::FoldHinge } else { Layer::Mountain };
            if crease.is_fold || crease.deployed_rad >= options.hide_below_rad {
                let line = Polyline { points: crease.ends.to_vec(), is_closed: false };
                marks.push(path(layer, vec![line]));
            }
        }
        for slit in &self.slits {
            let line = Polyline { points: slit.clone(), is_closed: false };
            marks.push(path(Layer::Slit, vec![line]));
        }
        marks.push(path(Layer::Cut, vec![closed(&self.outline)]));
        for label in &self.labels {
            let layer = if label.kind == LabelKind::Joint { Layer::Glue } else { Layer::Label };
            marks.push(Mark {
                layer,
                piece: Some(self.name.clone()),
                shape: Shape::Text(Text {
                    content: label.text.clone(),
                    anchor: label.anchor,
                    cap_height_mm: label.cap_height_mm,
                    angle_rad: label.angle_rad,
                    align: Align::Middle,
                    colour: stroke_of(layer).colour,
                }),
            });
        }
        marks
    }
}
