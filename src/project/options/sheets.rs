//! Options of paper and sheets.

use super::settings::put;
use super::{Count, Dial, Entry, Flag, Key, Kind, Number, Range, Switch, Text, Unit};
use crate::net::{LabelPlace, Side};
use crate::sheet::{Calibration, Registration, Rotation};
use crate::units::parse_paper;

pub(super) const PAPERS: &[&Entry] = &[&PAPER, &MARGIN, &THICKNESS, &THICK];
pub(super) const ALL: &[&Entry] = &[&SIDE, &LABELS, &GRAIN, &SPACING, &EFFORT, &MARKS, &CALIBRATE];

const HEADING: &str = "Sheets";
/// The most effort that may be asked for: 200,000 take half a minute for the sample teddy, so that this takes minutes;
/// ten times as much would take half an hour.
const MOST_EFFORT: usize = 1_000_000;
/// What else is paper.
pub(super) const OR_SIZE: &str = "or width and height such as `\"210x297mm\"`";

/// Names of papers that are offered.
pub(super) fn papers() -> Vec<&'static str> {
    vec!["a4", "a3", "a5", "letter", "legal"]
}

/// Size of the sheets.
pub static PAPER: Entry = Entry {
    key: Key::new("paper", "size"),
    flag: Some(Flag {
        more: "A mesh without a project file gets letter where your locale (LC_PAPER, LANG) is of a country that uses \
               it.",
        ..Flag::named("paper", "SIZE", None)
    }),
    kind: Kind::Text(Text {
        names: papers,
        other: OR_SIZE,
        such_as: "a4",
        get: |s| Some(s.model.paper.name()),
        set: |s, text| put(&mut s.model.paper, parse_paper(text).map_err(|error| error.to_string())?),
    }),
    short: "Size of the sheets: {names}, or width and height such as 210x297mm",
    long: "Width and height are in mm unless they have a unit.",
    example: "--paper 210x297mm, --paper 12x12in",
    meaning: "size of the sheets; another SIZE is width and height, such as `210x297mm`. A mesh without a project \
              file gets `letter` where your locale (`LC_PAPER`, `LANG`) is of a country that uses it",
    dial: Dial::new("Paper"),
    ..Entry::BLANK
};

/// Border that stays free.
pub static MARGIN: Entry = Entry {
    key: Key::new("paper", "margin_mm"),
    flag: Flag::new("margin", "LENGTH"),
    kind: Kind::Number(Number {
        unit: Unit::Length,
        range: Range::NotNegative,
        fault: "",
        such_as: 5.0,
        get: |s| Some(s.model.margin_mm),
        set: |s, mm| put(&mut s.model.margin_mm, mm),
    }),
    short: "Free margin around each sheet",
    long: "Most printers cannot print the outer 5 mm.",
    example: "--margin 5mm",
    meaning: "free margin around each sheet",
    dial: Dial::spanning("Margin", 0.0, 60.0, 1),
    ..Entry::BLANK
};

/// Thickness of the paper.
pub static THICKNESS: Entry = Entry {
    key: Key::new("paper", "thickness_mm"),
    flag: Flag::new("thickness", "LENGTH"),
    kind: Kind::Number(Number {
        unit: Unit::Length,
        range: Range::Within(0.02, 5.0),
        fault: "the thickness must be from {least} to {most} mm",
        such_as: 0.4,
        get: |s| Some(s.model.thickness_mm),
        set: |s, mm| put(&mut s.model.thickness_mm, mm),
    }),
    short: "Thickness of the paper, {least} to {most}",
    long: "The check of the folding ignores contacts of up to half of it; up to all of it panels rub, beyond it they \
           clash. Card of 200 g/m² is 0.25 mm thick.",
    example: "--thickness 0.4mm",
    meaning: "thickness of the paper. The check of the folding ignores contacts of up to half of it; up to all of it \
              panels rub, beyond it they clash",
    dial: Some(Dial { digits: 2, ..Dial::plain("Thickness") }),
    ..Entry::BLANK
};

