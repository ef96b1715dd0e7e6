//! Files for cutters and plotters in their own language, one a sheet.

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use tatamu_draw::drawing::Pages;
use tatamu_plot::plotter::profile::CUTTERS;
use tatamu_plot::plotter::{Cutter, Media, Plan, PlanError};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "plt",
    extensions: &["plt", "hpgl"],
    description: "for cutters and plotters (HP-GL, GP-GL, DM/PL, EBB), one file per sheet",
    source: Source::Pages(|pages, options| write(&FORMAT, pages, options)),
};

/// The registry's entry for G-code.
pub const GCODE: Format = Format {
    name: "gcode",
    extensions: &["gcode", "nc"],
    description: "for lasers, drag knives and pen plotters with GRBL, one file per sheet",
    source: Source::Pages(|pages, options| write(&GCODE, pages, options)),
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

fn write(format: &Format, pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let PltOptions { cutter, media } = &options.plt;
    let language = cutter.dialect().name();
    if (language == GCODE.name) != (format.name == GCODE.name) {
        let cutter = cutter.name().to_owned();
        return Err(ExportError::Language {
            format: format.name,
            cutter,
            language,
            such_as: such_as(format),
        });
    }
    let file = |(index, drawing)| match Plan::new(drawing, cutter, media) {
        Ok(plan) => Ok(plan.bytes().to_vec()),
        Err(PlanError::Nothing) => Ok(Vec::new()),
        Err(error) => Err(ExportError::Plan { format: format.name, page: index + 1, error }),
    };
    let files: Result<Vec<Vec<u8>>, ExportError> = pages.drawings().iter().enumerate().map(file).collect();
    let mut files = ExportFile::of_pages(files?);
    // Sheets that only have words on them are no jobs; the others keep their numbers.
    files.retain(|file| !file.bytes.is_empty());
    if files.is_empty() {
        return Err(ExportError::writer(format, PlanError::Nothing.to_string()));
    }
    Ok(files)
}

/// The cutters that a format is for.
fn such_as(format: &Format) -> String {
    let is_gcode = |name: &str| name.starts_with("grbl");
    let names = CUTTERS.iter().map(|profile| profile.name);
    let names: Vec<&str> = names.filter(|name| is_gcode(name) == (format.name == GCODE.name)).collect();
    names.join(", ")
}
