//! PNG pictures of drawings.

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use tatamu_draw::drawing::{Drawing, Pages, Rgb};
pub use tatamu_draw::pixels::{PngError, of_raster, rasterise, render};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "png",
    extensions: &["png"],
    description: "PNG pictures, one file per sheet, to look at",
    source: Source::Pages(write),
};

/// Choices for PNG files of sheets.
///
/// # Guarantees
/// The resolution is from 10 to 2400 dots per inch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PngOptions {
    dots_per_inch: f64,
}

impl PngOptions {
    /// Resolutions that may be asked for.
    pub const DOTS_PER_INCH: std::ops::RangeInclusive<f64> = 10.0..=2400.0;

    /// The resolution.
    pub fn dots_per_inch(&self) -> f64 {
        self.dots_per_inch
    }

    /// Chooses the resolution.
    ///
    /// # Errors
    /// A message for one out of range.
    pub fn new(dots_per_inch: f64) -> Result<Self, String> {
        if Self::DOTS_PER_INCH.contains(&dots_per_inch) {
            return Ok(Self { dots_per_inch });
        }
        let (least, most) = (Self::DOTS_PER_INCH.start(), Self::DOTS_PER_INCH.end());
        Err(format!("the resolution must be from {least} to {most} dots per inch"))
    }
}

/// Small letters can be read.
impl Default for PngOptions {
    fn default() -> Self {
        Self { dots_per_inch: 150.0 }
    }
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    // Viewers show what is transparent as black or as a chequerboard.
    let on_paper = |sheet: &Drawing| Drawing { ground: Some(Rgb::WHITE), ..sheet.clone() };
    let file = |sheet| render(&on_paper(sheet), options.png.dots_per_inch);
    let files = pages.drawings().iter().map(file).collect::<Result<Vec<_>, _>>();
    files.map(ExportFile::of_pages).map_err(|error| ExportError::writer(&FORMAT, error))
}
