//! The look of each kind of line, read from style files.

use super::{Layer, Rgb, Stroke};
use serde::Deserialize;
use toml::Spanned;

/// Widest line that a style file may ask for.
const MAX_WIDTH_MM: f64 = 5.0;
/// Longest dash or gap that a style file may ask for.
const MAX_DASH_MM: f64 = 100.0;
/// Longest name of a layer: what DXF R12 allows.
const MAX_NAME: usize = 31;

/// A style file that cannot be used. The message shows the line of the mistake.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StyleError {
    /// Not TOML, an unknown key, or a value that is not accepted.
    #[error("{0}")]
    Toml(#[from] toml::de::Error),
    /// Two operations share a layer and look different there.
    #[error(
        "line {line}: [{operation}] is on layer \"{layer}\" like [{other}], but does not look the same; \
         give it the same width, colours and dashes, or a layer of its own"
    )]
    SharedLayer {
        /// Line of the second operation's layer, from 1.
        line: usize,
        /// The layer's name.
        layer: String,
        /// The second operation.
        operation: &'static str,
        /// The first one on the layer.
        other: &'static str,
    },
}

/// How the areas of a layer are filled: tabs, and places where components are glued.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fill {
    /// Not at all.
    Plain,
    /// With lines of the layer's stroke, for printers that turn grey into dots.
    Hatch,
    /// With a colour.
    Tint(Rgb),
}

/// The look of one operation.
#[derive(Debug, Clone, PartialEq)]
struct Look {
    stroke: Stroke,
    fill: Fill,
    layer: String,
    dxf_colour: u8,
}

/// How the lines of each layer look, and what the layer is called in files.
///
/// # Guarantees
/// Widths are above 0 and at most 5 mm; dashes are above 0, at most 100 mm, and even in number.
/// Layers' names have 1 to 31 letters, digits, `_` and `-`. Operations that share a name look the
/// same.
#[derive(Debug, Clone, PartialEq)]
pub struct LineStyles {
    looks: [Look; Layer::ALL.len()],
}

impl LineStyles {
    /// The style files that come with the program, by name.
    pub const BUILT_IN: [(&str, &str); 3] = [
        ("standard", include_str!("../../../../profiles/styles/standard.toml")),
        ("laser", include_str!("../../../../profiles/styles/laser.toml")),
        ("bw", include_str!("../../../../profiles/styles/bw.toml")),
    ];

    /// The first built-in style: black and grey, for printed sheets.
    pub fn standard() -> Self {
        Self::over(&Self::plain(), Self::BUILT_IN[0].1)
            .expect("the built-in style file is valid, which a test checks")
    }

    /// The built-in style of this name.
    pub fn built_in(name: &str) -> Option<Self> {
        let (_, toml) = Self::BUILT_IN.iter().find(|(known, _)| *known == name)?;
        Self::parse(toml).ok()
    }

    /// Reads a style file: a table for each [`Layer`], by its name. What it leaves out is as in the
    /// standard style.
    ///
    /// # Errors
    /// See [`StyleError`].
    pub fn parse(toml: &str) -> Result<Self, StyleError> {
        Self::over(&Self::standard(), toml)
    }

    fn plain() -> Self {
        let stroke = Stroke::solid(0.2, Rgb::BLACK);
        let layer = |layer: Layer| layer.name().to_ascii_uppercase();
        let looks = Layer::ALL.map(|kind| Look {
            stroke: stroke.clone(),
            fill: Fill::Plain,
            layer: layer(kind),
            dxf_colour: 7,
        });
        Self { looks }
    }

    fn over(base: &Self, toml: &str) -> Result<Self, StyleError> {
        let file: StyleFile = toml::from_str(toml)?;
        let looks = Layer::ALL.map(|kind| file.table(kind).over(&base.looks[kind as usize]));
        for (k, look) in looks.iter().enumerate() {
            let first = looks[..k].iter().position(|other| other.layer == look.layer);
            if let Some(other) = first.filter(|&other| looks[other] != *look) {
                let place = [k, other].into_iter().find_map(|k| file.table(Layer::ALL[k]).layer.as_ref());
                let before = place.map_or("", |place| &toml[..place.span().start]);
                return Err(StyleError::SharedLayer {
                    line: before.lines().count().max(1),
                    layer: look.layer.clone(),
                    operation: Layer::ALL[k].name(),
                    other: Layer::ALL[other].name(),
                });
            }
        }
        Ok(Self { looks })
    }

    /// The look of a layer's lines.
    pub fn stroke(&self, layer: Layer) -> &Stroke {
        &self.looks[layer as usize].stroke
    }

