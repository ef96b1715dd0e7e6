//! All that options choose.

use super::program::Program;
use crate::export::FormatOptions;
use crate::pipeline::Options;
use crate::units::Paper;
use std::sync::LazyLock;

/// All that options choose.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Settings {
    /// The model, its pieces and sheets.
    pub model: Options,
    /// The most sheets that the model may take: it is made smaller until it does.
    pub most_sheets: Option<usize>,
    /// Whether components have card of the mesh's colours, where no other is chosen.
    pub has_cards_of_mesh: bool,
    /// The files.
    pub files: Files,
}

/// What is chosen about files.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Files {
    /// By format.
    pub formats: FormatOptions,
    /// Paper on which a PDF divides larger sheets, which may be too small for that.
    pub tile: Option<Paper>,
    /// Look of the lines: a built-in style, or a file.
    pub style: Option<String>,
    /// Whether tabs look as panels do.
    pub has_plain_tabs: bool,
    /// Whether panels have the mesh's colours.
    pub is_coloured: bool,
    /// The program that the files are for.
    pub program: Option<&'static Program>,
    /// Name or file of the cutter's profile.
    pub cutter: Option<String>,
    /// Name or file of the medium's profile.
    pub media: Option<String>,
}

impl Settings {
    /// The default settings.
    pub fn standard() -> &'static Self {
        static STANDARD: LazyLock<Settings> = LazyLock::new(Settings::default);
        &STANDARD
    }
}

/// Puts a value into its place.
pub(super) fn put<T>(place: &mut T, value: T) -> Result<(), String> {
    *place = value;
    Ok(())
}
