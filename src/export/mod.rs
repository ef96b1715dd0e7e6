//! File formats, one file each, registered in one list.
//!
//! A format's function turns an [`ExportInput`] into files: drawings become pages, and documents
//! that are no drawings (FOLD, the report) come in already serialised. Adding a format is one file
//! and one line in [`FORMATS`].

mod dxf;
#[cfg(test)]
mod fixture;
pub mod fold;
pub mod gltf;
mod pdf;
pub mod png;
mod svg;

use crate::drawing::{Drawing, Shape, Stroke};
use glam::DVec2;

/// What cannot be exported.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ExportError {
    /// There is no drawing.
    #[error("there is no page to write")]
    NoPages,
    /// A page, a line or a letter has no usable size, or a coordinate is not a number.
    #[error("page {page}: {what} is not a usable number")]
    BadNumber {
        /// Number of the page, from 1.
        page: usize,
        /// What is wrong on it.
        what: &'static str,
    },
    /// The format writes a document that was not handed over.
    #[error("there is no {0} document to write")]
    NoDocument(&'static str),
    /// A library could not write the file.
    #[error("the {format} file could not be written: {message}")]
    Writer {
        /// Name of the format.
        format: &'static str,
        /// What the library said.
        message: String,
    },
}

/// How texts are written where a format leaves the choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TextMode {
    /// As outlines of letters: looks the same everywhere.
    #[default]
    Outlines,
    /// As text, which needs the font where it is read.
    Text,
}

/// Version of DXF files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DxfVersion {
    /// For old programs and machines.
    R12,
    /// AutoCAD 2000 and everything since.
    #[default]
    R2000,
}

/// Everything that a format may write.
///
/// # Guarantees
/// All coordinates, sizes and widths in the drawings are finite; pages, letters and dashes have a
/// size above 0.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportInput {
    title: String,
    drawings: Vec<Drawing>,
    documents: Vec<(&'static str, Vec<u8>)>,
    text_mode: TextMode,
    dxf_version: DxfVersion,
}

impl ExportInput {
    /// Takes the model's title and its pages.
    ///
    /// # Errors
    /// [`ExportError::BadNumber`] where a drawing breaks the guarantees above.
    pub fn new(title: impl Into<String>, drawings: Vec<Drawing>) -> Result<Self, ExportError> {
        for (index, drawing) in drawings.iter().enumerate() {
            check(drawing).map_err(|what| ExportError::BadNumber { page: index + 1, what })?;
        }
        Ok(Self {
            title: title.into(),
            drawings,
            documents: Vec::new(),
            text_mode: TextMode::default(),
            dxf_version: DxfVersion::default(),
        })
    }

    /// Adds a serialised document for the format of this name.
    #[must_use]
    pub fn with_document(mut self, format: &'static str, bytes: Vec<u8>) -> Self {
        self.documents.push((format, bytes));
        self
    }

    /// Chooses how texts are written.
    #[must_use]
    pub fn with_text_mode(mut self, text_mode: TextMode) -> Self {
        self.text_mode = text_mode;
        self
    }

    /// Chooses the version of DXF files.
    #[must_use]
    pub fn with_dxf_version(mut self, dxf_version: DxfVersion) -> Self {
        self.dxf_version = dxf_version;
        self
    }

    /// The model's title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The pages.
    ///
    /// # Errors
    /// [`ExportError::NoPages`] where there is none.
    pub fn pages(&self) -> Result<&[Drawing], ExportError> {
        if self.drawings.is_empty() { Err(ExportError::NoPages) } else { Ok(&self.drawings) }
    }

    /// The serialised document for a format.
    ///
    /// # Errors
    /// [`ExportError::NoDocument`] where it was not handed over.
    pub fn document(&self, format: &'static str) -> Result<&[u8], ExportError> {
        let found = self.documents.iter().find(|(name, _)| *name == format);
        found.map(|(_, bytes)| bytes.as_slice()).ok_or(ExportError::NoDocument(format))
    }

    /// How texts are written.
    pub fn text_mode(&self) -> TextMode {
        self.text_mode
    }

