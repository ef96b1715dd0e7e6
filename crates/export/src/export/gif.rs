//! Animated GIF of the folding: one palette for all frames, and of each frame only what changes.

use super::{ExportError, ExportFile, Format, FormatOptions, Source, film};
use crate::product::Product;
use crate::show::Film;
use color_quant::NeuQuant;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeMap;
use tiny_skia::Pixmap;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "gif",
    extensions: &["gif"],
    description: "animation of the folding, for web pages and messages",
    source: Source::Model(write),
};

/// The last colour of the palette stands for "as before".
const TRANSPARENT: u8 = 255;
/// Number of the most frequent colours that are kept exactly: the ground, and panels at rest.
const EXACT: usize = 96;
/// About how many pixels the palette is computed from.
const SAMPLES: usize = 400_000;

fn write(product: &Product<'_>, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    film::write(&FORMAT, product, options, encode)
}

/// The film as the bytes of a GIF file that runs for ever.
fn encode(film: &Film) -> Result<Vec<u8>, ::gif::EncodingError> {
    let palette = Palette::of(film.pictures());
    let indexed: Vec<Vec<u8>> = film.pictures().par_iter().map(|p| palette.indices(p)).collect();
    let [width, height] =
        film.pictures().first().map_or([1, 1], |p| [p.width(), p.height()].map(|side| side as u16));
    let mut bytes = Vec::new();
    let mut encoder = ::gif::Encoder::new(&mut bytes, width, height, &palette.rgb())?;
    encoder.set_repeat(::gif::Repeat::Infinite)?;
    let mut before: Option<&[u8]> = None;
    for shot in film.shots() {
        let picture = &indexed[shot.picture];
        let mut frame = changed(picture, before, usize::from(width));
        // Hundredths of a second.
        frame.delay = (shot.duration_ms as f64 / 10.0).round() as u16;
        encoder.write_frame(&frame)?;
        before = Some(picture);
    }
    drop(encoder);
    Ok(bytes)
}

/// The smallest rectangle that holds what differs from the frame before; what is the same in it is
/// transparent.
fn changed<'a>(picture: &'a [u8], before: Option<&[u8]>, width: usize) -> ::gif::Frame<'a> {
    let mut frame = ::gif::Frame { dispose: ::gif::DisposalMethod::Keep, ..::gif::Frame::default() };
    let Some(before) = before else {
        frame.width = width as u16;
        frame.height = (picture.len() / width) as u16;
        frame.buffer = Cow::Borrowed(picture);
        return frame;
    };
    let differs = |k: &usize| picture[*k] != before[*k];
    let places: Vec<usize> = (0..picture.len()).filter(differs).collect();
    let columns = || places.iter().map(|k| k % width);
    let (left, right) = (columns().min().unwrap_or(0), columns().max().unwrap_or(0));
    let row = |k: Option<&usize>| k.map_or(0, |k| k / width);
    let (top, bottom) = (row(places.first()), row(places.last()));
    let pixel = |k: usize| if picture[k] == before[k] { TRANSPARENT } else { picture[k] };
    let rows = (top..=bottom).flat_map(|row| (left..=right).map(move |column| row * width + column));
    frame.buffer = rows.map(pixel).collect();
    frame.transparent = Some(TRANSPARENT);
    (frame.left, frame.top) = (left as u16, top as u16);
    (frame.width, frame.height) = ((right - left + 1) as u16, (bottom - top + 1) as u16);
    frame
}

/// 255 colours for all pictures of a film.
struct Palette {
    colours: Vec<[u8; 3]>,
}

impl Palette {
    /// The most frequent colours, and others that a neural net finds (Dekker 1994).
    fn of(pictures: &[Pixmap]) -> Self {
        let count: usize = pictures.iter().map(|p| p.pixels().len()).sum();
        let step = (count / SAMPLES).max(1);
        let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
        let samples = pictures.iter().flat_map(|p| p.pixels().iter()).step_by(step);
        samples.for_each(|p| *counts.entry([p.red(), p.green(), p.blue()]).or_default() += 1);
        let mut frequent: Vec<([u8; 3], usize)> = counts.into_iter().collect();
        frequent.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        let most = usize::from(TRANSPARENT);
        let exact = if frequent.len() <= most { frequent.len() } else { EXACT };
        let mut colours: Vec<[u8; 3]> = frequent[..exact].iter().map(|c| c.0).collect();
        let rest: Vec<u8> = frequent[exact..].iter().flat_map(|([r, g, b], _)| [*r, *g, *b, 255]).collect();
        if !rest.is_empty() {
            let net = NeuQuant::new(1, most - exact, &rest);
            colours.extend(net.color_map_rgb().chunks_exact(3).map(|c| [c[0], c[1], c[2]]));
        }
        colours.resize(most, [0; 3]);
        Self { colours }
    }

    fn rgb(&self) -> Vec<u8> {
        let last = [0; 3];
        self.colours.iter().chain(std::iter::once(&last)).flatten().copied().collect()
    }

    fn nearest(&self, colour: [u8; 3]) -> u8 {
        let distance = |own: &[u8; 3]| -> i32 {
            own.iter().zip(colour).map(|(a, b)| (i32::from(*a) - i32::from(b)).pow(2)).sum()
        };
        let best = (0..self.colours.len()).min_by_key(|&k| distance(&self.colours[k]));
        best.unwrap_or(0) as u8
    }

    fn indices(&self, picture: &Pixmap) -> Vec<u8> {
        let mut known: BTreeMap<[u8; 3], u8> = BTreeMap::new();
        let mut last = ([0; 3], self.nearest([0; 3]));
        let index = |p: &tiny_skia::PremultipliedColorU8| {
            let colour = [p.red(), p.green(), p.blue()];
            if colour != last.0 {
                last = (colour, *known.entry(colour).or_insert_with(|| self.nearest(colour)));
            }
            last.1
        };
        picture.pixels().iter().map(index).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_changes_is_written() {
        let before = [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1];
        let now = [1, 1, 1, 1, 1, 2, 1, 1, 1, 1, 3, 1];
        let frame = changed(&now, Some(&before), 4);
        assert_eq!((frame.left, frame.top, frame.width, frame.height), (1, 1, 2, 2));
        assert_eq!(&frame.buffer[..], [2, TRANSPARENT, TRANSPARENT, 3]);
        assert_eq!(changed(&now, None, 4).buffer.len(), 12);
        let same = changed(&now, Some(&now), 4);
        assert_eq!((same.width, same.height, &same.buffer[..]), (1, 1, &[TRANSPARENT][..]));
    }

    #[test]
    fn few_colours_stay_what_they_are() {
        let mut picture = Pixmap::new(16, 16).unwrap();
        picture.fill(tiny_skia::Color::from_rgba8(250, 240, 30, 255));
        let palette = Palette::of(std::slice::from_ref(&picture));
        assert_eq!(palette.colours[usize::from(palette.nearest([250, 240, 30]))], [250, 240, 30]);
        assert_eq!(palette.rgb().len(), 3 * 256);
        assert!(palette.indices(&picture).iter().all(|&k| k == 0));
    }
}
