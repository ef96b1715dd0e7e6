//! DXF by the crate `dxf`: R2000 or R12, for cutters and CAD programs.
//!
//! Furniture and pictures are left out: a cutter would cut them. The crate's output is mended
//! afterwards, see [`mended`].

use super::{ExportError, ExportFile, Format, FormatOptions, SHEET_GAP_MM, Source, TextMode};
use dxf::entities::{Entity, EntityType, Line, LwPolyline, Polyline as OldPolyline, Vertex};
use dxf::enums::{AcadVersion, Units};
use dxf::tables::{Layer as DxfLayer, LineType};
use dxf::{Color, LwPolylineVertex, Point};
use glam::{DAffine2, DVec2};
use tatamu_draw::drawing::{Drawing, Layer, LineStyles, Mark, Pages, Polyline, Shape, Text, strokes, text};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "dxf",
    extensions: &["dxf"],
    description: "DXF in millimetres, one file per sheet or all in one, for cutters and CAD programs",
    source: Source::Pages(write),
};

/// Straight pieces in the place of each curve of a letter.
const CURVE_STEPS: usize = 4;
/// Names of line types that every file has.
const BY_LAYER_TYPE: &str = "BYLAYER";
const CONTINUOUS: &str = "CONTINUOUS";
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

impl std::str::FromStr for DxfVersion {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.to_ascii_lowercase().as_str() {
            "r12" => Ok(Self::R12),
            "r2000" => Ok(Self::R2000),
            _ => Err("the version must be one of r12, r2000".to_owned()),
        }
    }
}

/// How sheets are divided among files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DxfSheets {
    /// Each in a file of its own.
    #[default]
    Files,
    /// All in one file, side by side.
    Row,
}

impl std::str::FromStr for DxfSheets {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "files" => Ok(Self::Files),
            "row" => Ok(Self::Row),
            _ => Err("the sheets must be one of files, row".to_owned()),
        }
    }
}

/// Choices for DXF files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DxfOptions {
    /// The version.
    pub version: DxfVersion,
    /// How texts are written.
    pub text: TextMode,
    /// How sheets are divided among files.
    pub sheets: DxfSheets,
}

/// Texts are single lines, which a pen or a blade can follow.
impl Default for DxfOptions {
    fn default() -> Self {
        Self { version: DxfVersion::default(), text: TextMode::Strokes, sheets: DxfSheets::default() }
    }
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let drawings = match options.dxf.sheets {
        DxfSheets::Files => pages.drawings().to_vec(),
        DxfSheets::Row => vec![row(pages)],
    };
    let file = |drawing| document(drawing, pages.styles(), options.dxf);
    let files = drawings.iter().map(file).collect::<Result<Vec<_>, String>>();
    files.map(ExportFile::of_pages).map_err(|error| ExportError::writer(&FORMAT, error))
}

/// All pages on one, side by side.
fn row(pages: &Pages) -> Drawing {
    let mut all = Drawing::new(pages.title(), DVec2::ZERO);
    for page in pages.drawings() {
        let gap_mm = if all.size_mm.x > 0.0 { SHEET_GAP_MM } else { 0.0 };
        let left_mm = all.size_mm.x + gap_mm;
        all.place(page.marks.iter().cloned(), DAffine2::from_translation(DVec2::X * left_mm));
        all.size_mm = DVec2::new(left_mm + page.size_mm.x, all.size_mm.y.max(page.size_mm.y));
    }
    all
}

fn document(drawing: &Drawing, styles: &LineStyles, options: DxfOptions) -> Result<Vec<u8>, String> {
    let mut file = dxf::Drawing::new();
    file.header.version = match options.version {
        DxfVersion::R12 => AcadVersion::R12,
        DxfVersion::R2000 => AcadVersion::R2000,
    };
    file.header.default_drawing_units = Units::Millimeters;
    file.header.maximum_drawing_extents = point(drawing.size_mm);
    file.header.maximum_drawing_limits = point(drawing.size_mm);
    let mut names: Vec<&str> = Vec::new();
    for layer in Layer::ALL.into_iter().filter(|&layer| is_for_cutters(layer)) {
        let name = styles.layer_name(layer);
        if drawing.marks.iter().any(|mark| mark.layer == layer) && !names.contains(&name) {
            names.push(name);
            add_layer(&mut file, name, styles.dxf_colour(layer), &styles.stroke(layer).dash_mm);
        }
    }
    for mark in drawing.marks.iter().filter(|mark| is_for_cutters(mark.layer)) {
        add_mark(&mut file, styles.layer_name(mark.layer), mark, options);
    }
    let mut bytes = Vec::new();
    file.save(&mut bytes).map_err(|error| error.to_string())?;
    let text = String::from_utf8(bytes).map_err(|error| error.to_string())?;
    Ok(mended(&text, options.version).into_bytes())
}

/// A cutter would cut a scale bar.
fn is_for_cutters(layer: Layer) -> bool {
    !matches!(layer, Layer::Tab | Layer::Furniture | Layer::Registration | Layer::Picture)
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

fn add_mark(file: &mut dxf::Drawing, layer: &str, mark: &Mark, options: DxfOptions) {
    let contours = match (&mark.shape, options.text) {
        (Shape::Path { contours, stroke: Some(_), .. }, _) => contours.clone(),
        (Shape::Path { stroke: None, .. } | Shape::Image(_), _) => Vec::new(),
        (Shape::Text(text), TextMode::Outlines) => text::contours(text, CURVE_STEPS),
        (Shape::Text(text), TextMode::Strokes) => strokes::polylines(text),
        (Shape::Text(text), TextMode::Text) => {
            add_entity(file, layer, BY_LAYER_TYPE, EntityType::Text(written(text)));
            Vec::new()
        }
    };
    // Letters are not dashed, whatever their layer is.
    let is_text = matches!(mark.shape, Shape::Text(_));
    let line_type = if is_text { CONTINUOUS } else { BY_LAYER_TYPE };
    for contour in &contours {
        let entity = match contour.points[..] {
            [a, b] if !contour.is_closed => {
                EntityType::Line(Line { p1: point(a), p2: point(b), ..Line::default() })
            }
            _ if options.version == DxfVersion::R12 => EntityType::Polyline(old_polyline(file, contour)),
            _ => EntityType::LwPolyline(polyline(contour)),
        };
        add_entity(file, layer, line_type, entity);
    }
}

fn add_entity(file: &mut dxf::Drawing, layer: &str, line_type: &str, specific: EntityType) {
    let mut entity = Entity::new(specific);
    entity.common.layer = layer.to_owned();
    entity.common.line_type_name = line_type.to_owned();
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
        value: text::as_seen(&text.content),
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
