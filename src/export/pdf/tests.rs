use super::*;
use crate::export::fixture::{A4_MM, LEGEND, model};
use lopdf::content::{Content, Operation};

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
    let mountain = [2.0, 1.0].map(|mm| mm * PT_PER_MM);
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
        assert!(names.contains(&layer.name().to_owned()), "{names:?}");
    }
    assert_eq!(names.last().map(String::as_str), Some("picture"));
}

#[test]
fn the_font_is_embedded_and_texts_can_be_found() {
    let document = Document::load_mem(&written(1)).expect("valid PDF");
    let fonts = document.objects.values().filter_map(|object| match object {
        Object::Stream(stream) if stream.dict.has(b"Length1") => stream.decompressed_content().ok(),
        _ => None,
    });
    assert_eq!(fonts.collect::<Vec<_>>(), [FONT_FILE]);
    let text = document.extract_text(&[1]).expect("text");
    for words in ["100 mm: print at 100 % (actual size)", "page 1 of 1", "A → 12", "fold flat 180°"] {
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
