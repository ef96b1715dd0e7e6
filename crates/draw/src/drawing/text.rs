//! The fonts: metrics and outlines of letters.
//!
//! They are subsets of Inter (Latin letters, digits, a few signs) and, for what that lacks, of Noto Sans JP,
//! embedded in the program; see `font/README.md`. Every back end draws text without kerning, so that all files agree.

use super::{Polyline, Text};
use glam::{DAffine2, DVec2};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;
use ttf_parser::{Face, OutlineBuilder};

/// A font that is embedded in the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Font {
    /// Its PostScript name.
    pub name: &'static str,
    /// Its file, for formats that embed it.
    pub file: &'static [u8],
}

/// The fonts; a character is of the first that has it. Static, because each use of a constant may have its own copy.
pub static FONTS: [Font; 2] = [
    Font { name: "Inter-Regular", file: include_bytes!("font/inter-subset.ttf") },
    Font { name: "NotoSansJP-Regular", file: include_bytes!("font/noto-sans-jp-subset.ttf") },
];
/// Family names of the fonts, as CSS has them.
pub const FONT_FAMILIES: &str = "Inter, Noto Sans JP";

/// What stands for a character that the font lacks.
const REPLACEMENT: char = '?';
/// From here on, letters are written without spaces between words: a line may end after any of them.
const WIDE: char = '\u{3000}';
/// Signs that no line begins with, and that no line ends with.
const CLOSING: &str = "、。」）／：ーゃゅょっャュョッ";
const OPENING: &str = "「（";

/// Letters that reach below the base line, and how far, as a share of a capital's height.
const DESCENDING: &str = "gjpqy,;()/Q_";
const DESCENT: f64 = 0.3;

/// A step of an outline, in page coordinates (mm).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PathCommand {
    /// Begins a contour.
    MoveTo(DVec2),
    /// Straight line.
    LineTo(DVec2),
    /// Quadratic Bézier curve: control point, end.
    QuadTo(DVec2, DVec2),
    /// Cubic Bézier curve: two control points, end.
    CubicTo(DVec2, DVec2, DVec2),
    /// Closes the contour.
    Close,
}

impl PathCommand {
    /// Control points and end.
    pub fn points(&self) -> Vec<DVec2> {
        match *self {
            Self::MoveTo(p) | Self::LineTo(p) => vec![p],
            Self::QuadTo(a, p) => vec![a, p],
            Self::CubicTo(a, b, p) => vec![a, b, p],
            Self::Close => Vec::new(),
        }
    }

    fn transformed(&self, map: &DAffine2) -> Self {
        let at = |p: DVec2| map.transform_point2(p);
        match *self {
            Self::MoveTo(p) => Self::MoveTo(at(p)),
            Self::LineTo(p) => Self::LineTo(at(p)),
            Self::QuadTo(a, p) => Self::QuadTo(at(a), at(p)),
            Self::CubicTo(a, b, p) => Self::CubicTo(at(a), at(b), at(p)),
            Self::Close => Self::Close,
        }
    }
}

/// One glyph, in units of the em.
struct Glyph {
    /// Index among the fonts.
    font: usize,
    advance: f64,
    outline: Vec<PathCommand>,
}

/// The fonts, decoded once.
struct Typeface {
    cap_height: f64,
    glyphs: BTreeMap<char, Glyph>,
}

static TYPEFACE: LazyLock<Typeface> = LazyLock::new(Typeface::embedded);

impl Typeface {
    /// Decodes the embedded fonts. They are part of the program, so a fault in them is a fault of the
    /// build, which a test catches.
    fn embedded() -> Self {
        let faces = FONTS.map(|font| Face::parse(font.file, 0).expect("the embedded fonts can be read"));
        let mut glyphs = BTreeMap::new();
        for (font, face) in faces.iter().enumerate() {
            for c in characters(face) {
                if let Some(glyph) = glyph(face, font, c) {
                    glyphs.entry(c).or_insert(glyph);
                }
            }
        }
        let cap_height = faces[0].capital_height().expect("the first font has capitals");
        Self { cap_height: f64::from(cap_height) / f64::from(faces[0].units_per_em()), glyphs }
    }

