//! Models of many components and layouts of many sheets.

#[expect(dead_code, reason = "boxes are enough here")]
mod support;

use std::collections::BTreeSet;
use std::fmt::Write;
use support::Prism;
use tatamu::drawing::{LineStyles, Pages};
use tatamu::export::{FormatOptions, Source, format_of};
use tatamu::model::PartId;
use tatamu::net::{Naming, Net, NetOptions, develop};
use tatamu::pipeline::{self, Options};
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::sheet::{Imprint, Layout, SheetOptions};
use tatamu::units::Paper;

/// A project file of lanterns that stand on one another, each a little smaller than the one below.
fn tower(storeys: usize) -> String {
    let mut text = String::new();
    for k in 0..storeys {
        let radius = 40.0 - 0.1 * k as f64;
        let _ = writeln!(
            text,
            "[[component]]\nname = \"storey-{k}\"\ntop = {{ edges = 5, radius = {radius} }}\n\
             profiles = [[[0, 20], [8, 10], [-1, 0]]]"
        );
        if let Some(below) = k.checked_sub(1) {
            let _ = writeln!(text, "[component.joint]\nto = \"storey-{below}\"\npanel = \"top\"");
        }
    }
    text
}

#[test]
fn a_hundred_components() {
    let sketches = Project::parse(&tower(100)).unwrap().sketches().unwrap();
    let output = pipeline::run_drawn(&sketches, None, &Options::default(), &Silent).unwrap();
    let parts = output.model().parts();
    assert_eq!(parts.len(), 100);
    assert_eq!(parts.iter().filter(|part| part.joint.is_some()).count(), 99);
    let order: BTreeSet<PartId> = output.fold_plan().order().iter().copied().collect();
    assert_eq!(order.len(), 100, "each is folded once");
    let flat_mm = output.fold_plan().stacks()[0].size_mm;
    assert!(flat_mm.max_element() < 130.0, "{flat_mm}: the flat tower is as wide as a storey");
    let placed: usize = output.model().ids().map(|part| output.layout().places(part).len()).sum();
    let pieces: usize = output.nets().iter().map(|net| net.pieces().len()).sum();
    assert!(placed == pieces && pieces >= 100);
}

#[test]
fn two_hundred_sheets() {
    // Each net needs more than half of a sheet.
    let options = SheetOptions::new(Paper::default(), 10.0);
    let net = |k: usize| -> Net {
        let size = 52.0 + 0.01 * k as f64;
        let set = Prism::cuboid(size, size, size).panel_set();
        let name = format!("box-{k}");
        let naming = Naming { name: &name, prefix: "A" };
        develop(&set, naming, &[], &NetOptions::new(6.0, options.room_mm())).unwrap()
    };
    let nets: Vec<Net> = (0..200).map(net).collect();
    let layout = Layout::new(&nets, &options, &Silent).unwrap();
    assert!(layout.sheet_count() >= 200, "{}", layout.sheet_count());
    let styles = LineStyles::standard();
    let drawings = layout.pages(&nets, Imprint { title: "boxes", ..Imprint::default() }, &styles);
    let pages = Pages::new("boxes", drawings, styles).unwrap();
    let Source::Pages(write) = format_of("pdf").unwrap().source else { panic!("a PDF has pages") };
    let pdf = write(&pages, &FormatOptions::default()).unwrap().remove(0).bytes;
    let document = lopdf::Document::load_mem(&pdf).unwrap();
    assert!(document.get_pages().len() >= 200);
}
