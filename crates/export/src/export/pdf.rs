//! PDF by `printpdf`: vector at exactly 1:1, one page a drawing or a tile of it, the font embedded.
//!
//! What `printpdf` does not offer is set on the finished document: no scaling by the print dialog,
//! bookmarks, and nothing in it that varies (`printpdf` numbers its ids by a counter of the
//! process).

mod bookmarks;
mod date;
mod page;
mod tile;

pub use date::Timestamp;

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use glam::DVec2;
use lopdf::{Dictionary, Document, Object, ObjectId};
use page::Builder;
use printpdf::{FontId, LayerInternalId, ParsedFont, PdfDocument, PdfFont, PdfSaveOptions};
use std::collections::BTreeSet;
use tatamu_core::units::Paper;
use tatamu_draw::drawing::text::{self, FONTS};
use tatamu_draw::drawing::{Layer, LineStyles, Pages, Shape};
use tile::{Grid, Tile};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "pdf",
    extensions: &["pdf"],
    description: "PDF at exactly 1:1, one page per sheet, for printing",
    source: Source::Pages(write),
};

/// Layers need 1.5, `PrintScaling` 1.6.
const PDF_VERSION: &str = "1.6";
/// Entries of the document information that vary, or that claim what is not so.
const UNWANTED_INFO: [&[u8]; 7] =
    [b"CreationDate", b"ModDate", b"GTS_PDFXVersion", b"Identifier", b"Trapped", b"Author", b"Keywords"];
/// Marks the font as a subset, as the format wants it: six letters and a plus sign.
const SUBSET_TAG: &str = "TATAMU+";

/// Choices for PDF files.
///
/// # Guarantees
/// Tiles have room for more than their overlap.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PdfOptions {
    created: Option<Timestamp>,
    tile: Option<Paper>,
    has_overview: bool,
}

impl PdfOptions {
    /// The same with a date of creation; without one, none is written.
    #[must_use]
    pub fn with_created(self, created: Option<Timestamp>) -> Self {
        Self { created, ..self }
    }

    /// The same with a page about the whole model before the sheets.
    #[must_use]
    pub fn with_overview(self, has_overview: bool) -> Self {
        Self { has_overview, ..self }
    }

    /// Whether a page about the whole model comes before the sheets.
    pub fn has_overview(&self) -> bool {
        self.has_overview
    }

    /// The same with sheets that are larger than `tile` divided among pages of that size.
    ///
    /// # Errors
    /// A message for paper on which there is no room beside margins and overlap.
    pub fn with_tile(self, tile: Option<Paper>) -> Result<Self, String> {
        match tile {
            Some(paper) => tile::check(paper).map(|()| Self { tile, ..self }),
            None => Ok(Self { tile, ..self }),
        }
    }
}

/// A page of the document: a drawing, or a part of it.
struct Leaf {
    /// Index of the drawing.
    drawing: usize,
    tile: Option<Tile>,
}

impl Leaf {
    /// From the drawing's coordinates to the page's, mm.
    fn shift_mm(&self) -> DVec2 {
        self.tile.as_ref().map_or(DVec2::ZERO, |tile| tile.shift_mm)
    }

    /// Whether a point of the drawing is on the page.
    fn holds(&self, point: DVec2) -> bool {
        self.tile.as_ref().is_none_or(|tile| tile.holds(point))
    }
}

