use super::*;
use crate::export::fixture::model;
use std::collections::BTreeSet;

fn written(version: DxfVersion, text_mode: TextMode) -> String {
    let options = FormatOptions { dxf: DxfOptions { version, text: text_mode }, ..FormatOptions::default() };
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
        EntityType::Line(line) => (line.p2.x - line.p1.x).hypot(line.p2.y - line.p1.y),
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
