//! SVG by the crate `svg`: one document a drawing, one unit a millimetre, one group a layer.
//!
//! Layers are painted in the order in which they first occur. Path data is written here, since the
//! crate's own is `f32`.

use super::{ExportError, ExportFile, Format, FormatOptions, Source, TextMode};
use crate::drawing::text::{self, FONT_FAMILY, PathCommand};
use crate::drawing::{Drawing, Layer, Mark, Pages, Polyline, Rgb, Shape, Stroke, Text};
use glam::DVec2;
use std::collections::BTreeSet;
use std::fmt::Write;
use svg::node::element::{self, Group, Path, Rectangle, Title};
use svg::{Document, Node};

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "svg",
    extensions: &["svg"],
    description: "SVG in millimetres, one file a sheet, one group a kind of line",
    source: Source::Pages(write),
};

/// Digits after the point: a tenth of a micrometre.
const DECIMALS: usize = 4;

/// Choices for SVG files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SvgOptions {
    /// How texts are written.
    pub text: TextMode,
}

fn write(pages: &Pages, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let file = |(index, drawing)| {
        let page = Page { drawing, text_mode: options.svg.text, ids: BTreeSet::new() };
        let svg = format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n", page.document());
        ExportFile::of_page(index, svg.into_bytes())
    };
    Ok(pages.drawings().iter().enumerate().map(file).collect())
}

/// One drawing on its way to SVG.
struct Page<'a> {
    drawing: &'a Drawing,
    text_mode: TextMode,
    ids: BTreeSet<String>,
}

impl Page<'_> {
    fn document(mut self) -> Document {
        let size = self.drawing.size_mm;
        let (width, height) = (number(size.x), number(size.y));
        let mut document = Document::new()
            .set("width", format!("{width}mm"))
            .set("height", format!("{height}mm"))
            .set("viewBox", format!("0 0 {width} {height}"))
            .set("xmlns:inkscape", "http://www.inkscape.org/namespaces/inkscape")
            .add(Title::new(xml_text(&self.drawing.title)));
        if let Some(ground) = self.drawing.ground {
            let sheet = Rectangle::new().set("width", width).set("height", height);
            document.append(sheet.set("fill", colour(ground)));
        }
        let mut layers = Vec::new();
        for mark in &self.drawing.marks {
            if !layers.contains(&mark.layer) {
                layers.push(mark.layer);
            }
        }
        for layer in layers {
            document.append(self.layer(layer));
        }
        document
    }

    /// All marks of a layer; those of a piece that follow each other are grouped.
    fn layer(&mut self, layer: Layer) -> Group {
        let mut group = Group::new()
            .set("id", self.new_id(layer.name()))
            .set("inkscape:groupmode", "layer")
            .set("inkscape:label", layer.name());
        let drawing = self.drawing;
        let marks = drawing.marks.iter().filter(|mark| mark.layer == layer).collect::<Vec<_>>();
        for run in marks.chunk_by(|a, b| a.piece == b.piece) {
            let nodes = run.iter().map(|mark| self.mark(mark));
            match &run[0].piece {
                Some(piece) => {
                    let mut part = Group::new().set("inkscape:label", xml_text(piece));
                    nodes.for_each(|node| part.append(node));
                    group.append(part.set("id", self.new_id(&format!("{}-{piece}", layer.name()))));
                }
                None => nodes.for_each(|node| group.append(node)),
            }
        }
        group
    }

    fn mark(&self, mark: &Mark) -> Box<dyn Node> {
        match &mark.shape {
            Shape::Path { contours, stroke, fill } => Box::new(self.path(contours, stroke, *fill)),
            Shape::Text(text) => match self.text_mode {
                TextMode::Outlines => Box::new(self.outlined(text)),
                TextMode::Text => Box::new(self.written(text)),
            },
        }
    }

    fn path(&self, contours: &[Polyline], stroke: &Option<Stroke>, fill: Option<Rgb>) -> Path {
        let mut data = String::new();
        for contour in contours {
            for (index, &point) in contour.points.iter().enumerate() {
                self.push(&mut data, if index == 0 { 'M' } else { 'L' }, &[point]);
            }
            if contour.is_closed {
                data.push('Z');
            }
        }
        let mut path = Path::new().set("d", data);
        path = match fill {
            Some(fill) => path.set("fill", colour(fill)).set("fill-rule", "evenodd"),
            None => path.set("fill", "none"),
        };
        let Some(stroke) = stroke else { return path };
        path = path
            .set("stroke", colour(stroke.colour))
            .set("stroke-width", number(stroke.width_mm))
            .set("stroke-linejoin", "round");
        if stroke.dash_mm.is_empty() {
            return path;
        }
        let dash = stroke.dash_mm.iter().map(|&mm| number(mm)).collect::<Vec<_>>();
        path.set("stroke-dasharray", dash.join(" "))
    }

    /// Text as the outlines of its letters; the words stay searchable as the path's label.
    fn outlined(&self, text: &Text) -> Path {
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
        Path::new()
            .set("d", data)
            .set("fill", colour(text.colour))
            .set("aria-label", text::printable(&text.content))
    }

    fn written(&self, text: &Text) -> element::Text {
        let start = self.flip(text.start());
        let turn = format!(
            "translate({} {}) rotate({})",
            number(start.x),
            number(start.y),
            number(-text.angle_rad.to_degrees())
        );
        element::Text::new(text::printable(&text.content))
            .set("transform", turn)
            .set("font-family", format!("{FONT_FAMILY}, sans-serif"))
            .set("font-size", number(text::em_mm(text.cap_height_mm)))
            .set("font-kerning", "none")
            .set("fill", colour(text.colour))
    }

    fn push(&self, data: &mut String, letter: char, points: &[DVec2]) {
        data.push(letter);
        for (index, &point) in points.iter().enumerate() {
            let p = self.flip(point);
            let gap = if index == 0 { "" } else { " " };
            let _ = write!(data, "{gap}{},{}", number(p.x), number(p.y));
        }
    }

    /// From y up to y down.
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

