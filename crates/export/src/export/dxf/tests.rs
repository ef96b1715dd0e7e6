use super::*;
use crate::export::fixture::model;
use std::collections::BTreeSet;

fn written(version: DxfVersion, text_mode: TextMode) -> String {
    let options = FormatOptions {
        dxf: DxfOptions { version, text: text_mode, ..DxfOptions::default() },
        ..FormatOptions::default()
    };
    let files = write(&model(2), &options).expect("can be written");
    assert_eq!(files.iter().map(|f| f.suffix.as_str()).collect::<Vec<_>>(), ["-1", "-2"]);
    String::from_utf8(files[0].bytes.clone()).expect("ASCII")
}

fn read(text: &str) -> dxf::Drawing {
    dxf::Drawing::load(&mut text.as_bytes()).expect("valid DXF")
}

/// Total length of the closed and open lines on a layer.
fn length_mm(file: &dxf::Drawing, layer: &str) -> f64 {
    let ring = |mut points: Vec<DVec2>, is_closed: bool| {
        if is_closed {
            points.push(points[0]);
        }
        points.windows(2).map(|w| (w[1] - w[0]).length()).sum::<f64>()
    };
    let entities = file.entities().filter(|e| e.common.layer == layer);
    let length = |entity: &Entity| match &entity.specific {
        EntityType::Line(line) => libm::hypot(line.p2.x - line.p1.x, line.p2.y - line.p1.y),
        EntityType::LwPolyline(line) => {
            ring(line.vertices.iter().map(|v| DVec2::new(v.x, v.y)).collect(), line.is_closed())
        }
        EntityType::Polyline(line) => {
            let at = |v: &Vertex| DVec2::new(v.location.x, v.location.y);
            ring(line.vertices().map(at).collect(), line.is_closed())
        }
        _ => 0.0,
    };
    entities.map(length).sum()
}

#[test]
fn both_versions_hold_the_exact_lengths() {
    for version in [DxfVersion::R12, DxfVersion::R2000] {
        let file = read(&written(version, TextMode::Outlines));
        // Two pieces: a square of 30 mm with a hole of 6 mm, creases of 30 mm, glue of 5 mm.
        for (layer, expected) in
            [("CUT", 288.0), ("SLIT", 60.0), ("MOUNTAIN", 60.0), ("FOLD180", 60.0), ("GLUE", 40.0)]
        {
            let length = length_mm(&file, layer);
            assert!((length - expected).abs() < 1e-6, "{version:?} {layer}: {length}");
        }
        assert!(length_mm(&file, "LABEL") > 0.0);
        assert!(file.entities().all(|e| e.common.layer != "FURNITURE"));
    }
}

#[test]
fn layers_have_their_line_types_and_units_are_millimetres() {
    let file = read(&written(DxfVersion::R2000, TextMode::Outlines));
    assert_eq!(file.header.default_drawing_units, Units::Millimeters);
    let mountain = file.layers().find(|layer| layer.name == "MOUNTAIN").expect("layer");
    let dashes = file.line_types().find(|t| t.name == mountain.line_type_name).expect("type");
    assert_eq!(dashes.dash_dot_space_lengths, [2.0, -1.0]);
    let cut = file.layers().find(|layer| layer.name == "CUT").expect("layer");
    assert_eq!(cut.line_type_name, "CONTINUOUS");
}

#[test]
fn texts_may_stay_texts() {
    let file = read(&written(DxfVersion::R2000, TextMode::Text));
    let says = |e: &Entity| match &e.specific {
        EntityType::Text(text) => Some((text.value.clone(), text.text_height)),
        _ => None,
    };
    let texts = file.entities().filter_map(says).collect::<Vec<_>>();
    assert_eq!(texts, vec![("A → 12".to_owned(), 2.5); 2]);
}

#[test]
fn every_handle_is_used_once_and_below_the_seed() {
    let text = written(DxfVersion::R2000, TextMode::Outlines);
    let lines = text.lines().map(str::trim).collect::<Vec<_>>();
    let pairs = lines.chunks_exact(2).map(|p| (p[0], p[1])).collect::<Vec<_>>();
    let seed = pairs.iter().position(|p| *p == ("9", "$HANDSEED")).expect("seed") + 1;
    let value = |hex: &str| u64::from_str_radix(hex, 16).expect("a handle");
    let header_end = pairs.iter().position(|p| *p == ("0", "ENDSEC")).expect("header");
    let handles = pairs[header_end..].iter().filter(|p| matches!(p.0, "5" | "105"));
    let handles = handles.map(|p| value(p.1)).collect::<Vec<_>>();
    assert_eq!(handles.iter().collect::<BTreeSet<_>>().len(), handles.len());
    assert!(handles.iter().all(|&handle| handle < value(pairs[seed].1)));
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    for version in [DxfVersion::R12, DxfVersion::R2000] {
        let text = written(version, TextMode::Outlines);
        assert!(text == written(version, TextMode::Outlines));
        assert_eq!(text.contains("AcDb"), version == DxfVersion::R2000);
    }
}

#[test]
fn letters_on_a_dashed_layer_are_solid_lines() {
    let stroke = LineStyles::standard().stroke(Layer::Glue).clone();
    let mut drawing = Drawing::new("page", DVec2::new(100.0, 100.0));
    drawing.marks = vec![
        Mark::line(Layer::Glue, DVec2::ZERO, DVec2::X, &stroke),
        Mark::text(Layer::Glue, Text::new("LL", DVec2::ONE, 2.0)),
    ];
    let pages = Pages::new("page", vec![drawing], LineStyles::standard()).expect("valid");
    let files = write(&pages, &FormatOptions::default()).expect("can be written");
    let file = read(std::str::from_utf8(&files[0].bytes).expect("ASCII"));
    let types: Vec<&str> = file.entities().map(|e| e.common.line_type_name.as_str()).collect();
    // A crease, and two strokes for each letter.
    assert_eq!(types, [&["BYLAYER"][..], &["CONTINUOUS"; 4]].concat());
}

#[test]
fn sheets_may_stand_in_a_row_in_one_file() {
    let dxf = DxfOptions { sheets: DxfSheets::Row, ..DxfOptions::default() };
    let files = write(&model(3), &FormatOptions { dxf, ..FormatOptions::default() }).expect("can be written");
    assert_eq!(files.len(), 1);
    let file = read(std::str::from_utf8(&files[0].bytes).expect("ASCII"));
    assert!((length_mm(&file, "CUT") - 3.0 * 288.0).abs() < 1e-6);
    let left = file.entities().filter_map(|e| match &e.specific {
        EntityType::LwPolyline(line) if e.common.layer == "CUT" => line.vertices.first().map(|v| v.x),
        _ => None,
    });
    let left: Vec<f64> = left.collect();
    // A4 and a gap of 20 mm.
    assert!((left[4] - left[0] - 230.0).abs() < 1e-9 && (left[8] - left[0] - 460.0).abs() < 1e-9, "{left:?}");
    assert_eq!(file.header.maximum_drawing_extents.x, 670.0);
}
