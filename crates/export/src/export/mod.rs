//! File formats, one file each, registered in one list.
//!
//! A format's function turns a finished model, or no more than its pages, into the bytes of files.
//! Nothing is computed for a format that is not asked for. Adding a format is one file and one line
//! in [`FORMATS`]; one with choices of its own adds their type to [`FormatOptions`].

mod apng;
mod dxf;
mod fcm;
mod film;
#[cfg(test)]
mod fixture;
pub mod fold;
mod gif;
pub mod glb;
pub mod gltf;
mod guide;
mod json;
mod lbrn;
mod obj;
mod options;
mod pdf;
mod plt;
pub mod png;
mod prism;
mod stl;
mod svg;

pub use dxf::{DxfOptions, DxfSheets, DxfVersion};
pub use fold::{FoldOptions, PoseCount};
pub use glb::GlbOptions;
pub use guide::{GUIDES, GuideOptions};
pub use options::{FormatOptions, TextMode};
pub use pdf::{PdfOptions, Timestamp};
pub use plt::PltOptions;
pub use png::PngOptions;
pub use svg::{SvgOptions, SvgStroke};

use crate::guide::overview;
use crate::product::Product;
use std::collections::BTreeSet;
use tatamu_core::remedy::Remedy;
use tatamu_draw::drawing::{Pages, PagesError};
use tatamu_plot::plotter::PlanError;

/// Distance between sheets side by side in one drawing, mm.
const SHEET_GAP_MM: f64 = 20.0;

/// All formats, in the order of help texts.
pub const FORMATS: &[Format] = &[
    pdf::FORMAT,
    svg::FORMAT,
    dxf::FORMAT,
    png::FORMAT,
    plt::FORMAT,
    plt::GCODE,
    lbrn::FORMAT,
    fcm::FORMAT,
    gif::FORMAT,
    apng::FORMAT,
    glb::FORMAT,
    obj::FORMAT,
    stl::FORMAT,
    fold::FORMAT,
    guide::HTML,
    json::FORMAT,
];

/// What cannot be exported.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// The sheets cannot be drawn.
    #[error(transparent)]
    Pages(#[from] PagesError),
    /// A library could not write the file.
    #[error("cannot write the {format} file: {message}")]
    Writer {
        /// Name of the format.
        format: &'static str,
        /// What the library said.
        message: String,
    },
    /// A sheet cannot be worked on by the machine.
    #[error("the {format} file could not be written: sheet {page}: {error}")]
    Plan {
        /// Name of the format.
        format: &'static str,
        /// Its page, from 1.
        page: usize,
        /// Why.
        error: PlanError,
    },
    /// The machine speaks another language than the file is in.
    #[error(
        "a {format} file is not for {cutter}, whose language is {language}; choose one of these cutters: {such_as}"
    )]
    Language {
        /// Name of the format.
        format: &'static str,
        /// Name of the machine.
        cutter: String,
        /// Its language.
        language: &'static str,
        /// Machines that the format is for.
        such_as: String,
    },
}

impl ExportError {
    /// What can be done, where the text does not say so.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::Plan { error, .. } => error.remedies(),
            Self::Pages(_) | Self::Writer { .. } | Self::Language { .. } => Vec::new(),
        }
    }

    /// What a library said when it was to write this format.
    pub fn writer(format: &Format, message: impl ToString) -> Self {
        Self::Writer { format: format.name, message: message.to_string() }
    }
}

/// One file of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportFile {
    /// What stands between the stem and the extension of the name that the user gave: nothing, or
    /// `-1` for page 1.
    pub suffix: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl ExportFile {
    /// The only file of an export.
    pub fn single(bytes: Vec<u8>) -> Self {
        Self { suffix: String::new(), bytes }
    }

    /// The files of things with names, of which letters and digits stay. Numbers tell apart those that would be one
    /// file, as on Windows those that differ in capitals alone.
    pub fn named<'n>(things: impl IntoIterator<Item = (&'n str, Vec<u8>)>) -> Vec<Self> {
        let mut taken = BTreeSet::new();
        let file = |(name, bytes)| {
            let slug = slug(name);
            let numbered = (2..).map(|k| format!("{slug}-{k}"));
            let free = std::iter::once(slug.clone()).chain(numbered).find(|s| taken.insert(s.to_lowercase()));
            Self { suffix: free.unwrap_or(slug), bytes }
        };
        things.into_iter().map(file).collect()
    }

    /// The files of all pages, numbered where there are several.
    pub fn of_pages(pages: Vec<Vec<u8>>) -> Vec<Self> {
        let is_one = pages.len() == 1;
        let suffix = |k: usize| if is_one { String::new() } else { format!("-{}", k + 1) };
        pages.into_iter().enumerate().map(|(k, bytes)| Self { suffix: suffix(k), bytes }).collect()
    }
}

