//! What is printed on every sheet besides the pieces: scale bar, title, page number, legend.
//!
//! It stands in a strip at the bottom, inside the margin. Printing "fit to page" is the commonest
//! mistake with paper models, so the scale bar comes first: a narrow sheet loses its legend before
//! its bar.

use glam::DVec2;
use tatamu_draw::drawing::text::{shortened, width_mm};
use tatamu_draw::drawing::{Align, Fill, Layer, LineStyles, Mark, Stroke, Text};

/// Capital height of all texts in the strip.
const CAP_MM: f64 = 1.9;
/// Distance between lines of the strip, from base line to base line.
const LINE_MM: f64 = 4.2;
/// Clear space between the strip and the pieces.
const CLEARANCE_MM: f64 = 3.0;
/// Least distance between things side by side.
const GAP_MM: f64 = 4.0;
/// Largest distance between entries of the legend.
const MAX_GAP_MM: f64 = 8.0;
/// Lengths of the scale bar, of which the longest that fits is drawn.
const BARS_MM: [f64; 4] = [100.0, 50.0, 20.0, 10.0];
/// Heights of the bar's ticks: at its ends, in the middle, at the other centimetres.
const TICKS_MM: [f64; 3] = [2.6, 1.9, 1.2];
/// Distance of the upright bar from the pieces; narrower margins have no bar.
const SIDE_BAR_MM: f64 = 2.5;
const SIDE_BAR_MARGIN_MM: f64 = 8.0;
/// Distance between the ticks and the words above.
const TICK_GAP_MM: f64 = 1.2;
/// The titles stand beside the bar where they have at least this width.
const MIN_TITLES_MM: f64 = 35.0;
/// Forms of the legend, the best first: length of a line, mm, and which of its words it has. On A4, six kinds of
/// lines have their full words, and seven those of the second form, beside short lines.
const FORMS: [(f64, usize); 5] = [(11.0, 0), (8.0, 0), (11.0, 1), (8.0, 1), (8.0, 2)];
/// Height of a tab in the legend.
const TAB_SAMPLE_MM: f64 = 2.6;
/// Distance between a line in the legend and its word.
const WORD_GAP_MM: f64 = 1.5;

/// What the strip tells about its sheet.
#[derive(Debug, Clone, Copy)]
pub struct Furniture<'a> {
    /// Width and height of the sheet, mm.
    pub size_mm: DVec2,
    /// Margin of the sheet on all sides, mm.
    pub margin_mm: f64,
    /// The model's name.
    pub title: &'a str,
    /// What follows the name where there is room, such as the model's size; may be empty.
    pub note: &'a str,
    /// What tells this page from others, such as "sheet 1 of 4".
    pub number: &'a str,
    /// The kinds of lines to explain; layers that are no kind of line are left out.
    pub legend: &'a [Layer],
}

impl Furniture<'_> {
    /// The marks of the strip, all on [`Layer::Furniture`].
    pub fn marks(&self, styles: &LineStyles) -> Vec<Mark> {
        let strip = Strip::new(self.size_mm, self.margin_mm, self.legend);
        let mut marks = strip.scale_bar(styles);
        marks.extend(strip.titles(self, styles));
        marks.extend(strip.legend_marks(styles));
        marks
    }

    /// An upright bar in the left margin, to measure the printer's scale along the page. Nothing
    /// where the margin is too narrow to be printed on, or the page too low.
    pub(crate) fn side_bar(&self, styles: &LineStyles) -> Vec<Mark> {
        let room_mm = self.size_mm.y - 2.0 * self.margin_mm;
        let fitting = BARS_MM.into_iter().find(|&bar_mm| bar_mm <= room_mm);
        let Some(bar_mm) = fitting.filter(|_| self.margin_mm >= SIDE_BAR_MARGIN_MM) else {
            return Vec::new();
        };
        let at = |x: f64, y: f64| DVec2::splat(self.margin_mm) + DVec2::new(x - SIDE_BAR_MM, y);
        let line = |from, to| Mark::line(Layer::Furniture, from, to, styles.stroke(Layer::Furniture));
        let ticks = [0.0, bar_mm].map(|y| line(at(0.0, y), at(TICKS_MM[2], y)));
        let end = at(TICKS_MM[2], bar_mm + TICK_GAP_MM);
        let text = Text::new(format!("{bar_mm}"), end, CAP_MM).aligned(Align::End);
        let text = Mark::text(Layer::Furniture, text.coloured(styles.colour(Layer::Furniture)));
        [line(at(0.0, 0.0), at(0.0, bar_mm)), text].into_iter().chain(ticks).collect()
    }
}