    /// The version of DXF files.
    pub fn dxf_version(&self) -> DxfVersion {
        self.dxf_version
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

    /// The file of one page of several, by its index from 0.
    pub fn of_page(index: usize, bytes: Vec<u8>) -> Self {
        Self { suffix: format!("-{}", index + 1), bytes }
    }
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
    write: fn(&ExportInput) -> Result<Vec<ExportFile>, ExportError>,
}

impl Format {
    /// The files of an export in this format.
    ///
    /// # Errors
    /// See [`ExportError`].
    pub fn write(&self, input: &ExportInput) -> Result<Vec<ExportFile>, ExportError> {
        (self.write)(input)
    }
}

/// All formats, in the order of help texts.
pub const FORMATS: &[Format] = &[pdf::FORMAT, svg::FORMAT, dxf::FORMAT, png::FORMAT, FOLD, JSON];

/// The crease pattern, the deployed and the flat model.
const FOLD: Format = Format {
    name: "fold",
    extensions: &["fold"],
    description: "FOLD 1.2: crease pattern, deployed and flat model in one file",
    write: |input| Ok(vec![ExportFile::single(input.document("fold")?.to_vec())]),
};

/// The report.
const JSON: Format = Format {
    name: "json",
    extensions: &["json"],
    description: "report: components, nets, sheets, warnings",
    write: |input| Ok(vec![ExportFile::single(input.document("json")?.to_vec())]),
};

/// The format for a file name's extension (without the dot, in any case).
pub fn format_of(extension: &str) -> Option<&'static Format> {
    let extension = extension.to_ascii_lowercase();
    FORMATS.iter().find(|format| format.extensions.contains(&extension.as_str()))
}

/// `Err` with what is wrong in a drawing.
fn check(drawing: &Drawing) -> Result<(), &'static str> {
    let is_size = |mm: f64| mm.is_finite() && mm > 0.0;
    let ensure = |holds: bool, what| if holds { Ok(()) } else { Err(what) };
    ensure(is_size(drawing.size_mm.x) && is_size(drawing.size_mm.y), "the size of the page")?;
    for mark in &drawing.marks {
        match &mark.shape {
            Shape::Path { contours, stroke, .. } => {
                let mut points = contours.iter().flat_map(|c| &c.points);
                ensure(points.all(|p: &DVec2| p.is_finite()), "a corner of a line")?;
                ensure(stroke.as_ref().is_none_or(is_drawable), "the width or dash of a line")?;
            }
            Shape::Text(text) => {
                ensure(text.anchor.is_finite() && text.angle_rad.is_finite(), "the place of a text")?;
                ensure(is_size(text.cap_height_mm), "the size of a text")?;
            }
        }
    }
    Ok(())
}

fn is_drawable(stroke: &Stroke) -> bool {
    let mut dashes = stroke.dash_mm.iter();
    stroke.width_mm.is_finite() && stroke.width_mm >= 0.0 && dashes.all(|mm| mm.is_finite() && *mm > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Layer, LineStyles, Mark};
    use std::collections::BTreeSet;

    #[test]
    fn extensions_lead_to_one_format_each() {
        let all = FORMATS.iter().flat_map(|f| f.extensions).collect::<Vec<_>>();
        assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
        assert_eq!(format_of("PDF").map(|f| f.name), Some("pdf"));
        assert_eq!(format_of("svg").map(|f| f.name), Some("svg"));
        assert!(format_of("doc").is_none());
        assert!(format_of("").is_none());
    }

    #[test]
    fn documents_pass_through() {
        let input = ExportInput::new("box", Vec::new()).expect("valid");
        let fold = format_of("fold").expect("registered");
        assert_eq!(fold.write(&input), Err(ExportError::NoDocument("fold")));
        let files = fold.write(&input.with_document("fold", b"{}".to_vec()));
        assert_eq!(files, Ok(vec![ExportFile::single(b"{}".to_vec())]));
    }

    #[test]
    fn drawings_need_pages() {
        let input = ExportInput::new("box", Vec::new()).expect("valid");
        for name in ["pdf", "svg", "dxf"] {
            assert_eq!(format_of(name).expect("registered").write(&input), Err(ExportError::NoPages));
        }
    }

    #[test]
    fn numbers_that_cannot_be_drawn_are_refused_with_their_page() {
        let good = Drawing::new("page", DVec2::new(210.0, 297.0));
        let mut bad = good.clone();
        let stroke = LineStyles::standard().stroke(Layer::Cut).clone();
        bad.marks.push(Mark::line(Layer::Cut, DVec2::ZERO, DVec2::new(1.0, f64::NAN), &stroke));
        let error = ExportInput::new("box", vec![good, bad]).expect_err("NaN");
        assert_eq!(error, ExportError::BadNumber { page: 2, what: "a corner of a line" });
        let empty = Drawing::new("page", DVec2::new(210.0, 0.0));
        assert!(ExportInput::new("box", vec![empty]).is_err());
    }
}