/// Whether panels are boards.
pub static THICK: Entry = Entry {
    key: Key::new("paper", "thick"),
    flag: Flag::new("thick", "BOOL"),
    kind: Kind::Switch(Switch {
        get: |s| s.model.is_thick,
        set: |s, is_on| put(&mut s.model.is_thick, is_on),
    }),
    short: "Makes the panels of board: each is cut on its own and hinged with tape",
    long: "For drawn components and meshes that are boxes; the panels of most meshes are too slanted. Set the \
           thickness to that of the board. The outside keeps its size: tatamu shortens panels at their hinges \
           and moves creases so that the boards lie flat on each other. Tape valley hinges on the outside.",
    example: "--thickness 1.5mm --thick -o box.pdf -o box.stl",
    meaning: "makes the panels of board of that thickness: each is cut on its own and hinged with tape. For drawn \
              components and meshes that are boxes",
    dial: Dial::new("Panels of board"),
    ..Entry::BLANK
};

/// Names with the side of lines and labels, and whether the other one is printed too.
const SIDES: [(&str, (Side, bool)); 3] =
    [("outside", (Side::Outside, false)), ("inside", (Side::Inside, false)), ("both", (Side::Inside, true))];

/// The printed side.
pub static SIDE: Entry = Entry {
    key: Key::new("sheets", "side"),
    flag: Flag::under(HEADING, "side", "SIDE"),
    kind: Kind::Text(Text {
        names: || SIDES.map(|(name, _)| name).to_vec(),
        other: "",
        such_as: "inside",
        get: |s| {
            let chosen = (s.model.sheets.side, s.model.sheets.is_duplex);
            SIDES.iter().find(|(_, sides)| *sides == chosen).map(|(name, _)| (*name).to_owned())
        },
        set: |s, text| {
            let found = SIDES.iter().find(|(name, _)| *name == text);
            let (side, is_duplex) = found.ok_or("the printed side must be one of outside, inside, both")?.1;
            s.model.sheets.is_duplex = is_duplex;
            put(&mut s.model.sheets.side, side)
        },
    }),
    short: "Printed side of the paper: {names}",
    long: "With inside, pieces are mirrored, the finished model shows no lines, and creases fold towards you. With both, \
           a PDF has two pages for each sheet, to print on both sides: lines and labels inside; outside the places where \
           parts are glued on, and the mesh's colours, if they are printed.",
    example: "--side both",
    meaning: "printed side; `inside` is mirrored. `both` makes two pages for each sheet of a PDF: lines and labels \
              inside, the places of joints and the colours of the mesh outside",
    dial: Dial::new("Printed side"),
    ..Entry::BLANK
};

/// Names of places of labels.
const LABEL_PLACES: [(&str, LabelPlace); 3] =
    [("panels", LabelPlace::Panels), ("tabs", LabelPlace::Tabs), ("inside", LabelPlace::Inside)];

/// Where labels are.
pub static LABELS: Entry = Entry {
    key: Key::new("sheets", "labels"),
    flag: Flag::under(HEADING, "labels", "PLACE"),
    kind: Kind::Text(Text {
        names: || LABEL_PLACES.map(|(name, _)| name).to_vec(),
        other: "",
        such_as: "tabs",
        get: |s| {
            let found = LABEL_PLACES.iter().find(|(_, place)| *place == s.model.sheets.labels);
            found.map(|(name, _)| (*name).to_owned())
        },
        set: |s, text| {
            let found = LABEL_PLACES.iter().find(|(name, _)| *name == text);
            let (_, place) = found.ok_or("the place of labels must be one of panels, tabs, inside")?;
            put(&mut s.model.sheets.labels, *place)
        },
    }),
    short: "Place of names and labels: {names}",
    long: "For a model without letters on its faces. With tabs, a piece has letters on its tabs and where parts are \
           glued on; all others are beside it, on paper that you cut off: write them inside with a pencil before you \
           cut. With inside, a PDF has two pages for each sheet, to print on both sides: lines and the labels of tabs \
           outside, all other labels inside. On paper that is printed inside, labels stay on the panels: nobody sees them there.",
    example: "--labels tabs",
    meaning: "place of names and labels: on the `panels`; on `tabs` and joints, all others beside the piece; or \
              `inside`, on a page of their own in a PDF, for printing on both sides",
    dial: Dial::new("Labels"),
    ..Entry::BLANK
};

/// Whether paper has a grain.
pub static GRAIN: Entry = Entry {
    key: Key::new("sheets", "grain"),
    flag: Flag::under(HEADING, "grain", "BOOL"),
    kind: Kind::Switch(Switch {
        get: |s| s.model.sheets.rotation == Rotation::QuarterTurns,
        set: |s, is_on| {
            put(&mut s.model.sheets.rotation, if is_on { Rotation::QuarterTurns } else { Rotation::Free })
        },
    }),
    short: "Rotates pieces by multiples of 90 degrees only, for paper with a grain",
    meaning: "rotates pieces by multiples of 90° only, for paper with a grain",
    dial: Dial::new("Along the grain"),
    ..Entry::BLANK
};

