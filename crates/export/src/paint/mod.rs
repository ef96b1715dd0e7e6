//! The mesh's colours on panels: each point of a panel gets the colour of the nearest point of the
//! mesh's surface.

mod cards;
mod panel;

pub use cards::cards;
pub use panel::pictures;

use tatamu_draw::drawing::{Drawing, Layer, Mark, Rgb, Shape, Stroke, text};
use tatamu_pipeline::Output;
use tatamu_read::painting::Painting;

/// Width of the white line round letters on coloured panels, mm, so that they can be read.
const LETTER_HALO_MM: f64 = 0.8;
/// What is white on both sides of the other lines there, mm, but for cuts, which go away.
const LINE_HALO_MM: f64 = 0.15;
/// Straight pieces in the place of each curve of a letter's halo.
const CURVE_STEPS: usize = 4;

/// Puts the pictures of all panels under the marks of their sheets, and white halos under the
/// letters and lines on pieces.
pub fn colour(output: &Output, painting: &Painting, pages: &mut [Drawing]) {
    let mut under: Vec<Vec<Mark>> = vec![Vec::new(); pages.len()];
    for (sheet, picture) in pictures(output, painting) {
        under[sheet.0].push(picture);
    }
    for (page, pictures) in pages.iter_mut().zip(under) {
        let halos: Vec<Mark> = page.marks.iter().filter_map(halo).collect();
        let (tabs, above): (Vec<Mark>, Vec<Mark>) =
            std::mem::take(&mut page.marks).into_iter().partition(|mark| mark.layer == Layer::Tab);
        // Tabs first, since pictures reach on to them.
        page.marks = [tabs, pictures, halos, above].concat();
    }
}

fn halo(mark: &Mark) -> Option<Mark> {
    let piece = mark.piece.as_ref()?;
    let white = |width_mm| Stroke::solid(width_mm, Rgb::WHITE);
    let (contours, stroke) = match (&mark.shape, mark.layer) {
        (Shape::Text(text), _) => (text::contours(text, CURVE_STEPS), white(LETTER_HALO_MM)),
        (_, Layer::Cut | Layer::Slit | Layer::Tab | Layer::Picture) => return None,
        (Shape::Path { contours, stroke: Some(stroke), .. }, _) => {
            let dash_mm = stroke.dash_mm.clone();
            (contours.clone(), Stroke { dash_mm, ..white(stroke.width_mm + 2.0 * LINE_HALO_MM) })
        }
        _ => return None,
    };
    Some(Mark::path(Layer::Picture, contours, Some(stroke), None).of_piece(piece).of_part("halo"))
}
