//! The guide as printed pages.

use super::content::{Guide, GuideError, ShownStep};
use super::language::fill;
use glam::{DAffine2, DVec2};
use tatamu_core::units::Paper;
use tatamu_draw::drawing::{
    Align, Chapter, Drawing, Layer, LineStyles, Mark, Pages, Rgb, Stroke, Text, text,
};

/// Border of the pages, mm.
const MARGIN_MM: f64 = 12.0;
/// Heights of capitals: the title, chapters, steps, texts, small print.
const TITLE_MM: f64 = 6.0;
const CHAPTER_MM: f64 = 4.4;
const STEP_MM: f64 = 3.2;
const TEXT_MM: f64 = 2.3;
const SMALL_MM: f64 = 1.9;
/// Distance of lines, against the height of capitals.
const LINE: f64 = 1.95;
/// Width of a step's column at least; its picture, and what is left of it for maps.
const COLUMN_MM: f64 = 86.0;
const GAP_MM: f64 = 8.0;
const PICTURE: f64 = 0.70;
const MAP: f64 = 0.85;
/// Height of the pictures on the first page at most.
const COVER_MM: f64 = 76.0;
/// Space below a step.
const BELOW_MM: f64 = 6.0;
/// A chapter begins where there is room for its first steps.
const CHAPTER_ROOM_MM: f64 = 92.0;
const SOFT: Rgb = Rgb(96, 96, 102);
const FRAME: Rgb = Rgb(205, 205, 210);

/// The pages, on the paper given.
///
/// # Errors
/// [`GuideError::Pages`]; no guide is known that brings it about.
pub fn leaflet(guide: &Guide, paper: Paper) -> Result<Pages, GuideError> {
    let mut book = Book::new(guide, paper);
    book.cover();
    book.parts();
    for chapter in &guide.chapters {
        book.chapter(&chapter.title);
        book.steps(chapter.entries.clone());
    }
    let heading = fill(&guide.words.page.heading, &[("title", &guide.title)]);
    let chapters = guide.chapters.iter().map(|chapter| {
        let title = chapter.title.clone();
        Chapter { name: title.clone(), pieces: vec![title] }
    });
    let chapters = chapters.collect();
    Ok(Pages::new(heading, book.finish(), LineStyles::standard())?.with_chapters(chapters))
}

/// Marks with a height, whose top is at y = 0, and free space below them, which a page need not have at its end.
struct Block {
    marks: Vec<Mark>,
    height_mm: f64,
    below_mm: f64,
}

impl Block {
    fn new() -> Self {
        Self { marks: Vec::new(), height_mm: 0.0, below_mm: 0.0 }
    }

    /// Lines of text below what is there.
    fn write(&mut self, words: &str, cap_mm: f64, width_mm: f64, left_mm: f64, colour: Rgb) {
        for line in text::wrapped(words, cap_mm, width_mm) {
            let anchor = DVec2::new(left_mm, -self.height_mm - cap_mm);
            let text = Text::new(line, anchor, cap_mm).coloured(colour);
            self.marks.push(Mark::text(Layer::Picture, text));
            self.height_mm += cap_mm * LINE;
        }
    }

    /// A picture whose upper left corner is at a place, in another size.
    fn draw(&mut self, drawing: &Drawing, factor: f64, at: DVec2) {
        let shift = at - DVec2::Y * (drawing.size_mm.y * factor);
        let place = DAffine2::from_translation(shift);
        self.marks.extend(drawing.marks.iter().map(|mark| mark.clone().scaled(factor).placed(place)));
    }
}

/// Pages while they are filled from top to bottom.
struct Book<'a> {
    guide: &'a Guide,
    size_mm: DVec2,
    pages: Vec<Drawing>,
    /// Height on the last page above which all is filled.
    y_mm: f64,
}

impl<'a> Book<'a> {
    fn new(guide: &'a Guide, paper: Paper) -> Self {
        let size_mm = DVec2::new(paper.width_mm(), paper.height_mm());
        Self { guide, size_mm, pages: Vec::new(), y_mm: 0.0 }
    }

    fn width_mm(&self) -> f64 {
        self.size_mm.x - 2.0 * MARGIN_MM
    }

    /// How many columns there are, and how far apart they begin.
    fn columns(&self) -> (usize, f64) {
        let room = self.width_mm() + GAP_MM;
        let columns = (room / (COLUMN_MM + GAP_MM)).floor().max(1.0) as usize;
        (columns, room / columns as f64)
    }

    fn new_page(&mut self) {
        self.pages.push(Drawing::new(self.guide.title.clone(), self.size_mm));
        self.y_mm = self.size_mm.y - MARGIN_MM;
    }

