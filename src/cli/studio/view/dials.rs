//! The dials of the whole model, and of paper and pieces.

use super::super::state::Studio;
use super::values::{Number, choice_row, tick_row};
use eframe::egui::Ui;
use tatamu::mesh::Up;
use tatamu::net::Side;
use tatamu::pipeline::Level;
use tatamu::segment::{Method, SegmentOptions, SymmetryChoice};
use tatamu::sheet::Registration;
use tatamu::sheet::fit::Rotation;

/// A number with a unit of its own.
const fn number(
    [label, help]: [&'static str; 2],
    [table, key]: [&'static str; 2],
    (least, most): (f64, f64),
    digits: Option<i32>,
    unit: &'static str,
) -> Number {
    Number { label, help, table, key, range: least..=most, digits, unit }
}

const MORE: &str = "more follow the shape better, fewer fold faster";

const SIZE: Number =
    number(["Size", "the longest side of the model"], ["", "size"], (10.0, 2000.0), Some(0), " mm");
const PARTS: Number =
    number(["Parts", "how many components to aim at"], ["segmentation", "parts"], (1.0, 200.0), None, "");
const DETAIL: Number = number(
    ["Detail", "from 0, few components, to 1, many"],
    ["segmentation", "detail"],
    (0.0, 1.0),
    Some(2),
    "",
);
const CLUSTERS: Number =
    number(["Clusters", "classes of thickness"], ["segmentation", "clusters"], (1.0, 32.0), None, "");
const SMOOTHING: Number = number(
    ["Smoothing", "cost of borders between parts"],
    ["segmentation", "smoothing"],
    (0.0, 10.0),
    Some(2),
    "",
);
const EDGES: Number = number(["Top edges", MORE], ["defaults", "top_edges"], (3.0, 64.0), None, "");
const VERTICES: Number =
    number(["Profile vertices", MORE], ["defaults", "profile_vertices"], (3.0, 64.0), None, "");
/// Where edges and vertices start that one sets by hand.
const COUNT: f64 = 6.0;
const TOLERANCE: Number = number(
    ["Tolerance", "with a tick: as few edges and vertices as come so close to the shape"],
    ["defaults", "tolerance"],
    (0.1, 50.0),
    Some(1),
    " mm",
);

/// The dials of the whole model, as rows of a grid.
pub fn model(studio: &mut Studio, ui: &mut Ui) {
    let Some(options) = studio.document().map(|d| d.options().clone()) else { return };
    if studio.is_drawn() {
        let size_mm = studio.shown().shaped().map_or(options.size_mm, |shaped| shaped.options().size_mm);
        return SIZE.row(studio, ui, size_mm);
    }
    SIZE.row(studio, ui, options.size_mm);
    let up = match options.up {
        Up::X => "x",
        Up::Y => "y",
        Up::Z => "z",
    };
    choice_row(
        studio,
        ui,
        ("Upwards", "the axis of the mesh that points up"),
        ("", "up"),
        up,
        &["x", "y", "z"],
    );
    division(studio, ui, options.segmentation);
    let what = ("Level", "how much work the model may be: big parts get most of the panels");
    let levels = Level::ALL.map(Level::name);
    choice_row(studio, ui, what, ("defaults", "level"), options.level.name(), &levels);
    EDGES.optional_row(studio, ui, options.top_edges.map(|n| n as f64), COUNT);
    VERTICES.optional_row(studio, ui, options.profile_vertices.map(|n| n as f64), COUNT);
    TOLERANCE.optional_row(studio, ui, options.tolerance_mm, 2.0);
}

/// How the mesh is divided.
fn division(studio: &mut Studio, ui: &mut Ui, segmentation: SegmentOptions) {
    let method = match segmentation.method {
        Method::Merge => "merge",
        Method::Sdf { .. } => "sdf",
    };
    let what = ("Method", "merge suits most meshes; sdf is the method of the paper");
    choice_row(studio, ui, what, ("segmentation", "method"), method, &["merge", "sdf"]);
    if let Method::Sdf { clusters, smoothing } = segmentation.method {
        CLUSTERS.row(studio, ui, clusters as f64);
        SMOOTHING.row(studio, ui, smoothing);
        return;
    }
    let found = studio.shown().names().len().max(1) as f64;
    let names = SymmetryChoice::ALL.map(SymmetryChoice::name);
    let what = ("Symmetry", "whether the two sides are mirror images, and in which plane");
    choice_row(studio, ui, what, ("segmentation", "symmetry"), segmentation.symmetry.name(), &names);
    PARTS.optional_row(studio, ui, segmentation.parts.map(|n| n as f64), found);
    if segmentation.parts.is_none() {
        DETAIL.row(studio, ui, segmentation.detail);
    }
}

const PAPERS: [&str; 6] = ["a5", "a4", "a3", "letter", "legal", "12x12in"];
const MARGIN: Number =
    number(["Margin", "border that stays free"], ["paper", "margin_mm"], (0.0, 60.0), Some(1), " mm");
const THICKNESS: Number = number(
    ["Thickness", "of the paper, for the check of the folding"],
    ["paper", "thickness_mm"],
    (0.02, 5.0),
    Some(2),
    " mm",
);
const TABS: Number =
    number(["Tabs", "width of the glue tabs"], ["defaults", "tab_width_mm"], (1.0, 30.0), Some(1), " mm");
const LEAST: Number = number(
    ["Least panel", "no panel is narrower or lower"],
    ["defaults", "min_panel_width_mm"],
    (0.5, 30.0),
    Some(1),
    " mm",
);
const SPACING: Number = number(
    ["Spacing", "least distance between pieces"],
    ["sheets", "spacing_mm"],
    (0.0, 30.0),
    Some(1),
    " mm",
);

/// The dials of paper and pieces, as rows of a grid.
pub fn paper(studio: &mut Studio, ui: &mut Ui) {
    let Some(options) = studio.document().map(|d| d.options().clone()) else { return };
    let (nets, sheets) = (options.nets, options.sheets);
    choice_row(
        studio,
        ui,
        ("Paper", "size of the sheets"),
        ("paper", "size"),
        &options.paper.name(),
        &PAPERS,
    );
    MARGIN.row(studio, ui, options.margin_mm);
    THICKNESS.row(studio, ui, options.thickness_mm);
    TABS.row(studio, ui, options.tab_width_mm);
    LEAST.row(studio, ui, options.min_panel_width_mm);
    SPACING.row(studio, ui, sheets.spacing_mm);
    let side = if sheets.side == Side::Outside { "outside" } else { "inside" };
    let what = ("Print on", "printed side of the paper");
    choice_row(studio, ui, what, ("sheets", "side"), side, &["outside", "inside"]);
    let marks = sheets.registration.map_or("none", Registration::name);
    let what = ("Marks", "registration marks for a cutter");
    choice_row(studio, ui, what, ("sheets", "marks"), marks, &["none", "silhouette", "corners"]);
    let what = ("Along the grain", "pieces turned by multiples of 90° only");
    tick_row(studio, ui, what, ("sheets", "grain"), sheets.rotation == Rotation::QuarterTurns);
    let what = ("Glue marks", "the place of each tab behind its mate");
    tick_row(studio, ui, what, ("nets", "glue_marks"), nets.glue_marks);
    let what = ("Angles", "the angle of each crease beside it");
    tick_row(studio, ui, what, ("nets", "angles"), nets.angles);
}
