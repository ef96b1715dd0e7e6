//! The assembly guide: a web page, or printed pages.

use super::{ExportError, ExportFile, Format, FormatOptions, Source, pdf};
use crate::guide::{Guide, Language, html, leaflet};
use crate::product::Product;
use tatamu_core::units::Paper;

/// The web page.
pub const HTML: Format = Format {
    name: "html",
    extensions: &["html", "htm"],
    description: "assembly guide for phone, tablet and computer: one file that works offline",
    source: Source::Model(write_html),
};

/// The printed pages. A file name that ends in `.pdf` means sheets unless a guide is asked for, so
/// this format is not in the list of all.
pub const PDF: Format = Format {
    name: "guide",
    extensions: &["pdf"],
    description: "assembly guide for printing",
    source: Source::Model(write_pdf),
};

/// Formats of guides.
pub const GUIDES: &[Format] = &[HTML, PDF];

/// Guides are read on paper of these sizes; for larger and smaller sheets, on the usual one.
const SIDES_MM: std::ops::RangeInclusive<f64> = 200.0..=360.0;

/// Choices for guides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct GuideOptions {
    /// The language.
    pub language: Language,
}

fn guide(product: &Product<'_>, options: &FormatOptions, format: &Format) -> Result<Guide, ExportError> {
    let language = options.guide.language;
    let guide = Guide::new(product.output(), product.title(), product.styles(), language);
    guide.map_err(|error| ExportError::writer(format, error))
}

fn write_html(product: &Product<'_>, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let guide = guide(product, options, &HTML)?;
    Ok(vec![ExportFile::single(html(&guide).into_bytes())])
}

fn write_pdf(product: &Product<'_>, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let guide = guide(product, options, &PDF)?;
    let sheet = product.output().options().paper;
    let is_handy = [sheet.width_mm(), sheet.height_mm()].iter().all(|side| SIDES_MM.contains(side));
    let paper = if is_handy { sheet } else { Paper::default() };
    let pages = leaflet(&guide, paper).map_err(|error| ExportError::writer(&PDF, error))?;
    pdf::whole(&pages, options)
}
