//! Pieces on their sheets.

use super::SheetOptions;
use super::nest::{NestError, Placement, Shape, nest_alternatives};
use super::pin::{Pin, Unheeded, unheeded};
use super::place::PiecePlace;
use crate::net::{Blank, BlankNet, Net, Piece};
use glam::DAffine2;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use tatamu_core::geom::polygon;
use tatamu_core::progress::Progress;
use tatamu_core::remedy::Remedy;

/// Why there is no layout.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LayoutError {
    /// Margins and strip leave no room.
    #[error(
        "a sheet of {width_mm:.0} × {height_mm:.0} mm with a margin of {margin_mm} mm leaves no room for pieces"
    )]
    NoRoom {
        /// Width of the sheet.
        width_mm: f64,
        /// Height of the sheet.
        height_mm: f64,
        /// The margin.
        margin_mm: f64,
    },
    /// Nesting failed.
    #[error(transparent)]
    Nest(#[from] NestError),
}

impl LayoutError {
    /// What can be done.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::NoRoom { .. } => vec![Remedy::LargerPaper, Remedy::SmallerMargin],
            Self::Nest(_) => Vec::new(),
        }
    }
}

/// All pieces of a model on sheets.
#[derive(Debug, Clone)]
pub struct Layout {
    options: SheetOptions,
    places: Vec<Vec<PiecePlace>>,
    sheets: usize,
    utilisation: f64,
    unheeded: Vec<Unheeded>,
    /// Which of its alternatives each net is.
    taken: Vec<usize>,
}

impl Layout {
    /// Nests the pieces of all nets.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn new(nets: &[Net], options: &SheetOptions, progress: &dyn Progress) -> Result<Self, LayoutError> {
        let groups: Vec<Vec<Vec<&Blank>>> =
            nets.iter().map(|net| vec![net.pieces().iter().map(Piece::blank).collect()]).collect();
        Ok(Self::nested(&groups, options, &BTreeMap::new(), progress)?.0)
    }

    /// Nests the pieces of one net of each list, which are alternatives with as many pieces, the
    /// best first; also gives the nets that were taken. Pieces that are pinned, by name, lie where
    /// they are pinned; a net that has one is the one of its list that the first of its pins says.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn of_alternatives(
        nets: &[Vec<Arc<BlankNet>>],
        options: &SheetOptions,
        pins: &BTreeMap<String, Pin>,
        progress: &dyn Progress,
    ) -> Result<(Self, Vec<Net>), LayoutError> {
        let chosen: Vec<Option<usize>> = nets
            .iter()
            .map(|nets| {
                let pin = nets.first()?.blanks().iter().find_map(|blank| pins.get(blank.name()))?;
                Some(if pin.net < nets.len() { pin.net } else { 0 })
            })
            .collect();
        let groups: Vec<Vec<Vec<&Blank>>> = nets
            .iter()
            .zip(&chosen)
            .map(|(nets, chosen)| {
                let own = chosen.map_or(&nets[..], |k| std::slice::from_ref(&nets[k]));
                own.iter().map(|net| net.blanks().iter().collect()).collect()
            })
            .collect();
        let (layout, taken) = Self::nested(&groups, options, pins, progress)?;
        let taken: Vec<usize> =
            chosen.iter().zip(taken).map(|(chosen, taken)| chosen.unwrap_or(taken)).collect();
        let nets = nets.par_iter().zip(&taken).map(|(nets, &taken)| nets[taken].finished().clone()).collect();
        let layout = Self { taken, ..layout };
        Ok((layout, nets))
    }

    /// Nests the pieces `groups[g][a]` of alternative a of each group g; also gives which alternative
    /// was taken.
    fn nested(
        groups: &[Vec<Vec<&Blank>>],
        options: &SheetOptions,
        pins: &BTreeMap<String, Pin>,
        progress: &dyn Progress,
    ) -> Result<(Self, Vec<usize>), LayoutError> {
        let room = options.room_mm();
        if room.min_element() <= 0.0 {
            let size = options.size_mm();
            return Err(LayoutError::NoRoom {
                width_mm: size.x,
                height_mm: size.y,
                margin_mm: options.border_mm(),
            });
        }
        let shape = |n: usize, blank: &Blank| {
            let shape = Shape::new(blank.outline().to_vec(), n)?;
            Some(match pins.get(blank.name()) {
                Some(pin) => shape.pinned(pin.placement(blank.outline(), options.origin_mm())),
                None => shape,
            })
        };
        let shapes = |n: usize, blanks: &[&Blank]| -> Vec<Shape> {
            let shapes: Vec<Shape> = blanks.iter().filter_map(|blank| shape(n, blank)).collect();
            debug_assert_eq!(shapes.len(), blanks.len(), "every piece has an area");
            shapes
        };
        let shapes: Vec<Vec<Vec<Shape>>> = groups
            .iter()
            .enumerate()
            .map(|(n, alternatives)| alternatives.iter().map(|blanks| shapes(n, blanks)).collect())
            .collect();
        let placed = nest_alternatives(&shapes, &options.nesting(), progress)?;
        let place = |p: &Placement| PiecePlace {
            sheet: p.sheet,
            place: DAffine2::from_translation(options.origin_mm()) * p.motion(),
        };
        let places: Vec<Vec<PiecePlace>> =
            placed.iter().map(|(_, placements)| placements.iter().map(place).collect()).collect();
        let sheets = places.iter().flatten().map(|p| p.sheet + 1).max().unwrap_or(0);
        let taken: Vec<usize> = placed.iter().map(|(chosen, _)| *chosen).collect();
        let blanks = || groups.iter().zip(&taken).flat_map(|(group, &taken)| group[taken].iter().copied());
        let area: f64 = blanks().map(|blank| polygon::area(blank.outline())).sum();
        let utilisation = area / (room.x * room.y * sheets.max(1) as f64);
        let unheeded = unheeded(pins, blanks().zip(places.iter().flatten()));
        let layout = Self { options: *options, places, sheets, utilisation, unheeded, taken: taken.clone() };
        Ok((layout, taken))
    }

    /// Pins that could not be heeded.
    pub fn unheeded_pins(&self) -> &[Unheeded] {
        &self.unheeded
    }

    /// Places of the pieces of net `n`, in the net's order.
    pub fn places(&self, n: usize) -> &[PiecePlace] {
        &self.places[n]
    }

    /// Which of its alternatives net `n` is.
    pub fn taken(&self, n: usize) -> usize {
        self.taken[n]
    }

    /// Number of sheets.
    pub fn sheet_count(&self) -> usize {
        self.sheets
    }

    /// What the sheets are like.
    pub fn options(&self) -> &SheetOptions {
        &self.options
    }

    /// Share of the usable area that is covered by pieces.
    pub fn utilisation(&self) -> f64 {
        self.utilisation
    }
}