/// Distance between pieces.
pub static SPACING: Entry = Entry {
    key: Key::new("sheets", "spacing_mm"),
    flag: Flag::under(HEADING, "spacing", "LENGTH"),
    kind: Kind::Number(Number {
        unit: Unit::Length,
        range: Range::NotNegative,
        fault: "",
        such_as: 4.0,
        get: |s| Some(s.model.sheets.spacing_mm),
        set: |s, mm| put(&mut s.model.sheets.spacing_mm, mm),
    }),
    short: "Least distance between pieces",
    long: "At most the shorter side of the sheet.",
    example: "--spacing 4mm",
    meaning: "least distance between pieces, at most the shorter side of the sheet",
    dial: Dial::spanning("Spacing", 0.0, 30.0, 1),
    ..Entry::BLANK
};

/// How much the nesting tries.
pub static EFFORT: Entry = Entry {
    key: Key::new("sheets", "effort"),
    flag: Flag::under(HEADING, "effort", "N"),
    kind: Kind::Count(Count {
        least: 0,
        most: MOST_EFFORT,
        fault: "the effort must be from {least} to {most}",
        such_as: 20_000,
        get: |s| Some(s.model.sheets.effort),
        set: |s, n| put(&mut s.model.sheets.effort, n),
    }),
    short: "How long to search for fewer sheets: number of trial placements",
    long: "Ten times the number takes ten times as long and sometimes saves a sheet; 0 is quickest. The same number \
           gives the same sheets on any computer. At most 1000000, which takes minutes.",
    example: "--effort 20000",
    meaning: "how long to search for fewer sheets: number of trial placements, at most 1000000",
    dial: Dial::new("Search effort"),
    ..Entry::BLANK
};

const NO_MARKS: &str = "none";

/// Registration marks.
pub static MARKS: Entry = Entry {
    key: Key::new("sheets", "marks"),
    flag: Flag::under(HEADING, "marks", "KIND"),
    kind: Kind::Text(Text {
        names: || [NO_MARKS].into_iter().chain(Registration::NAMES.map(|(name, _)| name)).collect(),
        other: "",
        such_as: "silhouette",
        get: |s| Some(s.model.sheets.registration.map_or(NO_MARKS, Registration::name).to_owned()),
        set: |s, text| {
            let known = || Registration::NAMES.map(|(name, _)| name).join(", ");
            let message = || format!("the registration marks must be one of {NO_MARKS}, {}", known());
            let marks = Registration::of_name(text);
            let is_known = marks.is_some() || text == NO_MARKS;
            is_known.then_some(()).ok_or_else(message)?;
            put(&mut s.model.sheets.registration, marks)
        },
    }),
    short: "Registration marks for a cutter: {names}",
    long: "silhouette: a square and two corners that Silhouette cutters detect; the margin grows to 18 mm. \
           silhouette-alpha: four corners for the Cameo 5 Alpha and the Cameo Pro MK-II. \"plot\" has these machines \
           look for them. corners: four corners to align by eye.",
    example: "--marks silhouette",
    meaning: "registration marks for a cutter",
    dial: Dial::new("Registration marks"),
    ..Entry::BLANK
};

/// What a printer makes of a length.
pub static CALIBRATE: Entry = Entry {
    key: Key::new("sheets", "calibrate"),
    flag: Flag::under(HEADING, "calibrate", "X:MM,Y:MM"),
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "text",
        such_as: "X:97.3,Y:100.1",
        get: |s| Some(s.model.sheets.calibration.text()),
        set: |s, text| {
            let calibration = Calibration::parse(text).map_err(|error| error.to_string())?;
            put(&mut s.model.sheets.calibration, calibration)
        },
    }),
    short: "Corrects the printer's scale: measured lengths of the two 100 mm bars",
    long: "Print a page, measure the horizontal bar (X) and the vertical bar in the left margin (Y), and print again \
           with these lengths.",
    example: "--calibrate X:97.3,Y:100.1",
    meaning: "measured lengths of the horizontal (X) and the vertical (Y) bar of 100 mm",
    dial: Dial::new("Measured bars"),
    ..Entry::BLANK
};
