//! A font of single lines, for pens: each letter is a few polylines instead of an outline.
//!
//! The letters are those of the Hershey font "Roman Simplex" (see `strokes/README.md`), with a few
//! signs added.

use super::{Polyline, Text, text};
use crate::drawing::Align;
use glam::{DAffine2, DVec2};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// One glyph a line, from the space on, in the order of ASCII.
///
/// A line is a number (5 columns), the number of pairs (3 columns), then pairs of characters, each
/// of them a number by its distance from `R`: first the left and the right edge, then points (x
/// right, y down); ` R` lifts the pen.
const FONT_FILE: &str = include_str!("strokes/rowmans.jhf");

/// Column of the first pair.
const FIRST_PAIR: usize = 8;

/// Signs that the font lacks, and a hyphen that is shorter than its minus; as in the font.
const ADDED: [(char, &str); 7] = [
    ('-', "KYNRVR"),
    ('–', "H\\KRYR"),
    ('·', "MWRPQQRRSQRP"),
    ('°', "KYRFPGOIPKRLTKUITGRF"),
    ('×', "H\\LKXW RXKLW"),
    ('…', "H\\KYJZK[LZKY RRYQZR[SZRY RYYXZY[ZZYY"),
    ('→', "E_IR[R RVMZR[R RVWZR"),
];

/// Base line and capital height of the font, in its units.
const BASE_LINE: f64 = 9.0;
const CAP_HEIGHT: f64 = 21.0;

/// What stands for a character that the font lacks.
const REPLACEMENT: char = '?';

/// One glyph, in units of the capital height, y up from the base line.
#[derive(Debug, Clone, PartialEq, Default)]
struct Glyph {
    advance: f64,
    strokes: Vec<Vec<DVec2>>,
}

static GLYPHS: LazyLock<BTreeMap<char, Glyph>> = LazyLock::new(|| {
    let ascii = FONT_FILE.lines().zip(' '..='~').map(|(line, c)| (c, &line[FIRST_PAIR..]));
    ascii.chain(ADDED).map(|(c, pairs)| (c, Glyph::parse(pairs.as_bytes()))).collect()
});

impl Glyph {
    /// Reads the pairs of one glyph.
    fn parse(pairs: &[u8]) -> Self {
        let value = |byte: u8| f64::from(byte) - f64::from(b'R');
        let mut pairs = pairs.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
        let Some([left, right]) = pairs.next() else {
            return Self::default();
        };
        let points: Vec<[u8; 2]> = pairs.collect();
        let at = |&[x, y]: &[u8; 2]| DVec2::new(value(x) - value(left), BASE_LINE - value(y)) / CAP_HEIGHT;
        let stroke = |points: &[[u8; 2]]| points.iter().map(at).collect();
        let strokes = points.split(|pair| pair == b" R").map(stroke).collect();
        Self { advance: (value(right) - value(left)) / CAP_HEIGHT, strokes }
    }
}

fn glyph(c: char) -> &'static Glyph {
    let stand_in = if c.is_whitespace() { ' ' } else { REPLACEMENT };
    GLYPHS.get(&c).unwrap_or_else(|| &GLYPHS[&stand_in])
}

/// Width of a line of text, mm, at the font's own proportions.
pub fn width_mm(content: &str, cap_height_mm: f64) -> f64 {
    content.chars().map(|c| glyph(c).advance).sum::<f64>() * cap_height_mm
}

/// The strokes of a text at its place on the page, mm; open polylines, in writing order.
///
/// A text that is wider than the same one in the font of the page ([`text`]) is narrowed to that
/// width, so that it stays in the room that was found for it.
pub fn polylines(text: &Text) -> Vec<Polyline> {
    let full_mm = width_mm(&text.content, text.cap_height_mm);
    let width = full_mm.min(text::width_mm(&text.content, text.cap_height_mm));
    let narrowing = if full_mm > 0.0 { width / full_mm } else { 1.0 };
    let share = match text.align {
        Align::Start => 0.0,
        Align::Middle => 0.5,
        Align::End => 1.0,
    };
    let size = text.cap_height_mm * DVec2::new(narrowing, 1.0);
    let to_page = DAffine2::from_scale_angle_translation(size, text.angle_rad, text.anchor)
        * DAffine2::from_translation(DVec2::X * (-share * width / size.x));
    let mut pen = 0.0;
    let mut strokes = Vec::new();
    for glyph in text.content.chars().map(glyph) {
        let at = |p: &DVec2| to_page.transform_point2(*p + DVec2::X * pen);
        strokes.extend(glyph.strokes.iter().map(|s| Polyline::open(s.iter().map(at).collect())));
        pen += glyph.advance;
    }
    strokes.retain(|stroke| stroke.points.len() > 1);
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_core::geom::polygon;

    fn bounds(text: &Text) -> (DVec2, DVec2) {
        let strokes = polylines(text);
        polygon::bounds(strokes.iter().flat_map(|s| s.points.iter().copied())).expect("has strokes")
    }

    #[test]
    fn every_sign_of_ascii_has_strokes() {
        assert_eq!(FONT_FILE.lines().count(), 96);
        for line in FONT_FILE.lines() {
            let pairs: usize = line[5..FIRST_PAIR].trim().parse().unwrap();
            assert_eq!(line.len(), FIRST_PAIR + 2 * pairs, "{line}");
        }
        for c in ('!'..='~').chain(ADDED.map(|(c, _)| c)) {
            assert!(!polylines(&Text::new(c, DVec2::ZERO, 2.0)).is_empty(), "{c}");
            assert!(c == REPLACEMENT || glyph(c) != glyph(REPLACEMENT), "{c}");
        }
        assert_eq!(glyph('漢'), glyph(REPLACEMENT));
        assert_eq!(glyph('\u{a0}'), glyph(' '));
    }

    #[test]
    fn capitals_stand_on_the_base_line_at_their_height() {
        for c in 'A'..='Z' {
            let (lo, hi) = bounds(&Text::new(c, DVec2::new(10.0, 20.0), 3.5));
            let tail = if c == 'Q' { 0.5 } else { 1e-9 };
            assert!((lo.y - 20.0).abs() <= tail && (hi.y - 23.5).abs() < 1e-9, "{c}: {lo} {hi}");
            assert!(lo.x > 9.9 && hi.x < 10.0 + width_mm(&c.to_string(), 3.5), "{c}");
        }
    }

    #[test]
    fn strokes_keep_to_the_width_of_the_printed_text() {
        for content in ["A12", "part-2", "fold flat 180°", "WWW", "iii", "teddy · 200 mm"] {
            for align in [Align::Start, Align::Middle, Align::End] {
                let printed = Text::new(content, DVec2::new(50.0, 10.0), 2.0).aligned(align);
                let left = printed.start().x;
                let right = left + text::width_mm(content, 2.0);
                let (lo, hi) = bounds(&printed);
                assert!(lo.x > left - 1e-9 && hi.x < right + 1e-9, "{content} {align:?}: {lo} {hi}");
            }
        }
    }

    #[test]
    fn a_turned_text_turns_about_its_anchor() {
        let text = Text::new("L", DVec2::new(5.0, 5.0), 4.0).turned(std::f64::consts::FRAC_PI_2);
        let (lo, hi) = bounds(&text);
        assert!((hi.x - 5.0).abs() < 1e-9 && (lo.x - 1.0).abs() < 1e-9, "{lo} {hi}");
        assert!(lo.y > 5.0 && hi.y < 9.0);
    }
}
