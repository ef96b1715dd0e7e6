//! Programs that files are made for: each sets the look, the sheet and the format that the program reads at true
//! size. Other options change these again.

use super::program::Program;
use super::settings::put;
use super::{Entry, Flag, Kind, Scope, Settings, Text};
use crate::export::{DxfVersion, SvgStroke, TextMode};
use crate::units::parse_paper;

const HEADING: &str = "File formats";

/// A program, and what it makes of settings.
struct Preset {
    program: Program,
    set: fn(&mut Settings) -> Result<(), String>,
}

/// All of them, in the order of help texts.
static PRESETS: [Preset; 5] = [CRICUT, SILHOUETTE_STUDIO, LIGHTBURN, SCANNCUT, INKSCAPE];

/// Design Space divides a file by colours and drops texts and dashes; frediz cut models with layers of cuts and
/// folds (github.com/rodrigorc/papercraft/issues/2). A mat of 12 × 12 in is cut up to 1/4 in from its edges.
const CRICUT: Preset = Preset {
    program: Program {
        name: "cricut",
        extension: "svg",
        is_job: true,
        advice: "in Design Space, set the operation of blue lines to Score and of black ones to Pen (or hide them), select all, \
                 and Attach",
    },
    set: |s| {
        laser_lines(s);
        mat(s, "304.8x304.8mm", 6.35)
    },
};

/// Basic Edition opens DXF and no SVG (krafix.de, "Grundlegendes zu Plotterdateien"), and of DXF only the simplest
/// (github.com/Malacath-92/Proxy-PDF-Maker/issues/62): R12 with lines.
const SILHOUETTE_STUDIO: Preset = Preset {
    program: Program {
        name: "silhouette-studio",
        extension: "dxf",
        is_job: true,
        advice: "in the preferences of Silhouette Studio, under Import, set DXF to millimetres and \"as is\"; then set a \
             Line Color of its own for creases",
    },
    set: |s| {
        laser_lines(s);
        s.files.formats.dxf.version = DxfVersion::R12;
        mat(s, "304.8x304.8mm", 6.35)
    },
};

/// See the format in `crates/export/src/export/lbrn.rs`.
const LIGHTBURN: Preset = Preset {
    program: Program {
        name: "lightburn",
        extension: "lbrn2",
        is_job: false,
        advice: "in LightBurn, check that labels are not mirrored, and set power and speed of each layer for your laser",
    },
    set: |s| {
        laser_lines(s);
        Ok(())
    },
};

/// See the format in `crates/export/src/export/fcm.rs`. The paper is what the machine cuts on its mat of 12 × 12 in.
const SCANNCUT: Preset = Preset {
    program: Program {
        name: "scanncut",
        extension: "fcm",
        is_job: true,
        advice: "copy the file to a USB stick; on the machine, draw or crease the first lines before you cut the others",
    },
    set: |s| {
        laser_lines(s);
        mat(s, "296.6x298.8mm", 3.0)
    },
};

/// Layers of Inkscape, the page in millimetres, and texts that can be edited.
const INKSCAPE: Preset = Preset {
    program: Program {
        name: "inkscape",
        extension: "svg",
        is_job: false,
        advice: "in Inkscape, each kind of line is a layer",
    },
    set: |s| {
        s.files.formats.svg.text = TextMode::Text;
        Ok(())
    },
};

/// Solid lines with a colour for each operation, and letters as single lines.
fn laser_lines(s: &mut Settings) {
    s.files.style = Some("laser".to_owned());
    s.files.formats.svg.stroke = SvgStroke::Hairline;
    s.files.formats.svg.text = TextMode::Strokes;
    s.files.formats.dxf.text = TextMode::Strokes;
}

fn mat(s: &mut Settings, paper: &str, margin_mm: f64) -> Result<(), String> {
    s.model.margin_mm = margin_mm;
    put(&mut s.model.paper, parse_paper(paper).map_err(|error| error.to_string())?)
}

/// The program that files are made for.
pub static FOR: Entry = Entry {
    flag: Flag::under(HEADING, "for", "PROGRAM"),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: || PRESETS.iter().map(|preset| preset.program.name).collect(),
        other: "",
        such_as: "cricut",
        get: |s| s.files.program.map(|program| program.name.to_owned()),
        set: |s, text| {
            let names = || PRESETS.iter().map(|preset| preset.program.name).collect::<Vec<_>>().join(", ");
            let preset = PRESETS.iter().find(|preset| preset.program.name == text);
            let preset = preset.ok_or_else(|| format!("the program must be one of {}", names()))?;
            s.files.program = Some(&preset.program);
            (preset.set)(s)
        },
    }),
    short: "Makes files for a program: {names}",
    long: "It sets format, paper, margin and look of the lines as the program reads them; other options change these. \
           Without -o the file is named after the input.",
    example: "--for cricut, --for lightburn -o bear.lbrn2",
    meaning: "makes files for a program: sets format, paper, margin and look of the lines, see [For a \
              program](formats.md#for-a-program)",
    ..Entry::BLANK
};
