//! Pieces on their sheets, and the sheets as drawings.

use super::furniture::{self, Furniture};
use super::nest::{NestError, NestOptions, Shape, nest};
use crate::drawing::{Drawing, Layer, LineStyles, Mark, Text, text};
use crate::geom::polygon;
use crate::net::{Net, Side};
use crate::progress::Progress;
use crate::units::Paper;
use glam::{DAffine2, DVec2};

/// What sheets are like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetOptions {
    /// Size of a sheet.
    pub paper: Paper,
    /// Border that stays free, mm.
    pub margin_mm: f64,
}

/// Kinds of lines that the legend explains.
const LEGEND: [Layer; 5] = [Layer::Cut, Layer::Slit, Layer::Mountain, Layer::FoldHinge, Layer::Glue];

impl SheetOptions {
    fn size_mm(&self) -> DVec2 {
        DVec2::new(self.paper.width_mm(), self.paper.height_mm())
    }

    fn strip_mm(&self) -> f64 {
        furniture::height_mm(self.size_mm(), self.margin_mm, &LEGEND)
    }

    /// Width and height of the area for pieces: within the margins, above the strip with the
    /// scale bar.
    pub fn room_mm(&self) -> DVec2 {
        self.size_mm() - DVec2::splat(2.0 * self.margin_mm) - DVec2::Y * self.strip_mm()
    }

    /// Lower left corner of that area.
    fn origin_mm(&self) -> DVec2 {
        DVec2::splat(self.margin_mm) + DVec2::Y * self.strip_mm()
    }
}

/// Where a piece lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PiecePlace {
    /// Index of the sheet.
    pub sheet: usize,
    /// Rigid motion from the piece's coordinates to the sheet's, mm.
    pub place: DAffine2,
}

/// Why there is no layout.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LayoutError {
    /// Margins and strip leave no room.
    #[error(
        "a sheet of {width_mm:.0} × {height_mm:.0} mm with a margin of {margin_mm} mm leaves no room for pieces; use larger --paper or a smaller --margin"
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

/// All pieces of a model on sheets.
#[derive(Debug, Clone)]
pub struct Layout {
    options: SheetOptions,
    places: Vec<Vec<PiecePlace>>,
    sheets: usize,
    utilisation: f64,
}

impl Layout {
    /// Nests the pieces of all nets.
    ///
    /// # Errors
    /// See [`LayoutError`].
    pub fn new(nets: &[Net], options: &SheetOptions, progress: &dyn Progress) -> Result<Self, LayoutError> {
        let room = options.room_mm();
        if room.min_element() <= 0.0 {
            let size = options.size_mm();
            return Err(LayoutError::NoRoom {
                width_mm: size.x,
                height_mm: size.y,
                margin_mm: options.margin_mm,
            });
        }
        let pieces = || nets.iter().enumerate().flat_map(|(n, net)| net.pieces().iter().map(move |p| (n, p)));
        let shapes: Vec<Shape> = pieces().filter_map(|(n, p)| Shape::new(p.outline().to_vec(), n)).collect();
        debug_assert_eq!(shapes.len(), pieces().count(), "every piece has an area");
        let placements = nest(&shapes, &NestOptions::new(room.x, room.y), progress)?;
        let mut places = vec![Vec::new(); nets.len()];
        for ((n, _), placement) in pieces().zip(&placements) {
            let place = DAffine2::from_translation(options.origin_mm()) * placement.motion();
            places[n].push(PiecePlace { sheet: placement.sheet, place });
        }
        let sheets = placements.iter().map(|p| p.sheet + 1).max().unwrap_or(0);
        let area: f64 = shapes.iter().map(|s| polygon::area(s.outline())).sum();
        let utilisation = area / (room.x * room.y * sheets.max(1) as f64);
        Ok(Self { options: *options, places, sheets, utilisation })
    }

    /// Places of the pieces of net `n`, in the net's order.
    pub fn places(&self, n: usize) -> &[PiecePlace] {
        &self.places[n]
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

    /// One drawing for each sheet.
    pub fn pages(&self, nets: &[Net], title: &str, note: &str, styles: &LineStyles) -> Vec<Drawing> {
        let mut pages: Vec<Drawing> =
            (0..self.sheets).map(|_| Drawing::new(title, self.options.size_mm())).collect();
        let mut lost: Vec<Vec<String>> = vec![Vec::new(); self.sheets];
        for (net, places) in nets.iter().zip(&self.places) {
            for (piece, at) in net.pieces().iter().zip(places) {
                let marks = piece.marks(Side::default(), |layer| styles.stroke(layer).clone());
                pages[at.sheet].place(marks, at.place);
                lost[at.sheet]
                    .extend(piece.unplaced_labels().iter().map(|l| format!("{}: {l}", piece.name())));
            }
        }
        for (k, page) in pages.iter_mut().enumerate() {
            let strip = Furniture {
                size_mm: self.options.size_mm(),
                margin_mm: self.options.margin_mm,
                title,
                note,
                page: k + 1,
                pages: self.sheets,
                legend: &LEGEND,
            };
            page.marks.extend(strip.marks(styles));
            page.marks.extend(lost_labels(&lost[k], &self.options, styles));
        }
        pages
    }
}

/// Height of capitals in the list of labels without a place.
const LOST_CAP_MM: f64 = 2.0;

/// A line at the top of the sheet that lists labels without a place on their piece.
fn lost_labels(labels: &[String], options: &SheetOptions, styles: &LineStyles) -> Option<Mark> {
    let size = options.size_mm();
    let anchor = DVec2::new(options.margin_mm, size.y - options.margin_mm * 0.6);
    let content = format!("no room on the piece for: {}", labels.join("; "));
    let content = text::shortened(&content, LOST_CAP_MM, size.x - 2.0 * options.margin_mm);
    let text = Text::new(content, anchor, LOST_CAP_MM).coloured(styles.colour(Layer::Label));
    (!labels.is_empty()).then(|| Mark::text(Layer::Furniture, text))
}
