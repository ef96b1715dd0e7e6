//! DXF by the crate `dxf`: R2000 or R12, one file a drawing, for cutters and CAD programs.
//!
//! Furniture and pictures are left out: a cutter would cut them. The crate's output is mended
//! afterwards, see [`mended`].

use super::{ExportError, ExportFile, Format, FormatOptions, Source, TextMode};
use crate::drawing::text;
use crate::drawing::{Drawing, Layer, Mark, Pages, Polyline, Shape, Text};
use dxf::entities::{Entity, EntityType, Line, LwPolyline, Polyline as OldPolyline, Vertex};
use dxf::enums::{AcadVersion, Units};
use dxf::tables::{Layer as DxfLayer, LineType};
use dxf::{Color, LwPolylineVertex, Point};
use glam::DVec2;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "dxf",
    extensions: &["dxf"],
    description: "DXF in millimetres, one file a sheet, for cutters and CAD programs",
    source: Source::Pages(write),
};

/// Straight pieces in the place of each curve of a letter.
const CURVE_STEPS: usize = 4;
/// Line weight "by layer".
const BY_LAYER: i16 = -1;
/// Header variables that hold times or random ids, with what is written instead.
const VARYING: [(&str, &str); 6] = [
    ("$TDCREATE", "0.0"),
    ("$TDUCREATE", "0.0"),
    ("$TDUPDATE", "0.0"),
    ("$TDUUPDATE", "0.0"),
    ("$FINGERPRINTGUID", "{00000000-0000-0000-0000-000000000000}"),
    ("$VERSIONGUID", "{00000000-0000-0000-0000-000000000000}"),
];

/// Version of DXF files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DxfVersion {
    /// For old programs and machines.
    R12,
    /// AutoCAD 2000 and everything since.
    #[default]
    R2000,
}

/// Choices for DXF files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DxfOptions {
    /// The version.
    pub version: DxfVersion,
    /// How texts are written.
    pub text: TextMode,
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let file = |(index, drawing)| {
        let bytes = document(drawing, options.dxf).map_err(|error| ExportError::writer(&FORMAT, error))?;
        Ok(ExportFile::of_page(index, bytes))
    };
    pages.drawings().iter().enumerate().map(file).collect()
}

fn document(drawing: &Drawing, options: DxfOptions) -> Result<Vec<u8>, String> {
    let DxfOptions { version, text: text_mode } = options;
    let mut file = dxf::Drawing::new();
    file.header.version = match version {
        DxfVersion::R12 => AcadVersion::R12,
        DxfVersion::R2000 => AcadVersion::R2000,
    };
    file.header.default_drawing_units = Units::Millimeters;
    file.header.maximum_drawing_extents = point(drawing.size_mm);
    file.header.maximum_drawing_limits = point(drawing.size_mm);
    for layer in Layer::ALL {
        let mut marks = drawing.marks.iter().filter(|mark| mark.layer == layer).peekable();
        if let (Some((name, colour)), true) = (layer_name(layer), marks.peek().is_some()) {
            let dash_mm = marks.find_map(|mark| match &mark.shape {
                Shape::Path { stroke: Some(stroke), .. } => Some(stroke.dash_mm.as_slice()),
                _ => None,
            });
            add_layer(&mut file, name, colour, dash_mm.unwrap_or_default());
        }
    }
    for mark in &drawing.marks {
        if let Some((name, _)) = layer_name(mark.layer) {
            add_mark(&mut file, name, mark, version, text_mode);
        }
    }
    let mut bytes = Vec::new();
    file.save(&mut bytes).map_err(|error| error.to_string())?;
    let text = String::from_utf8(bytes).map_err(|error| error.to_string())?;
    Ok(mended(&text, version).into_bytes())
}

/// Name and colour (AutoCAD's index) of a layer; none for what is not for the cutter.
fn layer_name(layer: Layer) -> Option<(&'static str, u8)> {
    match layer {
        Layer::Cut => Some(("CUT", 7)),
        Layer::Slit => Some(("SLIT", 3)),
        Layer::Mountain => Some(("MOUNTAIN", 1)),
        Layer::Valley => Some(("VALLEY", 5)),
        Layer::FoldHinge => Some(("FOLD180", 6)),
        Layer::Glue => Some(("GLUE", 8)),
        Layer::Label => Some(("LABEL", 4)),
        Layer::Furniture | Layer::Registration | Layer::Picture => None,
    }
}

