use super::*;
use crate::export::fixture::{A4_MM, LEGEND, model};
use glam::DAffine2;
use lopdf::content::{Content, Operation};
use tatamu_core::units::parse_paper;
use tatamu_draw::drawing::{Chapter, Drawing, Image, Mark, Polyline, Raster, Rgb};

const MM_PER_PT: f64 = 25.4 / 72.0;

fn written(pages: usize) -> Vec<u8> {
    let mut files = write(&model(pages), &FormatOptions::default()).expect("the fixture can be written");
    assert_eq!(files.len(), 1);
    files.remove(0).bytes
}

fn numbers(operands: &[Object]) -> Vec<f64> {
    operands.iter().map(|o| f64::from(o.as_float().expect("a number"))).collect()
}

fn operations(document: &Document, page: u32) -> Vec<Operation> {
    let content = document.get_page_content(document.get_pages()[&page]);
    Content::decode(&content).expect("valid operators").operations
}

/// All straight segments of a page, in mm.
fn segments(operations: &[Operation]) -> Vec<[DVec2; 2]> {
    let (mut out, mut pen) = (Vec::new(), DVec2::ZERO);
    for operation in operations {
        if let "m" | "l" = operation.operator.as_str() {
            let at = DVec2::from_slice(&numbers(&operation.operands)) * MM_PER_PT;
            if operation.operator == "l" {
                out.push([pen, at]);
            }
            pen = at;
        }
    }
    out
}

#[test]
fn pages_have_the_exact_size_of_the_sheet() {
    let document = Document::load_mem(&written(3)).expect("valid PDF");
    assert_eq!(document.version, "1.6");
    let pages = document.get_pages();
    assert_eq!(pages.len(), 3);
    for id in pages.values() {
        let page = document.get_dictionary(*id).expect("page");
        let media = numbers(page.get(b"MediaBox").and_then(Object::as_array).expect("box"));
        assert_eq!(media[..2], [0.0, 0.0]);
        let size_mm = DVec2::from_slice(&media[2..]) * MM_PER_PT;
        assert!((size_mm - A4_MM).length() < 2e-5, "{size_mm}");
        assert!((media[2] - 595.2756).abs() < 5e-5);
    }
}

#[test]
fn the_scale_bar_is_100_mm_by_the_operators() {
    let document = Document::load_mem(&written(2)).expect("valid PDF");
    for page in [1, 2] {
        let operations = operations(&document, page);
        // Nothing scales the page.
        assert!(operations.iter().all(|o| o.operator != "cm"));
        let bars = segments(&operations);
        let bars = bars.iter().filter(|[a, b]| (b.x - a.x - 100.0).abs() < 0.01 && a.y == b.y);
        let [bar] = bars.collect::<Vec<_>>()[..] else { panic!("not one scale bar") };
        assert!((bar[1].x - bar[0].x - 100.0).abs() < 5e-5, "{bar:?}");
    }
}

#[test]
fn rings_are_closed_one_by_one() {
    let document = Document::load_mem(&written(1)).expect("valid PDF");
    let operations = operations(&document, 1);
    let operators = operations.iter().map(|o| o.operator.as_str()).collect::<Vec<_>>().join(" ");
    // Each of the two pieces has two rings to cut and one to glue, of four corners each.
    assert_eq!(operators.matches("m l l l h S").count(), 6);
    assert_eq!(operators.matches("m l l l m l l l h f*").count(), 2);
}

#[test]
fn dashes_are_in_points() {
    let document = Document::load_mem(&written(1)).expect("valid PDF");
    let dashes = operations(&document, 1).into_iter().filter(|o| o.operator == "d");
    let dashes = dashes.map(|o| numbers(o.operands[0].as_array().expect("array")));
    let mountain = [2.0, 1.0].map(|mm| mm / MM_PER_PT);
    let is_mountain = |dash: &Vec<f64>| {
        dash.len() == 2 && (dash[0] - mountain[0]).abs() < 1e-5 && (dash[1] - mountain[1]).abs() < 1e-5
    };
    // The legend and two pieces.
    assert_eq!(dashes.filter(is_mountain).count(), 3);
}

