//! `tatamu formats`, and the options that shape files: flags first, then the project file, then the
//! defaults.

use super::error::CliError;
use super::{input, terminal};
use clap::Args;
use std::path::{Path, PathBuf};
use tatamu::drawing::LineStyles;
use tatamu::export::{
    DxfSheets, DxfVersion, FORMATS, FormatOptions, PngOptions, SvgStroke, TextMode, Timestamp,
};
use tatamu::project::ExportTable;
use tatamu::units::{Paper, parse_paper};

/// Options of the files.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Options of files")]
pub struct FileArgs {
    /// Look of the lines: standard, laser, bw, or a style file (TOML) [default: standard]
    ///
    /// "laser" has red hairlines to cut and blue ones to score; "bw" has no grey. A style file of
    /// your own sets width, colour, dashes and layer of each kind of line; it needs only what
    /// differs from the standard. Example: --style laser, --style mine.toml
    #[arg(long, value_name = "NAME|FILE")]
    style: Option<PathBuf>,

    /// Texts in SVG and DXF: outlines, strokes or text [default: outlines in SVG, strokes in DXF]
    ///
    /// "outlines" look the same everywhere; "strokes" are single lines for pens and for scoring;
    /// "text" can be edited, but needs the font where it is opened. Example: --text strokes
    #[arg(long, value_name = "MODE")]
    text: Option<TextMode>,

    /// Lines in SVG: styled or hairline [default: styled]
    ///
    /// Drivers of laser cutters follow hairlines and engrave what is wider.
    /// Example: --stroke hairline --style laser
    #[arg(long, value_name = "MODE")]
    stroke: Option<SvgStroke>,

    /// Version of DXF files: r12 or r2000 [default: r2000]
    ///
    /// r12 is for old programs and machines. Example: --dxf-version r12
    #[arg(long, value_name = "VERSION")]
    dxf_version: Option<DxfVersion>,

    /// Sheets in DXF: files, one each, or row, all in one file side by side [default: files]
    ///
    /// Example: --dxf-sheets row
    #[arg(long, value_name = "MODE")]
    dxf_sheets: Option<DxfSheets>,

    /// Resolution of PNG files of sheets, in dots per inch [default: 150]
    ///
    /// From 10 to 2400. Example: --dpi 300
    #[arg(long, value_name = "N", value_parser = dpi)]
    dpi: Option<PngOptions>,

    /// Paper on which the PDF divides larger sheets
    ///
    /// A sheet that does not fit is divided among pages of this size, which overlap and have marks
    /// to lay them on one another. Example: --paper a2 --tile a4
    #[arg(long, value_name = "SIZE", value_parser = parse_paper)]
    tile: Option<Paper>,

    /// Panels in the mesh's own colours, in PDF, SVG and PNG
    ///
    /// From materials and textures (OBJ, glTF) and colours of vertices and faces (OBJ, PLY, OFF,
    /// glTF). Leave it out for files that are cut and not printed. Example: --color -o bear.pdf
    #[arg(long, visible_alias = "colour")]
    color: bool,

    /// GLB files without the animation of the folding
    ///
    /// The model stands still, for programs that want no animation. Example: --static -o bear.glb
    #[arg(long = "static")]
    is_static: bool,

    /// Each piece in a FOLD file of its own, besides the whole model
    ///
    /// With the angles of the flat state, for Flat-Folder and Origami Simulator.
    /// Example: --fold-pieces -o teddy.fold
    #[arg(long)]
    fold_pieces: bool,
}

fn dpi(text: &str) -> Result<PngOptions, String> {
    let dots = text.trim().parse().map_err(|_| "this must be a number such as 300".to_owned())?;
    PngOptions::new(dots)
}

/// What the user chose about files.
pub struct FileChoice {
    /// For the formats.
    pub formats: FormatOptions,
    /// Look of the lines.
    pub styles: LineStyles,
    /// Whether panels have the mesh's colours.
    pub is_coloured: bool,
}

impl FileArgs {
    /// The choices for an input, whose project file, if it is one, is at `input_path`.
    pub fn merge(&self, project: Option<&ExportTable>, input_path: &Path) -> Result<FileChoice, CliError> {
        let none = ExportTable::default();
        let table = project.unwrap_or(&none);
        let mut formats = FormatOptions::default();
        if let Some(text) = self.text.or(table.text) {
            (formats.svg.text, formats.dxf.text) = (text, text);
        }
        formats.svg.stroke = self.stroke.or(table.stroke).unwrap_or(formats.svg.stroke);
        formats.dxf.version = self.dxf_version.or(table.dxf_version).unwrap_or(formats.dxf.version);
        formats.dxf.sheets = self.dxf_sheets.or(table.dxf_sheets).unwrap_or(formats.dxf.sheets);
        formats.png = self.dpi.or(table.dpi).unwrap_or(formats.png);
        formats.glb.is_static = self.is_static || table.is_static;
        formats.fold.pieces = self.fold_pieces || table.fold_pieces;
        let pdf = formats.pdf.with_created(source_date()?);
        formats.pdf = pdf.with_tile(self.tile.or(table.tile)).map_err(CliError::Options)?;
        let styles = match (&self.style, &table.style) {
            (Some(name), _) => styles(name, name)?,
            (None, Some(name)) => styles(Path::new(name), &input_path.with_file_name(name))?,
            (None, None) => LineStyles::standard(),
        };
        Ok(FileChoice { formats, styles, is_coloured: self.color || table.color })
    }
}

/// The built-in style of this name, or the file at `path`.
fn styles(name: &Path, path: &Path) -> Result<LineStyles, CliError> {
    if let Some(styles) = name.to_str().and_then(LineStyles::built_in) {
        return Ok(styles);
    }
    if !path.exists() {
        return Err(CliError::Options(format!(
            "there is no style file {}, and no built-in style of that name; built in are: {}",
            path.display(),
            style_names()
        )));
    }
    let text = String::from_utf8(input::read_file(path)?).map_err(|_| CliError::Input {
        path: path.to_owned(),
        reason: "a style file is text in UTF-8".to_owned(),
    })?;
    LineStyles::parse(&text).map_err(|error| CliError::Style { path: path.to_owned(), error })
}

fn style_names() -> String {
    LineStyles::BUILT_IN.map(|(name, _)| name).join(", ")
}

/// The date of reproducible builds (<https://reproducible-builds.org/specs/source-date-epoch/>).
fn source_date() -> Result<Option<Timestamp>, CliError> {
    let Some(value) = std::env::var_os("SOURCE_DATE_EPOCH") else {
        return Ok(None);
    };
    let text = value.to_string_lossy();
    let date = text.parse().ok().and_then(Timestamp::of_unix);
    date.map(Some).ok_or_else(|| {
        let message = "the variable SOURCE_DATE_EPOCH must be a whole number of seconds since 1970, not";
        CliError::Options(format!("{message} \"{text}\""))
    })
}

/// Lists the formats that can be written, and the styles of their lines.
#[derive(Debug, Args)]
pub struct FormatsArgs {}

/// Runs `tatamu formats`.
pub fn run(_: &FormatsArgs) {
    terminal::say(&list());
    terminal::say(&format!("Styles of --style: {}, or a file", style_names()));
}

/// One line for each format: extensions and description.
pub fn list() -> String {
    let lines = FORMATS.iter().map(|format| {
        let extensions = format.extensions.join(", .");
        format!("  .{extensions:<8} {}\n", format.description)
    });
    format!("Formats of -o, by extension:\n{}", lines.collect::<String>())
}
