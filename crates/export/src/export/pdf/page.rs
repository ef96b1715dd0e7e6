//! Drawings as operators of PDF pages.

use super::tile::Tile;
use super::{font_id, layer_id};
use glam::DVec2;
use printpdf::{
    Color, CurTransMat, DictItem, ExternalStream, ExternalXObject, Greyscale, Line, LineDashPattern,
    LineJoinStyle, LinePoint, Op, PaintMode, PdfFontHandle, PdfPage, Point, Polygon, PolygonRing, Pt, Px,
    Rect, TextItem, TextMatrix, WindingOrder, XObject, XObjectId, XObjectMap, XObjectTransform,
};
use std::collections::BTreeMap;
use tatamu_draw::drawing::text;
use tatamu_draw::drawing::{
    Drawing, Image, LineStyles, Mark, Pages, Polyline, Rgb, Shape, Stroke, Text, rectangle,
};

/// Points in a millimetre.
pub(super) const PT_PER_MM: f64 = 72.0 / 25.4;

/// Turns drawings into pages; their pictures go into the document's resources.
pub(super) struct Builder<'a> {
    styles: &'a LineStyles,
    pictures: &'a mut XObjectMap,
}

impl<'a> Builder<'a> {
    pub(super) fn new(styles: &'a LineStyles, pictures: &'a mut XObjectMap) -> Self {
        Self { styles, pictures }
    }

    /// The whole drawing on a page of its size.
    pub(super) fn whole(&mut self, drawing: &Drawing) -> PdfPage {
        let mut ops = vec![Op::SetLineJoinStyle { join: LineJoinStyle::Round }];
        self.push_ground(&mut ops, drawing);
        self.push_marks(&mut ops, &drawing.marks);
        sized_page(drawing.size_mm, ops)
    }

    /// A part of page number `page` within its window, and what is needed to put the tiles
    /// together.
    pub(super) fn tile(&mut self, drawing: &Drawing, tile: &Tile, page: usize, pages: &Pages) -> PdfPage {
        let mut ops = vec![
            Op::SetLineJoinStyle { join: LineJoinStyle::Round },
            Op::SaveGraphicsState,
            clip(&Polyline::closed(tile.window_corners())),
            Op::SetTransformationMatrix {
                matrix: CurTransMat::Translate(pt(tile.shift_mm.x), pt(tile.shift_mm.y)),
            },
        ];
        self.push_ground(&mut ops, drawing);
        let marks: Vec<Mark> = drawing.marks.iter().filter(|mark| tile.meets(mark)).cloned().collect();
        self.push_marks(&mut ops, &marks);
        ops.push(Op::RestoreGraphicsState);
        self.push_marks(&mut ops, &tile.marks(page, pages));
        sized_page(tile.paper_mm, ops)
    }

    fn push_ground(&self, ops: &mut Vec<Op>, drawing: &Drawing) {
        if let Some(ground) = drawing.ground {
            let corners = rectangle(DVec2::ZERO, drawing.size_mm);
            push_fill(ops, &[Polyline::closed(corners.to_vec())], ground);
        }
    }

    fn push_marks(&mut self, ops: &mut Vec<Op>, marks: &[Mark]) {
        let name = |mark: &Mark| self.styles.layer_name(mark.layer);
        for run in marks.chunk_by(|a, b| name(a) == name(b)) {
            ops.push(Op::BeginLayer { layer_id: layer_id(self.styles, run[0].layer) });
            for mark in run {
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
                    Shape::Image(image) => push_image(ops, self.pictures, image),
                }
            }
            ops.push(Op::EndLayer);
        }
    }
}

fn sized_page(size_mm: DVec2, ops: Vec<Op>) -> PdfPage {
    let sheet = Rect::from_wh(pt(size_mm.x), pt(size_mm.y));
    PdfPage { media_box: sheet.clone(), trim_box: sheet.clone(), crop_box: sheet, ops }
}

/// From here to the end of the graphics state, nothing is seen outside.
fn clip(contour: &Polyline) -> Op {
    let rings = vec![PolygonRing { points: line_points(&contour.points) }];
    let polygon = Polygon { rings, mode: PaintMode::Clip, winding_order: WindingOrder::NonZero };
    Op::DrawPolygon { polygon }
}

/// Pixels are an object of the document; the unit square, where PDF has them, is brought to their
/// place.
fn push_image(ops: &mut Vec<Op>, pictures: &mut XObjectMap, image: &Image) {
    let raster = &image.raster;
    let id = XObjectId(format!("I{}", pictures.map.len() + 1));
    let name = |text: &str| DictItem::Name(text.as_bytes().to_vec());
    let dict = BTreeMap::from([
        ("Type".to_owned(), name("XObject")),
        ("Subtype".to_owned(), name("Image")),
        ("Width".to_owned(), DictItem::Int(i64::from(raster.width()))),
        ("Height".to_owned(), DictItem::Int(i64::from(raster.height()))),
        ("ColorSpace".to_owned(), name("DeviceRGB")),
        ("BitsPerComponent".to_owned(), DictItem::Int(8)),
        ("Interpolate".to_owned(), DictItem::Bool(true)),
    ]);
    let stream = ExternalStream { dict, content: raster.rgb_bytes(), compress: true };
    let pixels = |count: u32| Some(Px(count as usize));
    let object =
        ExternalXObject { stream, width: pixels(raster.width()), height: pixels(raster.height()), dpi: None };
    pictures.map.insert(id.clone(), XObject::External(object));
    let across = image.place.matrix2.x_axis * (f64::from(raster.width()) * raster.pixel_mm());
    let up = image.place.matrix2.y_axis * (f64::from(raster.height()) * raster.pixel_mm());
    let matrix = [across, up, image.place.translation].map(|v| [pt(v.x).0, pt(v.y).0]);
    let matrix = [matrix[0][0], matrix[0][1], matrix[1][0], matrix[1][1], matrix[2][0], matrix[2][1]];
    ops.extend([
        Op::SaveGraphicsState,
        clip(&image.clip),
        Op::SetTransformationMatrix { matrix: CurTransMat::Raw(matrix) },
        Op::UseXobject { id, transform: XObjectTransform { no_auto_scale: true, ..Default::default() } },
        Op::RestoreGraphicsState,
    ]);
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
    ops.extend([Op::SetFillColor { col: colour(text.colour) }, Op::StartTextSection]);
    for (k, (font, letters)) in text::runs(&text.content).into_iter().enumerate() {
        ops.push(Op::SetFont { font: PdfFontHandle::External(font_id(font)), size });
        // A reader goes on where the run before ended.
        ops.extend((k == 0).then_some(Op::SetTextMatrix { matrix }));
        ops.push(Op::ShowText { items: vec![TextItem::Text(letters)] });
    }
    ops.push(Op::EndTextSection);
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
