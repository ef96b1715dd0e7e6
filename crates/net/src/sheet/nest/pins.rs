//! Sheets with the pieces whose places the user chose, before any other is placed.

use super::super::place::SheetId;
use super::occupancy::{Occupancy, Pose, Spot};
use super::raster::Grid;
use geo::{Distance, Euclidean};
use glam::DVec2;

/// Rounding of places, mm.
const SLIVER_MM: f64 = 1e-6;

/// A piece at a place that the user chose.
pub(super) struct Pinned {
    pub sheet: SheetId,
    pub pose: Pose,
    pub spot: Spot,
}

/// The sheets on which pinned pieces lie.
pub(super) struct Start {
    stock: Vec<Occupancy>,
    is_free: Vec<bool>,
}

impl Start {
    /// Takes the places of pins, of which there may be one for each piece; `outlines` are those of the
    /// pinned pieces there. One whose place is taken by another before it is ignored.
    pub fn new(
        pins: &[Option<Pinned>],
        outlines: &[Option<Vec<DVec2>>],
        spacing_mm: f64,
        grid: &Grid,
    ) -> Self {
        let mut start = Self { stock: Vec::new(), is_free: vec![true; pins.len()] };
        for (item, pin) in pins.iter().enumerate().filter_map(|(k, pin)| Some((k, pin.as_ref()?))) {
            while start.stock.len() <= pin.sheet.0 {
                start.stock.push(Occupancy::new(grid));
            }
            // Cells are coarse: pieces that were placed in another order need not fit in this one, though
            // they are far enough apart.
            let is_apart = || {
                let taken = (0..item).filter(|&other| !start.is_free[other]);
                let mut same =
                    taken.filter(|&k| pins[k].as_ref().is_some_and(|other| other.sheet == pin.sheet));
                same.all(|other| are_apart([&outlines[other], &outlines[item]], spacing_mm))
            };
            let may_stand = start.stock[pin.sheet.0].is_free(&pin.pose, &pin.spot) || is_apart();
            if may_stand {
                start.stock[pin.sheet.0].place(&pin.pose, &pin.spot);
                start.is_free[item] = false;
            }
        }
        start
    }

    /// The sheets.
    pub fn stock(&self) -> &[Occupancy] {
        &self.stock
    }

    /// Whether a piece is still to be placed.
    pub fn is_free(&self, item: usize) -> bool {
        self.is_free[item]
    }

    /// The pieces that are still to be placed.
    pub fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_free.len()).filter(|&item| self.is_free[item])
    }
}

/// Whether two outlines are at least the spacing apart.
fn are_apart(outlines: [&Option<Vec<DVec2>>; 2], spacing_mm: f64) -> bool {
    let [Some(a), Some(b)] = outlines else { return false };
    let [a, b] = [a, b].map(|outline| {
        let ring = outline.iter().map(|p| geo::Coord { x: p.x, y: p.y }).collect();
        geo::Polygon::new(ring, Vec::new())
    });
    let distance_mm = Euclidean.distance(&a, &b);
    distance_mm > 0.0 && distance_mm >= spacing_mm - SLIVER_MM
}