    fn glyph(&self, c: char) -> &Glyph {
        &self.glyphs[&self.available(c)]
    }

    fn available(&self, c: char) -> char {
        match c {
            _ if self.glyphs.contains_key(&c) => c,
            _ if c.is_whitespace() => ' ',
            _ => REPLACEMENT,
        }
    }
}

/// All characters of a font that can be seen, and the space.
fn characters(face: &Face<'_>) -> BTreeSet<char> {
    let mut found = BTreeSet::new();
    for subtable in face.tables().cmap.iter().flat_map(|cmap| cmap.subtables) {
        if subtable.is_unicode() {
            subtable.codepoints(|point| found.extend(char::from_u32(point).filter(|c| !c.is_control())));
        }
    }
    found
}

fn glyph(face: &Face<'_>, font: usize, c: char) -> Option<Glyph> {
    let em = f64::from(face.units_per_em());
    let id = face.glyph_index(c)?;
    let mut pen = Pen { em, outline: Vec::new() };
    // Spaces have none.
    let _ = face.outline_glyph(id, &mut pen);
    let advance = f64::from(face.glyph_hor_advance(id)?) / em;
    Some(Glyph { font, advance, outline: pen.outline })
}

/// Collects an outline in units of the em.
struct Pen {
    em: f64,
    outline: Vec<PathCommand>,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> DVec2 {
        DVec2::new(f64::from(x), f64::from(y)) / self.em
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.outline.push(PathCommand::MoveTo(self.at(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.outline.push(PathCommand::LineTo(self.at(x, y)));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.outline.push(PathCommand::QuadTo(self.at(cx, cy), self.at(x, y)));
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        self.outline.push(PathCommand::CubicTo(self.at(ax, ay), self.at(bx, by), self.at(x, y)));
    }

    fn close(&mut self) {
        self.outline.push(PathCommand::Close);
    }
}

/// Whether a character steers what shows a text, instead of being shown: control characters, line
/// separators, and those that turn the direction of writing (Unicode UAX #9).
pub fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// JSON, or a quoted text of TOML, with an escape for each character that steers: both have `\u` and four digits.
pub fn with_escapes(written: &str) -> String {
    let escaped = |c: char| match c {
        c if steers(c) && c != '\n' => format!("\\u{:04x}", u32::from(c)),
        c => c.to_string(),
    };
    written.chars().map(escaped).collect()
}

/// The text as it will be seen: characters that the font lacks become `?`, any white space a
/// space.
pub fn as_seen(content: &str) -> String {
    content.chars().map(|c| TYPEFACE.available(c)).collect()
}

/// The text as it will be seen, in pieces of one font: its index, and the letters.
pub fn runs(content: &str) -> Vec<(usize, String)> {
    let seen: Vec<char> = content.chars().map(|c| TYPEFACE.available(c)).collect();
    let font = |c: &char| TYPEFACE.glyph(*c).font;
    seen.chunk_by(|a, b| font(a) == font(b)).map(|run| (font(&run[0]), run.iter().collect())).collect()
}

/// Size of the em, mm, at which capitals are `cap_height_mm` high: what other programs call the
/// font size.
pub fn em_mm(cap_height_mm: f64) -> f64 {
    cap_height_mm / TYPEFACE.cap_height
}

/// Length of a line of text, mm.
pub fn width_mm(content: &str, cap_height_mm: f64) -> f64 {
    content.chars().map(|c| TYPEFACE.glyph(c).advance).sum::<f64>() * em_mm(cap_height_mm)
}

/// How far a line of text reaches below its base line, mm.
pub fn depth_mm(content: &str, cap_height_mm: f64) -> f64 {
    if content.contains(|c: char| DESCENDING.contains(c) || c >= WIDE) {
        DESCENT * cap_height_mm
    } else {
        0.0
    }
}

/// The text, or as much of its beginning as fits in `max_width_mm`, with an ellipsis; empty where
/// not even that fits.
pub fn shortened(content: &str, cap_height_mm: f64, max_width_mm: f64) -> String {
    if width_mm(content, cap_height_mm) <= max_width_mm {
        return content.to_owned();
    }
    let ends = content.char_indices().map(|(at, _)| at).rev();
    ends.map(|end| format!("{}…", content[..end].trim_end()))
        .find(|short| width_mm(short, cap_height_mm) <= max_width_mm)
        .unwrap_or_default()
}

/// Text in lines of at most a width; a longer word is shortened.
pub fn wrapped(words: &str, cap_height_mm: f64, max_width_mm: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split_whitespace() {
        for (k, part) in unbroken(word).iter().enumerate() {
            let part = shortened(part, cap_height_mm, max_width_mm);
            let space = if k == 0 { " " } else { "" };
            match lines.last_mut() {
                Some(line) if width_mm(&format!("{line}{space}{part}"), cap_height_mm) <= max_width_mm => {
                    line.push_str(space);
                    line.push_str(&part);
                }
                _ => lines.push(part),
            }
        }
    }
    lines
}

/// The parts of a word that stay on one line: the whole of it, or its wide letters with the signs that belong
/// to them.
fn unbroken(word: &str) -> Vec<String> {
    let letters: Vec<char> = word.chars().collect();
    let stays = |a: &char, b: &char| OPENING.contains(*a) || CLOSING.contains(*b) || (*a < WIDE && *b < WIDE);
    letters.chunk_by(stays).map(|part| part.iter().collect()).collect()
}

/// Outlines of the letters at their place on the page, to be filled by the non-zero rule.
pub fn outlines(text: &Text) -> Vec<PathCommand> {
    let em = em_mm(text.cap_height_mm);
    let mut pen = text.start();
    let along = DVec2::from_angle(text.angle_rad);
    let mut out = Vec::new();
    for c in text.content.chars() {
        let glyph = TYPEFACE.glyph(c);
        let map = DAffine2::from_scale_angle_translation(DVec2::splat(em), text.angle_rad, pen);
        out.extend(glyph.outline.iter().map(|command| command.transformed(&map)));
        pen += along * (glyph.advance * em);
    }
    out
}

/// The outlines as closed polylines, each curve in the given number of straight steps: for
/// machines that know no curves.
pub fn contours(text: &Text, steps: usize) -> Vec<Polyline> {
    let mut out: Vec<Polyline> = Vec::new();
    for command in outlines(text) {
        match (command, out.last_mut()) {
            (PathCommand::MoveTo(p), _) => out.push(Polyline::closed(vec![p])),
            (PathCommand::Close, _) | (_, None) => {}
            (curve, Some(contour)) => {
                let mut points = curve.points();
                points.insert(0, contour.points[contour.points.len() - 1]);
                let count = if points.len() == 2 { 1 } else { steps.max(1) };
                let at = |step: usize| on_curve(&points, step as f64 / count as f64);
                contour.points.extend((1..=count).map(at));
            }
        }
    }
    for contour in &mut out {
        let ends_at_start = contour.points.len() > 1 && contour.points.first() == contour.points.last();
        if ends_at_start {
            contour.points.pop();
        }
    }
    out
}

/// The point at `t` of the Bézier curve with these control points (de Casteljau).
fn on_curve(control: &[DVec2], t: f64) -> DVec2 {
    let mut points = control.to_vec();
    while points.len() > 1 {
        points = points.windows(2).map(|pair| pair[0].lerp(pair[1], t)).collect();
    }
    points[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_core::geom::polygon;

    fn bounds(text: &Text) -> (DVec2, DVec2) {
        let points = outlines(text).iter().flat_map(PathCommand::points).collect::<Vec<_>>();
        polygon::bounds(points).expect("letters have outlines")
    }

    #[test]
    fn what_steers_becomes_an_escape() {
        assert_eq!(with_escapes("{\n  \"a\u{202e}é\u{9b}\"\n}"), "{\n  \"a\\u202eé\\u009b\"\n}");
    }

    #[test]
    fn the_font_has_what_labels_and_titles_need() {
        for c in (' '..='~').chain("äöüßéèñçåøÅčśžő°×–—µ·→←±²½…−".chars()) {
            assert!(TYPEFACE.glyphs.contains_key(&c), "{c:?} is missing");
        }
        assert!(FONTS[0].file.len() <= 60_000);
        // All kana, so that names in them can be read, and the letters of the guide.
        assert!(('ぁ'..='ゖ').chain('ァ'..='ヺ').all(|c| TYPEFACE.glyphs[&c].font == 1));
        assert!(FONTS[1].file.len() <= 80_000);
    }

    #[test]
    fn letters_of_two_fonts_are_in_runs() {
        assert_eq!(
            runs("のりしろ A1 の裏"),
            [(1, "のりしろ"), (0, " A1 "), (1, "の裏")].map(|(font, run)| (font, run.to_owned()))
        );
        let (lo, hi) = bounds(&Text::new("差の", DVec2::ZERO, 3.0));
        // A wide letter is as high as the em.
        assert!(hi.y > 2.5 && hi.y < em_mm(3.0) && lo.y > -depth_mm("の", 3.0), "{lo} {hi}");
    }

    /// Japanese has no spaces: a sentence was one word, which was cut off at the end of the line.
    #[test]
    fn lines_of_wide_letters_break_anywhere_but_before_their_signs() {
        let sentence = "のりしろを辺 A1 の裏に差し込み、「辺」と折り線をぴったり合わせます。";
        for width_mm in (12..60).map(f64::from) {
            let lines = wrapped(sentence, 2.0, width_mm);
            assert!(lines.iter().all(|line| super::width_mm(line, 2.0) <= width_mm));
            let letters = |text: &str| text.replace(' ', "");
            assert_eq!(letters(&lines.concat()), letters(sentence), "nothing is lost");
            assert!(lines.iter().all(|line| !line.starts_with(['、', '。', '」', 'っ'])), "{lines:?}");
            assert!(lines.iter().all(|line| !line.ends_with('「')), "{lines:?}");
        }
        assert_eq!(wrapped("two words", 2.0, 100.0), ["two words"]);
    }

    #[test]
    fn capitals_are_as_high_as_asked() {
        let (lo, hi) = bounds(&Text::new("H", DVec2::new(20.0, 30.0), 3.0));
        assert!((lo.y - 30.0).abs() < 1e-9 && (hi.y - 33.0).abs() < 0.005, "{lo} {hi}");
    }

    #[test]
    fn width_is_the_sum_of_advances() {
        let one = width_mm("H", 3.0);
        assert!((width_mm("HHHH", 3.0) - 4.0 * one).abs() < 1e-12);
        assert!((width_mm("H", 6.0) - 2.0 * one).abs() < 1e-12);
        let (lo, hi) = bounds(&Text::new("HHHH", DVec2::ZERO, 3.0));
        assert!(lo.x > 0.0 && hi.x < 4.0 * one && hi.x > 3.5 * one);
    }

    #[test]
    fn missing_characters_are_seen_as_question_marks() {
        assert_eq!(as_seen("畳 head\t1\u{7}"), "? head 1?");
        assert_eq!(width_mm("畳", 2.0), width_mm("?", 2.0));
    }

    #[test]
    fn shortening_keeps_the_beginning() {
        let full = width_mm("armadillo", 2.0);
        assert_eq!(shortened("armadillo", 2.0, full), "armadillo");
        let short = shortened("armadillo", 2.0, full * 0.7);
        assert!(short.starts_with("arm") && short.ends_with('…'), "{short}");
        assert!(width_mm(&short, 2.0) <= full * 0.7);
        assert_eq!(shortened("armadillo", 2.0, 0.1), "");
    }

    #[test]
    fn flattened_letters_keep_their_area() {
        // An "o" is two rings; the ring between them is what is inked.
        let text = Text::new("o", DVec2::ZERO, 10.0);
        let area = |steps| {
            let rings = contours(&text, steps);
            assert_eq!(rings.len(), 2);
            rings.iter().map(|ring| polygon::area(&ring.points)).sum::<f64>().abs()
        };
        let (coarse, fine) = (area(4), area(64));
        assert!((coarse - fine).abs() < 0.02 * fine, "{coarse} {fine}");
        assert_eq!(contours(&Text::new("l", DVec2::ZERO, 10.0), 4)[0].points.len(), 4);
    }
}