    /// Makes sure that there is room for a height.
    fn ensure(&mut self, height_mm: f64) {
        if self.pages.is_empty() || self.y_mm - height_mm < MARGIN_MM + SMALL_MM * 3.0 {
            self.new_page();
        }
    }

    /// Puts blocks side by side, with their left edges at these places.
    fn put(&mut self, blocks: Vec<(f64, Block)>) {
        let highest = |height: fn(&Block) -> f64| blocks.iter().map(|(_, b)| height(b)).fold(0.0, f64::max);
        let height_mm = highest(|block| block.height_mm + block.below_mm);
        self.ensure(highest(|block| block.height_mm));
        let y_mm = self.y_mm;
        if let Some(page) = self.pages.last_mut() {
            for (x_mm, block) in blocks {
                let place = DAffine2::from_translation(DVec2::new(MARGIN_MM + x_mm, y_mm));
                page.place(block.marks, place);
            }
        }
        self.y_mm -= height_mm;
    }

    fn heading(&mut self, words: &str, cap_mm: f64) {
        let mut block = Block::new();
        block.write(words, cap_mm, self.width_mm(), 0.0, Rgb::BLACK);
        block.marks = block.marks.into_iter().map(|mark| mark.of_piece(words)).collect();
        block.height_mm += cap_mm * 0.4;
        self.put(vec![(0.0, block)]);
    }

    /// The heading of a chapter, which needs room for a row of steps below it.
    fn chapter(&mut self, title: &str) {
        self.ensure(CHAPTER_ROOM_MM);
        if self.y_mm < self.size_mm.y - MARGIN_MM {
            let stroke = Stroke::solid(0.3, FRAME);
            let line = Mark::line(Layer::Picture, DVec2::ZERO, DVec2::X * self.width_mm(), &stroke);
            self.put(vec![(0.0, Block { marks: vec![line], height_mm: 5.0, below_mm: 0.0 })]);
        }
        self.heading(title, CHAPTER_MM);
    }

    fn cover(&mut self) {
        let (words, guide) = (&self.guide.words, self.guide);
        self.heading(&fill(&words.page.heading, &[("title", &guide.title)]), TITLE_MM);
        let column = (self.width_mm() - GAP_MM) / 2.0;
        // Both in one scale, as large as there is room, and on one ground.
        let ends = guide.frames.first().zip(guide.frames.last());
        let ends = ends.map(|(unfolded, flat)| [unfolded.trimmed(), flat.trimmed()]);
        if let Some([unfolded, flat]) = ends {
            let size_mm = unfolded.size_mm.max(flat.size_mm);
            let factor = (DVec2::new(column, COVER_MM) / size_mm).min_element();
            let picture = |drawing: &Drawing, caption: &str| {
                let mut block = Block::new();
                let air_mm = factor * (size_mm.y - drawing.size_mm.y);
                block.draw(drawing, factor, DVec2::NEG_Y * air_mm);
                block.height_mm = factor * size_mm.y + 3.0;
                block.write(caption, TEXT_MM, column, 0.0, SOFT);
                block.height_mm += 4.0;
                block
            };
            let unfolded = picture(&unfolded, &words.cover.deployed);
            self.put(vec![(0.0, unfolded), (column + GAP_MM, picture(&flat, &words.cover.flat))]);
        }
        for pair in guide.facts.chunks(2) {
            let fact = |(title, sentences): &(String, Vec<String>)| {
                let mut block = Block::new();
                block.write(title, STEP_MM, column, 0.0, Rgb::BLACK);
                for sentence in sentences {
                    block.write(sentence, TEXT_MM, column, 0.0, Rgb::BLACK);
                    block.height_mm += 0.8;
                }
                block.height_mm += 4.0;
                block
            };
            self.put(pair.iter().enumerate().map(|(k, f)| (k as f64 * (column + GAP_MM), fact(f))).collect());
        }
        self.clashes(column);
        self.heading(&words.lines.title, STEP_MM);
        for line in &guide.lines {
            let mut block = Block::new();
            block.height_mm = (line.sample.size_mm.y - TEXT_MM * LINE).max(0.0) / 2.0 + 0.6;
            block.write(&line.meaning, TEXT_MM, self.width_mm() - 26.0, 26.0, Rgb::BLACK);
            block.draw(&line.sample, 1.0, DVec2::ZERO);
            block.height_mm = block.height_mm.max(line.sample.size_mm.y);
            self.put(vec![(0.0, block)]);
        }
    }

