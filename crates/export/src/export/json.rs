//! The report as a file.

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use crate::product::Product;
use crate::report;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "json",
    extensions: &["json"],
    description: "report: components, nets, sheets, warnings",
    source: Source::Model(write),
};

fn write(product: &Product<'_>, _: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let bytes = report::to_json(product.output(), product.run());
    let bytes = bytes.map_err(|error| ExportError::writer(&FORMAT, error))?;
    Ok(vec![ExportFile::single(bytes)])
}
