//! The table `[export]` of a project file: choices about files.

use super::fields;
use crate::export::{DxfSheets, DxfVersion, PngOptions, SvgStroke, TextMode};
use crate::guide::Language;
use crate::units::Paper;
use serde::Deserialize;

/// The table `[export]`.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ExportTable {
    /// A built-in style, or a style file relative to the project file.
    pub style: Option<String>,
    /// How texts are written in SVG and DXF.
    #[serde(deserialize_with = "fields::named")]
    pub text: Option<TextMode>,
    /// How wide lines are in SVG.
    #[serde(deserialize_with = "fields::named")]
    pub stroke: Option<SvgStroke>,
    /// Version of DXF files.
    #[serde(deserialize_with = "fields::named")]
    pub dxf_version: Option<DxfVersion>,
    /// How sheets are divided among DXF files.
    #[serde(deserialize_with = "fields::named")]
    pub dxf_sheets: Option<DxfSheets>,
    /// Resolution of PNG files.
    #[serde(deserialize_with = "fields::dpi")]
    pub dpi: Option<PngOptions>,
    /// Paper on which a PDF divides larger sheets.
    #[serde(deserialize_with = "fields::paper")]
    pub tile: Option<Paper>,
    /// Whether panels have the mesh's own colours.
    pub color: bool,
    /// Language of the assembly guide.
    #[serde(deserialize_with = "fields::named")]
    pub guide_language: Option<Language>,
    /// Whether GLB files are without animation.
    #[serde(rename = "static")]
    pub is_static: bool,
    /// Whether each piece is written to a FOLD file of its own.
    pub fold_pieces: bool,
}

/// The table in a fresh project file: everything in comments, with the defaults.
pub(super) const TEMPLATE: &str = r#"
[export]
# Look of the lines: "standard", "laser", "bw", or a style file relative to this one.
# style = "standard"
# Texts in SVG and DXF: "outlines", "strokes" (single lines) or "text".
# text = "outlines"
# Lines in SVG: "styled" or "hairline".
# stroke = "styled"
# Version of DXF files, "r12" or "r2000", and their sheets: "files", one each, or all in a "row".
# dxf_version = "r2000"
# dxf_sheets = "files"
# Resolution of PNG files, dots per inch.
# dpi = 150
# Paper on which a PDF divides sheets that are larger.
# tile = "a4"
# Panels in the mesh's own colours.
# color = true
# Language of the assembly guide, "en" or "de".
# guide_language = "en"
# GLB files without the animation of the folding.
# static = true
# Each piece in a FOLD file of its own, besides the whole model.
# fold_pieces = true
"#;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Project;

    #[test]
    fn every_key_of_the_template_is_known_and_every_known_key_is_in_it() {
        let text = TEMPLATE.replace("# ", "");
        let keys = text.lines().filter(|line| line.contains(" = ") || line.starts_with('['));
        let toml: String = keys.map(|line| format!("{line}\n")).collect();
        let export = Project::parse(&format!("mesh = 'a.obj'\n{toml}")).expect("valid").export;
        let expected = ExportTable {
            style: Some("standard".to_owned()),
            text: Some(TextMode::Outlines),
            stroke: Some(SvgStroke::Styled),
            dxf_version: Some(DxfVersion::R2000),
            dxf_sheets: Some(DxfSheets::Files),
            dpi: Some(PngOptions::default()),
            tile: Some(Paper::default()),
            color: true,
            guide_language: Some(Language::English),
            is_static: true,
            fold_pieces: true,
        };
        assert_eq!(export, expected);
    }

    #[test]
    fn errors_name_the_line_and_what_is_accepted() {
        for (line, word) in [
            ("text = 'letters'", "outlines, strokes, text"),
            ("stroke = 'thin'", "hairline"),
            ("dxf_version = 'r9'", "r12, r2000"),
            ("dxf_sheets = 3", "text"),
            ("dpi = 5", "from 10 to 2400"),
            ("tile = 'a9'", "paper size"),
            ("colour = 'red'", "expected one of"),
        ] {
            let error =
                Project::parse(&format!("mesh = 'a.obj'\n[export]\n{line}\n")).unwrap_err().to_string();
            assert!(error.contains("line 3") && error.contains(word), "{line}: {error}");
        }
    }
}