/// Adds a layer and, where its lines are dashed, a line type of the same name.
fn add_layer(file: &mut dxf::Drawing, name: &str, colour: u8, dash_mm: &[f64]) {
    let mut layer =
        DxfLayer { name: name.to_owned(), color: Color::from_index(colour), ..DxfLayer::default() };
    if !dash_mm.is_empty() {
        let signed = dash_mm.iter().enumerate();
        let signed = signed.map(|(i, &mm)| if i % 2 == 0 { mm } else { -mm }).collect();
        file.add_line_type(LineType {
            name: name.to_owned(),
            element_count: dash_mm.len() as i32,
            total_pattern_length: dash_mm.iter().sum(),
            dash_dot_space_lengths: signed,
            ..LineType::default()
        });
        layer.line_type_name = name.to_owned();
    }
    file.add_layer(layer);
}

fn add_mark(file: &mut dxf::Drawing, layer: &str, mark: &Mark, version: DxfVersion, text_mode: TextMode) {
    let contours = match (&mark.shape, text_mode) {
        (Shape::Path { contours, stroke: Some(_), .. }, _) => contours.clone(),
        (Shape::Path { stroke: None, .. }, _) => Vec::new(),
        (Shape::Text(text), TextMode::Outlines) => text::contours(text, CURVE_STEPS),
        (Shape::Text(text), TextMode::Text) => {
            add_entity(file, layer, EntityType::Text(written(text)));
            Vec::new()
        }
    };
    for contour in &contours {
        let entity = match contour.points[..] {
            [a, b] if !contour.is_closed => {
                EntityType::Line(Line { p1: point(a), p2: point(b), ..Line::default() })
            }
            _ if version == DxfVersion::R12 => EntityType::Polyline(old_polyline(file, contour)),
            _ => EntityType::LwPolyline(polyline(contour)),
        };
        add_entity(file, layer, entity);
    }
}

fn add_entity(file: &mut dxf::Drawing, layer: &str, specific: EntityType) {
    let mut entity = Entity::new(specific);
    entity.common.layer = layer.to_owned();
    entity.common.lineweight_enum_value = BY_LAYER;
    file.add_entity(entity);
}

fn polyline(contour: &Polyline) -> LwPolyline {
    let vertex = |p: &DVec2| LwPolylineVertex { x: p.x, y: p.y, ..LwPolylineVertex::default() };
    let vertices = contour.points.iter().map(vertex).collect();
    LwPolyline { flags: i32::from(contour.is_closed), vertices, ..LwPolyline::default() }
}

fn old_polyline(file: &mut dxf::Drawing, contour: &Polyline) -> OldPolyline {
    let mut line = OldPolyline { flags: i32::from(contour.is_closed), ..OldPolyline::default() };
    for &p in &contour.points {
        line.add_vertex(file, Vertex { location: point(p), ..Vertex::default() });
    }
    line
}

/// The height of a DXF text is that of its capitals.
fn written(text: &Text) -> dxf::entities::Text {
    dxf::entities::Text {
        location: point(text.start()),
        text_height: text.cap_height_mm,
        value: text::printable(&text.content),
        rotation: text.angle_rad.to_degrees(),
        ..dxf::entities::Text::default()
    }
}

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y, 0.0)
}

/// The crate's output made acceptable to strict readers, and the same for every run.
///
/// From R13 on, each TABLE needs a handle and an owner, and each dash of a line type its type
/// (code 74). R12 knows no subclass markers (code 100). Times and random ids become constants.
fn mended(text: &str, version: DxfVersion) -> String {
    let mut lines = text.lines();
    let pairs = std::iter::from_fn(|| Some((lines.next()?.trim(), lines.next()?)));
    let pairs = pairs.collect::<Vec<_>>();
    let is_handle = |code: &str| matches!(code, "5" | "105");
    let handles = pairs.iter().filter(|(code, _)| is_handle(code));
    let mut next = 1 + handles.filter_map(|(_, v)| u64::from_str_radix(v, 16).ok()).max().unwrap_or(0);
    let mut out = Vec::with_capacity(pairs.len() + 64);
    let mut seed_at = None;
    for (index, &(code, value)) in pairs.iter().enumerate() {
        let before = if index > 0 { pairs[index - 1] } else { ("", "") };
        let fixed = VARYING.iter().find(|(name, _)| before == ("9", *name)).map(|(_, fixed)| *fixed);
        if before == ("9", "$HANDSEED") {
            seed_at = Some(out.len());
        }
        if code == "100" && version == DxfVersion::R12 {
            continue;
        }
        out.push((code, fixed.unwrap_or(value).to_owned()));
        if version == DxfVersion::R12 {
            continue;
        }
        if before == ("0", "TABLE") {
            out.extend([("5", format!("{next:X}")), ("330", "0".to_owned())]);
            next += 1;
        }
        if code == "49" {
            out.push(("74", "0".to_owned()));
        }
    }
    if let Some(at) = seed_at {
        out[at].1 = format!("{next:X}");
    }
    out.iter().map(|(code, value)| format!("{code:>3}\r\n{value}\r\n")).collect()
}

#[cfg(test)]
mod tests;
