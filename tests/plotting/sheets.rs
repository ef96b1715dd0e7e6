//! Sheets of whole models, from the drawing to what a machine executed.

use super::measure::{self, Figures};
use super::{media, profile};
use glam::DVec2;
use tatamu::drawing::{Drawing, Layer, Mark, Rgb, Stroke};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::plotter::Cutter;
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;

/// How far the tip may be from its line. A unit of 0.05 mm alone puts the shaft 0.035 mm off, and
/// the swings at corners add to it.
fn most_mm(cutter: &Cutter) -> f64 {
    if cutter.frame().units_per_mm().value() < 30.0 { 0.08 } else { 0.05 }
}

#[test]
fn the_sheets_of_a_model_are_executed_as_they_are_drawn() {
    let path = format!("{}/samples/snowman.obj", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).unwrap();
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(&bytes).unwrap()).unwrap();
    let output = pipeline::run(&mesh, &Options::default(), &Silent).unwrap();
    let product = Product::new(
        &output,
        "snowman",
        Run { path: "", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string },
    );
    for (cutter, medium) in
        [("generic-hpgl", "cardstock-200"), ("graphtec", "paper-120"), ("pen-plotter", "pen")]
    {
        let (cutter, medium) = (profile(cutter), media(medium));
        let pages = product.pages().unwrap();
        let sheets = pages.drawings().iter().map(|page| measure::sheet(page, &cutter, &medium).unwrap());
        let figures = sheets.reduce(Figures::and).unwrap();
        let name = cutter.name();
        assert!(figures.strokes > 40 && figures.bytes > 20 * figures.strokes, "{name}: {figures:?}");
        assert_eq!(figures.lost, 0, "{name}");
        assert!(figures.unit_error <= 0.5 + 1e-6, "{name}: {figures:?}");
        assert!(figures.drawing_mm <= 2.5e-4, "{name}: {figures:?}");
        assert!(figures.tip_mm <= most_mm(&cutter) && figures.missed_mm <= 0.05, "{name}: {figures:?}");
        assert!(figures.travel_mm <= 0.6 * figures.file_travel_mm, "{name}: {figures:?}");
    }
}

/// Once "4 strokes executed of 5": a snowman has slits of a hundredth of a millimetre, which a unit of 0.025 mm cannot
/// show.
#[test]
fn a_slit_shorter_than_a_unit_is_no_stroke() {
    let look = Stroke { width_mm: 0.2, colour: Rgb::BLACK, dash_mm: Vec::new() };
    let mut page = Drawing::new("page", DVec2::new(210.0, 297.0));
    let slit = |from: DVec2, by: DVec2| Mark::line(Layer::Slit, from, from + by, &look);
    page.marks.extend((1..5).map(|k| slit(DVec2::splat(20.0 * f64::from(k)), DVec2::X * 5.0)));
    page.marks.push(slit(DVec2::splat(30.0), DVec2::new(0.0094, -0.0041)));
    // As short, but over the border of two units.
    let border = slit(DVec2::splat(50.0125) - DVec2::X * 0.004, DVec2::X * 0.008);
    for (marks, strokes) in [(vec![], 4), (vec![border], 5)] {
        page.marks.extend(marks);
        let figures = measure::sheet(&page, &profile("pen-plotter"), &media("pen")).unwrap();
        assert_eq!((figures.strokes, figures.lost), (strokes, 0));
        assert!(figures.unit_error <= 0.5 + 1e-6 && figures.drawing_mm <= 2.5e-4, "{figures:?}");
    }
}

/// Contours as nets really have them: corners twice at one place, next to each other or not, a spike
/// that goes out and back, and edges far shorter than a unit of the machine.
#[test]
fn contours_with_edges_of_no_length_are_cut_like_others() {
    let corners = |points: &[[f64; 2]]| points.iter().map(|&p| DVec2::from(p) + DVec2::splat(40.0)).collect();
    let pinched =
        [[0.0, 0.0], [20.0, 0.0], [20.0, 0.0], [10.0, 10.0], [20.0, 20.0], [0.0, 20.0], [10.0, 10.0]];
    let spiked =
        [[40.0, 0.0], [60.0, 0.0], [60.0, 10.0], [75.0, 10.0], [60.0, 10.0], [60.0, 20.0], [40.0, 20.0]];
    let tiny = [
        [0.0, 40.0],
        [20.0, 40.0],
        [20.0, 40.0 + 1e-9],
        [20.003, 40.001],
        [20.0, 60.0],
        [0.0, 60.0],
        [0.0, 40.0],
    ];
    let look = Stroke { width_mm: 0.2, colour: Rgb::BLACK, dash_mm: Vec::new() };
    let mut page = Drawing::new("page", DVec2::new(210.0, 297.0));
    for contour in [&pinched, &spiked, &tiny] {
        page.marks.push(Mark::polygon(Layer::Cut, corners(contour), &look));
    }
    page.marks.push(Mark::line(Layer::Slit, DVec2::splat(9.0), DVec2::splat(9.0), &look));
    page.marks.push(Mark::line(Layer::Mountain, DVec2::splat(30.0), DVec2::splat(30.0), &look));
    for (cutter, medium) in
        [("vinyl-cutter", "cardstock-300"), ("generic-hpgl", "vinyl"), ("silhouette", "paper-120")]
    {
        let (cutter, medium) = (profile(cutter), media(medium));
        let figures = measure::sheet(&page, &cutter, &medium).unwrap();
        let cutter_name = cutter.name();
        // One stroke turns the blade; a line without length is no work.
        assert_eq!((figures.strokes, figures.lost), (4, 0), "{cutter_name}");
        assert!(
            figures.unit_error <= 0.5 + 1e-6 && figures.drawing_mm <= 2.5e-4,
            "{cutter_name}: {figures:?}"
        );
        assert!(
            figures.tip_mm <= most_mm(&cutter) && figures.missed_mm <= 0.05,
            "{cutter_name}: {figures:?}"
        );
    }
}
