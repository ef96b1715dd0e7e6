//! Sheets as drawings.

use super::furniture::Furniture;
use super::{Layout, SheetOptions};
use crate::net::{Net, Side};
use glam::DVec2;
use tatamu_draw::drawing::{Drawing, Layer, LineStyles, Mark, Text, text};

/// Height of capitals in the list of labels without a place.
const LOST_CAP_MM: f64 = 2.0;
/// Distance of its lines.
const LOST_LINE_MM: f64 = 3.6;
/// What the list begins with.
const LOST: &str = "no room on the piece for ";

impl Layout {
    /// One drawing for each sheet, in true size: what a printer makes of it is not considered. A
    /// list of labels without a place that is too long for its sheet has a page of its own.
    pub fn pages(&self, nets: &[Net], title: &str, note: &str, styles: &LineStyles) -> Vec<Drawing> {
        let options = self.options();
        let mut pages: Vec<Drawing> =
            (0..self.sheet_count()).map(|_| Drawing::new(title, options.size_mm())).collect();
        let mut lost: Vec<Vec<String>> = vec![Vec::new(); pages.len()];
        for (n, net) in nets.iter().enumerate() {
            for (piece, at) in net.pieces().iter().zip(self.places(n)) {
                let marks = piece.marks(options.choices.side, |layer| styles.stroke(layer).clone());
                let placed = marks.into_iter().map(|mark| mark.placed(at.place));
                pages[at.sheet].marks.extend(placed.map(|mark| on_side(mark, options).righted()));
                let texts = piece.unplaced_labels().iter();
                lost[at.sheet].extend(texts.map(|text| format!("{}: {text}", piece.name())));
            }
        }
        let mut rest = Vec::new();
        for (k, page) in pages.iter_mut().enumerate() {
            let lines = wrapped(&lost[k], text_width_mm(options));
            let room_mm = options.border_mm() - LOST_LINE_MM;
            if lines.len() as f64 * LOST_LINE_MM <= room_mm {
                let top_mm = LOST_LINE_MM * (lines.len() as f64 + 0.4);
                page.marks.extend(list(
                    &lines,
                    options,
                    styles,
                    options.size_mm().y - options.border_mm() + top_mm,
                ));
            } else {
                rest.push(format!("sheet {}", k + 1));
                rest.extend(lines);
            }
        }
        pages.extend(list_pages(&rest, title, options, styles));
        let count = pages.len();
        for (k, page) in pages.iter_mut().enumerate() {
            let furniture = Furniture {
                size_mm: options.size_mm(),
                margin_mm: options.border_mm(),
                title,
                note,
                page: k + 1,
                pages: count,
                legend: &options.legend(),
            };
            page.marks.extend(furniture.marks(styles));
            page.marks.extend(furniture.side_bar(styles));
            page.marks
                .extend(options.choices.registration.iter().flat_map(|r| r.marks(page.size_mm, styles)));
        }
        pages
    }
}

/// A mark as it is on the printed side of the paper.
fn on_side(mark: Mark, options: &SheetOptions) -> Mark {
    match options.choices.side {
        Side::Outside => mark,
        Side::Inside => mark.mirrored(options.size_mm().x / 2.0),
    }
}

fn text_width_mm(options: &SheetOptions) -> f64 {
    options.size_mm().x - 2.0 * options.border_mm()
}

/// A list in lines of at most a width.
fn wrapped(labels: &[String], width_mm: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for label in labels {
        match lines.last_mut() {
            Some(line) if text::width_mm(&format!("{line}; {label}"), LOST_CAP_MM) <= width_mm => {
                *line += "; ";
                *line += label;
            }
            Some(_) => lines.push(label.clone()),
            None => lines.push(format!("{LOST}{label}")),
        }
    }
    lines
}

/// Lines of text from a height down.
fn list(lines: &[String], options: &SheetOptions, styles: &LineStyles, top_mm: f64) -> Vec<Mark> {
    let mark = |(k, line): (usize, &String)| {
        let anchor = DVec2::new(options.border_mm(), top_mm - LOST_LINE_MM * (k + 1) as f64);
        let text = Text::new(line.clone(), anchor, LOST_CAP_MM);
        Mark::text(Layer::Furniture, text.coloured(styles.colour(Layer::Label)))
    };
    lines.iter().enumerate().map(mark).collect()
}

/// Pages with nothing but a list.
fn list_pages(lines: &[String], title: &str, options: &SheetOptions, styles: &LineStyles) -> Vec<Drawing> {
    let each = (options.room_mm().y / LOST_LINE_MM).floor().max(1.0) as usize;
    let page = |lines: &[String]| {
        let mut page = Drawing::new(title, options.size_mm());
        page.marks = list(lines, options, styles, options.size_mm().y - options.border_mm());
        page
    };
    lines.chunks(each).map(page).collect()
}
