//! Sheets as drawings.

use super::furniture::Furniture;
use super::{Layout, SheetId, SheetOptions, beside};
use crate::net::{LabelPlace, Net, Piece, Side};
use glam::{DAffine2, DVec2};
use tatamu_core::model::PartId;
use tatamu_draw::drawing::{Align, Drawing, Layer, LineStyles, Mark, Text, text};

/// Height of capitals in the list of labels without a place.
const LOST_CAP_MM: f64 = 2.0;
/// Distance of its lines.
const LOST_LINE_MM: f64 = 3.6;
/// Half the size of the crosses that both sides of a sheet have.
const CROSS_MM: f64 = 2.0;
/// What the list begins with.
const LOST: &str = "labels without room on their piece: ";

/// What pages say of the model.
#[derive(Debug, Clone, Copy, Default)]
pub struct Imprint<'a> {
    /// Its name.
    pub title: &'a str,
    /// What follows the name, such as its size; may be empty.
    pub note: &'a str,
    /// What is above a sheet, such as the order of folding: the first of these that has room on one line, on the first
    /// sheet that has a line free.
    pub advice: &'a [String],
}

impl Layout {
    /// One drawing for each sheet, in true size: what a printer makes of it is not considered. A
    /// list of labels without a place that is too long for its sheet has a page of its own.
    pub fn pages(&self, nets: &[Net], imprint: Imprint<'_>, styles: &LineStyles) -> Vec<Drawing> {
        let options = self.options();
        let title = imprint.title;
        let mut pages: Vec<Drawing> =
            self.sheet_ids().map(|_| Drawing::new(title, options.size_mm())).collect();
        let lost = self.add_pieces(&mut pages, nets, styles);
        if options.labels() == LabelPlace::Tabs {
            for (page, marks) in pages.iter_mut().zip(beside::texts(self, nets, styles)) {
                page.marks.extend(marks);
            }
        }
        let rest = self.add_lists(&mut pages, &lost, imprint.advice, styles);
        pages.extend(list_pages(&rest, title, options, styles));
        let count = self.sheet_count();
        for (k, page) in pages.iter_mut().enumerate() {
            page.card = self.card(SheetId(k)).map(str::to_owned);
            let number = if k < count {
                let card = page.card.iter().map(|card| format!(" · {card} card"));
                format!("sheet {} of {count}{}", k + 1, card.collect::<String>())
            } else {
                "labels of the sheets".to_owned()
            };
            let furniture = Furniture {
                size_mm: options.size_mm(),
                margin_mm: options.border_mm(),
                title,
                note: imprint.note,
                number: &number,
                legend: &options.legend(),
            };
            page.marks.extend(furniture.marks(styles));
            page.marks.extend(furniture.side_bar(styles));
            if options.has_two_sides() {
                page.marks.extend(crosses(options, styles));
            }
            page.registration = options.choices.registration;
            page.marks
                .extend(options.choices.registration.iter().flat_map(|r| r.marks(page.size_mm, styles)));
        }
        pages
    }

    /// Puts the pieces on their sheets; the labels that have no place on them, for each sheet.
    fn add_pieces(&self, pages: &mut [Drawing], nets: &[Net], styles: &LineStyles) -> Vec<Vec<String>> {
        let options = self.options();
        let mut lost: Vec<Vec<String>> = vec![Vec::new(); pages.len()];
        for (piece, sheet, place) in self.placed(nets) {
            let marks = match options.labels() {
                LabelPlace::Panels => piece.marks(options.choices.side, styles),
                LabelPlace::Tabs | LabelPlace::Inside => {
                    let hidden = piece.text_marks(styles, |label| piece.hides(label));
                    piece.line_marks(options.choices.side, styles).into_iter().chain(hidden).collect()
                }
            };
            let placed = marks.into_iter().map(|mark| mark.placed(place));
            pages[sheet.0].marks.extend(placed.map(|mark| on_side(mark, options).righted()));
            let texts = piece.unplaced_labels().iter();
            lost[sheet.0].extend(texts.map(|text| format!("{}: {text}", piece.name())));
        }
        lost
    }

