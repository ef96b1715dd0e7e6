//! Animated PNG of the folding, in full colour.

use super::{ExportError, ExportFile, Format, FormatOptions, Source, film};
use crate::product::Product;
use crate::show::Film;
use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, EncodingError};
use tiny_skia::Pixmap;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "apng",
    extensions: &["apng"],
    description: "animation of the folding in full colour, for browsers",
    source: Source::Model(write),
};

fn write(product: &Product<'_>, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    film::write(&FORMAT, product, options, encode)
}

/// Part of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Part {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
}

/// The film as the bytes of an APNG file that runs for ever.
fn encode(film: &Film) -> Result<Vec<u8>, EncodingError> {
    let [width, height] = film.pictures().first().map_or([1, 1], |p| [p.width(), p.height()]);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_animated(film.shots().len() as u32, 0)?;
    encoder.set_blend_op(BlendOp::Source)?;
    encoder.set_dispose_op(DisposeOp::None)?;
    let mut writer = encoder.write_header()?;
    let mut before: Option<&Pixmap> = None;
    for shot in film.shots() {
        let picture = &film.pictures()[shot.picture];
        let part = before.map_or(Part { left: 0, top: 0, width, height }, |b| changed(picture, b));
        // The first frame is the whole picture, so that its place need not be set.
        if before.is_some() {
            writer.reset_frame_position()?;
            writer.set_frame_dimension(part.width, part.height)?;
            writer.set_frame_position(part.left, part.top)?;
        }
        writer.set_frame_delay(shot.duration_ms.min(u32::from(u16::MAX)) as u16, 1000)?;
        writer.write_image_data(&pixels(picture, part))?;
        before = Some(picture);
    }
    writer.finish()?;
    Ok(bytes)
}

fn pixels(picture: &Pixmap, part: Part) -> Vec<u8> {
    let row = |y: u32| {
        let start = (y * picture.width() + part.left) as usize;
        &picture.pixels()[start..start + part.width as usize]
    };
    let rows = (part.top..part.top + part.height).flat_map(row);
    rows.flat_map(|p| [p.red(), p.green(), p.blue()]).collect()
}

/// The smallest part that holds what differs; one pixel where nothing does.
fn changed(picture: &Pixmap, before: &Pixmap) -> Part {
    let width = picture.width() as usize;
    let pairs = picture.pixels().iter().zip(before.pixels()).enumerate();
    let places: Vec<usize> = pairs.filter(|(_, (a, b))| a != b).map(|(k, _)| k).collect();
    let columns = || places.iter().map(|k| k % width);
    let (left, right) = (columns().min().unwrap_or(0), columns().max().unwrap_or(0));
    let row = |k: Option<&usize>| k.map_or(0, |k| k / width);
    let (top, bottom) = (row(places.first()), row(places.last()));
    Part {
        left: left as u32,
        top: top as u32,
        width: (right - left + 1) as u32,
        height: (bottom - top + 1) as u32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_changed_part_is_written() {
        let before = Pixmap::new(8, 6).unwrap();
        let mut now = before.clone();
        now.data_mut()[4 * (2 * 8 + 3)] = 255;
        now.data_mut()[4 * (4 * 8 + 5)] = 255;
        assert_eq!(changed(&now, &before), Part { left: 3, top: 2, width: 3, height: 3 });
        assert_eq!(changed(&now, &now), Part { left: 0, top: 0, width: 1, height: 1 });
    }
}
