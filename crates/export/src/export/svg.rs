//! SVG by the crate `svg`: one document a drawing, one Inkscape layer for each layer of the style.
//!
//! Programs for cutters disagree on what they read of `width`, `height` and `viewBox`. So the size
//! is written in mm, and the user unit is a pixel of 1/96 inch: a program that ignores any of the
//! three still reads the right size. Nothing but pictures is transformed. Layers are painted from the
//! lowest to the highest, whatever piece comes first. Path data is written here, since the crate's own
//! is `f32`.

use super::{ExportError, ExportFile, Format, FormatOptions, Source, TextMode, png};
use base64::Engine;
use glam::DVec2;
use std::collections::BTreeSet;
use std::fmt::Write;
use svg::node::element::{self, ClipPath, Element, Group, Path, Rectangle, Title};
use svg::{Document, Node};
use tatamu_core::units::MM_PER_INCH;
use tatamu_draw::drawing::text::{self, FONT_FAMILIES, PathCommand};
use tatamu_draw::drawing::{
    Drawing, Image, Layer, LineStyles, Mark, Pages, Polyline, Rgb, Shape, Stroke, Text, strokes,
};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "svg",
    extensions: &["svg"],
    description: "SVG in millimetres, one file per sheet, one layer per kind of line",
    source: Source::Pages(write),
};

/// Digits after the point: less than a tenth of a micrometre.
const DECIMALS: usize = 4;
/// Pixels of CSS, which are the user unit, in a millimetre.
const PX_PER_MM: f64 = 96.0 / MM_PER_INCH;
/// Lines up to 0.001 inch are vectors to follow for the drivers of laser cutters.
const HAIRLINE_MM: f64 = 0.025;

/// How wide lines are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SvgStroke {
    /// As the style says.
    #[default]
    Styled,
    /// As thin as laser cutters want them.
    Hairline,
}

impl std::str::FromStr for SvgStroke {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "styled" => Ok(Self::Styled),
            "hairline" => Ok(Self::Hairline),
            _ => Err("the lines must be one of styled, hairline".to_owned()),
        }
    }
}

/// Choices for SVG files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SvgOptions {
    /// How texts are written.
    pub text: TextMode,
    /// How wide lines are.
    pub stroke: SvgStroke,
}

/// Letters are outlines, since cutters' programs drop fonts.
impl Default for SvgOptions {
    fn default() -> Self {
        Self { text: TextMode::Outlines, stroke: SvgStroke::default() }
    }
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let file = |drawing| {
        let page = Page { drawing, styles: pages.styles(), options: options.svg, ids: BTreeSet::new() };
        let document = page.document()?;
        Ok(format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{document}\n").into_bytes())
    };
    let files = pages.drawings().iter().map(file).collect::<Result<Vec<_>, ExportError>>()?;
    Ok(ExportFile::of_pages(files))
}

/// One drawing on its way to SVG.
struct Page<'a> {
    drawing: &'a Drawing,
    styles: &'a LineStyles,
    options: SvgOptions,
    ids: BTreeSet<String>,
}