    /// The colour of a layer's lines, and of its texts.
    pub fn colour(&self, layer: Layer) -> Rgb {
        self.stroke(layer).colour
    }

    /// How the layer's areas are filled.
    pub fn fill(&self, layer: Layer) -> Fill {
        self.looks[layer as usize].fill
    }

    /// The same with the areas of a layer left as they are.
    #[must_use]
    pub fn with_plain(mut self, layer: Layer) -> Self {
        self.looks[layer as usize].fill = Fill::Plain;
        self
    }

    /// What the layer is called in files.
    pub fn layer_name(&self, layer: Layer) -> &str {
        &self.looks[layer as usize].layer
    }

    /// The layer's colour in DXF files: AutoCAD's index, from 1 to 255.
    pub fn dxf_colour(&self, layer: Layer) -> u8 {
        self.looks[layer as usize].dxf_colour
    }
}

impl Default for LineStyles {
    fn default() -> Self {
        Self::standard()
    }
}

/// The style file as it is written.
#[derive(Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
#[derive(Default)]
struct StyleFile {
    cut: StyleTable,
    slit: StyleTable,
    mountain: StyleTable,
    valley: StyleTable,
    fold_hinge: StyleTable,
    tab: StyleTable,
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
            Layer::Tab => &self.tab,
            Layer::Glue => &self.glue,
            Layer::Label => &self.label,
            Layer::Furniture => &self.furniture,
            Layer::Registration => &self.registration,
            Layer::Picture => &self.picture,
        }
    }
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct StyleTable {
    width_mm: Option<Width>,
    colour: Option<Colour>,
    dash_mm: Option<Dash>,
    fill: Option<Filling>,
    layer: Option<Spanned<LayerName>>,
    dxf_colour: Option<DxfColour>,
}

impl StyleTable {
    /// What the table says, and the base where it says nothing.
    fn over(&self, base: &Look) -> Look {
        let stroke = &base.stroke;
        Look {
            stroke: Stroke {
                width_mm: self.width_mm.as_ref().map_or(stroke.width_mm, |width| width.0),
                colour: self.colour.as_ref().map_or(stroke.colour, |colour| colour.0),
                dash_mm: self.dash_mm.as_ref().map_or(&stroke.dash_mm, |dash| &dash.0).clone(),
            },
            fill: self.fill.as_ref().map_or(base.fill, |fill| fill.0),
            layer: self.layer.as_ref().map_or(&base.layer, |name| &name.get_ref().0).clone(),
            dxf_colour: self.dxf_colour.as_ref().map_or(base.dxf_colour, |colour| colour.0),
        }
    }
}

#[derive(Deserialize)]
#[serde(try_from = "f64")]
struct Width(f64);

impl TryFrom<f64> for Width {
    type Error = String;

    fn try_from(mm: f64) -> Result<Self, String> {
        if mm > 0.0 && mm <= MAX_WIDTH_MM {
            Ok(Self(mm))
        } else {
            Err(format!("a width of {mm} mm; give a width above 0 and at most {MAX_WIDTH_MM} mm"))
        }
    }
}

#[derive(Deserialize)]
#[serde(try_from = "String")]
struct Filling(Fill);

impl TryFrom<String> for Filling {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        match text.as_str() {
            "none" => Ok(Self(Fill::Plain)),
            "hatch" => Ok(Self(Fill::Hatch)),
            _ => match Colour::try_from(text.clone()) {
                Ok(Colour(colour)) => Ok(Self(Fill::Tint(colour))),
                Err(_) => {
                    Err(format!("{text:?} is no fill; write \"none\", \"hatch\", or a colour as \"#rrggbb\""))
                }
            },
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

#[derive(Deserialize)]
#[serde(try_from = "String")]
struct LayerName(String);

impl TryFrom<String> for LayerName {
    type Error = String;

    fn try_from(name: String) -> Result<Self, String> {
        let is_usable = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
        if (1..=MAX_NAME).contains(&name.len()) && name.chars().all(is_usable) {
            return Ok(Self(name));
        }
        Err(format!("{name:?} cannot be a layer's name; use 1 to {MAX_NAME} letters, digits, _ and -"))
    }
}

#[derive(Deserialize)]
#[serde(try_from = "i64")]
struct DxfColour(u8);

impl TryFrom<i64> for DxfColour {
    type Error = String;

    fn try_from(index: i64) -> Result<Self, String> {
        let index = u8::try_from(index).ok().filter(|&index| index > 0).ok_or(index);
        let message = |index| format!("{index} is not the index of a DXF colour; use a number from 1 to 255");
        index.map(Self).map_err(message)
    }
}

#[cfg(test)]
mod tests;
