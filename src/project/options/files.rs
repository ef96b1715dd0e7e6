//! Options of the look and the content of files.

use super::settings::put;
use super::sheets::{OR_SIZE, papers};
use super::{Entry, Flag, Key, Kind, Number, Range, Scope, Settings, Switch, Text, Unit};
use crate::drawing::LineStyles;
use crate::export::PngOptions;
use crate::guide::Language;
use crate::units::parse_paper;
use std::str::FromStr;

pub(super) const ALL: &[&Entry] =
    &[&STYLE, &TEXT, &STROKE, &DXF_VERSION, &DXF_SHEETS, &DPI, &TILE, &COLOR, &STATIC, &FOLD_PIECES];
pub(super) const GUIDE: &[&Entry] = &[&GUIDE_LANGUAGE];

const HEADING: &str = "Options of files";

/// The name of a choice among those that its type reads.
fn name_of<T: FromStr + PartialEq>(names: &[&str], choice: &T) -> Option<String> {
    let is_it = |name: &&&str| name.parse::<T>().is_ok_and(|named| named == *choice);
    names.iter().find(is_it).map(|name| (*name).to_owned())
}

/// Look of the lines.
pub static STYLE: Entry = Entry {
    key: Key::new("export", "style"),
    flag: Flag::under(HEADING, "style", "NAME|FILE"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || LineStyles::BUILT_IN.map(|(name, _)| name).to_vec(),
        other: "or a file",
        such_as: "standard",
        get: |s| s.files.style.clone(),
        set: |s, text| put(&mut s.files.style, Some(text.to_owned())),
    }),
    short: "Look of the lines: {names}, or a style file (TOML)",
    long: "\"laser\" has red hairlines to cut and blue ones to score; \"bw\" has no grey. A style file of your own sets \
           width, colour, dashes and layer of each kind of line; it needs only what differs from the standard.",
    example: "--style laser, --style mine.toml",
    automatic: "standard",
    meaning: "look of the lines: a built-in style, or a [style file](styles.md). One that a project file names is relative \
              to it",
    ..Entry::BLANK
};

const TEXTS: [&str; 3] = ["outlines", "strokes", "text"];

/// How texts are written.
static TEXT: Entry = Entry {
    key: Key::new("export", "text"),
    flag: Flag::under(HEADING, "text", "MODE"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || TEXTS.to_vec(),
        other: "",
        such_as: "outlines",
        get: |s| {
            let [svg, dxf] = [s.files.formats.svg.text, s.files.formats.dxf.text];
            name_of(&TEXTS, &svg).filter(|_| svg == dxf)
        },
        set: |s, text| {
            let mode = text.parse()?;
            put(&mut s.files.formats.svg.text, mode)?;
            put(&mut s.files.formats.dxf.text, mode)
        },
    }),
    short: "Texts in SVG and DXF: {names}",
    long: "\"outlines\" look the same everywhere; \"strokes\" are single lines for pens and for scoring; \"text\" can be \
           edited, but needs the font where it is opened.",
    example: "--text strokes",
    automatic: "outlines in SVG, strokes in DXF",
    meaning: "texts in SVG and DXF",
    ..Entry::BLANK
};

const STROKES: [&str; 2] = ["styled", "hairline"];

/// How wide lines are in SVG.
static STROKE: Entry = Entry {
    key: Key::new("export", "stroke"),
    flag: Flag::under(HEADING, "stroke", "MODE"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || STROKES.to_vec(),
        other: "",
        such_as: "hairline",
        get: |s| name_of(&STROKES, &s.files.formats.svg.stroke),
        set: |s, text| put(&mut s.files.formats.svg.stroke, text.parse()?),
    }),
    short: "Lines in SVG: {names}",
    long: "Drivers of laser cutters follow hairlines and engrave what is wider.",
    example: "--stroke hairline --style laser",
    meaning: "lines in SVG",
    ..Entry::BLANK
};

const VERSIONS: [&str; 2] = ["r12", "r2000"];

/// Version of DXF files.
static DXF_VERSION: Entry = Entry {
    key: Key::new("export", "dxf_version"),
    flag: Flag::under(HEADING, "dxf-version", "VERSION"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || VERSIONS.to_vec(),
        other: "",
        such_as: "r12",
        get: |s| name_of(&VERSIONS, &s.files.formats.dxf.version),
        set: |s, text| put(&mut s.files.formats.dxf.version, text.parse()?),
    }),
    short: "Version of DXF files: {names}",
    long: "r12 is for old programs and machines.",
    example: "--dxf-version r12",
    meaning: "version of DXF files",
    ..Entry::BLANK
};

const DIVISIONS: [&str; 2] = ["files", "row"];

