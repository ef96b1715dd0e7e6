//! PDF by `printpdf`: vector at exactly 1:1, one page a drawing, the font embedded.
//!
//! What `printpdf` does not offer is set on the finished document: no scaling by the print dialog,
//! and nothing in it that varies (`printpdf` numbers its ids by a counter of the process).

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use crate::drawing::text::{self, FONT_FILE, FONT_NAME};
use crate::drawing::{Drawing, Layer, Mark, Pages, Polyline, Rgb, Shape, Stroke, Text};
use glam::DVec2;
use lopdf::{Dictionary, Document, Object};
use printpdf::{
    Color, FontId, Greyscale, LayerInternalId, Line, LineDashPattern, LineJoinStyle, LinePoint, Op,
    PaintMode, ParsedFont, PdfDocument, PdfFont, PdfFontHandle, PdfPage, PdfSaveOptions, Point, Polygon,
    PolygonRing, Pt, Rect, TextItem, TextMatrix, WindingOrder,
};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "pdf",
    extensions: &["pdf"],
    description: "PDF at exactly 1:1, one page a sheet, for printing",
    source: Source::Pages(write),
};

/// Points in a millimetre.
const PT_PER_MM: f64 = 72.0 / 25.4;
/// Layers need 1.5, `PrintScaling` 1.6.
const PDF_VERSION: &str = "1.6";
/// Entries of the document information that vary, or that claim what is not so.
const UNWANTED_INFO: [&[u8]; 7] =
    [b"CreationDate", b"ModDate", b"GTS_PDFXVersion", b"Identifier", b"Trapped", b"Author", b"Keywords"];

fn write(pages: &Pages, _: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let failed = |message: String| ExportError::writer(&FORMAT, message);
    let mut pdf = PdfDocument::new(pages.title());
    let producer = concat!("tatamu ", env!("CARGO_PKG_VERSION"));
    pdf.metadata.info.creator = producer.to_owned();
    pdf.metadata.info.producer = producer.to_owned();
    let mut font = ParsedFont::from_bytes(FONT_FILE, 0, &mut Vec::new())
        .ok_or_else(|| failed("the embedded font cannot be read".to_owned()))?;
    font.font_name = Some(FONT_NAME.to_owned());
    pdf.resources.fonts.map.insert(font_id(), PdfFont::new(font));
    for drawing in pages.drawings() {
        for mark in &drawing.marks {
            pdf.resources.layers.map.entry(layer_id(mark.layer)).or_insert_with(|| group(mark.layer));
        }
        pdf.pages.push(page(drawing));
    }
    let mut document = pdf.to_lopdf_document(&PdfSaveOptions::default(), &mut Vec::new());
    settle(&mut document).map_err(|error| failed(error.to_string()))?;
    let mut bytes = Vec::new();
    document.save_to(&mut bytes).map_err(|error| failed(error.to_string()))?;
    Ok(vec![ExportFile::single(bytes)])
}

/// Forbids scaling by the print dialog and takes out what varies.
fn settle(document: &mut Document) -> Result<(), lopdf::Error> {
    document.version = PDF_VERSION.to_owned();
    document.trailer.remove(b"ID");
    let preferences = Dictionary::from_iter([("PrintScaling", Object::from("None"))]);
    document.catalog_mut()?.set("ViewerPreferences", preferences);
    let info = document.trailer.get(b"Info")?.as_reference()?;
    let info = document.get_object_mut(info)?.as_dict_mut()?;
    for key in UNWANTED_INFO {
        info.remove(key);
    }
    document.compress();
    Ok(())
}

fn font_id() -> FontId {
    FontId("F1".to_owned())
}

/// Optional-content group of a layer. Its id sorts in the order of the layers.
fn layer_id(layer: Layer) -> LayerInternalId {
    LayerInternalId(format!("L{}-{}", layer as usize + 1, layer.name()))
}

fn group(layer: Layer) -> printpdf::Layer {
    let mut group = printpdf::Layer::new(layer.name());
    group.creator = "tatamu".to_owned();
    group
}