/// Height above the bottom margin that the strip takes, with its clearance: pieces stay above
/// `margin_mm + height_mm`. It depends on the sheet and the legend alone.
pub fn height_mm(size_mm: DVec2, margin_mm: f64, legend: &[Layer]) -> f64 {
    Strip::new(size_mm, margin_mm, legend).top_mm() + CLEARANCE_MM
}

/// The explanations of a kind of line, the longest first.
fn words(layer: Layer) -> Option<[&'static str; 3]> {
    match layer {
        Layer::Cut => Some(["cut"; 3]),
        Layer::Slit => Some(["slit"; 3]),
        Layer::Mountain => Some(["fold back (mountain)", "fold back (mountain)", "mountain"]),
        Layer::Valley => Some(["fold up (valley)", "fold up (valley)", "valley"]),
        Layer::FoldHinge => Some(["fold flat 180°", "fold flat 180°", "180°"]),
        Layer::Glue => Some(["glue here, triangles meet", "glue here", "glue"]),
        Layer::Tab => Some(["tab"; 3]),
        Layer::Label | Layer::Furniture | Layer::Registration | Layer::Picture => None,
    }
}

/// One line of the legend with its word.
struct LegendEntry {
    layer: Layer,
    word: &'static str,
    sample_mm: f64,
}

impl LegendEntry {
    fn width_mm(&self) -> f64 {
        self.sample_mm + WORD_GAP_MM + width_mm(self.word, CAP_MM)
    }
}

/// All entries of a form of the legend.
fn entries(legend: &[Layer], (sample_mm, form): (f64, usize)) -> Vec<LegendEntry> {
    let entry = |&layer: &Layer| {
        let word = words(layer)?[form];
        Some(LegendEntry { layer, word, sample_mm })
    };
    legend.iter().filter_map(entry).collect()
}

/// Width of a legend without its gaps, and the number of gaps.
fn legend_mm(entries: &[LegendEntry]) -> (f64, usize) {
    (entries.iter().map(LegendEntry::width_mm).sum(), entries.len().saturating_sub(1))
}

/// The strip's arrangement on one size of sheet. From the bottom: the legend; the scale bar with
/// its words above; the titles to the right of the bar or, on a narrow sheet, above it.
struct Strip {
    /// Bottom-left corner of the area inside the margin.
    corner: DVec2,
    width_mm: f64,
    /// None where not even the shortest bar fits.
    bar_mm: Option<f64>,
    /// Empty where it does not fit.
    legend: Vec<LegendEntry>,
}

impl Strip {
    fn new(size_mm: DVec2, margin_mm: f64, legend: &[Layer]) -> Self {
        let width_mm = size_mm.x - 2.0 * margin_mm;
        let fits = |entries: &Vec<LegendEntry>| {
            let (entries_mm, gaps) = legend_mm(entries);
            entries_mm + GAP_MM * gaps as f64 <= width_mm
        };
        Self {
            corner: DVec2::splat(margin_mm),
            width_mm,
            bar_mm: BARS_MM.into_iter().find(|&bar_mm| bar_mm <= width_mm),
            legend: FORMS.map(|form| entries(legend, form)).into_iter().find(fits).unwrap_or_default(),
        }
    }

    /// Height of the bar above the corner.
    fn bar_base_mm(&self) -> f64 {
        if self.legend.is_empty() { 0.0 } else { LINE_MM }
    }

    /// Base line of the words above the bar.
    fn words_base_mm(&self) -> f64 {
        self.bar_base_mm() + TICKS_MM[0] + TICK_GAP_MM
    }

    /// Width left beside the bar.
    fn room_mm(&self) -> f64 {
        self.width_mm - self.bar_mm.map_or(0.0, |bar_mm| bar_mm + GAP_MM)
    }

    fn has_titles_beside(&self) -> bool {
        self.room_mm() >= MIN_TITLES_MM
    }

    fn top_mm(&self) -> f64 {
        let titles_mm = if self.has_titles_beside() { 0.0 } else { LINE_MM };
        self.words_base_mm() + titles_mm + CAP_MM
    }

    fn line(&self, from: [f64; 2], to: [f64; 2], like: Layer, styles: &LineStyles) -> Mark {
        let at = |p: [f64; 2]| self.corner + DVec2::from(p);
        Mark::line(Layer::Furniture, at(from), at(to), styles.stroke(like))
    }

