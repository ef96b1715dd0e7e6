//! A scene, seen in a view, as a drawing.

use glam::{DVec2, DVec3};

use super::bsp::{self, Fragment};
use super::light;
use super::scene::{Edge, Scene};
use super::view::View;
use crate::drawing::{Drawing, Layer, Mark, Polyline, Rgb, Stroke};

/// Widths of lines; 0 leaves them out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// Creases, mm.
    pub crease_mm: f64,
    /// Borders and silhouettes, mm.
    pub outline_mm: f64,
    /// How much the light tells, from 0, where faces have their own colours, to 1.
    pub relief: f64,
}

impl Look {
    /// Lines that suit a picture of this size: about 1 and 1.6 pixels at 640 pixels.
    pub fn for_size(size_mm: DVec2) -> Self {
        let pixel_mm = size_mm.max_element() / 640.0;
        Self { crease_mm: pixel_mm, outline_mm: 1.6 * pixel_mm, relief: 1.0 }
    }
}

/// The width of the lines, in their own colour, that close the seams between filled neighbours
/// where no other line does (and would be painted over), relative to the picture's size: 1.5 pixels at 640 pixels. Those of 1 pixel let 7% of the ground
/// shine through.
const SEAM_SHARE: f64 = 1.5 / 640.0;

/// Draws what is to be seen, farthest first, over the marks of `under` (a shadow, say). The ground
/// is transparent where it is none.
pub fn picture(scene: &Scene, view: &View, look: &Look, ground: Option<Rgb>, under: Vec<Mark>) -> Drawing {
    let seam_mm = view.size_mm().max_element() * SEAM_SHARE;
    let mut marks = under;
    for fragment in bsp::back_to_front(scene, view) {
        draw(scene, view, look, seam_mm, &fragment, &mut marks);
    }
    Drawing { ground, marks, ..Drawing::new("", view.size_mm()) }
}

fn draw(scene: &Scene, view: &View, look: &Look, seam_mm: f64, fragment: &Fragment, marks: &mut Vec<Mark>) {
    let face = &scene.faces()[fragment.face];
    let is_front = bsp::is_seen_from_front(scene, view, fragment.face);
    let side = if is_front {
        Some((face.front(), face.normal()))
    } else {
        face.back().map(|back| (back, -face.normal()))
    };
    let Some((colour, normal)) = side else {
        return;
    };
    let lit = light::shaded(colour, view.camera().direction(normal));
    let colour = light::mixed(colour, lit, look.relief);
    let points: Vec<DVec2> = fragment.corners.iter().map(|&c| view.project(c)).collect();
    let widths_mm = [look.crease_mm, look.outline_mm];
    let (mut lines, mut seams) = ([Vec::new(), Vec::new()], Vec::new());
    for (k, edge) in fragment.edges.iter().enumerate() {
        let edge = edge.map(|e| face.edges()[e]);
        let weight = edge.and_then(|edge| weight(view, edge, fragment.corners[k], is_front));
        let line = Polyline::open(vec![points[k], points[(k + 1) % points.len()]]);
        match weight.map(|w| w as usize).filter(|&w| widths_mm[w] > 0.0) {
            Some(weight) => lines[weight].push(line),
            None => seams.push(line),
        }
    }
    marks.push(Mark::path(Layer::Picture, vec![Polyline::closed(points)], None, Some(colour)));
    let line_colour = light::line_on(colour);
    let [creases, outlines] = lines;
    for (contours, width_mm, colour) in [
        (seams, seam_mm, colour),
        (creases, look.crease_mm, line_colour),
        (outlines, look.outline_mm, line_colour),
    ] {
        if !contours.is_empty() {
            marks.push(Mark::path(Layer::Picture, contours, Some(Stroke::solid(width_mm, colour)), None));
        }
    }
}

#[derive(Clone, Copy)]
enum Weight {
    Crease,
    Outline,
}

/// How an edge is drawn; `start` is a point of it.
fn weight(view: &View, edge: Edge, start: DVec3, is_front: bool) -> Option<Weight> {
    let is_silhouette = |across: DVec3| (view.towards_eye(start).dot(across) > 0.0) != is_front;
    match edge {
        Edge::Border => Some(Weight::Outline),
        Edge::Smooth(across) | Edge::Crease(across) if is_silhouette(across) => Some(Weight::Outline),
        Edge::Smooth(_) => None,
        Edge::Crease(_) => Some(Weight::Crease),
    }
}
