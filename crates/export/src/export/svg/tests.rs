use super::*;
use crate::export::fixture::{A4_MM, model, sheet};
use glam::DAffine2;
use roxmltree::{Document as Xml, Node as XmlNode};
use std::sync::Arc;
use tatamu_draw::drawing::{Layer, Raster};

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

fn written(pages: usize, text_mode: TextMode) -> Vec<String> {
    let options = FormatOptions {
        svg: SvgOptions { text: text_mode, ..SvgOptions::default() },
        ..FormatOptions::default()
    };
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
    let numbers = |text: &str| text.split(' ').map(|n| n.parse::<f64>().expect("number")).collect::<Vec<_>>();
    let view = numbers(root.attribute("viewBox").expect("a view box"));
    // A user unit is 1/96 inch.
    assert_eq!(view[..2], [0.0, 0.0]);
    assert!((view[2] * 25.4 / 96.0 - 210.0).abs() < 1e-4 && (view[3] * 25.4 / 96.0 - 297.0).abs() < 1e-4);
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
    let styles = LineStyles::standard();
    let all = Layer::ALL.map(|layer| styles.layer_name(layer).to_owned());
    assert_eq!(labels, BTreeSet::from(all));
    let ids = xml.descendants().filter_map(|n| n.attribute("id")).collect::<Vec<_>>();
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len());
    assert!(ids.contains(&"cut-head-1-2") && ids.contains(&"cut-head-2-2"), "{ids:?}");
}

/// A sheet whose first piece had no tabs had the areas of tabs above their letters.
#[test]
fn areas_lie_below_lines_and_texts_whatever_piece_comes_first() {
    let mut drawing = sheet(A4_MM, 1, 1);
    let first = drawing.marks.iter().position(|mark| mark.layer == Layer::Tab).expect("a tab");
    drawing.marks.remove(first);
    let pages = Pages::new("t", vec![drawing], LineStyles::standard()).expect("can be drawn");
    let files = write(&pages, &FormatOptions::default()).expect("can be written");
    let text = String::from_utf8(files[0].bytes.clone()).expect("UTF-8");
    let xml = Xml::parse(&text).expect("valid XML");
    let order: Vec<_> = groups(&xml).iter().filter_map(|g| g.attribute((INKSCAPE, "label"))).collect();
    let place = |layer| order.iter().position(|&name| name == LineStyles::standard().layer_name(layer));
    for area in [Layer::Picture, Layer::Tab, Layer::Glue] {
        for line in [Layer::Mountain, Layer::Valley, Layer::FoldHinge, Layer::Cut, Layer::Label] {
            assert!(place(area).expect("drawn") < place(line).expect("drawn"), "{area:?} {line:?} {order:?}");
        }
    }
}

#[test]
fn coordinates_are_exact_and_flipped_once() {
    let text = &written(1, TextMode::Outlines)[0];
    let xml = Xml::parse(text).expect("valid XML");
    let path_mm = |id: &str| {
        let group = xml.descendants().find(|n| n.attribute("id") == Some(id)).expect("group");
        let data = group.descendants().find_map(|n| n.attribute("d")).expect("path");
        points(data).into_iter().map(|p| p / PX_PER_MM).collect::<Vec<_>>()
    };
    let assert_near = |found: &[DVec2], expected: &[[f64; 2]]| {
        assert_eq!(found.len(), expected.len());
        let far = found.iter().zip(expected).find(|&(p, &q)| p.distance(q.into()) > 1e-4);
        assert_eq!(far, None);
    };
    // The first piece stands at (20, 40) from the bottom.
    assert_near(&path_mm("mountain-head-1-2"), &[[20.0, 249.0], [50.0, 249.0]]);
    let corners = [[20.0, 257.0], [50.0, 257.0], [50.0, 227.0], [20.0, 227.0]];
    assert_near(&path_mm("cut-head-1-2"), &corners);
    // The second is turned, and keeps its length.
    let [a, b] = path_mm("mountain-head-2-2")[..] else { panic!("not a segment") };
    assert!(((b - a).length() - 30.0).abs() < 2e-4);
    let bar = path_mm("furniture");
    assert!((bar[1] - bar[0]).distance(DVec2::new(100.0, 0.0)) < 1e-4);
    assert!(bar[0].y < A4_MM.y - 10.0 + 1e-4);
}

#[test]
fn each_contour_is_one_continuous_path() {
    let text = &written(1, TextMode::Outlines)[0];
    let xml = Xml::parse(text).expect("valid XML");
    let group = xml.descendants().find(|n| n.attribute("id") == Some("cut-head-1-2")).expect("group");
    let paths = group.descendants().filter_map(|n| n.attribute("d")).collect::<Vec<_>>();
    // The square and its hole.
    assert_eq!(paths.len(), 2);
    for path in paths {
        assert_eq!((path.matches('M').count(), path.matches('L').count()), (1, 3), "{path}");
        assert!(path.ends_with('Z'), "{path}");
    }
}

