//! The table of line styles, read from a style file.

use super::{Layer, Rgb, Stroke};
use serde::Deserialize;

/// Widest line that a style file may ask for.
const MAX_WIDTH_MM: f64 = 5.0;
/// Longest dash or gap that a style file may ask for.
const MAX_DASH_MM: f64 = 100.0;

/// A style file that cannot be used. The message shows the line of the mistake.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the style file cannot be used: {0}")]
pub struct StyleError(#[from] toml::de::Error);

/// How the lines of each layer look.
///
/// # Guarantees
/// Widths are above 0 and at most 5 mm; dashes are above 0, at most 100 mm, and even in number.
#[derive(Debug, Clone, PartialEq)]
pub struct LineStyles {
    strokes: [Stroke; Layer::ALL.len()],
}

impl LineStyles {
    /// The style file that comes with the program: black and white, for printed sheets.
    pub fn standard() -> Self {
        Self::parse(include_str!("../../profiles/papers/standard.toml"))
            .expect("the built-in style file is valid, which a test checks")
    }

    /// Reads a style file: one table for each [`Layer`], by its name.
    ///
    /// # Errors
    /// Text that is not TOML, a missing or unknown table or key, a value out of range.
    pub fn parse(toml: &str) -> Result<Self, StyleError> {
        let file: StyleFile = toml::from_str(toml)?;
        let strokes = Layer::ALL.map(|layer| file.table(layer).stroke());
        Ok(Self { strokes })
    }

    /// The look of a layer's lines.
    pub fn stroke(&self, layer: Layer) -> &Stroke {
        &self.strokes[layer as usize]
    }

    /// The colour of a layer's lines, and of its texts.
    pub fn colour(&self, layer: Layer) -> Rgb {
        self.stroke(layer).colour
    }
}

impl Default for LineStyles {
    fn default() -> Self {
        Self::standard()
    }
}

/// The style file as it is written.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
struct StyleFile {
    cut: StyleTable,
    slit: StyleTable,
    mountain: StyleTable,
    valley: StyleTable,
    fold_hinge: StyleTable,
    glue: StyleTable,
    label: StyleTable,
    furniture: StyleTable,
    registration: StyleTable,
    picture: StyleTable,
}

impl StyleFile {
    fn table(&self, layer: Layer) -> &StyleTable {
        match layer {
            Layer::Cut => &self.cut,
            Layer::Slit => &self.slit,
            Layer::Mountain => &self.mountain,
            Layer::Valley => &self.valley,
            Layer::FoldHinge => &self.fold_hinge,
            Layer::Glue => &self.glue,
            Layer::Label => &self.label,
            Layer::Furniture => &self.furniture,
            Layer::Registration => &self.registration,
            Layer::Picture => &self.picture,
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StyleTable {
    width_mm: Width,
    colour: Colour,
    dash_mm: Dash,
}

impl StyleTable {
    fn stroke(&self) -> Stroke {
        Stroke { width_mm: self.width_mm.0, colour: self.colour.0, dash_mm: self.dash_mm.0.clone() }
    }
}

/// Checked while it is read, so that the message shows the line.
#[derive(Deserialize)]
#[serde(try_from = "f64")]
struct Width(f64);

impl TryFrom<f64> for Width {
    type Error = String;

    fn try_from(mm: f64) -> Result<Self, String> {
        if mm > 0.0 && mm <= MAX_WIDTH_MM {
            Ok(Self(mm))
        } else {
            Err(format!("a line is {mm} mm wide; give a width above 0 and at most {MAX_WIDTH_MM} mm"))
        }
    }
}

#[derive(Deserialize)]
#[serde(try_from = "String")]
struct Colour(Rgb);

impl TryFrom<String> for Colour {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let digits =
            text.strip_prefix('#').filter(|d| d.len() == 6 && d.chars().all(|c| c.is_ascii_hexdigit()));
        let value = digits.and_then(|d| u32::from_str_radix(d, 16).ok());
        let Some(value) = value else {
            return Err(format!("{text:?} is not a colour; write it as \"#rrggbb\""));
        };
        let [_, red, green, blue] = value.to_be_bytes();
        Ok(Self(Rgb(red, green, blue)))
    }
}

#[derive(Deserialize)]
#[serde(try_from = "Vec<f64>")]
struct Dash(Vec<f64>);

impl TryFrom<Vec<f64>> for Dash {
    type Error = String;

    fn try_from(lengths: Vec<f64>) -> Result<Self, String> {
        if lengths.len() % 2 == 1 {
            return Err(format!("{} lengths; a dash needs its gap, so give an even number", lengths.len()));
        }
        match lengths.iter().find(|mm| !(**mm > 0.0 && **mm <= MAX_DASH_MM)) {
            Some(mm) => {
                Err(format!("a dash or gap of {mm} mm; give lengths above 0 and at most {MAX_DASH_MM} mm"))
            }
            None => Ok(Self(lengths)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STANDARD: &str = include_str!("../../profiles/papers/standard.toml");

    /// Replaces `from` once and returns the complaint.
    fn complaint(from: &str, to: &str) -> String {
        assert!(STANDARD.contains(from));
        LineStyles::parse(&STANDARD.replacen(from, to, 1)).expect_err("must be refused").to_string()
    }

    #[test]
    fn the_standard_lines_differ_without_colour() {
        let styles = LineStyles::standard();
        let folds = [Layer::Mountain, Layer::Valley, Layer::FoldHinge, Layer::Glue];
        for (i, &a) in folds.iter().enumerate() {
            assert!(!styles.stroke(a).dash_mm.is_empty());
            for &b in &folds[i + 1..] {
                assert_ne!(styles.stroke(a).dash_mm, styles.stroke(b).dash_mm);
            }
        }
        assert!(styles.stroke(Layer::Cut).dash_mm.is_empty());
        assert_eq!(styles.stroke(Layer::Cut).width_mm, 0.25);
        assert_eq!(styles.colour(Layer::Glue), Rgb(0x80, 0x80, 0x80));
    }

    #[test]
    fn mistakes_are_shown_with_their_line() {
        let line_of = |needle: &str| {
            STANDARD.lines().position(|line| line.starts_with(needle)).expect("in the file") + 1
        };
        let message = complaint("width_mm = 0.25", "width_mm = 0.0");
        assert!(message.contains(&format!("line {}", line_of("width_mm = 0.25"))), "{message}");
        let message = complaint("\"#808080\"", "\"grey\"");
        assert!(message.contains(&format!("line {}", line_of("colour = \"#808080\""))), "{message}");
        let message = complaint("[2.0, 1.0]", "[2.0]");
        assert!(message.contains("even number") && message.contains("line "), "{message}");
        let message = complaint("[glue]", "[glu]");
        assert!(message.contains("glu") && message.contains("line "), "{message}");
        let message = complaint("[0.3, 0.9]", "[0.3, nan]");
        assert!(message.contains("NaN"), "{message}");
    }

    #[test]
    fn every_layer_has_its_table() {
        for layer in Layer::ALL {
            let table = format!("[{}]", layer.name());
            assert!(complaint(&table, "[other]").contains("unknown field `other`"));
        }
    }
}
