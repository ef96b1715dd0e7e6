//! Files for cutters and plotters in their own language, one a sheet.

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use tatamu_draw::drawing::Pages;
use tatamu_plot::plotter::{Cutter, Media, Plan, PlanError};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "plt",
    extensions: &["plt", "hpgl"],
    description: "for cutters and plotters (HP-GL, GP-GL, DM/PL), one file per sheet",
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
    let file = |(index, drawing)| match Plan::new(drawing, cutter, media) {
        Ok(plan) => Ok(plan.bytes().to_vec()),
        Err(PlanError::Nothing) => Ok(Vec::new()),
        Err(error) => Err(ExportError::Plan { sheet: index + 1, error }),
    };
    let files: Result<Vec<Vec<u8>>, ExportError> = pages.drawings().iter().enumerate().map(file).collect();
    let mut files = ExportFile::of_pages(files?);
    // Sheets that only have words on them are no jobs; the others keep their numbers.
    files.retain(|file| !file.bytes.is_empty());
    if files.is_empty() {
        return Err(ExportError::writer(&FORMAT, PlanError::Nothing.to_string()));
    }
    Ok(files)
}
