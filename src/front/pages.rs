//! The sheets as they are printed.

use super::opened::Opened;
use super::words;
use glam::{DAffine2, DVec2};
use tatamu::drawing::Drawing;
use tatamu::geom::polygon;
use tatamu::listing;
use tatamu::model::PartId;
use tatamu::net::{Piece, Side};
use tatamu::pipeline::Output;
use tatamu::project::Project;
use tatamu::sheet::{PiecePlace, Pin, SheetId};

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
    /// The net, which is that of this component.
    pub net: PartId,
    /// Number of the piece.
    pub piece: usize,
}

/// The pieces of a sheet with their outlines on the page, as printed.
pub fn outlines(output: &Output, sheet: SheetId) -> Vec<(PieceId, Vec<DVec2>)> {
    let on_page = on_page(output);
    let own = all(output).filter(|(_, _, at)| at.sheet == sheet);
    own.map(|(id, piece, at)| (id, placed(piece, at).into_iter().map(&on_page).collect())).collect()
}

/// The piece at a point of a sheet.
pub fn piece_at(outlines: &[(PieceId, Vec<DVec2>)], at: DVec2) -> Option<PieceId> {
    outlines.iter().find(|(_, outline)| polygon::contains(outline, at)).map(|(id, _)| *id)
}

/// The piece with this name of a net.
pub fn named(output: &Output, net: PartId, name: &str) -> Option<PieceId> {
    let pieces = output.nets().get(net.0)?.pieces();
    pieces.iter().position(|piece| piece.name() == name).map(|piece| PieceId { net, piece })
}

/// Where a piece is to go: to a sheet, moved on the page from where it is, and turned about its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// The sheet; one that there is not yet is added.
    pub sheet: SheetId,
    /// How far it is moved on the page, mm.
    pub by_mm: DVec2,
    /// Its turn, counter-clockwise on the page, radians.
    pub turn_rad: f64,
}

/// A piece that is dragged stays within the margins and may come as near to free places as this, mm.
const REACH_MM: f64 = 8.0;
/// The layout works on a lattice; this is the least number of cells along the longer side of a sheet.
const CELLS: f64 = 250.0;

/// All pieces pinned where they lie, but for one that is moved, to the free place that is nearest to where
/// it is wanted; that one is the first.
///
/// # Errors
/// A message with the pieces that are in the way.
pub fn rearranged(output: &Output, id: PieceId, to: &Move) -> Result<Vec<(String, Pin)>, String> {
    let (Some(own), Some(wanted)) = (piece(output, id), moved(output, id, to)) else { return Ok(Vec::new()) };
    let steps = (0..=16).flat_map(|ring| {
        let count = if ring == 0 { 1 } else { 16 };
        (0..count).map(move |k| {
            let way = DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / f64::from(count));
            REACH_MM * f64::from(ring) / 16.0 * way
        })
    });
    let tried = steps.map(|step| {
        let place = PiecePlace { place: DAffine2::from_translation(step) * wanted.place, ..wanted };
        let place = within(output, own, place);
        (place, in_the_way(output, id, &place))
    });
    let mut first = None;
    let mut found = None;
    for (place, others) in tried {
        if others.is_empty() {
            found = Some(place);
            break;
        }
        first.get_or_insert(others);
    }
    let Some(place) = found else {
        let others = listing::with_and(&first.unwrap_or_default());
        return Err(format!("{} would overlap {others}; it stays where it was", own.name()));
    };
    let pin = |id: PieceId, piece: &Piece, place: &PiecePlace| {
        let net = output.layout().taken(id.net);
        (piece.name().to_owned(), Pin { net, ..Pin::of_place(piece.outline(), place) })
    };
    let mut pins = vec![pin(id, own, &place)];
    pins.extend(
        all(output).filter(|(other, ..)| *other != id).map(|(id, piece, place)| pin(id, piece, place)),
    );
    // A sheet that becomes empty goes.
    let mut sheets: Vec<SheetId> = pins.iter().map(|(_, pin)| pin.sheet).collect();
    sheets.sort_unstable();
    sheets.dedup();
    for (_, pin) in &mut pins {
        pin.sheet = sheets.iter().position(|sheet| *sheet == pin.sheet).map_or(pin.sheet, SheetId);
    }
    Ok(pins)
}

/// The pieces that a piece would overlap, or come too near to, at a place.
fn in_the_way(output: &Output, id: PieceId, place: &PiecePlace) -> Vec<String> {
    let Some(own) = piece(output, id) else { return Vec::new() };
    let options = output.layout().options();
    let room_mm = options.choices.spacing_mm + options.size_mm().max_element() / CELLS;
    let outline = placed(own, place);
    let others = all(output).filter(|(other, _, at)| *other != id && at.sheet == place.sheet);
    let near = others.filter(|(_, other, at)| is_near(&outline, &placed(other, at), room_mm));
    near.map(|(_, other, _)| other.name().to_owned()).collect()
}

/// The pieces that a piece would overlap there.
pub fn overlapped(output: &Output, id: PieceId, to: &Move) -> Vec<PieceId> {
    let (Some(own), Some(place)) = (piece(output, id), moved(output, id, to)) else { return Vec::new() };
    let outline = placed(own, &within(output, own, place));
    let others = all(output).filter(|(other, _, at)| *other != id && at.sheet == place.sheet);
    others
        .filter(|(_, other, at)| is_near(&outline, &placed(other, at), 0.0))
        .map(|(other, ..)| other)
        .collect()
}

