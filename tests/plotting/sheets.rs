//! Sheets of whole models, from the drawing to what a machine executed.

use super::measure::{self, Figures};
use super::{media, profile};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;

#[test]
fn the_sheets_of_a_model_are_executed_as_they_are_drawn() {
    let path = format!("{}/samples/snowman.obj", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).unwrap();
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(&bytes).unwrap()).unwrap();
    let output = pipeline::run(&mesh, &Options::default(), &Silent).unwrap();
    let product =
        Product::new(&output, "snowman", Run { path: "", repairs: &repairs, stages: &[], warnings: &[] });
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
        assert!(figures.tip_mm <= 0.05 && figures.missed_mm <= 0.05, "{name}: {figures:?}");
        assert!(figures.travel_mm <= 0.6 * figures.file_travel_mm, "{name}: {figures:?}");
    }
}