    /// Lists labels above their sheets, and the advice where a line is left; the lines of lists that are too long for
    /// that.
    fn add_lists(
        &self,
        pages: &mut [Drawing],
        lost: &[Vec<String>],
        advice: &[String],
        styles: &LineStyles,
    ) -> Vec<String> {
        let options = self.options();
        let mut rest = Vec::new();
        let fits = |words: &&String| text::width_mm(words, LOST_CAP_MM) <= text_width_mm(options);
        let mut advice = advice.iter().find(fits);
        for (k, (page, lost)) in pages.iter_mut().zip(lost).enumerate() {
            let mut lines = wrapped(lost, text_width_mm(options));
            let has_room = |lines: usize| lines as f64 * LOST_LINE_MM <= head_mm(options);
            if has_room(lines.len()) {
                if has_room(lines.len() + 1) {
                    lines.splice(0..0, advice.take().cloned());
                }
                let top_mm = LOST_LINE_MM * (lines.len() as f64 + 0.4);
                let at_mm = options.size_mm().y - options.border_mm() + top_mm;
                page.marks.extend(list(&lines, options, styles, at_mm));
            } else {
                rest.push(format!("sheet {}", k + 1));
                rest.extend(lines);
            }
        }
        rest
    }
}

impl Layout {
    /// The other sides of the sheets, where both are printed: outside, the places of joints; or inside, the
    /// texts that shall not be seen. Four crosses are at the same places of both sides, to check that they lie on
    /// each other.
    pub fn other_pages(&self, nets: &[Net], imprint: Imprint<'_>, styles: &LineStyles) -> Vec<Drawing> {
        let options = self.options();
        let sheets = if options.has_two_sides() { self.sheet_count() } else { 0 };
        let side = if options.choices.is_duplex { "outside" } else { "inside" };
        let mut pages: Vec<Drawing> =
            (0..sheets).map(|_| Drawing::new(imprint.title, options.size_mm())).collect();
        for (k, page) in pages.iter_mut().enumerate() {
            page.marks.extend(crosses(options, styles));
            let words = format!("{} · {side} of sheet {} of {sheets}", imprint.title, k + 1);
            let at = DVec2::new(options.size_mm().x / 2.0, options.border_mm() / 2.0);
            let text = Text::new(words, at, LOST_CAP_MM).aligned(Align::Middle);
            page.marks.push(Mark::text(Layer::Furniture, text.coloured(styles.colour(Layer::Furniture))));
        }
        for (piece, sheet, place) in self.placed(nets).filter(|_| sheets > 0) {
            let marks = if options.choices.is_duplex {
                piece.joint_marks(styles)
            } else {
                piece.text_marks(styles, |label| !piece.hides(label))
            };
            let placed = marks.into_iter().map(|mark| mark.placed(place));
            let mirrored = |mark: Mark| mark.mirrored(options.size_mm().x / 2.0);
            let is_outside = options.choices.is_duplex;
            let sided = placed.map(|mark| if is_outside { mark } else { mirrored(mark) });
            pages[sheet.0].marks.extend(sided.map(Mark::righted));
        }
        pages
    }

    /// Every piece with its sheet and its place there.
    pub(super) fn placed<'a>(
        &'a self,
        nets: &'a [Net],
    ) -> impl Iterator<Item = (&'a Piece, SheetId, DAffine2)> + 'a {
        let of_net = |(part, net): (PartId, &'a Net)| net.pieces().iter().zip(self.places(part));
        (0..).map(PartId).zip(nets).flat_map(of_net).map(|(piece, at)| (piece, at.sheet, at.place))
    }
}

/// Crosses in the corners of the border, which a mirror leaves where they are.
fn crosses(options: &SheetOptions, styles: &LineStyles) -> Vec<Mark> {
    let (size_mm, inset_mm) = (options.size_mm(), options.border_mm() / 2.0);
    let stroke = styles.stroke(Layer::Furniture);
    let corners = [DVec2::ONE, DVec2::new(-1.0, 1.0), DVec2::NEG_ONE, DVec2::new(1.0, -1.0)];
    let arms = corners.into_iter().flat_map(|sign| {
        let at = size_mm / 2.0 + (size_mm / 2.0 - inset_mm) * sign;
        [DVec2::X, DVec2::Y].map(|arm| (at - arm * CROSS_MM, at + arm * CROSS_MM))
    });
    arms.map(|(from, to)| Mark::line(Layer::Furniture, from, to, stroke)).collect()
}

/// A mark as it is on the printed side of the paper.
fn on_side(mark: Mark, options: &SheetOptions) -> Mark {
    match options.choices.side {
        Side::Outside => mark,
        Side::Inside => mark.mirrored(options.size_mm().x / 2.0),
    }
}

/// Height above the pieces that may be printed on: cutters that look for marks want it white.
fn head_mm(options: &SheetOptions) -> f64 {
    if options.choices.registration.is_some() { 0.0 } else { options.border_mm() - LOST_LINE_MM }
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
