//! Pieces on their sheets.

use super::SheetOptions;
use super::nest::{NestError, NestPiece, Placement, nest, nest_alternatives};
use super::pin::{Pin, PinWarning, pin_warnings};
use super::place::{PiecePlace, SheetId};
use crate::net::{Blank, BlankNet, Net, Piece, Tab};
use glam::{DAffine2, DVec2};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;
use tatamu_core::geom::polygon;
use tatamu_core::model::PartId;
use tatamu_core::progress::Progress;
use tatamu_core::remedy::Remedy;

/// Corners that are nearer are the same, mm.
const SAME_MM: f64 = 1e-6;

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
    pin_warnings: Vec<PinWarning>,
    /// Which of its alternatives each net is.
    taken: Vec<usize>,
    /// The colour of each sheet, where one is chosen.
    cards: Vec<Option<String>>,
}

impl Layout {
    /// Nests the pieces of all nets.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn new(nets: &[Net], options: &SheetOptions, progress: &dyn Progress) -> Result<Self, LayoutError> {
        let groups: Vec<Vec<Vec<&Blank>>> =
            nets.iter().map(|net| vec![net.pieces().iter().map(Piece::blank).collect()]).collect();
        Ok(Self::nested(&groups, &[], options, &BTreeMap::new(), progress)?.0)
    }

    /// Nests the pieces of one net of each list, which are alternatives with as many pieces, the
    /// best first; also gives the nets that were taken. Pieces that are pinned, by name, lie where
    /// they are pinned; a net that has one is the one of its list that the first of its pins says. `cards`
    /// has the colour of card of each net, and may end early: sheets have pieces of one colour.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn of_alternatives(
        nets: &[Vec<Arc<BlankNet>>],
        cards: &[Option<String>],
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
        let (layout, taken) = Self::nested(&groups, cards, options, pins, progress)?;
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
        cards: &[Option<String>],
        options: &SheetOptions,
        pins: &BTreeMap<String, Pin>,
        progress: &dyn Progress,
    ) -> Result<(Self, Vec<usize>), LayoutError> {
        let room = room_mm(options)?;
        let place = |first: usize, p: &Placement| PiecePlace {
            sheet: SheetId(first + p.sheet.0),
            place: DAffine2::from_translation(options.origin_mm()) * p.motion(),
        };
        let card_of = |n: usize| cards.get(n).and_then(Option::as_deref);
        let mut colours: Vec<Option<&str>> = Vec::new();
        for n in 0..groups.len() {
            if !colours.contains(&card_of(n)) {
                colours.push(card_of(n));
            }
        }
        // Pieces of one colour after the other; `first` is the first sheet of a colour.
        let shapes = |group: usize, first: usize, blanks: &[&Blank]| -> Vec<NestPiece> {
            let shapes = blanks.iter().filter_map(|blank| shape(blank, group, first, options, pins));
            let shapes: Vec<NestPiece> = shapes.collect();
            debug_assert_eq!(shapes.len(), blanks.len(), "every piece has an area");
            shapes
        };
        let (mut taken, mut places) = (vec![0; groups.len()], vec![Vec::new(); groups.len()]);
        let mut of_sheets: Vec<Option<String>> = Vec::new();
        for colour in colours {
            let own: Vec<usize> = (0..groups.len()).filter(|&n| card_of(n) == colour).collect();
            let first = of_sheets.len();
            let shapes: Vec<Vec<Vec<NestPiece>>> = own
                .iter()
                .enumerate()
                .map(|(group, &n)| groups[n].iter().map(|blanks| shapes(group, first, blanks)).collect())
                .collect();
            let placed = nest_alternatives(&shapes, &options.nesting(), progress)?;
            let count = placed.iter().flat_map(|(_, on)| on).map(|p| p.sheet.number()).max().unwrap_or(0);
            of_sheets.resize(first + count, colour.map(str::to_owned));
            for (&n, (chosen, placements)) in own.iter().zip(&placed) {
                taken[n] = *chosen;
                places[n] = placements.iter().map(|p| place(first, p)).collect();
            }
        }
        let sheets = of_sheets.len();
        let blanks = || groups.iter().zip(&taken).flat_map(|(group, &taken)| group[taken].iter().copied());
        let area: f64 = blanks().map(|blank| polygon::area(blank.outline())).sum();
        let utilisation = area / (room.x * room.y * sheets.max(1) as f64);
        let pin_warnings = pin_warnings(pins, blanks().zip(places.iter().flatten()));
        let (options, cards) = (*options, of_sheets);
        let layout = Self { options, places, sheets, utilisation, pin_warnings, taken: taken.clone(), cards };
        Ok((layout, taken))
    }

    /// Pins that could not be followed.
    pub fn pin_warnings(&self) -> &[PinWarning] {
        &self.pin_warnings
    }

    /// About how many sheets the pieces of these nets, which it was made for, would take at `factor` of their
    /// size, with tabs as wide as they are.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn sheets_at(
        &self,
        nets: &[Net],
        factor: f64,
        progress: &dyn Progress,
    ) -> Result<usize, LayoutError> {
        let mut colours: BTreeMap<Option<&str>, Vec<NestPiece>> = BTreeMap::new();
        for (n, net) in nets.iter().enumerate() {
            for (piece, at) in net.pieces().iter().zip(self.places(PartId(n))) {
                let outline = piece.outline().iter().map(|&p| widened(p, piece, 1.0 / factor) * factor);
                colours.entry(self.card(at.sheet)).or_default().extend(NestPiece::new(outline.collect(), n));
            }
        }
        let sheets_of = |shapes: &Vec<NestPiece>| {
            let placed = nest(shapes, &self.options.nesting(), progress)?;
            Ok(placed.iter().map(|at| at.sheet.number()).max().unwrap_or(0))
        };
        colours.values().map(sheets_of).sum()
    }

    /// Places of the pieces of a component's net, in the net's order.
    pub fn places(&self, part: PartId) -> &[PiecePlace] {
        &self.places[part.0]
    }

    /// Which of its alternatives a component's net is.
    pub fn taken(&self, part: PartId) -> usize {
        self.taken[part.0]
    }

    /// The colour of card of a sheet, where one is chosen.
    pub fn card(&self, sheet: SheetId) -> Option<&str> {
        self.cards.get(sheet.0).and_then(Option::as_deref)
    }

    /// The colours that are chosen, in the order of their sheets, and how many sheets each has; nothing where
    /// none is chosen. Sheets of no colour are last.
    pub fn cards(&self) -> Vec<(Option<&str>, usize)> {
        let mut out: Vec<(Option<&str>, usize)> = Vec::new();
        for card in self.cards.iter().map(Option::as_deref) {
            match out.iter_mut().find(|(known, _)| *known == card) {
                Some((_, count)) => *count += 1,
                None => out.push((card, 1)),
            }
        }
        out.sort_by_key(|(card, _)| card.is_none());
        if out.iter().all(|(card, _)| card.is_none()) { Vec::new() } else { out }
    }

    /// Number of sheets.
    pub fn sheet_count(&self) -> usize {
        self.sheets
    }

    /// The sheets' ids, in their order.
    pub fn sheet_ids(&self) -> impl Iterator<Item = SheetId> + use<> {
        (0..self.sheets).map(SheetId)
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

/// A corner of a piece's outline; the far corners of a tab are moved so that it is wider by a factor.
fn widened(corner: DVec2, piece: &Piece, factor: f64) -> DVec2 {
    let is_far = |tab: &&Tab| tab.outline[2..].iter().any(|p| p.distance(corner) < SAME_MM);
    let tab = piece.tabs().iter().find(is_far);
    tab.map_or(corner, |tab| {
        let outward = -(tab.outline[1] - tab.outline[0]).perp().normalize_or_zero();
        corner - outward * (tab.width_mm() * (1.0 - factor))
    })
}

/// The room for pieces on a sheet.
fn room_mm(options: &SheetOptions) -> Result<DVec2, LayoutError> {
    let room = options.room_mm();
    if room.min_element() > 0.0 {
        return Ok(room);
    }
    let size = options.size_mm();
    Err(LayoutError::NoRoom { width_mm: size.x, height_mm: size.y, margin_mm: options.border_mm() })
}

/// A piece to be nested, where it is pinned if it is; its colour begins on the sheet `first`.
fn shape(
    blank: &Blank,
    group: usize,
    first: usize,
    options: &SheetOptions,
    pins: &BTreeMap<String, Pin>,
) -> Option<NestPiece> {
    let shape = NestPiece::new(blank.outline().to_vec(), group)?;
    let pin = pins.get(blank.name()).map(|pin| pin.placement(blank.outline(), options.origin_mm()));
    Some(match pin {
        Some(at) => shape.pinned(Placement { sheet: SheetId(at.sheet.0.saturating_sub(first)), ..at }),
        None => shape,
    })
}
