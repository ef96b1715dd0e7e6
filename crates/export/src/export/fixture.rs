//! A small sheet with every kind of mark, for the tests of the formats.

use glam::{DAffine2, DVec2};
use tatamu_draw::drawing::{Align, Drawing, Layer, LineStyles, Mark, Pages, Polyline, Rgb, Text};
use tatamu_net::sheet::furniture::Furniture;

/// The sheets' kinds of lines.
pub const LEGEND: [Layer; 5] = [Layer::Cut, Layer::Slit, Layer::Mountain, Layer::FoldHinge, Layer::Glue];
/// A4, upright.
pub const A4_MM: DVec2 = DVec2::new(210.0, 297.0);

/// A model of as many sheets as `pages`.
pub fn model(pages: usize) -> Pages {
    let sheets = (1..=pages).map(|page| sheet(A4_MM, page, pages)).collect();
    Pages::new("teddy <3> \"ÿ\"", sheets, LineStyles::standard()).expect("the fixture can be drawn")
}

/// One sheet with two pieces and its furniture.
pub fn sheet(size_mm: DVec2, page: usize, pages: usize) -> Drawing {
    let styles = LineStyles::standard();
    let number = format!("sheet {page} of {pages}");
    let furniture = Furniture {
        size_mm,
        margin_mm: 10.0,
        title: "teddy <3>",
        note: "200 mm",
        number: &number,
        legend: &LEGEND,
    };
    let mut drawing = Drawing::new(format!("teddy <3> {page}/{pages}"), size_mm);
    drawing.marks = furniture.marks(&styles);
    let stroke = styles.stroke(Layer::Registration);
    let ends = [DVec2::new(15.0, 140.0), DVec2::new(25.0, 140.0)];
    drawing.marks.push(Mark::line(Layer::Registration, ends[0], ends[1], stroke));
    for (name, angle_rad, corner) in [("head 1/2", 0.0, [20.0, 40.0]), ("head 2/2", 0.4, [60.0, 90.0])] {
        let place = DAffine2::from_angle_translation(angle_rad, DVec2::from(corner));
        drawing.place(piece(name, &styles), place);
    }
    drawing
}

/// A square ring of 30 mm with a hole, creases, a tab's area, a glue mark and a label.
fn piece(name: &str, styles: &LineStyles) -> Vec<Mark> {
    let square = |lo: f64, hi: f64| [[lo, lo], [hi, lo], [hi, hi], [lo, hi]].map(DVec2::from).to_vec();
    let ring = vec![Polyline::closed(square(0.0, 30.0)), Polyline::closed(square(12.0, 18.0))];
    let crease = |layer, y| Mark::line(layer, DVec2::new(0.0, y), DVec2::new(30.0, y), styles.stroke(layer));
    let label = Text::new("A → 12", DVec2::new(15.0, 25.0), 2.5).aligned(Align::Middle);
    let marks = [
        Mark::path(Layer::Picture, ring.clone(), None, Some(Rgb(250, 240, 220))),
        Mark::filled(Layer::Tab, square(19.0, 29.0), Rgb(226, 226, 226)),
        Mark::path(Layer::Cut, ring, Some(styles.stroke(Layer::Cut).clone()), None),
        crease(Layer::Slit, 4.0),
        crease(Layer::Mountain, 8.0),
        crease(Layer::Valley, 10.0),
        crease(Layer::FoldHinge, 20.0),
        Mark::polygon(Layer::Glue, square(2.0, 7.0), styles.stroke(Layer::Glue)),
        Mark::text(Layer::Label, label),
    ];
    marks.map(|mark| mark.of_piece(name)).to_vec()
}