/// Pages in their own size, whatever is chosen for sheets.
pub(super) fn whole(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let pdf = PdfOptions { tile: None, ..options.pdf };
    write(pages, &FormatOptions { pdf, ..options.clone() })
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let failed = |message: String| ExportError::writer(&FORMAT, message);
    let mut pdf = PdfDocument::new(pages.title());
    let producer = concat!("tatamu ", env!("CARGO_PKG_VERSION"));
    pdf.metadata.info.creator = producer.to_owned();
    pdf.metadata.info.producer = producer.to_owned();
    for index in fonts(pages) {
        let mut font = ParsedFont::from_bytes(FONTS[index].file, 0, &mut Vec::new())
            .ok_or_else(|| failed("an embedded font cannot be read".to_owned()))?;
        font.font_name = Some(format!("{SUBSET_TAG}{}", FONTS[index].name));
        pdf.resources.fonts.map.insert(font_id(index), PdfFont::new(font));
    }
    let styles = pages.styles();
    for mark in pages.drawings().iter().flat_map(|drawing| &drawing.marks) {
        let id = layer_id(styles, mark.layer);
        pdf.resources.layers.map.entry(id).or_insert_with(|| group(styles, mark.layer));
    }
    let leaves = leaves(pages, options.pdf);
    for leaf in &leaves {
        let mut builder = Builder::new(styles, &mut pdf.resources.xobjects);
        let drawing = &pages.drawings()[leaf.drawing];
        pdf.pages.push(match &leaf.tile {
            None => builder.whole(drawing),
            Some(tile) => builder.tile(drawing, tile, leaf.drawing + 1, pages),
        });
    }
    let mut document = pdf.to_lopdf_document(&PdfSaveOptions::default(), &mut Vec::new());
    let ids: Vec<ObjectId> = document.get_pages().into_values().collect();
    bookmarks::add(&mut document, pages, &leaves, &ids).map_err(|error| failed(error.to_string()))?;
    settle(&mut document, options.pdf.created).map_err(|error| failed(error.to_string()))?;
    let mut bytes = Vec::new();
    document.save_to(&mut bytes).map_err(|error| failed(error.to_string()))?;
    Ok(vec![ExportFile::single(bytes)])
}

/// Every drawing on a page, or on those of its tiles on which there is something.
fn leaves(pages: &Pages, options: PdfOptions) -> Vec<Leaf> {
    let mut out = Vec::new();
    for (index, drawing) in pages.drawings().iter().enumerate() {
        let grid = options.tile.and_then(|paper| Grid::new(drawing.size_mm, paper));
        match grid {
            None => out.push(Leaf { drawing: index, tile: None }),
            Some(grid) => {
                let tiles = grid.tiles().into_iter().filter(|tile| tile.has_marks(drawing));
                out.extend(tiles.map(|tile| Leaf { drawing: index, tile: Some(tile) }));
            }
        }
    }
    out
}

/// Forbids scaling by the print dialog, and takes out what varies.
fn settle(document: &mut Document, created: Option<Timestamp>) -> Result<(), lopdf::Error> {
    document.version = PDF_VERSION.to_owned();
    document.trailer.remove(b"ID");
    let preferences = Dictionary::from_iter([("PrintScaling", Object::from("None"))]);
    document.catalog_mut()?.set("ViewerPreferences", preferences);
    let info = document.trailer.get(b"Info")?.as_reference()?;
    let info = document.get_object_mut(info)?.as_dict_mut()?;
    for key in UNWANTED_INFO {
        info.remove(key);
    }
    if let Some(created) = created {
        info.set("CreationDate", Object::string_literal(created.to_pdf()));
    }
    document.compress();
    Ok(())
}

/// Indices of the fonts that the texts need.
fn fonts(pages: &Pages) -> BTreeSet<usize> {
    let marks = pages.drawings().iter().flat_map(|drawing| &drawing.marks);
    let texts = marks.filter_map(|mark| match &mark.shape {
        Shape::Text(text) => Some(text),
        _ => None,
    });
    // What tiles say besides is in the first.
    texts.flat_map(|text| text::runs(&text.content)).map(|(font, _)| font).chain([0]).collect()
}

fn font_id(index: usize) -> FontId {
    FontId(format!("F{}", index + 1))
}

/// Optional-content group of a layer. Its id sorts in the order of the layers.
fn layer_id(styles: &LineStyles, layer: Layer) -> LayerInternalId {
    let name = styles.layer_name(layer);
    let first = Layer::ALL.iter().position(|&other| styles.layer_name(other) == name);
    LayerInternalId(format!("L{:02}-{name}", first.unwrap_or_default() + 1))
}

fn group(styles: &LineStyles, layer: Layer) -> printpdf::Layer {
    let mut group = printpdf::Layer::new(styles.layer_name(layer));
    group.creator = "tatamu".to_owned();
    group
}

#[cfg(test)]
mod tests;