    fn text(&self, content: String, at: [f64; 2], align: Align, styles: &LineStyles) -> Mark {
        let text = Text::new(content, self.corner + DVec2::from(at), CAP_MM).aligned(align);
        Mark::text(Layer::Furniture, text.coloured(styles.colour(Layer::Furniture)))
    }

    /// A piece of a line, of a tab, or of a place where a component is glued.
    fn sample(&self, entry: &LegendEntry, [x, y]: [f64; 2], styles: &LineStyles) -> Vec<Mark> {
        let (end, half) = (x + entry.sample_mm, TAB_SAMPLE_MM / 2.0);
        let area = |slope_mm: f64| {
            let corners =
                [[x, y - half], [end, y - half], [end - slope_mm, y + half], [x + slope_mm, y + half]];
            let corners = corners.map(|corner| self.corner + DVec2::from(corner));
            let area = Mark::area(entry.layer, &corners, styles)?;
            Some(Mark { layer: Layer::Furniture, ..area })
        };
        let look = styles.stroke(entry.layer).clone();
        let stroke = Stroke { colour: styles.colour(Layer::Furniture), ..look };
        let [from, to] = [[x, y], [end, y]].map(|p| self.corner + DVec2::from(p));
        let line = Mark::line(Layer::Furniture, from, to, &stroke);
        match entry.layer {
            Layer::Tab => area(half).into_iter().collect(),
            Layer::Glue => {
                area(0.0).into_iter().chain([line, self.key_sample(entry, [x, y], styles)]).collect()
            }
            _ => vec![line],
        }
    }

    /// The triangle that shows which way round a component is glued on, above the line of the sample.
    fn key_sample(&self, entry: &LegendEntry, [x, y]: [f64; 2], styles: &LineStyles) -> Mark {
        let half = TAB_SAMPLE_MM / 2.0;
        let middle = x + entry.sample_mm / 2.0;
        let corners = [[middle - half, y - half], [middle + half, y - half], [middle, y + half]];
        let corners = corners.map(|corner| self.corner + DVec2::from(corner)).to_vec();
        Mark::filled(Layer::Furniture, corners, styles.colour(Layer::Furniture))
    }

    /// The bar between the middles of its end ticks, a tick at every centimetre, and its words.
    fn scale_bar(&self, styles: &LineStyles) -> Vec<Mark> {
        let Some(bar_mm) = self.bar_mm else {
            return Vec::new();
        };
        let y = self.bar_base_mm();
        let mut marks = vec![self.line([0.0, y], [bar_mm, y], Layer::Furniture, styles)];
        let last = (bar_mm / 10.0).round() as usize;
        for tick in 0..=last {
            let height_mm = match tick {
                _ if tick == 0 || tick == last => TICKS_MM[0],
                _ if 2 * tick == last => TICKS_MM[1],
                _ => TICKS_MM[2],
            };
            let x = 10.0 * tick as f64;
            marks.push(self.line([x, y], [x, y + height_mm], Layer::Furniture, styles));
        }
        let room_mm = if self.has_titles_beside() { bar_mm } else { self.width_mm };
        let words = ["mm: print at 100 % (actual size)", "mm: print at 100 %", "mm"];
        let words = words.map(|words| format!("{bar_mm} {words}"));
        if let Some(words) = words.into_iter().find(|w| width_mm(w, CAP_MM) <= room_mm) {
            marks.push(self.text(words, [0.0, self.words_base_mm()], Align::Start, styles));
        }
        marks
    }

    /// Name and note above the page number beside the bar, or all on a line above the bar.
    fn titles(&self, furniture: &Furniture, styles: &LineStyles) -> [Mark; 2] {
        let page = shortened(furniture.number, CAP_MM, self.width_mm);
        let (room_mm, title_base_mm, page_base_mm) = if self.has_titles_beside() {
            (self.room_mm(), self.words_base_mm(), self.bar_base_mm())
        } else {
            let base_mm = self.words_base_mm() + LINE_MM;
            (self.width_mm - width_mm(&page, CAP_MM) - GAP_MM, base_mm, base_mm)
        };
        let full = format!("{} · {}", furniture.title, furniture.note);
        let title = if !furniture.note.is_empty() && width_mm(&full, CAP_MM) <= room_mm {
            full
        } else {
            shortened(furniture.title, CAP_MM, room_mm)
        };
        let (title_x, title_align) =
            if self.has_titles_beside() { (self.width_mm, Align::End) } else { (0.0, Align::Start) };
        [
            self.text(title, [title_x, title_base_mm], title_align, styles),
            self.text(page, [self.width_mm, page_base_mm], Align::End, styles),
        ]
    }

