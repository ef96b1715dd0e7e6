//! PNG pictures of drawings, by tiny-skia.

use glam::DVec2;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform,
};

use crate::drawing::{Drawing, Polyline, Rgb, Shape, Stroke};

const MM_PER_INCH: f64 = 25.4;

/// Most pixels of a picture: an A0 sheet at 300 dpi.
const MAX_PIXELS: f64 = 140e6;

/// Why a picture cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PngError {
    /// No such picture can be made.
    #[error("{width} x {height} pixels is no usable size for a picture; change the resolution")]
    Size {
        /// Pixels across, as far as that is a number.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// The encoder failed.
    #[error("the picture could not be encoded: {0}")]
    Encoder(String),
    /// The drawing holds text, for which there is no font.
    #[error("the text \"{0}\" cannot be drawn without a font")]
    NoFont(String),
}

/// The drawing at a resolution, as the bytes of a PNG file. Without a ground it is transparent.
///
/// # Errors
/// [`PngError`] where the picture would have no or more than 140 million pixels.
pub fn render(drawing: &Drawing, dots_per_inch: f64) -> Result<Vec<u8>, PngError> {
    let pixmap = rasterise(drawing, dots_per_inch)?;
    pixmap
        .encode_png()
        .map_err(|error| PngError::Encoder(error.to_string()))
}

/// The drawing as pixels, for formats that hold several.
///
/// # Errors
/// As [`render`].
pub fn rasterise(drawing: &Drawing, dots_per_inch: f64) -> Result<Pixmap, PngError> {
    let dots_per_mm = dots_per_inch / MM_PER_INCH;
    let size = (drawing.size_mm * dots_per_mm).round();
    let bad_size = || PngError::Size {
        width: size.x,
        height: size.y,
    };
    if !(size.min_element() >= 1.0 && size.x * size.y <= MAX_PIXELS) {
        return Err(bad_size());
    }
    let mut pixmap = Pixmap::new(size.x as u32, size.y as u32).ok_or_else(bad_size)?;
    if let Some(Rgb(r, g, b)) = drawing.ground {
        pixmap.fill(Color::from_rgba8(r, g, b, 255));
    }
    let scale = dots_per_mm as f32;
    let page = Transform::from_row(scale, 0.0, 0.0, -scale, 0.0, size.y as f32);
    for mark in &drawing.marks {
        match &mark.shape {
            Shape::Path {
                contours,
                stroke,
                fill,
            } => {
                let Some(path) = path_of(contours) else {
                    continue;
                };
                if let Some(colour) = fill {
                    let rule = FillRule::EvenOdd;
                    pixmap.fill_path(&path, &paint(*colour), rule, page, None);
                }
                if let Some(stroke) = stroke {
                    let paint = paint(stroke.colour);
                    pixmap.stroke_path(&path, &paint, &pen(stroke), page, None);
                }
            }
            Shape::Text(text) => return Err(PngError::NoFont(text.content.clone())),
        }
    }
    Ok(pixmap)
}

fn paint(Rgb(r, g, b): Rgb) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, 255);
    paint.anti_alias = true;
    paint
}

/// Dashed lines have square ends, so that dashes keep their length; solid ones have round ends,
/// so that lines meet without notches.
fn pen(stroke: &Stroke) -> tiny_skia::Stroke {
    let mut dashes: Vec<f32> = stroke.dash_mm.iter().map(|&mm| mm as f32).collect();
    if dashes.len() % 2 == 1 {
        dashes.extend_from_within(..);
    }
    let dash = StrokeDash::new(dashes, 0.0);
    tiny_skia::Stroke {
        width: stroke.width_mm as f32,
        line_cap: if dash.is_some() {
            LineCap::Butt
        } else {
            LineCap::Round
        },
        line_join: LineJoin::Round,
        dash,
        ..tiny_skia::Stroke::default()
    }
}

/// None where there is nothing to draw.
fn path_of(contours: &[Polyline]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for contour in contours {
        for (k, &DVec2 { x, y }) in contour.points.iter().enumerate() {
            let (x, y) = (x as f32, y as f32);
            if k == 0 {
                builder.move_to(x, y);
            } else {
                builder.line_to(x, y);
            }
        }
        if contour.is_closed {
            builder.close();
        }
    }
    builder.finish()
}
