//! Files for cutters and plotters in their own language, one a sheet.

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use crate::drawing::Pages;
use crate::plotter::{Cutter, Media, Plan};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "plt",
    extensions: &["plt", "hpgl"],
    description: "for cutters and plotters (HP-GL, GP-GL, DM/PL), one file a sheet; see --cutter",
    source: Source::Pages(write),
};

/// The machine and the medium.
#[derive(Debug, Clone, PartialEq)]
pub struct PltOptions {
    /// The machine.
    pub cutter: Cutter,
    /// What is worked on.
    pub media: Media,
}

impl Default for PltOptions {
    fn default() -> Self {
        Self { cutter: Cutter::generic(), media: Media::usual() }
    }
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let PltOptions { cutter, media } = &options.plt;
    let file = |(index, drawing)| {
        let plan = Plan::new(drawing, cutter, media);
        let plan =
            plan.map_err(|error| ExportError::writer(&FORMAT, format!("sheet {}: {error}", index + 1)))?;
        Ok(plan.bytes().to_vec())
    };
    let files: Result<Vec<Vec<u8>>, ExportError> = pages.drawings().iter().enumerate().map(file).collect();
    files.map(ExportFile::of_pages)
}
