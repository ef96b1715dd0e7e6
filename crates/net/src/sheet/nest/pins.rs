//! Sheets with the pieces whose places the user chose, before any other is placed.

use super::occupancy::{Occupancy, Pose, Spot};
use super::raster::Grid;

/// A piece at a place that the user chose.
pub(super) struct Pinned {
    pub sheet: usize,
    pub pose: Pose,
    pub spot: Spot,
}

/// The sheets on which pinned pieces lie.
pub(super) struct Start {
    stock: Vec<Occupancy>,
    is_free: Vec<bool>,
}

impl Start {
    /// Takes the places of pins, of which there may be one for each piece. One whose place is taken
    /// by another before it is not heeded.
    pub fn new(pins: &[Option<Pinned>], grid: &Grid) -> Self {
        let mut start = Self { stock: Vec::new(), is_free: vec![true; pins.len()] };
        for (item, pin) in pins.iter().enumerate().filter_map(|(k, pin)| Some((k, pin.as_ref()?))) {
            while start.stock.len() <= pin.sheet {
                start.stock.push(Occupancy::new(grid));
            }
            let sheet = &mut start.stock[pin.sheet];
            if sheet.is_free(&pin.pose, &pin.spot) {
                sheet.place(&pin.pose, &pin.spot);
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
