//! An over-size sheet on several smaller pages that overlap.
//!
//! Neighbours share a strip. Both show the same match marks in it: trim one page along its frame,
//! lay its marks on those of the other, and glue.

use glam::DVec2;
use tatamu_core::units::Paper;
use tatamu_draw::drawing::text::{shortened, width_mm};
use tatamu_draw::drawing::{Align, Drawing, Layer, LineStyles, Mark, Pages, Polyline, Text};

/// Border of a page that stays free of the sheet: most printers reach no further.
const MARGIN_MM: f64 = 10.0;
/// Width of the strip that neighbours share.
const OVERLAP_MM: f64 = 10.0;
/// Least side of paper for tiles.
const LEAST_SIDE_MM: f64 = 60.0;
/// A sheet that is larger by less fits.
const SLACK_MM: f64 = 0.01;
/// Half the size of a match mark.
const MATCH_MM: f64 = 3.5;
/// Capital height of the words in the margin, their distance from the frame, and the scale bar.
const CAP_MM: f64 = 1.9;
const WORDS_MM: f64 = 4.0;
const BAR_MM: f64 = 50.0;
const TICK_MM: f64 = 1.5;
const GAP_MM: f64 = 4.0;

/// `Err` with a message where paper is too small for tiles.
pub(super) fn check(paper: Paper) -> Result<(), String> {
    if paper.width_mm().min(paper.height_mm()) >= LEAST_SIDE_MM {
        return Ok(());
    }
    Err(format!(
        "paper {} is too small for tiles with margins and overlap; use at least {LEAST_SIDE_MM} mm on each side",
        paper.name()
    ))
}

/// How a sheet is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grid {
    paper_mm: DVec2,
    columns: usize,
    rows: usize,
    /// Lower left corner of the lowest, leftmost window on the sheet.
    origin_mm: DVec2,
}

impl Grid {
    /// The division into the fewest pages, upright or across; none for a sheet that fits one page.
    pub(super) fn new(sheet_mm: DVec2, paper: Paper) -> Option<Self> {
        let upright = DVec2::new(paper.width_mm(), paper.height_mm());
        let papers = [upright, DVec2::new(upright.y, upright.x)];
        if papers.iter().any(|paper| sheet_mm.cmple(*paper + SLACK_MM).all()) {
            return None;
        }
        let grid = |paper_mm: DVec2| {
            let step = Self::step_mm(paper_mm);
            let counts = ((sheet_mm - OVERLAP_MM - SLACK_MM) / step).ceil().max(DVec2::ONE);
            let covered = counts * step + OVERLAP_MM;
            let (columns, rows) = (counts.x as usize, counts.y as usize);
            Self { paper_mm, columns, rows, origin_mm: (sheet_mm - covered) / 2.0 }
        };
        let [upright, across] = papers.map(grid);
        Some(if across.columns * across.rows < upright.columns * upright.rows { across } else { upright })
    }

    /// Distance from a window to the next.
    fn step_mm(paper_mm: DVec2) -> DVec2 {
        paper_mm - 2.0 * MARGIN_MM - OVERLAP_MM
    }

    /// Row by row, from the top left.
    pub(super) fn tiles(&self) -> Vec<Tile> {
        let places = (0..self.rows).flat_map(|row| (0..self.columns).map(move |column| (row, column)));
        places.map(|(row, column)| self.tile(row, column)).collect()
    }

    fn tile(&self, row: usize, column: usize) -> Tile {
        let step = DVec2::new(column as f64, (self.rows - 1 - row) as f64);
        let low_mm = self.origin_mm + step * Self::step_mm(self.paper_mm);
        Tile { grid: *self, row, column, low_mm, paper_mm: self.paper_mm, shift_mm: MARGIN_MM - low_mm }
    }
}

/// One page of a divided sheet.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tile {
    grid: Grid,
    /// From the top.
    row: usize,
    column: usize,
    /// Lower left corner of the window on the sheet.
    low_mm: DVec2,
    /// Size of the page.
    pub(super) paper_mm: DVec2,
    /// From the sheet to the page.
    pub(super) shift_mm: DVec2,
}

impl Tile {
    /// Rows have letters, as on a chess board, and columns numbers.
    fn name(&self) -> String {
        let mut letters = String::new();
        let mut left = self.row + 1;
        while left > 0 {
            letters.insert(0, char::from(b'A' + ((left - 1) % 26) as u8));
            left = (left - 1) / 26;
        }
        format!("{letters}{}", self.column + 1)
    }

    fn window_mm(&self) -> DVec2 {
        self.paper_mm - 2.0 * MARGIN_MM
    }

    /// Corners of the window on the page.
    pub(super) fn window_corners(&self) -> Vec<DVec2> {
        let (low, size) = (DVec2::splat(MARGIN_MM), self.window_mm());
        [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|corner| low + corner * size).to_vec()
    }

    /// Whether a point of the sheet is in the window.
    pub(super) fn holds(&self, point: DVec2) -> bool {
        let inside = point - self.low_mm;
        inside.min_element() >= 0.0 && inside.cmple(self.window_mm()).all()
    }

    /// Whether a mark of the sheet is in the window, at least in part.
    pub(super) fn meets(&self, mark: &Mark) -> bool {
        mark.bounds().is_some_and(|(low, high)| {
            low.cmplt(self.low_mm + self.window_mm()).all() && high.cmpgt(self.low_mm).all()
        })
    }

    /// Whether there is anything on this part of the sheet.
    pub(super) fn has_marks(&self, drawing: &Drawing) -> bool {
        drawing.marks.iter().any(|mark| self.meets(mark))
    }

