//! Files to take home.

use crate::desk::Desk;
use serde::Serialize;
use tatamu::export::{FORMATS, Format, FormatOptions, GUIDES, format_among};
use tatamu::front::words;
use tatamu::product::Product;

/// A format that can be downloaded.
#[derive(Serialize)]
pub struct FormatRow {
    /// Its extension, after `guide.` for a guide.
    id: String,
    description: &'static str,
}

/// The formats that can be downloaded.
pub fn formats() -> Vec<FormatRow> {
    let row = |prefix: &str, format: &Format| FormatRow {
        id: format!("{prefix}{}", format.extensions[0]),
        description: format.description,
    };
    let guides = GUIDES.iter().map(|format| row(GUIDE, format));
    // Jobs are for a machine, which is chosen where they are plotted; a guide is there once.
    let is_guide = |format: &Format| GUIDES.iter().any(|guide| guide.description == format.description);
    let files = FORMATS.iter().filter(|format| !format.is_job() && !is_guide(format));
    guides.chain(files.map(|format| row("", format))).collect()
}

/// Before the extension of a guide.
const GUIDE: &str = "guide.";

/// The files of a format, by their names.
///
/// # Errors
/// A message where the model is not finished or cannot be written.
pub fn files(desk: &Desk, id: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
    let output = desk.finished().ok_or("the model is not finished yet; try again in a moment")?;
    let (list, extension, end) = match id.strip_prefix(GUIDE) {
        Some(extension) => (GUIDES, extension, "-guide"),
        None => (FORMATS, id, ""),
    };
    let format = format_among(list, extension).ok_or_else(|| format!("there is no format {id}"))?;
    let write = |product: Product<'_>, options: FormatOptions| format.write(&product, &options);
    let written = desk.opened.with_product(desk.document.project(), output, write);
    let files = written.and_then(|files| Ok(files?)).map_err(|error| words::error(&error))?;
    let title = desk.opened.title();
    let name = |suffix: &str| format!("{title}{end}{suffix}.{extension}");
    Ok(files.into_iter().map(|file| (name(&file.suffix), file.bytes)).collect())
}

/// The sheets as SVG.
///
/// # Errors
/// A message where they cannot be drawn.
pub fn sheets(desk: &Desk) -> Result<Vec<String>, String> {
    let output = desk.laid().ok_or("the sheets are not laid out yet")?;
    let format = format_among(FORMATS, "svg").ok_or("there is no format svg")?;
    let write = |product: Product<'_>, options: FormatOptions| format.write(&product, &options);
    let written = desk.opened.with_product(desk.document.project(), output, write);
    let files = written.and_then(|files| Ok(files?)).map_err(|error| words::error(&error))?;
    Ok(files.into_iter().map(|file| String::from_utf8_lossy(&file.bytes).into_owned()).collect())
}
