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
}

impl Look {
    /// Lines that suit a picture of this size: about 1 and 1.6 pixels at 640 pixels.
    pub fn for_size(size_mm: DVec2) -> Self {
        let pixel_mm = size_mm.max_element() / 640.0;
        Self { crease_mm: pixel_mm, outline_mm: 1.6 * pixel_mm }
    }
}

/// The width of the lines, in their own colour, that close the seams between filled neighbours,
/// relative to the picture's size: 1.5 pixels at 640 pixels. Those of 1 pixel let 7% of the ground
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
    let colour = light::shaded(colour, view.camera().direction(normal));
    let points: Vec<DVec2> = fragment.corners.iter().map(|&c| view.project(c)).collect();
    let stroke = |width_mm, colour| Stroke { width_mm, colour, dash_mm: Vec::new() };
    let mut lines = [Vec::new(), Vec::new()];
    for (k, edge) in fragment.edges.iter().enumerate() {
        let Some(edge) = edge.map(|e| face.edges()[e]) else {
            continue;
        };
        if let Some(weight) = weight(view, edge, fragment.corners[k], is_front) {
            let (a, b) = (points[k], points[(k + 1) % points.len()]);
            lines[weight as usize].push(Polyline::open(vec![a, b]));
        }
    }
    let outline = Polyline::closed(points);
    let seam = stroke(seam_mm, colour);
    marks.push(Mark::path(Layer::Picture, vec![outline], Some(seam), Some(colour)));
    let line_colour = light::line_on(colour);
    for (contours, width_mm) in lines.into_iter().zip([look.crease_mm, look.outline_mm]) {
        if !contours.is_empty() && width_mm > 0.0 {
            let line = stroke(width_mm, line_colour);
            marks.push(Mark::path(Layer::Picture, contours, Some(line), None));
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
