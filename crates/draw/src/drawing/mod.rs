//! The neutral display list: everything that puts a mark on a page reads a [`Drawing`].
//!
//! Coordinates are millimetres, y up, origin at the bottom-left corner of the page; each back end
//! flips or scales once. Styles are resolved here, so that back ends stay simple.

mod area;
mod mark;
mod pages;
mod raster;
mod registration;
pub mod strokes;
mod style;
pub mod text;

pub use area::rectangle;
pub use pages::{Chapter, Pages, PagesError};
pub use raster::{Raster, RasterError};
pub use registration::Registration;
pub use style::{Fill, LineStyles, StyleError};
pub use tatamu_core::colour::Rgb;

use glam::{DAffine2, DVec2};
use std::sync::Arc;

/// What a mark means; exporters turn it into groups, layers or pens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Layer {
    /// Outlines to cut, tabs included.
    Cut,
    /// Free edges between neighbouring chains, cut too.
    Slit,
    /// Hinges that fold away from the viewer.
    Mountain,
    /// Hinges that fold towards the viewer.
    Valley,
    /// The hinge of a chain that folds by 180°.
    FoldHinge,
    /// Areas of tabs, told apart from panels.
    Tab,
    /// Outline of what is glued here.
    Glue,
    /// Labels and names on pieces.
    Label,
    /// Scale bar, legend, title: belongs to the page, not to a piece.
    Furniture,
    /// Marks by which a cutter finds the page.
    Registration,
    /// Filled faces of pictures.
    Picture,
}

impl Layer {
    /// All layers, in their order.
    pub const ALL: [Self; 11] = [
        Self::Cut,
        Self::Slit,
        Self::Mountain,
        Self::Valley,
        Self::FoldHinge,
        Self::Tab,
        Self::Glue,
        Self::Label,
        Self::Furniture,
        Self::Registration,
        Self::Picture,
    ];

    /// All layers from the lowest to the highest, as formats that paint one after the other have them:
    /// areas, lines, texts, what belongs to the page. Pictures reach on to tabs, and so do halos.
    pub const PAINTED: [Self; Self::ALL.len()] = [
        Self::Tab,
        Self::Picture,
        Self::Glue,
        Self::Mountain,
        Self::Valley,
        Self::FoldHinge,
        Self::Slit,
        Self::Cut,
        Self::Label,
        Self::Furniture,
        Self::Registration,
    ];

    /// Short name in small letters: the name of the layer in every file format, and of its table
    /// in style files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cut => "cut",
            Self::Slit => "slit",
            Self::Mountain => "mountain",
            Self::Valley => "valley",
            Self::FoldHinge => "fold-hinge",
            Self::Tab => "tab",
            Self::Glue => "glue",
            Self::Label => "label",
            Self::Furniture => "furniture",
            Self::Registration => "registration",
            Self::Picture => "picture",
        }
    }

    /// Whether a cutter works on these lines: cuts and creases. All else is printed only.
    pub fn is_worked(self) -> bool {
        match self {
            Self::Cut | Self::Slit | Self::Mountain | Self::Valley | Self::FoldHinge => true,
            Self::Tab | Self::Glue | Self::Label | Self::Furniture | Self::Registration | Self::Picture => {
                false
            }
        }
    }
}

/// A stroked line's look.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Line width, mm.
    pub width_mm: f64,
    /// Colour.
    pub colour: Rgb,
    /// Lengths of dashes and gaps in turn, mm; empty for a solid line.
    pub dash_mm: Vec<f64>,
}

impl Stroke {
    /// A line without dashes.
    pub fn solid(width_mm: f64, colour: Rgb) -> Self {
        Self { width_mm, colour, dash_mm: Vec::new() }
    }
}

/// One polyline.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyline {
    /// Corners.
    pub points: Vec<DVec2>,
    /// Whether the last corner is joined to the first.
    pub is_closed: bool,
}

/// Where the anchor of a text is along its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// Anchor at the left end.
    Start,
    /// Anchor in the middle.
    Middle,
    /// Anchor at the right end.
    End,
}

/// One line of text.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// What it says.
    pub content: String,
    /// Anchor on the base line, mm.
    pub anchor: DVec2,
    /// Height of a capital letter, mm.
    pub cap_height_mm: f64,
    /// Turn about the anchor, counter-clockwise, radians.
    pub angle_rad: f64,
    /// Anchor's place on the line.
    pub align: Align,
    /// Colour.
    pub colour: Rgb,
}

/// Pixels at a place, seen inside a contour.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// The pixels.
    pub raster: Arc<Raster>,
    /// To the page, from mm along the raster's lower and left edge: a rigid motion, but for a mirror
    /// and a printer's scale.
    pub place: DAffine2,
    /// Closed contour on the page; nothing is seen outside.
    pub clip: Polyline,
}

/// One mark.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Lines, stroked and/or filled (even–odd) as one path.
    Path {
        /// The path's contours.
        contours: Vec<Polyline>,
        /// How it is stroked, if it is.
        stroke: Option<Stroke>,
        /// How it is filled, if it is.
        fill: Option<Rgb>,
    },
    /// Text.
    Text(Text),
    /// Pixels.
    Image(Image),
}

/// One mark with its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Meaning.
    pub layer: Layer,
    /// Name of the piece that it belongs to, if any.
    pub piece: Option<String>,
    /// What it is on that piece, such as the panels that a crease lies between.
    pub part: Option<String>,
    /// The mark itself.
    pub shape: Shape,
}

/// A page, or a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Title of the page.
    pub title: String,
    /// Width and height of the page, mm.
    pub size_mm: DVec2,
    /// Colour of the card that it is for, where one is chosen.
    pub card: Option<String>,
    /// The registration marks that it has, where it has some.
    pub registration: Option<Registration>,
    /// Background; none is transparent.
    pub ground: Option<Rgb>,
    /// Marks, in painting order.
    pub marks: Vec<Mark>,
}
