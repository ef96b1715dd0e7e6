//! What the user may choose about files; each format reads its own part.

use super::dxf::DxfOptions;
use super::png::PngOptions;
use super::svg::SvgOptions;

/// The choices for all formats, one checked type a format that has any.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FormatOptions {
    /// For DXF.
    pub dxf: DxfOptions,
    /// For PNG.
    pub png: PngOptions,
    /// For SVG.
    pub svg: SvgOptions,
}

/// How texts are written where a format leaves the choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TextMode {
    /// As outlines of letters: looks the same everywhere.
    #[default]
    Outlines,
    /// As text, which needs the font where it is read.
    Text,
}