fn page(drawing: &Drawing) -> PdfPage {
    let size = drawing.size_mm;
    let sheet = Rect::from_wh(pt(size.x), pt(size.y));
    let mut ops = vec![Op::SetLineJoinStyle { join: LineJoinStyle::Round }];
    if let Some(ground) = drawing.ground {
        let corners = vec![DVec2::ZERO, DVec2::new(size.x, 0.0), size, DVec2::new(0.0, size.y)];
        push_fill(&mut ops, &[Polyline::closed(corners)], ground);
    }
    for run in drawing.marks.chunk_by(|a, b| a.layer == b.layer) {
        ops.push(Op::BeginLayer { layer_id: layer_id(run[0].layer) });
        run.iter().for_each(|mark| push_mark(&mut ops, mark));
        ops.push(Op::EndLayer);
    }
    PdfPage { media_box: sheet.clone(), trim_box: sheet.clone(), crop_box: sheet, ops }
}

fn push_mark(ops: &mut Vec<Op>, mark: &Mark) {
    match &mark.shape {
        Shape::Path { contours, stroke, fill } => {
            if let Some(fill) = fill {
                push_fill(ops, contours, *fill);
            }
            if let Some(stroke) = stroke {
                push_stroke(ops, contours, stroke);
            }
        }
        Shape::Text(text) => push_text(ops, text),
    }
}

fn push_fill(ops: &mut Vec<Op>, contours: &[Polyline], fill: Rgb) {
    let rings = contours.iter().map(|c| PolygonRing { points: line_points(&c.points) }).collect();
    let polygon = Polygon { rings, mode: PaintMode::Fill, winding_order: WindingOrder::EvenOdd };
    ops.push(Op::SetFillColor { col: colour(fill) });
    ops.push(Op::DrawPolygon { polygon });
}

/// One `DrawLine` a contour, since `DrawPolygon` closes only its last ring when it strokes.
fn push_stroke(ops: &mut Vec<Op>, contours: &[Polyline], stroke: &Stroke) {
    let dash = stroke.dash_mm.iter().map(|&mm| pt(mm).0).collect::<Vec<_>>();
    ops.push(Op::SetOutlineColor { col: colour(stroke.colour) });
    ops.push(Op::SetOutlineThickness { pt: pt(stroke.width_mm) });
    ops.push(Op::SetLineDashPattern { dash: LineDashPattern::new(0.0, &dash) });
    for contour in contours {
        let line = Line { points: line_points(&contour.points), is_closed: contour.is_closed };
        ops.push(Op::DrawLine { line });
    }
}

fn push_text(ops: &mut Vec<Op>, text: &Text) {
    let start = point(text.start());
    let along = DVec2::from_angle(text.angle_rad);
    let (cos, sin) = (along.x as f32, along.y as f32);
    let matrix = TextMatrix::Raw([cos, sin, -sin, cos, start.x.0, start.y.0]);
    let size = pt(text::em_mm(text.cap_height_mm));
    let content = text::printable(&text.content);
    ops.extend([
        Op::SetFillColor { col: colour(text.colour) },
        Op::StartTextSection,
        Op::SetFont { font: PdfFontHandle::External(font_id()), size },
        Op::SetTextMatrix { matrix },
        Op::ShowText { items: vec![TextItem::Text(content)] },
        Op::EndTextSection,
    ]);
}

/// Grey is written as such, so that printers use black ink alone.
fn colour(Rgb(red, green, blue): Rgb) -> Color {
    let [r, g, b] = [red, green, blue].map(|part| f32::from(part) / 255.0);
    if red == green && green == blue {
        Color::Greyscale(Greyscale { percent: r, icc_profile: None })
    } else {
        Color::Rgb(printpdf::Rgb { r, g, b, icc_profile: None })
    }
}

/// Converted in `f64`; PDF numbers of this library are `f32`, within 1e-5 mm on an A3 sheet.
fn pt(mm: f64) -> Pt {
    Pt((mm * PT_PER_MM) as f32)
}

fn point(p: DVec2) -> Point {
    Point { x: pt(p.x), y: pt(p.y) }
}

fn line_points(points: &[DVec2]) -> Vec<LinePoint> {
    points.iter().map(|&p| LinePoint { p: point(p), bezier: false }).collect()
}

#[cfg(test)]
mod tests;