    /// Where parts are in each other, two beside each other.
    fn clashes(&mut self, column_mm: f64) {
        let guide = self.guide;
        if guide.clashes.is_empty() {
            return;
        }
        self.heading(&guide.words.clash.title, STEP_MM);
        for pair in guide.clashes.chunks(2) {
            let block = |(sentence, picture): &(String, Drawing)| {
                let mut block = Block::new();
                block.draw(picture, PICTURE, DVec2::ZERO);
                block.height_mm = picture.size_mm.y * PICTURE + 1.0;
                block.write(sentence, TEXT_MM, column_mm, 0.0, Rgb::BLACK);
                block.height_mm += 4.0;
                block
            };
            let blocks =
                pair.iter().enumerate().map(|(k, clash)| (k as f64 * (column_mm + GAP_MM), block(clash)));
            self.put(blocks.collect());
        }
    }

    fn parts(&mut self) {
        let guide = self.guide;
        self.new_page();
        self.heading(&guide.words.cover.parts_title, CHAPTER_MM);
        let (columns, pitch) = self.columns();
        for row in guide.parts.chunks(columns) {
            let block = |part: &super::content::PartRow| {
                let mut block = Block::new();
                block.draw(&part.picture, 1.0, DVec2::ZERO);
                let left = part.picture.size_mm.x + 3.0;
                let room = pitch - GAP_MM - left;
                block.height_mm = 1.0;
                block.write(&part.name, STEP_MM, room, left, Rgb::BLACK);
                let pieces = format!("{}: {}", guide.words.cover.pieces, part.pieces);
                block.write(&pieces, TEXT_MM, room, left, Rgb::BLACK);
                block.write(&part.sheets, TEXT_MM, room, left, Rgb::BLACK);
                block.height_mm = block.height_mm.max(part.picture.size_mm.y) + 3.0;
                block
            };
            self.put(row.iter().enumerate().map(|(k, part)| (k as f64 * pitch, block(part))).collect());
        }
        self.y_mm -= GAP_MM;
    }

    fn steps(&mut self, range: std::ops::Range<usize>) {
        let (columns, pitch) = self.columns();
        let mut row: Vec<(f64, Block)> = Vec::new();
        let mut filled = 0;
        for k in range {
            let wanted = self.guide.entries[k].pictures.len().min(columns);
            if filled + wanted > columns {
                self.put(std::mem::take(&mut row));
                filled = 0;
            }
            let width_mm = wanted as f64 * pitch - GAP_MM;
            row.push((filled as f64 * pitch, self.step(k, width_mm)));
            filled += wanted;
        }
        self.put(row);
    }

    /// Number and title, pictures with maps beside them, texts.
    fn step(&self, k: usize, width_mm: f64) -> Block {
        let entry: &ShownStep = &self.guide.entries[k];
        let mut block = Block::new();
        block.write(&format!("{}  {}", k + 1, entry.title), STEP_MM, width_mm, 0.0, Rgb::BLACK);
        let top = DVec2::Y * -block.height_mm;
        let mut right = 0.0;
        let mut low: f64 = 0.0;
        for picture in &entry.pictures {
            let factor = PICTURE.min((width_mm - 2.0 * GAP_MM) / picture.size_mm.x);
            block.draw(picture, factor, top + DVec2::X * right);
            right += picture.size_mm.x * factor + 2.0;
            low = low.max(picture.size_mm.y * factor);
        }
        let mut at = DVec2::new(right, top.y);
        let part = &self.guide.parts[entry.step.part.0];
        for map in &part.maps {
            let size = map.size_mm * MAP;
            if at.y - size.y < top.y - low {
                at = DVec2::new(at.x + size.x + 1.5, top.y);
            }
            if at.x + size.x > width_mm + 0.1 {
                break;
            }
            block.draw(map, MAP, at);
            at.y -= size.y + 1.5;
        }
        block.height_mm += low + 2.0;
        for sentence in &entry.sentences {
            block.write(sentence, TEXT_MM, width_mm, 0.0, Rgb::BLACK);
            block.height_mm += 0.5;
        }
        block.below_mm = BELOW_MM;
        block
    }

    /// Adds the model's name and the page's number.
    fn finish(mut self) -> Vec<Drawing> {
        let count = self.pages.len();
        let name = text::shortened(&self.guide.title, SMALL_MM, self.width_mm() / 2.0);
        for (k, page) in self.pages.iter_mut().enumerate() {
            let values = [("page", (k + 1).to_string()), ("pages", count.to_string())];
            let values = values.each_ref().map(|(name, value)| (*name, value.as_str()));
            let number = fill(&self.guide.words.page.page, &values);
            let y_mm = MARGIN_MM - SMALL_MM;
            let left = Text::new(name.clone(), DVec2::new(MARGIN_MM, y_mm), SMALL_MM);
            let right = Text::new(number, DVec2::new(self.size_mm.x - MARGIN_MM, y_mm), SMALL_MM);
            let texts = [left, right.aligned(Align::End)];
            page.marks.extend(texts.map(|text| Mark::text(Layer::Picture, text.coloured(SOFT))));
        }
        self.pages
    }
}