impl<'a> Page<'a> {
    fn document(mut self) -> Result<Document, ExportError> {
        let size = self.drawing.size_mm;
        let [width, height] = [px(size.x), px(size.y)];
        let mut view = Element::new("sodipodi:namedview");
        view.assign("inkscape:document-units", "mm");
        let mut document = Document::new()
            .set("width", format!("{}mm", number(size.x)))
            .set("height", format!("{}mm", number(size.y)))
            .set("viewBox", format!("0 0 {width} {height}"))
            .set("xmlns:inkscape", "http://www.inkscape.org/namespaces/inkscape")
            .set("xmlns:sodipodi", "http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd")
            .add(Title::new(xml_text(&self.drawing.title)))
            .add(view);
        if let Some(ground) = self.drawing.ground {
            let sheet = Rectangle::new().set("width", width).set("height", height);
            document.append(sheet.set("fill", ground.hex()));
        }
        let used: BTreeSet<Layer> = self.drawing.marks.iter().map(|mark| mark.layer).collect();
        let mut names: Vec<&str> = Vec::new();
        for layer in Layer::PAINTED.into_iter().filter(|layer| used.contains(layer)) {
            let name = self.styles.layer_name(layer);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        for name in names {
            document.append(self.layer(name)?);
        }
        Ok(document)
    }

    /// All marks of a layer; those of a piece that follow each other are grouped.
    fn layer(&mut self, name: &'a str) -> Result<Group, ExportError> {
        let id = name.to_ascii_lowercase();
        let mut group = Group::new()
            .set("id", self.new_id(&id))
            .set("inkscape:groupmode", "layer")
            .set("inkscape:label", name);
        let (drawing, styles) = (self.drawing, self.styles);
        let marks = drawing.marks.iter().filter(|mark| styles.layer_name(mark.layer) == name);
        for run in marks.collect::<Vec<_>>().chunk_by(|a, b| a.piece == b.piece) {
            let Some(piece) = &run[0].piece else {
                for mark in run {
                    self.mark(mark)?.into_iter().for_each(|node| group.append(node));
                }
                continue;
            };
            let part = Group::new().set("inkscape:label", xml_text(piece));
            let mut part = part.set("id", self.new_id(&format!("{id}-{piece}")));
            for mark in run {
                self.mark(mark)?.into_iter().for_each(|node| part.append(node));
            }
            group.append(part);
        }
        Ok(group)
    }

    /// The elements of a mark. Those of a piece have an id of its role, piece and part.
    fn mark(&mut self, mark: &Mark) -> Result<Vec<Element>, ExportError> {
        let mut elements: Vec<Element> = match &mark.shape {
            Shape::Path { contours, stroke, fill } => self.paths(contours, stroke.as_ref(), *fill),
            Shape::Text(text) => vec![self.text(text, self.styles.stroke(mark.layer).width_mm)],
            Shape::Image(image) => self.image(image)?,
        };
        if let (Some(piece), Some(part)) = (&mark.piece, &mark.part) {
            let name = format!("{}-{piece}-{part}", mark.layer.name());
            for element in elements.iter_mut().filter(|element| !element.get_attributes().contains_key("id"))
            {
                let id = self.new_id(&name);
                element.assign("id", id);
            }
        }
        Ok(elements)
    }

    /// One path for each contour that is stroked, so that a cutter follows it in one go; those that
    /// are filled make one path together.
    fn paths(&self, contours: &[Polyline], stroke: Option<&Stroke>, fill: Option<Rgb>) -> Vec<Element> {
        let data: Vec<String> = contours.iter().map(|contour| self.contour(contour)).collect();
        if let Some(fill) = fill {
            let path = Path::new().set("d", data.concat()).set("fill", fill.hex());
            let path = path.set("fill-rule", "evenodd");
            return vec![stroke.map_or(path.clone(), |stroke| self.stroked(path, stroke)).into()];
        }
        let Some(stroke) = stroke else { return Vec::new() };
        let path = |data| self.stroked(Path::new().set("d", data).set("fill", "none"), stroke).into();
        data.into_iter().map(path).collect()
    }

    fn contour(&self, contour: &Polyline) -> String {
        let mut data = String::new();
        for (index, &point) in contour.points.iter().enumerate() {
            self.push(&mut data, if index == 0 { 'M' } else { 'L' }, &[point]);
        }
        if contour.is_closed {
            data.push('Z');
        }
        data
    }

    fn stroked(&self, path: Path, stroke: &Stroke) -> Path {
        let width_mm = match self.options.stroke {
            SvgStroke::Styled => stroke.width_mm,
            SvgStroke::Hairline => HAIRLINE_MM,
        };
        let path = path
            .set("stroke", stroke.colour.hex())
            .set("stroke-width", px(width_mm))
            .set("stroke-linejoin", "round");
        if stroke.dash_mm.is_empty() {
            return path.set("stroke-linecap", "round");
        }
        let dash = stroke.dash_mm.iter().map(|&mm| px(mm)).collect::<Vec<_>>();
        path.set("stroke-dasharray", dash.join(" "))
    }

    /// A text; where it becomes a path, its words stay searchable as the path's label.
    fn text(&self, text: &Text, pen_mm: f64) -> Element {
        let words = text::as_seen(&text.content);
        match self.options.text {
            TextMode::Outlines => {
                let path = Path::new().set("d", self.letters(text)).set("fill", text.colour.hex());
                path.set("aria-label", words).into()
            }
            TextMode::Strokes => {
                let stroke = Stroke::solid(pen_mm, text.colour);
                let lines = strokes::polylines(text);
                let data: String = lines.iter().map(|line| self.contour(line)).collect();
                let path = self.stroked(Path::new().set("d", data).set("fill", "none"), &stroke);
                path.set("aria-label", words).into()
            }
            TextMode::Text => self.written(text, words).into(),
        }
    }

    fn letters(&self, text: &Text) -> String {
        let mut data = String::new();
        for command in text::outlines(text) {
            let letter = match command {
                PathCommand::MoveTo(_) => 'M',
                PathCommand::LineTo(_) => 'L',
                PathCommand::QuadTo(..) => 'Q',
                PathCommand::CubicTo(..) => 'C',
                PathCommand::Close => 'Z',
            };
            self.push(&mut data, letter, &command.points());
        }
        data
    }

    fn written(&self, text: &Text, words: String) -> element::Text {
        let start = self.flip(text.start());
        let turn = number(-text.angle_rad.to_degrees());
        let place = format!("translate({} {}) rotate({turn})", px(start.x), px(start.y));
        element::Text::new(words)
            .set("transform", place)
            .set("font-family", format!("{FONT_FAMILIES}, sans-serif"))
            .set("font-size", px(text::em_mm(text.cap_height_mm)))
            .set("font-kerning", "none")
            .set("fill", text.colour.hex())
    }

    /// The clip's definition, and a group that it holds for: inside it the pixels are turned.
    fn image(&mut self, image: &Image) -> Result<Vec<Element>, ExportError> {
        let raster = &image.raster;
        let bytes = png::of_raster(raster).map_err(|error| ExportError::writer(&FORMAT, error))?;
        let bytes = base64::engine::general_purpose::STANDARD.encode(bytes);
        let clip = self.new_id("clip");
        let outline = Path::new().set("d", self.contour(&image.clip));
        let top_left =
            image.place.transform_point2(DVec2::Y * f64::from(raster.height()) * raster.pixel_mm());
        let top_left = self.flip(top_left) * PX_PER_MM;
        let along = image.place.matrix2.x_axis * (raster.pixel_mm() * PX_PER_MM);
        let numbers = [along.x, -along.y, along.y, along.x, top_left.x, top_left.y].map(number);
        let pixels = element::Image::new()
            .set("width", raster.width())
            .set("height", raster.height())
            .set("preserveAspectRatio", "none")
            .set("transform", format!("matrix({})", numbers.join(" ")))
            .set("href", format!("data:image/png;base64,{bytes}"));
        let shown = Group::new().set("clip-path", format!("url(#{clip})")).add(pixels);
        Ok(vec![ClipPath::new().set("id", clip).add(outline).into(), shown.into()])
    }

    fn push(&self, data: &mut String, letter: char, points: &[DVec2]) {
        data.push(letter);
        for (index, &point) in points.iter().enumerate() {
            let p = self.flip(point);
            let gap = if index == 0 { "" } else { " " };
            let _ = write!(data, "{gap}{},{}", px(p.x), px(p.y));
        }
    }

    /// From y up to y down, in mm.
    fn flip(&self, p: DVec2) -> DVec2 {
        DVec2::new(p.x, self.drawing.size_mm.y - p.y)
    }

    /// An id made from a name: letters and digits stay, and a number is added where it is taken.
    fn new_id(&mut self, name: &str) -> String {
        let slug = name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect::<String>();
        let mut id = slug.clone();
        let mut count = 1;
        while !self.ids.insert(id.clone()) {
            count += 1;
            id = format!("{slug}-{count}");
        }
        id
    }
}

/// Without the characters that XML forbids, and those that steer who reads it.
fn xml_text(content: &str) -> String {
    let is_forbidden = |c: char| text::steers(c) || matches!(c, '\u{fffe}' | '\u{ffff}');
    content.chars().map(|c| if is_forbidden(c) { ' ' } else { c }).collect()
}

/// A length in user units.
fn px(mm: f64) -> String {
    number(mm * PX_PER_MM)
}

/// A number with at most [`DECIMALS`] digits after the point, never `-0`.
fn number(value: f64) -> String {
    let text = format!("{value:.DECIMALS$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests;
