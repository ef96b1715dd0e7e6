//! The mesh's colours on panels: each point of a panel gets the colour of the nearest point of the
//! mesh's surface.

mod nearest;
mod panel;

pub use panel::pictures;

use crate::drawing::{Drawing, Layer, Mark, Rgb, Shape, Stroke, text};
use crate::mesh::painting::Painting;
use crate::pipeline::Output;

/// Width of the white line round letters on coloured panels, mm, so that they can be read.
const HALO_MM: f64 = 0.8;
/// Straight pieces in the place of each curve of a letter's halo.
const CURVE_STEPS: usize = 4;

/// Puts the pictures of all panels under the marks of their sheets, and white halos under the
/// letters on pieces.
pub fn colour(output: &Output, painting: &Painting, pages: &mut [Drawing]) {
    let mut under: Vec<Vec<Mark>> = vec![Vec::new(); pages.len()];
    for (sheet, picture) in pictures(output, painting) {
        under[sheet].push(picture);
    }
    for (page, mut marks) in pages.iter_mut().zip(under) {
        marks.extend(page.marks.iter().filter_map(halo));
        marks.append(&mut page.marks);
        page.marks = marks;
    }
}

fn halo(mark: &Mark) -> Option<Mark> {
    let (Shape::Text(text), Some(piece)) = (&mark.shape, &mark.piece) else {
        return None;
    };
    let stroke = Stroke { width_mm: HALO_MM, colour: Rgb::WHITE, dash_mm: Vec::new() };
    let contours = text::contours(text, CURVE_STEPS);
    Some(Mark::path(Layer::Picture, contours, Some(stroke), None).of_piece(piece).of_part("halo"))
}
