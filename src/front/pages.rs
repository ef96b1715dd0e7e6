//! The sheets as they are printed.

use super::opened::Opened;
use super::words;
use glam::{DAffine2, DVec2};
use tatamu::drawing::Drawing;
use tatamu::geom::polygon;
use tatamu::net::{Piece, Side};
use tatamu::pipeline::Output;
use tatamu::project::Project;
use tatamu::sheet::{PiecePlace, Pin};

/// Draws the sheets with the look and the colours that the project asks for.
///
/// # Errors
/// A message where its style file or its colours cannot be read.
pub fn drawings(opened: &Opened, project: &Project, output: &Output) -> Result<Vec<Drawing>, String> {
    let pages = opened.with_product(project, output, |product, _| {
        product.pages().map(|pages| pages.drawings().to_vec()).map_err(|error| error.to_string())
    });
    pages.map_err(|error| words::error(&error))?
}

/// A piece on a sheet: the net, and its number in the net.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PieceId {
    /// The net, which is that of the component of this index.
    pub net: usize,
    /// Number of the piece.
    pub piece: usize,
}

/// The pieces of a sheet with their outlines on the page, as printed.
pub fn outlines(output: &Output, sheet: usize) -> Vec<(PieceId, Vec<DVec2>)> {
    let layout = output.layout();
    let width_mm = layout.options().size_mm().x;
    let is_mirrored = layout.options().choices.side == Side::Inside;
    let on_page = |p: DVec2| if is_mirrored { DVec2::new(width_mm - p.x, p.y) } else { p };
    let nets = output.nets().iter().enumerate();
    nets.flat_map(|(net, own)| {
        let places = own.pieces().iter().zip(layout.places(net)).enumerate();
        places.filter(|(_, (_, at))| at.sheet == sheet).map(move |(piece, (own, at))| {
            let outline: Vec<DVec2> =
                own.outline().iter().map(|&p| on_page(at.place.transform_point2(p))).collect();
            (PieceId { net, piece }, outline)
        })
    })
    .collect()
}

/// The piece at a point of a sheet.
pub fn piece_at(outlines: &[(PieceId, Vec<DVec2>)], at: DVec2) -> Option<PieceId> {
    outlines.iter().find(|(_, outline)| polygon::contains(outline, at)).map(|(id, _)| *id)
}

/// The piece with this name of a net.
pub fn named(output: &Output, net: usize, name: &str) -> Option<PieceId> {
    let pieces = output.nets().get(net)?.pieces();
    pieces.iter().position(|piece| piece.name() == name).map(|piece| PieceId { net, piece })
}

/// The pin of a piece after it was moved on the page, from where it is, and turned about its middle.
pub fn moved(output: &Output, id: PieceId, sheet: usize, by_mm: DVec2, turn_rad: f64) -> Option<Pin> {
    let outline = piece(output, id)?.outline();
    let at = output.layout().places(id.net).get(id.piece)?;
    let is_mirrored = output.layout().options().choices.side == Side::Inside;
    let (by_mm, turn_rad) =
        if is_mirrored { (by_mm * DVec2::new(-1.0, 1.0), -turn_rad) } else { (by_mm, turn_rad) };
    let (low, high) = polygon::bounds(outline.iter().map(|&p| at.place.transform_point2(p)))?;
    let middle = low.midpoint(high);
    let turn = DAffine2::from_translation(middle + by_mm)
        * DAffine2::from_angle(turn_rad)
        * DAffine2::from_translation(-middle);
    Some(Pin::of_place(outline, &PiecePlace { sheet, place: turn * at.place }))
}

/// The piece itself.
pub fn piece(output: &Output, id: PieceId) -> Option<&Piece> {
    output.nets().get(id.net)?.pieces().get(id.piece)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_in_the_piece_around_it() {
        let id = |piece| PieceId { net: 0, piece };
        let corner = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]];
        let square = [[2.0, 2.0], [3.0, 2.0], [3.0, 3.0], [2.0, 3.0]];
        let outlines = [(id(0), corner.map(DVec2::from).to_vec()), (id(1), square.map(DVec2::from).to_vec())];
        for (at, expected) in
            [([0.5, 3.0], Some(0)), ([2.5, 2.5], Some(1)), ([1.5, 1.5], None), ([9.0, 0.5], None)]
        {
            assert_eq!(piece_at(&outlines, at.into()), expected.map(id), "{at:?}");
        }
    }
}