/// What a format is made of, and the function that makes it.
#[derive(Debug, Clone, Copy)]
pub enum Source {
    /// Drawings, each of which becomes a page or a file.
    Pages(fn(&Pages, &FormatOptions) -> Result<Vec<ExportFile>, ExportError>),
    /// The whole model.
    Model(fn(&Product<'_>, &FormatOptions) -> Result<Vec<ExportFile>, ExportError>),
}

/// One file format.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// Short name in small letters.
    pub name: &'static str,
    /// Extensions in small letters, without the dot; the first is the usual one.
    pub extensions: &'static [&'static str],
    /// One line for help texts.
    pub description: &'static str,
    /// How its files are made.
    pub source: Source,
}

impl Format {
    /// Whether its files are jobs for machines, which no one looks at.
    pub fn is_job(&self) -> bool {
        [plt::FORMAT.name, plt::GCODE.name].contains(&self.name)
    }

    /// Whether its files are pages to look at: neither jobs nor projects of a cutter's program.
    pub fn is_picture(&self) -> bool {
        let is_of_program = [fcm::FORMAT.name, lbrn::FORMAT.name].contains(&self.name);
        matches!(self.source, Source::Pages(_)) && !self.is_job() && !is_of_program
    }

    /// The files of a model in this format.
    ///
    /// # Errors
    /// See [`ExportError`].
    pub fn write(
        &self,
        product: &Product<'_>,
        options: &FormatOptions,
    ) -> Result<Vec<ExportFile>, ExportError> {
        match self.source {
            Source::Pages(write) => {
                if self.name != pdf::FORMAT.name {
                    let pages = product.pages()?;
                    return Ok(with_cards(write(pages, options)?, pages));
                }
                let pages = product.printed_pages()?;
                if !options.pdf.has_overview() || product.is_cut() {
                    return write(&pages, options);
                }
                let page = overview(product).map_err(|error| ExportError::writer(self, error))?;
                write(&pages.with_first(page)?, options)
            }
            Source::Model(write) => write(product, options),
        }
    }
}

/// With the colour of card in the names of files, where each is a sheet.
fn with_cards(mut files: Vec<ExportFile>, pages: &Pages) -> Vec<ExportFile> {
    if files.len() > 1 {
        for (file, page) in files.iter_mut().zip(pages.drawings()) {
            file.suffix.extend(page.card.as_deref().map(slug));
        }
    }
    files
}

/// The most letters of a name in the name of a file, which has at most 255 bytes.
const MOST_LETTERS: usize = 50;

/// A dash, and the letters and digits of a name.
fn slug(name: &str) -> String {
    let letter = |c: char| if c.is_alphanumeric() { c } else { '-' };
    let letters: String = name.chars().map(letter).take(MOST_LETTERS).collect();
    format!("-{letters}")
}

/// The format for a file name's extension (without the dot, in any case).
pub fn format_of(extension: &str) -> Option<&'static Format> {
    format_among(FORMATS, extension)
}

/// The same among some formats.
pub fn format_among<'a>(formats: &'a [Format], extension: &str) -> Option<&'a Format> {
    let extension = extension.to_ascii_lowercase();
    formats.iter().find(|format| format.extensions.contains(&extension.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_safe_on_windows() {
        let long = "長".repeat(300);
        let names =
            ["Head", "head", "a/b", "a\\b", "a b", "con", "..", "x. ", "<b>:\"|?*", "\u{1}\u{202e}", &long];
        let files = ExportFile::named(names.map(|name| (name, Vec::new())));
        let suffixes: Vec<&str> = files.iter().map(|file| file.suffix.as_str()).collect();
        assert_eq!(suffixes[..6], ["-Head", "-head-2", "-a-b", "-a-b-2", "-a-b-3", "-con"]);
        assert_eq!(suffixes.iter().map(|s| s.to_lowercase()).collect::<BTreeSet<_>>().len(), names.len());
        for suffix in suffixes {
            let is_safe = suffix.chars().all(|c| c == '-' || c.is_alphanumeric());
            assert!(suffix.starts_with('-') && is_safe && suffix.len() < 200, "{suffix}");
        }
    }

    #[test]
    fn extensions_lead_to_one_format_each() {
        let all = FORMATS.iter().flat_map(|f| f.extensions).collect::<Vec<_>>();
        assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
        assert_eq!(format_of("PDF").map(|f| f.name), Some("pdf"));
        assert_eq!(format_of("svg").map(|f| f.name), Some("svg"));
        assert!(format_of("doc").is_none());
        assert!(format_of("").is_none());
    }
}