/// The outline on the page of a piece that is moved.
pub fn moved_outline(output: &Output, id: PieceId, to: &Move) -> Vec<DVec2> {
    let (Some(own), Some(place)) = (piece(output, id), moved(output, id, to)) else { return Vec::new() };
    let on_page = on_page(output);
    placed(own, &within(output, own, place)).into_iter().map(on_page).collect()
}

/// All pieces with their places.
pub(super) fn all(output: &Output) -> impl Iterator<Item = (PieceId, &Piece, &PiecePlace)> {
    output.model().ids().zip(output.nets()).flat_map(|(net, own)| {
        let places = own.pieces().iter().zip(output.layout().places(net)).enumerate();
        places.map(move |(piece, (own, place))| (PieceId { net, piece }, own, place))
    })
}

fn placed(piece: &Piece, place: &PiecePlace) -> Vec<DVec2> {
    piece.outline().iter().map(|&p| place.place.transform_point2(p)).collect()
}

/// The place that is moved so far that the piece is within the margins.
fn within(output: &Output, piece: &Piece, at: PiecePlace) -> PiecePlace {
    let options = output.layout().options();
    let (least, most) = (options.origin_mm(), options.origin_mm() + options.room_mm());
    let Some((low, high)) = polygon::bounds(placed(piece, &at)) else { return at };
    let back = (least - low).max(DVec2::ZERO) + (most - high).min(DVec2::ZERO);
    PiecePlace { place: DAffine2::from_translation(back) * at.place, ..at }
}

/// Whether two outlines overlap, or come nearer than so far.
fn is_near(a: &[DVec2], b: &[DVec2], room_mm: f64) -> bool {
    let (Some((low, high)), Some((other_low, other_high))) =
        (polygon::bounds(a.iter().copied()), polygon::bounds(b.iter().copied()))
    else {
        return false;
    };
    if (other_low - high).max(low - other_high).max_element() > room_mm {
        return false;
    }
    let is_inside = |ring: &[DVec2], other: &[DVec2]| ring.iter().any(|&p| polygon::contains(other, p));
    let crosses = |(p, q): (DVec2, DVec2), (r, s): (DVec2, DVec2)| {
        let side = |a: DVec2, b: DVec2, c: DVec2| polygon::cross3(a, b, c) > 0.0;
        side(p, q, r) != side(p, q, s) && side(r, s, p) != side(r, s, q)
    };
    let touches = |ring: &[DVec2], other: &[DVec2]| {
        room_mm > 0.0 && ring.iter().any(|&p| polygon::distance_to_edges(other, p) < room_mm)
    };
    is_inside(a, b)
        || is_inside(b, a)
        || touches(a, b)
        || touches(b, a)
        || polygon::edges(a).any(|edge| polygon::edges(b).any(|other| crosses(edge, other)))
}

/// From a sheet as seen from outside to the page as it is printed.
pub(super) fn on_page(output: &Output) -> impl Fn(DVec2) -> DVec2 + use<> {
    let options = output.layout().options();
    let (width_mm, is_mirrored) = (options.size_mm().x, options.choices.side == Side::Inside);
    move |p| if is_mirrored { DVec2::new(width_mm - p.x, p.y) } else { p }
}

/// The place of a piece that is moved on the page.
fn moved(output: &Output, id: PieceId, to: &Move) -> Option<PiecePlace> {
    let outline = piece(output, id)?.outline();
    let at = output.layout().places(id.net).get(id.piece)?;
    let is_mirrored = output.layout().options().choices.side == Side::Inside;
    let (by_mm, turn_rad) =
        if is_mirrored { (to.by_mm * DVec2::new(-1.0, 1.0), -to.turn_rad) } else { (to.by_mm, to.turn_rad) };
    let (low, high) = polygon::bounds(outline.iter().map(|&p| at.place.transform_point2(p)))?;
    let middle = low.midpoint(high);
    let turn = DAffine2::from_translation(middle + by_mm)
        * DAffine2::from_angle(turn_rad)
        * DAffine2::from_translation(-middle);
    Some(PiecePlace { sheet: to.sheet, place: turn * at.place })
}

/// The piece itself.
pub fn piece(output: &Output, id: PieceId) -> Option<&Piece> {
    output.nets().get(id.net.0)?.pieces().get(id.piece)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_overlap_touch_or_are_apart() {
        let square = |x: f64| [[x, 0.0], [x + 2.0, 0.0], [x + 2.0, 2.0], [x, 2.0]].map(DVec2::from);
        let cross = [[0.5, -3.0], [1.0, -3.0], [1.0, 5.0], [0.5, 5.0]].map(DVec2::from);
        let near = |a: &[DVec2], b: &[DVec2], room| (is_near(a, b, room), is_near(b, a, room));
        assert_eq!(near(&square(0.0), &square(1.0), 0.0), (true, true));
        assert_eq!(near(&square(0.0), &cross, 0.0), (true, true), "no corner is inside");
        assert_eq!(near(&square(0.0), &square(2.5), 0.0), (false, false));
        assert_eq!(near(&square(0.0), &square(2.5), 0.6), (true, true));
        assert_eq!(near(&square(0.0), &square(2.5), 0.4), (false, false));
    }

    #[test]
    fn a_point_is_in_the_piece_around_it() {
        let id = |piece| PieceId { net: PartId(0), piece };
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