/// How sheets are divided among DXF files.
static DXF_SHEETS: Entry = Entry {
    key: Key::new("export", "dxf_sheets"),
    flag: Flag::under(HEADING, "dxf-sheets", "MODE"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || DIVISIONS.to_vec(),
        other: "",
        such_as: "row",
        get: |s| name_of(&DIVISIONS, &s.files.formats.dxf.sheets),
        set: |s, text| put(&mut s.files.formats.dxf.sheets, text.parse()?),
    }),
    short: "Sheets in DXF: files, one each, or row, all in one file side by side",
    example: "--dxf-sheets row",
    meaning: "one DXF file per sheet, or all in one, side by side",
    ..Entry::BLANK
};

/// Resolution of pictures of sheets.
static DPI: Entry = Entry {
    key: Key::new("export", "dpi"),
    flag: Flag::under(HEADING, "dpi", "N"),
    scope: Scope::Files,
    kind: Kind::Number(Number {
        unit: Unit::Bare,
        range: Range::Within(*PngOptions::DOTS_PER_INCH.start(), *PngOptions::DOTS_PER_INCH.end()),
        fault: "the resolution must be from {least} to {most} dots per inch",
        such_as: 300.0,
        get: |s| Some(s.files.formats.png.dots_per_inch()),
        set: |s, x| put(&mut s.files.formats.png, PngOptions::new(x)?),
    }),
    short: "Resolution of PNG files of sheets, in dots per inch",
    long: "From {least} to {most}.",
    example: "--dpi 300",
    meaning: "resolution of PNG files of sheets",
    ..Entry::BLANK
};

/// Paper of divided sheets.
static TILE: Entry = Entry {
    key: Key::new("export", "tile"),
    flag: Flag::under(HEADING, "tile", "SIZE"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: papers,
        other: OR_SIZE,
        such_as: "a4",
        get: |s| s.files.tile.map(|paper| paper.name()),
        set: |s, text| put(&mut s.files.tile, Some(parse_paper(text).map_err(|error| error.to_string())?)),
    }),
    short: "Paper on which the PDF divides larger sheets",
    long: "A sheet that does not fit is divided among pages of this size, which overlap and have marks to lay them on \
           one another.",
    example: "--paper 420x594mm --tile a4",
    meaning: "paper on which a PDF divides larger sheets",
    ..Entry::BLANK
};

/// Whether panels have the mesh's colours.
pub static COLOR: Entry = Entry {
    key: Key::new("export", "color"),
    flag: Some(Flag { alias: Some("colour"), ..Flag::named("color", "BOOL", Some(HEADING)) }),
    scope: Scope::Files,
    kind: Kind::Switch(Switch {
        get: |s| s.files.is_coloured,
        set: |s, is_on| put(&mut s.files.is_coloured, is_on),
    }),
    short: "Panels in the mesh's own colours, in PDF, SVG and PNG",
    long: "From materials and textures (OBJ, glTF) and colours of vertices and faces (OBJ, PLY, OFF, glTF). Leave it \
           out for files that are cut and not printed.",
    example: "--color -o bear.pdf",
    meaning: "panels in the mesh's own colours, in PDF, SVG and PNG",
    ..Entry::BLANK
};

/// Whether GLB files are without animation.
static STATIC: Entry = Entry {
    key: Key::new("export", "static"),
    flag: Flag::under(HEADING, "static", "BOOL"),
    scope: Scope::Files,
    kind: Kind::Switch(Switch {
        get: |s| s.files.formats.glb.is_static,
        set: |s, is_on| put(&mut s.files.formats.glb.is_static, is_on),
    }),
    short: "GLB files without the animation of the folding",
    long: "The model stands still, for programs that want no animation.",
    example: "--static -o bear.glb",
    meaning: "GLB files without the animation",
    ..Entry::BLANK
};

/// Whether pieces have FOLD files of their own.
static FOLD_PIECES: Entry = Entry {
    key: Key::new("export", "fold_pieces"),
    flag: Flag::under(HEADING, "fold-pieces", "BOOL"),
    scope: Scope::Files,
    kind: Kind::Switch(Switch {
        get: |s| s.files.formats.fold.pieces,
        set: |s, is_on| put(&mut s.files.formats.fold.pieces, is_on),
    }),
    short: "Each piece in a FOLD file of its own, besides the whole model",
    long: "With the angles of the flat state, for Flat-Folder and Origami Simulator.",
    example: "--fold-pieces -o teddy.fold",
    meaning: "each piece in a FOLD file of its own, too",
    ..Entry::BLANK
};

/// Language of the guide.
pub static GUIDE_LANGUAGE: Entry = Entry {
    key: Key::new("export", "guide_language"),
    flag: Flag::under("Assembly guide", "guide-language", "LANGUAGE"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || Language::ALL.map(Language::code).to_vec(),
        other: "",
        such_as: "de",
        get: |s: &Settings| Some(s.files.formats.guide.language.code().to_owned()),
        set: |s, text| put(&mut s.files.formats.guide.language, text.parse()?),
    }),
    short: "Language of the guide: {names}",
    example: "--guide-language de",
    meaning: "language of the assembly guide",
    ..Entry::BLANK
};
