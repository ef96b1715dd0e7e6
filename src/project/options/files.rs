//! Options of the look and the content of files.

use super::settings::put;
use super::sheets::{OR_SIZE, papers};
use super::{Dial, Entry, Flag, Key, Kind, Number, Range, Scope, Settings, Switch, Text, Unit};
use crate::drawing::LineStyles;
use crate::export::PngOptions;
use crate::guide::Language;
use crate::units::parse_paper;
use std::str::FromStr;

pub(super) const ALL: &[&Entry] = &[
    &STYLE,
    &TABS,
    &TEXT,
    &STROKE,
    &DXF_VERSION,
    &DXF_SHEETS,
    &DPI,
    &TILE,
    &OVERVIEW,
    &COLOR,
    &STATIC,
    &FOLD_PIECES,
];
pub(super) const GUIDE: &[&Entry] = &[&GUIDE_LANGUAGE];

const HEADING: &str = "File formats";

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
    long: "\"laser\" has red hairlines to cut and blue ones to score; \"bw\" has no grey. Your own style file sets width, \
           colour, dashes and layer of each kind of line; it lists only what differs from the standard.",
    example: "--style laser, --style mine.toml",
    automatic: "standard",
    meaning: "look of the lines: a built-in style, or a [style file](styles.md). One that a project file names is relative \
              to it",
    ..Entry::BLANK
};

const TABS_LOOKS: [(&str, bool); 2] = [("marked", false), ("plain", true)];

/// Look of tabs.
pub static TABS: Entry = Entry {
    key: Key::new("export", "tabs"),
    flag: Flag::under(HEADING, "tabs", "LOOK"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || TABS_LOOKS.map(|(name, _)| name).to_vec(),
        other: "",
        such_as: "plain",
        get: |s| {
            let found = TABS_LOOKS.iter().find(|(_, is_plain)| *is_plain == s.files.has_plain_tabs);
            found.map(|(name, _)| (*name).to_owned())
        },
        set: |s, text| {
            let found = TABS_LOOKS.iter().find(|(name, _)| *name == text);
            put(&mut s.files.has_plain_tabs, found.ok_or("the look of tabs must be one of marked, plain")?.1)
        },
    }),
    short: "Look of glue tabs: {names}",
    long: "Marked tabs have a tint or a hatch, as the style says, so that nobody takes them for panels. It is printed \
           only; cutters do not see it.",
    example: "--tabs plain",
    meaning: "look of glue tabs; marked ones have the tint or the hatch of the style",
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
    short: "Text in SVG and DXF: {names}",
    long: "\"outlines\" look the same everywhere; \"strokes\" are single lines for pens and scoring; \"text\" stays \
           editable but needs the font on the computer that opens it.",
    example: "--text strokes",
    automatic: "outlines in SVG, strokes in DXF",
    meaning: "text in SVG and DXF",
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
    long: "Laser cutters cut along hairlines and engrave wider lines.",
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
    short: "DXF version: {names}",
    long: "Use r12 for old programs and machines.",
    example: "--dxf-version r12",
    meaning: "version of DXF files",
    dial: Dial::new("DXF version"),
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
    short: "Sheets in DXF: files (one file per sheet) or row (all in one file, side by side)",
    example: "--dxf-sheets row",
    meaning: "one DXF file per sheet, or all in one, side by side",
    dial: Dial::new("DXF sheets"),
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
    short: "Resolution of PNG sheets, in dots per inch, {least} to {most}",
    example: "--dpi 300",
    meaning: "resolution of PNG sheets, in dots per inch",
    dial: Dial::new("Resolution (dpi)"),
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
    short: "Divides large sheets of a PDF into pages of this size",
    long: "The pages overlap and have alignment marks.",
    example: "--paper 420x594mm --tile a4",
    meaning: "divides large sheets of a PDF into pages of this size",
    ..Entry::BLANK
};

/// Whether a page about the whole model comes first.
static OVERVIEW: Entry = Entry {
    key: Key::new("export", "overview"),
    flag: Flag::under(HEADING, "overview", "BOOL"),
    scope: Scope::Files,
    kind: Kind::Switch(Switch {
        get: |s| s.files.formats.pdf.has_overview(),
        set: |s, is_on| {
            let pdf = s.files.formats.pdf.with_overview(is_on);
            put(&mut s.files.formats.pdf, pdf)
        },
    }),
    short: "Begins a PDF with a page about the whole model",
    long: "It has a picture with the names of the parts, a table of parts with their sheets, the order of folding, \
           and how long and how hard the work is.",
    meaning: "begins a PDF with a page about the whole model: picture, parts with their sheets, order of folding, time",
    dial: Dial::new("Overview page"),
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
    short: "Prints the mesh's colours on the panels, in PDF, SVG and PNG",
    long: "Colours come from materials and textures (OBJ, glTF, 3MF) and from vertex and face colours (OBJ, PLY, OFF, glTF, 3MF). \
           Leave it out for files that go to a cutter only.",
    example: "--color -o bear.pdf",
    meaning: "prints the mesh's colours on the panels, in PDF, SVG and PNG",
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
    short: "Leaves the folding animation out of GLB files",
    long: "For programs that cannot read animations.",
    example: "--static -o bear.glb",
    meaning: "leaves the folding animation out of GLB files",
    dial: Dial::new("Without animation"),
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
    short: "Writes a FOLD file for each piece, too",
    long: "With the fold angles of the flat state, for Flat-Folder and Origami Simulator.",
    example: "--fold-pieces -o teddy.fold",
    meaning: "writes a FOLD file for each piece, too",
    dial: Dial::new("FOLD file of each piece"),
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