/// Without the control characters that XML forbids.
fn xml_text(content: &str) -> String {
    content.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

fn colour(Rgb(red, green, blue): Rgb) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A number with at most [`DECIMALS`] digits after the point, never `-0`.
fn number(value: f64) -> String {
    let text = format!("{value:.DECIMALS$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::fixture::{A4_MM, model};
    use roxmltree::{Document as Xml, Node as XmlNode};

    const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

    fn written(pages: usize, text_mode: TextMode) -> Vec<String> {
        let options = FormatOptions { svg: SvgOptions { text: text_mode }, ..FormatOptions::default() };
        let files = write(&model(pages), &options).expect("can be written");
        files.into_iter().map(|file| String::from_utf8(file.bytes).expect("UTF-8")).collect()
    }

    fn groups<'a>(xml: &'a Xml) -> Vec<XmlNode<'a, 'a>> {
        let is_layer = |n: &XmlNode| n.attribute((INKSCAPE, "groupmode")) == Some("layer");
        xml.descendants().filter(is_layer).collect()
    }

    /// The coordinates of a path without curves.
    fn points(data: &str) -> Vec<DVec2> {
        let pairs = data.split(['M', 'L', 'Z']).filter(|pair| !pair.is_empty());
        let pair = |pair: &str| {
            let (x, y) = pair.split_once(',').expect("x,y");
            DVec2::new(x.parse().expect("x"), y.parse().expect("y"))
        };
        pairs.map(pair).collect()
    }

    #[test]
    fn one_file_a_sheet_in_millimetres() {
        let files = write(&model(2), &FormatOptions::default()).expect("can be written");
        assert_eq!(files.iter().map(|f| f.suffix.as_str()).collect::<Vec<_>>(), ["-1", "-2"]);
        let text = &written(1, TextMode::Outlines)[0];
        let xml = Xml::parse(text).expect("valid XML");
        let root = xml.root_element();
        assert_eq!(root.attribute("width"), Some("210mm"));
        assert_eq!(root.attribute("height"), Some("297mm"));
        assert_eq!(root.attribute("viewBox"), Some("0 0 210 297"));
        let title =
            xml.descendants().find(|n| n.has_tag_name((root.tag_name().namespace().unwrap_or(""), "title")));
        assert_eq!(title.and_then(|t| t.text()).map(str::trim), Some("teddy <3> 1/1"));
    }

    #[test]
    fn each_kind_of_line_has_its_layer_and_ids_are_unique() {
        let text = &written(1, TextMode::Outlines)[0];
        let xml = Xml::parse(text).expect("valid XML");
        let labels = groups(&xml)
            .iter()
            .map(|g| g.attribute((INKSCAPE, "label")).unwrap_or("").to_owned())
            .collect::<BTreeSet<_>>();
        let all = Layer::ALL.map(|layer| layer.name().to_owned());
        assert_eq!(labels, BTreeSet::from(all));
        let ids = xml.descendants().filter_map(|n| n.attribute("id")).collect::<Vec<_>>();
        assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len());
        assert!(ids.contains(&"cut-head-1-2") && ids.contains(&"cut-head-2-2"), "{ids:?}");
    }

    #[test]
    fn coordinates_are_exact_and_flipped_once() {
        let text = &written(1, TextMode::Outlines)[0];
        let xml = Xml::parse(text).expect("valid XML");
        let path = |id: &str| {
            let group = xml.descendants().find(|n| n.attribute("id") == Some(id)).expect("group");
            group.descendants().find_map(|n| n.attribute("d")).expect("path").to_owned()
        };
        // The first piece stands at (20, 40) from the bottom.
        assert_eq!(path("mountain-head-1-2"), "M20,249L50,249");
        assert!(path("cut-head-1-2").starts_with("M20,257L50,257L50,227L20,227ZM32,245"));
        // The second is turned, and keeps its length.
        let [a, b] = points(&path("mountain-head-2-2"))[..] else { panic!("not a segment") };
        assert!(((b - a).length() - 30.0).abs() < 2e-4);
        let bar = points(&path("furniture"));
        assert_eq!(bar[1] - bar[0], DVec2::new(100.0, 0.0));
        assert!(bar[0].y < A4_MM.y - 10.0 + 1e-9);
    }

    #[test]
    fn words_can_be_found_in_both_modes() {
        for text_mode in [TextMode::Outlines, TextMode::Text] {
            let text = &written(1, text_mode)[0];
            let xml = Xml::parse(text).expect("valid XML");
            let says = |n: &XmlNode| {
                let content = n.attribute("aria-label").or(n.text()).unwrap_or("").trim();
                content == "A → 12"
            };
            assert_eq!(xml.descendants().filter(|n| n.is_element() && says(n)).count(), 2);
            let has_text = xml.descendants().any(|n| n.tag_name().name() == "text");
            assert_eq!(has_text, text_mode == TextMode::Text);
        }
    }

    #[test]
    fn numbers_are_short_and_never_minus_zero() {
        assert_eq!(number(-0.000_01), "0");
        assert_eq!(number(100.0), "100");
        assert_eq!(number(0.123_46), "0.1235");
        assert_eq!(number(-12.5), "-12.5");
    }

    #[test]
    fn the_same_input_gives_the_same_bytes() {
        assert_eq!(written(2, TextMode::Outlines), written(2, TextMode::Outlines));
    }
}