    /// Frame, match marks and words, on the page.
    pub(super) fn marks(&self, page: usize, pages: &Pages) -> Vec<Mark> {
        let styles = pages.styles();
        let stroke = styles.stroke(Layer::Furniture);
        let mut marks = vec![Mark::polygon(Layer::Furniture, self.window_corners(), stroke)];
        for at in self.match_points() {
            let arm = |d: DVec2| Polyline::open(vec![at - d * MATCH_MM, at + d * MATCH_MM]);
            let ends = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|d| at + d * MATCH_MM);
            let contours = vec![Polyline::closed(ends.to_vec()), arm(DVec2::X), arm(DVec2::Y)];
            marks.push(Mark::path(Layer::Furniture, contours, Some(stroke.clone()), None));
        }
        marks.extend(self.words(page, pages, styles));
        marks
    }

    /// Middles of the match marks on the page: two in each strip that is shared with a neighbour,
    /// at the same places of the sheet on both pages.
    fn match_points(&self) -> Vec<DVec2> {
        let (low, size) = (DVec2::splat(MARGIN_MM), self.window_mm());
        let (near, far) = (OVERLAP_MM / 2.0, size - OVERLAP_MM / 2.0);
        let mut out = Vec::new();
        for share in [0.25, 0.75] {
            let along = share * size;
            let sides = [
                (self.column > 0, DVec2::new(near, along.y)),
                (self.column + 1 < self.grid.columns, DVec2::new(far.x, along.y)),
                (self.row + 1 < self.grid.rows, DVec2::new(along.x, near)),
                (self.row > 0, DVec2::new(along.x, far.y)),
            ];
            out.extend(sides.into_iter().filter(|(is_shared, _)| *is_shared).map(|(_, at)| low + at));
        }
        out
    }

    /// A line below the frame: which page this is, what to do, and a scale bar.
    fn words(&self, page: usize, pages: &Pages, styles: &LineStyles) -> Vec<Mark> {
        let base = DVec2::new(MARGIN_MM, MARGIN_MM - WORDS_MM);
        let width = self.window_mm().x;
        let text = |content: String, x: f64, align: Align| {
            let text = Text::new(content, base + DVec2::X * x, CAP_MM).aligned(align);
            Mark::text(Layer::Furniture, text.coloured(styles.colour(Layer::Furniture)))
        };
        let mut marks = Vec::new();
        let mut room = width;
        if width >= 2.5 * BAR_MM {
            let (left, right) = (base + DVec2::X * (width - BAR_MM), base + DVec2::X * width);
            let tick = DVec2::Y * TICK_MM;
            let bar = vec![left + tick, left, right, right + tick];
            marks.push(Mark::polyline(Layer::Furniture, bar, styles.stroke(Layer::Furniture)));
            let length = format!("{BAR_MM} mm");
            room -= BAR_MM + GAP_MM + width_mm(&length, CAP_MM) + GAP_MM;
            marks.push(text(length, width - BAR_MM - GAP_MM / 2.0, Align::End));
        }
        let place = format!(
            "{} · sheet {page} of {} · tile {} of {} × {}",
            pages.title(),
            pages.drawings().len(),
            self.name(),
            self.grid.rows,
            self.grid.columns
        );
        let advice = format!("{place} · trim along the frame, lay crosses on one another, glue");
        let content =
            if width_mm(&advice, CAP_MM) <= room { advice } else { shortened(&place, CAP_MM, room) };
        marks.push(text(content, 0.0, Align::Start));
        marks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_core::units::parse_paper;

    fn grid(sheet: [f64; 2], paper: &str) -> Option<Grid> {
        Grid::new(DVec2::from(sheet), parse_paper(paper).expect("valid"))
    }

    #[test]
    fn a_sheet_that_fits_is_not_divided() {
        assert_eq!(grid([210.0, 297.0], "a4"), None);
        assert_eq!(grid([297.0, 210.0], "a4"), None);
        assert!(grid([210.1, 297.0], "a4").is_some());
    }

    #[test]
    fn windows_cover_the_sheet_and_overlap() {
        for (sheet, paper) in [([297.0, 420.0], "a4"), ([594.0, 841.0], "letter"), ([500.0, 90.0], "a5")] {
            let grid = grid(sheet, paper).expect("divided");
            let tiles = grid.tiles();
            for k in 0..=200 {
                for l in 0..=200 {
                    let point = DVec2::from(sheet) * DVec2::new(f64::from(k), f64::from(l)) / 200.0;
                    assert!(tiles.iter().any(|tile| tile.holds(point)), "{point} of {sheet:?}");
                }
            }
            let names: std::collections::BTreeSet<String> = tiles.iter().map(Tile::name).collect();
            assert_eq!(names.len(), grid.rows * grid.columns);
        }
    }

    #[test]
    fn match_marks_of_neighbours_are_at_the_same_place_of_the_sheet() {
        let tiles = grid([594.0, 841.0], "a4").expect("divided").tiles();
        let on_sheet = |tile: &Tile| -> Vec<DVec2> {
            tile.match_points().into_iter().map(|p| p - tile.shift_mm).collect()
        };
        for tile in &tiles {
            for point in on_sheet(tile) {
                let shared = tiles.iter().filter(|other| {
                    *other != tile && on_sheet(other).iter().any(|p| p.distance(point) < 1e-9)
                });
                assert_eq!(shared.count(), 1, "{} {point}", tile.name());
                assert!(tile.holds(point));
            }
        }
        assert_eq!(tiles[0].name(), "A1");
    }

    #[test]
    fn small_paper_is_refused() {
        assert!(check(parse_paper("60x60").expect("valid")).is_ok());
        assert!(check(parse_paper("59x600").expect("valid")).unwrap_err().contains("60 mm"));
    }
}
