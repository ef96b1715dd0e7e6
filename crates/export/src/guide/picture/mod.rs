//! The pictures of the steps, by the 3D renderer: what is there is grey, what is new has its colour.

mod build;
mod join;
mod lens;
mod overlay;
mod paper;
mod whole;

pub use build::{folded, glued};
pub use join::joined;
pub use paper::{net, sheet_map, sheets_of};
pub use whole::{deploying, flattening, frames, pulling};

use glam::DVec2;
use tatamu_draw::drawing::{Drawing, Mark, Rgb};
use tatamu_draw::render::{Look, Scene, View, ViewError, picture, seen};

/// Size of a step's picture, mm.
pub const SIZE_MM: DVec2 = DVec2::new(84.0, 63.0);
/// Free border of pictures, which has room for labels at their edge, mm.
const MARGIN_MM: f64 = 6.0;
/// Colours must be told apart in the shade, too.
const RELIEF: f64 = 0.6;
/// What is there.
const THERE: Rgb = Rgb(214, 214, 218);
/// Where glue goes.
const GLUED: Rgb = Rgb(255, 226, 120);

/// A scene with marks over it; faces that are not seen are left out.
pub(super) fn taken(scene: &Scene, view: &View, over: Vec<Mark>) -> Drawing {
    let look = Look { relief: RELIEF, ..Look::for_size(view.size_mm()) };
    let mut drawing = picture(scene, view, &look, None, Vec::new());
    drawing.marks = seen(drawing.marks, view.size_mm());
    drawing.marks.extend(over);
    drawing
}

/// Why there is no picture; no model is known that brings one about.
pub type PictureError = ViewError;
