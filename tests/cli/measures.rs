//! What the report measures is what geometry says, of boxes whose measures are known.

use super::*;
use std::fmt::Write;

/// A plate of 120 × 80 mm and 40 mm high.
const PLATE: &str = "[[component]]\nname = 'plate'\ntop = [[-60, -40], [60, -40], [60, 40], [-60, 40]]\n\
                     profiles = [[[0, 40], [0, 0]]]\n";

/// A box that stands on the plate.
struct Block {
    name: &'static str,
    /// Width, depth and height, mm.
    size: [f64; 3],
    /// From the middle of the plate, mm.
    at: [f64; 2],
    turn_deg: f64,
}

impl Block {
    fn new(name: &'static str, size: [f64; 3], at: [f64; 2]) -> Self {
        Self { name, size, at, turn_deg: 0.0 }
    }
}

/// The report of a plate with blocks on it.
fn report_of(blocks: &[Block]) -> serde_json::Value {
    let mut drawn = PLATE.to_owned();
    for Block { name, size: [width, depth, height], at: [x, y], turn_deg } in blocks {
        let (u, v) = (width / 2.0, depth / 2.0);
        write!(
            drawn,
            "[[component]]\nname = '{name}'\ntop = [[-{u}, -{v}], [{u}, -{v}], [{u}, {v}], [-{u}, {v}]]\n\
             profiles = [[[0, {height}], [0, 0]]]\n[component.joint]\nto = 'plate'\npanel = 'top'\n\
             at = [{x}, {y}]\nturn = {turn_deg}\nhold = 'glue'\n"
        )
        .unwrap();
    }
    let folder = folder_with(&[("a.toml", drawn.as_bytes())]);
    let result = run(folder.path(), &["design", "a.toml", "-q", "--effort", "0", "-o", "a.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    report(&folder, "a.json")
}

/// The messages of the warnings with a code.
fn warnings<'a>(report: &'a serde_json::Value, code: &str) -> Vec<&'a str> {
    let all = report["warnings"].as_array().unwrap().iter();
    all.filter(|warning| warning["code"] == code)
        .map(|warning| warning["message"].as_str().unwrap())
        .collect()
}

#[test]
fn glue_is_the_area_that_two_panels_share() {
    for (block, glue_mm2, support_ratio) in [
        (Block::new("all of it", [20.0, 30.0, 25.0], [0.0, 0.0]), 600.0, 1.0),
        (Block::new("up to the edge", [20.0, 30.0, 25.0], [50.0, 0.0]), 600.0, 1.0),
        (Block::new("a quarter beyond an edge", [20.0, 30.0, 25.0], [55.0, 0.0]), 450.0, 0.75),
        (Block::new("a corner beyond two edges", [20.0, 30.0, 25.0], [55.0, -30.0]), 375.0, 0.625),
        (Block { turn_deg: 30.0, ..Block::new("turned", [20.0, 30.0, 25.0], [0.0, 0.0]) }, 600.0, 1.0),
        // Half of a square that stands on its corner.
        (
            Block { turn_deg: 45.0, ..Block::new("half of a turned one", [20.0, 20.0, 25.0], [60.0, 0.0]) },
            200.0,
            0.5,
        ),
    ] {
        let report = report_of(&[block]);
        let component = &report["components"][1];
        let name = component["name"].as_str().unwrap();
        for (key, expected) in [("glue_mm2", glue_mm2), ("support_ratio", support_ratio)] {
            let found = component["joint"][key].as_f64().unwrap();
            assert!((found - expected).abs() < 1e-6 * expected, "{name}: {key} is {found}, not {expected}");
        }
    }
}

/// A joint needs 40 mm², and a tenth of its smaller panel.
#[test]
fn a_joint_is_weak_below_40_mm2_or_a_tenth_of_its_panel() {
    for (size, on_plate_mm, glue_mm2, needed_mm2) in [
        // All of a small block.
        ([6.2, 6.2, 25.0], 6.2, 38.44, Some(40)),
        ([6.4, 6.4, 25.0], 6.4, 40.96, None),
        // A strip of a block of 900 mm².
        ([30.0, 30.0, 25.0], 2.9, 87.0, Some(90)),
        ([30.0, 30.0, 25.0], 3.1, 93.0, None),
    ] {
        let at = [60.0 + size[0] / 2.0 - on_plate_mm, 0.0];
        let report = report_of(&[Block::new("block", size, at)]);
        let found = report["components"][1]["joint"]["glue_mm2"].as_f64().unwrap();
        assert!((found - glue_mm2).abs() < 1e-6 * glue_mm2, "{found}, not {glue_mm2}");
        let told = warnings(&report, "weak_joint");
        assert_eq!(told.len(), usize::from(needed_mm2.is_some()), "{glue_mm2} mm²: {told:?}");
        if let Some(needed_mm2) = needed_mm2 {
            let words =
                format!("with plate has {glue_mm2:.0} mm² to glue, and holds well from {needed_mm2} mm²");
            assert!(told[0].contains(&words), "{told:?}");
        }
    }
}

/// A wide and a narrow block that overlap by `depth_mm` along x, less than in any other direction.
fn overlapping(depth_mm: f64) -> serde_json::Value {
    let wide = Block::new("wide", [30.0, 40.0, 30.0], [-15.0, 0.0]);
    let narrow = Block::new("narrow", [30.0, 24.0, 50.0], [15.0 - depth_mm, 0.0]);
    report_of(&[wide, narrow])
}

#[test]
fn an_overlap_is_as_deep_as_one_block_must_move_to_be_free() {
    for depth_mm in [0.5, 2.0, 6.5] {
        let report = overlapping(depth_mm);
        let overlaps = report["fold"]["deployed_overlaps"].as_array().unwrap();
        assert_eq!(overlaps.len(), 1, "{overlaps:?}");
        assert_eq!(overlaps[0]["components"], serde_json::json!(["wide", "narrow"]));
        let found = overlaps[0]["depth_mm"].as_f64().unwrap();
        assert!((found - depth_mm).abs() < 1e-6, "{found}, not {depth_mm}");
    }
}

/// Half of the paper's thickness, 0.25 mm, is ignored.
#[test]
fn an_overlap_has_a_warning_above_half_of_the_papers_thickness() {
    for (depth_mm, is_told) in [(-1.0, false), (0.0, false), (0.12, false), (0.13, true), (2.0, true)] {
        let report = overlapping(depth_mm);
        let overlaps = report["fold"]["deployed_overlaps"].as_array().unwrap();
        assert_eq!(overlaps.len(), usize::from(is_told), "{depth_mm} mm: {overlaps:?}");
        let told = warnings(&report, "deployed_overlap");
        assert_eq!(told.len(), usize::from(is_told), "{depth_mm} mm: {told:?}");
        let words = format!("overlap by {depth_mm:.1} mm");
        assert!(
            told.iter().all(|text| text.contains("wide and narrow") && text.contains(&words)),
            "{told:?}"
        );
    }
}
