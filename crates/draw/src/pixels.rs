//! Drawings as pixels, by tiny-skia, and as PNG pictures.

use crate::drawing::text::{self, PathCommand};
use crate::drawing::{Drawing, Image, Polyline, Raster, Rgb, Shape, Stroke};
use glam::DVec2;
use png::{BitDepth, ColorType, Compression, Encoder, PixelDimensions, Unit};
use tatamu_core::units::MM_PER_INCH;
use tiny_skia::{
    Color, FillRule, FilterQuality, LineCap, LineJoin, Paint, Path, PathBuilder, Pattern, Pixmap, SpreadMode,
    StrokeDash, Transform,
};

/// Most pixels of a picture: an A0 sheet at 300 dots per inch.
const MAX_PIXELS: f64 = 140e6;

/// Why a picture cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PngError {
    /// No such picture can be made.
    #[error("{width} x {height} pixels is not a usable size for a picture; change the resolution")]
    Size {
        /// Pixels across, as far as that is a number.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// The encoder failed.
    #[error("cannot encode the picture: {0}")]
    Encoder(String),
}

/// The drawing at a resolution, as the bytes of a PNG file that states its size in metres. Without
/// a ground it is transparent.
///
/// # Errors
/// [`PngError`] where the picture would have no or more than 140 million pixels.
pub fn render(drawing: &Drawing, dots_per_inch: f64) -> Result<Vec<u8>, PngError> {
    let pixmap = rasterise(drawing, dots_per_inch)?;
    let is_opaque = drawing.ground.is_some();
    let pixels: Vec<u8> = if is_opaque {
        let opaque = pixmap.pixels().iter();
        opaque.flat_map(|p| [p.red(), p.green(), p.blue()]).collect()
    } else {
        let pixels = pixmap.pixels().iter().map(|p| p.demultiply());
        pixels.flat_map(|p| [p.red(), p.green(), p.blue(), p.alpha()]).collect()
    };
    let dots_per_metre = (dots_per_inch / MM_PER_INCH * 1000.0).round() as u32;
    let colour_type = if is_opaque { ColorType::Rgb } else { ColorType::Rgba };
    encode([pixmap.width(), pixmap.height()], colour_type, dots_per_metre, &pixels)
}

/// A raster as the bytes of a PNG file.
///
/// # Errors
/// [`PngError::Encoder`]; no raster is known that brings it about.
pub fn of_raster(raster: &Raster) -> Result<Vec<u8>, PngError> {
    let dots_per_metre = (1000.0 / raster.pixel_mm()).round() as u32;
    encode([raster.width(), raster.height()], ColorType::Rgb, dots_per_metre, &raster.rgb_bytes())
}

fn encode(
    [width, height]: [u32; 2],
    colour_type: ColorType,
    dots_per_metre: u32,
    pixels: &[u8],
) -> Result<Vec<u8>, PngError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(colour_type);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_pixel_dims(Some(PixelDimensions {
        xppu: dots_per_metre,
        yppu: dots_per_metre,
        unit: Unit::Meter,
    }));
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels)?;
        writer.finish()
    });
    written.map_err(|error| PngError::Encoder(error.to_string()))?;
    Ok(bytes)
}

/// The drawing as pixels, for formats that hold several.
///
/// # Errors
/// As [`render`].
pub fn rasterise(drawing: &Drawing, dots_per_inch: f64) -> Result<Pixmap, PngError> {
    let dots_per_mm = dots_per_inch / MM_PER_INCH;
    let size = (drawing.size_mm * dots_per_mm).round();
    let bad_size = || PngError::Size { width: size.x, height: size.y };
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
            Shape::Path { contours, stroke, fill } => {
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
            Shape::Text(text) => {
                if let Some(path) = path_of_letters(&text::outlines(text)) {
                    let rule = FillRule::Winding;
                    pixmap.fill_path(&path, &paint(text.colour), rule, page, None);
                }
            }
            Shape::Image(image) => draw_image(&mut pixmap, image, page),
        }
    }
    Ok(pixmap)
}

/// The clip's area filled with the pixels.
fn draw_image(pixmap: &mut Pixmap, image: &Image, page: Transform) {
    let raster = &image.raster;
    let clip = path_of(std::slice::from_ref(&image.clip));
    let (Some(mut source), Some(clip)) = (Pixmap::new(raster.width(), raster.height()), clip) else {
        return;
    };
    for (target, rgb) in source.data_mut().chunks_exact_mut(4).zip(raster.rgb_bytes().chunks_exact(3)) {
        target[..3].copy_from_slice(rgb);
        target[3] = u8::MAX;
    }
    let scale = raster.pixel_mm();
    let top_left = image.place.transform_point2(DVec2::Y * f64::from(raster.height()) * scale);
    let [right, down] = [image.place.matrix2.x_axis * scale, image.place.matrix2.y_axis * -scale];
    let [a, b, c, d] = [right.x, right.y, down.x, down.y].map(|value| value as f32);
    let place = Transform::from_row(a, b, c, d, top_left.x as f32, top_left.y as f32);
    let shader = Pattern::new(source.as_ref(), SpreadMode::Pad, FilterQuality::Bilinear, 1.0, place);
    let paint = Paint { shader, anti_alias: true, ..Paint::default() };
    pixmap.fill_path(&clip, &paint, FillRule::Winding, page, None);
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
        line_cap: if dash.is_some() { LineCap::Butt } else { LineCap::Round },
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

/// None where there is nothing to draw: text without letters.
fn path_of_letters(outlines: &[PathCommand]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    let flat = |p: DVec2| (p.x as f32, p.y as f32);
    for command in outlines {
        match *command {
            PathCommand::MoveTo(p) => {
                let (x, y) = flat(p);
                builder.move_to(x, y);
            }
            PathCommand::LineTo(p) => {
                let (x, y) = flat(p);
                builder.line_to(x, y);
            }
            PathCommand::QuadTo(a, p) => {
                let ((ax, ay), (x, y)) = (flat(a), flat(p));
                builder.quad_to(ax, ay, x, y);
            }
            PathCommand::CubicTo(a, b, p) => {
                let ((ax, ay), (bx, by), (x, y)) = (flat(a), flat(b), flat(p));
                builder.cubic_to(ax, ay, bx, by, x, y);
            }
            PathCommand::Close => builder.close(),
        }
    }
    builder.finish()
}
