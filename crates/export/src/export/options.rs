//! What the user may choose about files; each format reads its own part.

use super::dxf::DxfOptions;
use super::fold::FoldOptions;
use super::glb::GlbOptions;
use super::guide::GuideOptions;
use super::pdf::PdfOptions;
use super::plt::PltOptions;
use super::png::PngOptions;
use super::svg::SvgOptions;
use crate::show::FilmOptions;

/// The choices for all formats, one checked type a format that has any.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FormatOptions {
    /// For DXF.
    pub dxf: DxfOptions,
    /// For animations.
    pub film: FilmOptions,
    /// For FOLD.
    pub fold: FoldOptions,
    /// For GLB.
    pub glb: GlbOptions,
    /// For assembly guides.
    pub guide: GuideOptions,
    /// For PDF.
    pub pdf: PdfOptions,
    /// For PLT.
    pub plt: PltOptions,
    /// For PNG.
    pub png: PngOptions,
    /// For SVG.
    pub svg: SvgOptions,
}

/// How texts are written where a format leaves the choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextMode {
    /// As outlines of letters: looks the same everywhere.
    Outlines,
    /// As single lines, for pens and for scoring.
    Strokes,
    /// As text, which needs a font where it is read.
    Text,
}

impl std::str::FromStr for TextMode {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "outlines" => Ok(Self::Outlines),
            "strokes" => Ok(Self::Strokes),
            "text" => Ok(Self::Text),
            _ => Err("the text must be one of outlines, strokes, text".to_owned()),
        }
    }
}