#[test]
fn ids_name_role_piece_and_part() {
    let stroke = LineStyles::standard().stroke(Layer::Mountain).clone();
    let crease = Mark::line(Layer::Mountain, DVec2::ZERO, DVec2::X, &stroke);
    let mut drawing = Drawing::new("page", A4_MM);
    drawing.marks = vec![crease.of_piece("head 1/2").of_part("top chain3.1"); 2];
    let pages = Pages::new("page", vec![drawing], LineStyles::standard()).expect("valid");
    let files = write(&pages, &FormatOptions::default()).expect("can be written");
    let text = String::from_utf8(files[0].bytes.clone()).expect("UTF-8");
    let xml = Xml::parse(&text).expect("valid XML");
    let ids = xml.descendants().filter_map(|n| n.attribute("id")).collect::<Vec<_>>();
    let crease = "mountain-head-1-2-top-chain3-1";
    assert_eq!(ids, ["mountain", "mountain-head-1-2", crease, &format!("{crease}-2")]);
}

#[test]
fn names_are_text_and_no_markup() {
    let name = "<script>alert(1)</script> \"&' ]]> -- \u{7}\u{1b}[31m\u{ffff}";
    let stroke = LineStyles::standard().stroke(Layer::Cut).clone();
    for text_mode in [TextMode::Outlines, TextMode::Strokes, TextMode::Text] {
        let mut drawing = Drawing::new(name, A4_MM);
        let line = Mark::line(Layer::Cut, DVec2::ZERO, DVec2::X, &stroke);
        let label = Mark::text(Layer::Label, Text::new(name, DVec2::ZERO, 3.0));
        drawing.marks = vec![line.of_piece(name).of_part(name), label.of_piece(name)];
        let pages = Pages::new(name, vec![drawing], LineStyles::standard()).expect("valid");
        let svg = SvgOptions { text: text_mode, ..SvgOptions::default() };
        let options = FormatOptions { svg, ..FormatOptions::default() };
        let files = write(&pages, &options).expect("can be written");
        let text = String::from_utf8(files[0].bytes.clone()).expect("UTF-8");
        let xml = Xml::parse(&text).expect("valid XML");
        assert!(xml.descendants().all(|n| !n.has_tag_name("script") && n.tag_name().name() != "script"));
        let labels: Vec<&str> = xml.descendants().filter_map(|n| n.attribute((INKSCAPE, "label"))).collect();
        assert!(labels.iter().any(|l| l.starts_with("<script>alert(1)</script> \"&' ]]>")), "{labels:?}");
        assert!(!text.contains(['\u{7}', '\u{1b}', '\u{ffff}']));
    }
}

#[test]
fn hairlines_are_thinner_than_a_thousandth_of_an_inch() {
    let svg = SvgOptions { stroke: SvgStroke::Hairline, text: TextMode::Strokes };
    let files = write(&model(1), &FormatOptions { svg, ..FormatOptions::default() }).expect("can be written");
    let text = String::from_utf8(files[0].bytes.clone()).expect("UTF-8");
    let xml = Xml::parse(&text).expect("valid XML");
    let widths = xml.descendants().filter_map(|n| n.attribute("stroke-width"));
    let widths = widths.map(|w| w.parse::<f64>().expect("number")).collect::<Vec<_>>();
    assert!(widths.len() > 10 && widths.iter().all(|&w| w / 96.0 <= 0.001 && w > 0.0));
    // Letters are lines too, so nothing is filled but the tabs and pictures of the two pieces, and the
    // place of glue in the legend with its triangle.
    let fills = xml.descendants().filter_map(|n| n.attribute("fill"));
    assert_eq!(
        fills.filter(|&fill| fill != "none").collect::<Vec<_>>(),
        ["#e2e2e2", "#e2e2e2", "#faf0dc", "#faf0dc", "#fdf1cc", "#404040"]
    );
}

#[test]
fn pictures_are_clipped_and_lie_at_their_place() {
    let pixels = vec![Rgb(255, 0, 0), Rgb(0, 255, 0), Rgb(0, 0, 255), Rgb(9, 9, 9)];
    let raster = Arc::new(Raster::new(2, 2, 5.0, pixels).expect("valid"));
    let clip = Polyline::closed([[20.0, 30.0], [30.0, 30.0], [25.0, 40.0]].map(DVec2::from).to_vec());
    let place = DAffine2::from_translation(DVec2::new(20.0, 30.0));
    let mut drawing = Drawing::new("page", A4_MM);
    drawing.marks.push(Mark::image(Layer::Picture, Image { raster, place, clip }));
    let pages = Pages::new("page", vec![drawing], LineStyles::standard()).expect("valid");
    let files = write(&pages, &FormatOptions::default()).expect("can be written");
    let text = String::from_utf8(files[0].bytes.clone()).expect("UTF-8");
    let xml = Xml::parse(&text).expect("valid XML");
    let image = xml.descendants().find(|n| n.has_tag_name(("http://www.w3.org/2000/svg", "image")));
    let matrix = image.and_then(|n| n.attribute("transform")).expect("placed");
    let numbers = matrix.trim_start_matches("matrix(").trim_end_matches(')').split(' ');
    let numbers = numbers.map(|n| n.parse::<f64>().expect("number") / PX_PER_MM).collect::<Vec<_>>();
    // A pixel is 5 mm, and the upper left corner is 10 mm above the lower one.
    for (found, expected) in numbers.iter().zip([5.0, 0.0, 0.0, 5.0, 20.0, 297.0 - 40.0]) {
        assert!((found - expected).abs() < 2e-5, "{matrix}");
    }
    let group = image.and_then(|n| n.parent()).expect("a group");
    assert_eq!(group.attribute("clip-path"), Some("url(#clip)"));
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
