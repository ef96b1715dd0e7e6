//! Flat pictures: nets, and where pieces lie on the sheets.

use glam::{DAffine2, DVec2};
use tatamu_core::geom::polygon;
use tatamu_core::model::PartId;
use tatamu_draw::drawing::{
    Align, Drawing, Layer, LineStyles, Mark, Rgb, Shape, Stroke, Text, rectangle, text,
};
use tatamu_draw::render::palette;
use tatamu_net::net::{Net, Side};
use tatamu_net::sheet::SheetId;
use tatamu_pipeline::Output;

/// Free border, mm.
const BORDER_MM: f64 = 2.0;
/// Distance of pieces, as a share of the first one's size.
const GAP: f64 = 0.06;
/// Widest line.
const LINE_MM: f64 = 0.25;
/// Height of the numbers of sheets on maps.
const NUMBER_MM: f64 = 2.2;
/// Paper on maps, and pieces of other components.
const PAPER: Rgb = Rgb(255, 255, 255);
const OTHERS: Rgb = Rgb(226, 226, 230);
const EDGE: Rgb = Rgb(120, 120, 126);

/// The pieces of a net beside each other, as they are printed, without texts.
pub fn net(net: &Net, colour: Rgb, side: Side, styles: &LineStyles, size_mm: DVec2) -> Drawing {
    let mut right = 0.0;
    let mut marks = Vec::new();
    for piece in net.pieces() {
        let shift = DAffine2::from_translation(DVec2::X * right);
        right += piece.size_mm().x * (1.0 + GAP);
        let paper = Mark::filled(Layer::Picture, piece.outline().to_vec(), colour);
        let lines = piece.marks(side, styles).into_iter();
        let lines = lines.filter(|mark| matches!(mark.shape, Shape::Path { .. }));
        let mirror_mm = piece.size_mm().x / 2.0;
        let on_side = |mark: Mark| match side {
            Side::Outside => mark,
            Side::Inside => mark.mirrored(mirror_mm),
        };
        marks.extend(std::iter::once(paper).chain(lines).map(|mark| on_side(mark).placed(shift)));
    }
    fitted(marks, size_mm)
}

/// Marks shrunk to fill a picture; lines keep their widths.
fn fitted(mut marks: Vec<Mark>, size_mm: DVec2) -> Drawing {
    let bounds = marks.iter().filter_map(Mark::bounds).flat_map(|(low, high)| [low, high]);
    let (low, high) = polygon::bounds(bounds).unwrap_or_default();
    let scale = ((size_mm - 2.0 * BORDER_MM) / (high - low).max(DVec2::splat(1e-6))).min_element();
    let shift = size_mm / 2.0 - low.midpoint(high);
    for mark in &mut marks {
        mark.stretch(low.midpoint(high), DVec2::splat(scale));
        if let Shape::Path { stroke: Some(stroke), .. } = &mut mark.shape {
            stroke.width_mm = stroke.width_mm.min(LINE_MM);
            stroke.dash_mm.iter_mut().for_each(|dash| *dash *= 0.5);
        }
    }
    let mut drawing = Drawing::new("", size_mm);
    drawing.place(marks, DAffine2::from_translation(shift));
    drawing
}

/// A small picture of a sheet with all of its pieces; those of `part` are in its colour.
pub fn sheet_map(output: &Output, sheet: SheetId, part: PartId, height_mm: f64) -> Drawing {
    let colour = palette::colour(part.0);
    let options = output.layout().options();
    let paper_mm = options.size_mm();
    let scale = height_mm / paper_mm.y;
    let size_mm = paper_mm * scale;
    let mut drawing = Drawing::new("", size_mm);
    let corners = rectangle(DVec2::ZERO, size_mm);
    let edge = Stroke::solid(0.3, EDGE);
    let thin = Stroke::solid(0.12, EDGE);
    drawing.marks.push(Mark::filled(Layer::Picture, corners.to_vec(), PAPER));
    for (n, net) in output.model().ids().zip(output.nets()) {
        for (piece, at) in
            net.pieces().iter().zip(output.layout().places(n)).filter(|(_, at)| at.sheet == sheet)
        {
            let mirrored = |p: DVec2| match options.choices.side {
                Side::Outside => p,
                Side::Inside => DVec2::new(paper_mm.x - p.x, p.y),
            };
            let on_sheet = |p: &DVec2| mirrored(at.place.transform_point2(*p)) * scale;
            let outline: Vec<DVec2> = piece.outline().iter().map(on_sheet).collect();
            let fill = if n == part { colour } else { OTHERS };
            drawing.marks.push(Mark::filled(Layer::Picture, outline.clone(), fill));
            drawing.marks.push(Mark::polygon(Layer::Picture, outline, &thin));
        }
    }
    // Pieces that lie in the corner leave the number room.
    let number = sheet.number().to_string();
    let low = DVec2::new(size_mm.x - 1.6 - text::width_mm(&number, NUMBER_MM), 0.0);
    let high = DVec2::new(size_mm.x, NUMBER_MM + 1.6);
    drawing.marks.push(Mark::filled(Layer::Picture, rectangle(low, high).to_vec(), PAPER));
    drawing.marks.push(Mark::polygon(Layer::Picture, corners.to_vec(), &edge));
    let number = Text::new(number, DVec2::new(size_mm.x - 0.8, 0.8), NUMBER_MM);
    drawing.marks.push(Mark::text(Layer::Picture, number.aligned(Align::End).coloured(EDGE)));
    drawing
}

/// The sheets on which pieces of a component lie.
pub fn sheets_of(output: &Output, part: PartId) -> Vec<SheetId> {
    let mut sheets: Vec<SheetId> = output.layout().places(part).iter().map(|at| at.sheet).collect();
    sheets.sort_unstable();
    sheets.dedup();
    sheets
}