    /// Each kind of line with its word, spread over the width but not too far apart. Samples have the colour
    /// of all that belongs to the page, since a laser cuts by colours; nothing where they would then look
    /// the same.
    fn legend_marks(&self, styles: &LineStyles) -> Vec<Mark> {
        let look = |layer: Layer| (styles.stroke(layer).width_mm, &styles.stroke(layer).dash_mm);
        let folds = self.legend.iter().map(|entry| entry.layer).filter(|layer| layer.is_worked());
        let are_distinct = folds.clone().any(|layer| look(layer) != look(Layer::Cut));
        if !are_distinct {
            return Vec::new();
        }
        // A tab without a fill has no look of its own.
        let is_seen =
            |entry: &LegendEntry| entry.layer != Layer::Tab || styles.fill(Layer::Tab) != Fill::Plain;
        let (entries_mm, gaps) = legend_mm(&self.legend);
        let gap_mm = ((self.width_mm - entries_mm) / gaps.max(1) as f64).min(MAX_GAP_MM);
        let mut x = 0.0;
        let mut marks = Vec::with_capacity(2 * self.legend.len());
        for entry in self.legend.iter().filter(|entry| is_seen(entry)) {
            let y = CAP_MM / 2.0;
            marks.extend(self.sample(entry, [x, y], styles));
            let word = [x + entry.sample_mm + WORD_GAP_MM, 0.0];
            marks.push(self.text(entry.word.to_owned(), word, Align::Start, styles));
            x += entry.width_mm() + gap_mm;
        }
        marks
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_draw::drawing::Shape;

    const LEGEND: [Layer; 5] = [Layer::Cut, Layer::Slit, Layer::Mountain, Layer::FoldHinge, Layer::Glue];
    const SHEETS: [[f64; 2]; 6] =
        [[210.0, 297.0], [215.9, 279.4], [297.0, 210.0], [148.0, 210.0], [100.0, 150.0], [50.0, 50.0]];

    fn strip_on(size_mm: DVec2, margin_mm: f64, title: &str) -> Vec<Mark> {
        let furniture = Furniture {
            size_mm,
            margin_mm,
            title,
            note: "200 mm",
            number: "sheet 12 of 34",
            legend: &LEGEND,
        };
        furniture.marks(&LineStyles::standard())
    }

    /// What stands on the only sheet of a model.
    fn only_sheet<'a>(size_mm: DVec2, legend: &'a [Layer]) -> Furniture<'a> {
        Furniture { size_mm, margin_mm: 10.0, title: "a", note: "", number: "sheet 1 of 1", legend }
    }

    fn texts(marks: &[Mark]) -> Vec<String> {
        let content = |mark: &Mark| match &mark.shape {
            Shape::Text(text) => Some(text.content.clone()),
            Shape::Path { .. } | Shape::Image(_) => None,
        };
        marks.iter().filter_map(content).collect()
    }

    #[test]
    fn everything_stays_inside_the_margin_and_the_declared_height() {
        for size in SHEETS.map(DVec2::from) {
            let top_mm = 10.0 + height_mm(size, 10.0, &LEGEND) - CLEARANCE_MM;
            for mark in strip_on(size, 10.0, "a model with quite a long name, to be shortened") {
                let Some((lo, hi)) = mark.bounds() else {
                    continue;
                };
                // Descenders and overshoots of letters reach below the base line.
                assert!(lo.x >= 10.0 - 1e-9 && lo.y >= 10.0 - 0.3 * CAP_MM, "{size} {mark:?}");
                assert!(hi.x <= size.x - 10.0 + 1e-9 && hi.y <= top_mm + 0.15 * CAP_MM, "{size} {mark:?}");
            }
        }
    }

    #[test]
    fn the_bar_is_exactly_100_mm_where_it_fits() {
        for size in [DVec2::new(210.0, 297.0), DVec2::new(120.0, 120.0)] {
            let marks = strip_on(size, 10.0, "teddy");
            let Shape::Path { contours, .. } = &marks[0].shape else { panic!("not a line") };
            let [a, b] = contours[0].points[..] else { panic!("not a segment") };
            assert!((b - a - DVec2::new(100.0, 0.0)).length() < 1e-12);
            assert!(texts(&marks).contains(&"100 mm: print at 100 % (actual size)".to_owned()));
        }
    }

    #[test]
    fn texts_do_not_overlap() {
        for size in SHEETS.map(DVec2::from) {
            let marks = strip_on(size, 10.0, "a model with quite a long name, to be shortened");
            let boxes = marks.iter().filter_map(|m| match m.shape {
                Shape::Text(_) => m.bounds(),
                Shape::Path { .. } | Shape::Image(_) => None,
            });
            let boxes = boxes.collect::<Vec<_>>();
            for (i, a) in boxes.iter().enumerate() {
                for b in &boxes[i + 1..] {
                    let apart = a.1.cmplt(b.0) | b.1.cmplt(a.0);
                    assert!(apart.any(), "{size}: {a:?} {b:?}");
                }
            }
        }
    }

    /// A laser cuts what has the colours of cuts and creases, wherever it stands on the page.
    #[test]
    fn nothing_in_the_strip_has_a_colour_that_cuts() {
        let styles = LineStyles::built_in("laser").unwrap();
        let worked =
            Layer::ALL.into_iter().filter(|layer| layer.is_worked()).map(|layer| styles.colour(layer));
        let worked: Vec<_> = worked.collect();
        let furniture = only_sheet(DVec2::new(210.0, 297.0), &LEGEND);
        let marks = furniture.marks(&styles).into_iter().chain(furniture.side_bar(&styles));
        for mark in marks {
            match mark.shape {
                Shape::Path { stroke: Some(stroke), .. } => assert!(!worked.contains(&stroke.colour)),
                Shape::Text(text) => assert!(!worked.contains(&text.colour) && text.content != "cut"),
                Shape::Path { .. } | Shape::Image(_) => {}
            }
        }
    }

    /// The sample of a tab without a fill was a blank beside its word.
    #[test]
    fn a_tab_without_a_fill_is_not_in_the_legend() {
        let words = |styles: &LineStyles| {
            let furniture = only_sheet(DVec2::new(210.0, 297.0), &[Layer::Cut, Layer::Mountain, Layer::Tab]);
            texts(&furniture.marks(styles)).contains(&"tab".to_owned())
        };
        let styles = LineStyles::standard();
        assert!(words(&styles) && !words(&styles.with_plain(Layer::Tab)));
    }

    /// With valleys, whose plugs have feet, A4 said "mountain" and "valley", which a beginner does not know.
    #[test]
    fn seven_kinds_of_lines_have_full_words_on_a4() {
        let legend = [
            Layer::Cut,
            Layer::Slit,
            Layer::Mountain,
            Layer::Valley,
            Layer::FoldHinge,
            Layer::Tab,
            Layer::Glue,
        ];
        let furniture = only_sheet(DVec2::new(210.0, 297.0), &legend);
        let texts = texts(&furniture.marks(&LineStyles::standard()));
        for words in ["fold back (mountain)", "fold up (valley)", "fold flat 180°", "glue here"] {
            assert!(texts.iter().any(|text| text == words), "{words}: {texts:?}");
        }
    }

    /// Nobody knew what the black triangle in each place for glue was for.
    #[test]
    fn the_legend_explains_the_triangles_on_a4_and_letter() {
        let legend = [Layer::Cut, Layer::Slit, Layer::Mountain, Layer::FoldHinge, Layer::Tab, Layer::Glue];
        for size_mm in [DVec2::new(210.0, 297.0), DVec2::new(215.9, 279.4)] {
            let marks = only_sheet(size_mm, &legend).marks(&LineStyles::standard());
            let texts = texts(&marks);
            assert!(texts.iter().any(|text| text == "glue here, triangles meet"), "{texts:?}");
            let is_triangle = |mark: &Mark| match &mark.shape {
                Shape::Path { contours, fill: Some(_), .. } => contours[0].points.len() == 3,
                Shape::Path { .. } | Shape::Text(_) | Shape::Image(_) => false,
            };
            assert_eq!(marks.iter().filter(|mark| is_triangle(mark)).count(), 1);
        }
    }

    #[test]
    fn a_tiny_sheet_drops_the_legend_and_keeps_a_bar() {
        let on_a4 = texts(&strip_on(DVec2::new(210.0, 297.0), 10.0, "teddy"));
        assert!(on_a4.contains(&"fold back (mountain)".to_owned()));
        assert!(on_a4.contains(&"teddy · 200 mm".to_owned()));
        let tiny = texts(&strip_on(DVec2::new(100.0, 150.0), 10.0, "teddy"));
        assert!(!tiny.iter().any(|t| t.contains("mountain")));
        assert!(tiny.iter().any(|t| t.starts_with("50 mm: print")), "{tiny:?}");
        assert!(tiny.contains(&"sheet 12 of 34".to_owned()));
    }
}