#[test]
fn the_catalog_forbids_scaling_and_names_the_layers() {
    let document = Document::load_mem(&written(1)).expect("valid PDF");
    let catalog = document.catalog().expect("catalog");
    let preferences = catalog.get(b"ViewerPreferences").and_then(Object::as_dict).expect("set");
    let scaling = preferences.get(b"PrintScaling").and_then(Object::as_name);
    assert_eq!(scaling.expect("set"), b"None");
    let groups = catalog.get(b"OCProperties").and_then(Object::as_dict).expect("layers");
    let groups = groups.get(b"OCGs").and_then(Object::as_array).expect("groups");
    let name = |group: &Object| {
        let group = document.get_dictionary(group.as_reference().expect("reference"));
        let name = group.and_then(|g| g.get(b"Name")).and_then(Object::as_str).expect("name");
        String::from_utf8_lossy(name).into_owned()
    };
    let names = groups.iter().map(name).collect::<Vec<_>>();
    for layer in LEGEND {
        assert!(names.iter().any(|name| name == LineStyles::standard().layer_name(layer)), "{names:?}");
    }
    assert_eq!(names.last().map(String::as_str), Some("PICTURE"));
}

#[test]
fn the_font_is_embedded_and_texts_can_be_found() {
    let document = Document::load_mem(&written(1)).expect("valid PDF");
    let fonts = document.objects.values().filter_map(|object| match object {
        Object::Stream(stream) if stream.dict.has(b"Length1") => stream.decompressed_content().ok(),
        _ => None,
    });
    assert_eq!(fonts.collect::<Vec<_>>(), [FONTS[0].file]);
    let text = document.extract_text(&[1]).expect("text");
    for words in ["100 mm: print at 100 % (actual size)", "sheet 1 of 1", "A → 12", "fold flat 180°"] {
        assert!(text.contains(words), "{words:?} is not in {text:?}");
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let first = written(2);
    assert!(first == written(2));
    let document = Document::load_mem(&first).expect("valid PDF");
    let info = document.trailer.get(b"Info").and_then(Object::as_reference).expect("info");
    let info = document.get_dictionary(info).expect("info");
    assert!(info.has(b"Title") && !info.has(b"CreationDate"));
    assert!(!document.trailer.has(b"ID"));
}

/// Title and destination of each bookmark, and how deep it is.
fn bookmarks(document: &Document) -> Vec<(usize, String, Vec<f64>, ObjectId)> {
    fn walk(
        document: &Document,
        of: &Dictionary,
        depth: usize,
        out: &mut Vec<(usize, String, Vec<f64>, ObjectId)>,
    ) {
        let mut next = of.get(b"First").and_then(Object::as_reference).ok();
        while let Some(id) = next {
            let item = document.get_dictionary(id).expect("an item");
            let title = lopdf::decode_text_string(item.get(b"Title").expect("title")).expect("text");
            let target = item.get(b"Dest").and_then(Object::as_array).expect("destination");
            out.push((depth, title, numbers(&target[2..]), target[0].as_reference().expect("a page")));
            walk(document, item, depth + 1, out);
            next = item.get(b"Next").and_then(Object::as_reference).ok();
        }
    }
    let mut out = Vec::new();
    let root = document.catalog().and_then(|c| c.get(b"Outlines")).and_then(Object::as_reference);
    walk(document, document.get_dictionary(root.expect("bookmarks")).expect("root"), 0, &mut out);
    out
}

#[test]
fn bookmarks_lead_to_components_and_pieces() {
    let pieces = vec!["head 1/2".to_owned(), "head 2/2".to_owned()];
    let chapters = vec![
        Chapter { name: "hëad".to_owned(), pieces },
        Chapter { name: "lost".to_owned(), pieces: vec!["lost".to_owned()] },
    ];
    let pages = model(2).with_chapters(chapters);
    let files = write(&pages, &FormatOptions::default()).expect("can be written");
    let document = Document::load_mem(&files[0].bytes).expect("valid PDF");
    let found = bookmarks(&document);
    let titles: Vec<(usize, &str)> = found.iter().map(|b| (b.0, b.1.as_str())).collect();
    // A component without a piece on any page has no bookmark.
    assert_eq!(titles, [(0, "hëad"), (1, "head 1/2"), (1, "head 2/2")]);
    // The first piece is the square of 30 mm at (20, 40) on the first page.
    let first = DVec2::from_slice(&found[1].2[..2]) * MM_PER_PT;
    let last = DVec2::from_slice(&found[1].2[2..]) * MM_PER_PT;
    assert!((first - DVec2::new(15.0, 35.0)).length() < 1e-4, "{first}");
    assert!((last - DVec2::new(55.0, 75.0)).length() < 1e-4, "{last}");
    assert_eq!(found[1].3, document.get_pages()[&1]);
}

#[test]
fn a_date_is_written_only_where_one_is_given() {
    let pdf = PdfOptions::default().with_created(Timestamp::of_unix(1_000_000_000));
    let files = write(&model(1), &FormatOptions { pdf, ..FormatOptions::default() }).expect("can be written");
    let document = Document::load_mem(&files[0].bytes).expect("valid PDF");
    let info = document.trailer.get(b"Info").and_then(Object::as_reference).expect("info");
    let date = document.get_dictionary(info).and_then(|info| info.get(b"CreationDate"));
    assert_eq!(date.and_then(Object::as_str).expect("a date"), b"D:20010909014640Z");
}

#[test]
fn tiles_hold_the_whole_sheet_at_full_size() {
    let pdf = PdfOptions::default().with_tile(parse_paper("a5").ok()).expect("large enough");
    let files = write(&model(1), &FormatOptions { pdf, ..FormatOptions::default() }).expect("can be written");
    let document = Document::load_mem(&files[0].bytes).expect("valid PDF");
    let pages = document.get_pages();
    // A4 on A5 upright is two by two: 148 - 30 mm and 210 - 30 mm a step. The upper half is empty.
    assert_eq!(pages.len(), 2);
    for (&number, id) in &pages {
        let page = document.get_dictionary(*id).expect("page");
        let media = numbers(page.get(b"MediaBox").and_then(Object::as_array).expect("box"));
        assert!((DVec2::from_slice(&media[2..]) * MM_PER_PT - DVec2::new(148.0, 210.0)).length() < 1e-4);
        let shifts = operations(&document, number).into_iter().filter(|o| o.operator == "cm");
        let shifts: Vec<Vec<f64>> = shifts.map(|o| numbers(&o.operands)).collect();
        // Moved, but not scaled.
        assert_eq!(shifts.len(), 1);
        assert_eq!(shifts[0][..4], [1.0, 0.0, 0.0, 1.0]);
    }
    let text = document.extract_text(&[1, 2]).expect("text");
    for words in ["tile B1 of 2 × 2", "tile B2 of 2 × 2", "50 mm"] {
        assert!(text.contains(words), "{words:?} is not in {text:?}");
    }
}

#[test]
fn pictures_are_pixels_at_their_place() {
    let pixels = vec![Rgb(255, 0, 0), Rgb(0, 255, 0)];
    let raster = std::sync::Arc::new(Raster::new(2, 1, 5.0, pixels).expect("valid"));
    let clip = Polyline::closed([[20.0, 30.0], [30.0, 30.0], [25.0, 35.0]].map(DVec2::from).to_vec());
    let place = DAffine2::from_translation(DVec2::new(20.0, 30.0));
    let mut drawing = Drawing::new("page", A4_MM);
    drawing.marks = vec![Mark::image(Layer::Picture, Image { raster, place, clip })];
    let pages = Pages::new("page", vec![drawing], LineStyles::standard()).expect("valid");
    let files = write(&pages, &FormatOptions::default()).expect("can be written");
    let document = Document::load_mem(&files[0].bytes).expect("valid PDF");
    let operations = operations(&document, 1);
    let operators = operations.iter().map(|o| o.operator.as_str()).collect::<Vec<_>>().join(" ");
    assert!(operators.contains("q m l l h W n cm q cm Do Q Q"), "{operators}");
    let matrix =
        operations.iter().find(|o| o.operator == "cm").map(|o| numbers(&o.operands)).expect("placed");
    for (found, expected) in matrix.iter().zip([10.0, 0.0, 0.0, 5.0, 20.0, 30.0]) {
        assert!((found * MM_PER_PT - expected).abs() < 1e-4, "{matrix:?}");
    }
    let stream = document.objects.values().filter_map(|object| object.as_stream().ok());
    let mut images =
        stream.filter(|s| s.dict.get(b"Subtype").and_then(Object::as_name).ok() == Some(b"Image"));
    let image = images.next().expect("an image");
    let content = image.decompressed_content().unwrap_or_else(|_| image.content.clone());
    assert_eq!(content, [255, 0, 0, 0, 255, 0]);
}
