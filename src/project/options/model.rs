//! Options of the whole model: where it stands, how large it is, how many panels it has.

use super::kind::FROM_TO;
use super::settings::put;
use super::{Count, Dial, Entry, Flag, Key, Kind, Number, Range, Scope, Text, Unit};
use crate::mesh::Up;
use crate::pipeline::Level;

pub(super) const ORIENTATION: &[&Entry] = &[&UP, &SIZE, &SHEETS_MAX];
pub(super) const SHAPE: &[&Entry] = &[&LEVEL, &TOP_EDGES, &PROFILE_VERTICES, &TOLERANCE];

const AXES: [(&str, Up); 6] =
    [("x", Up::X), ("y", Up::Y), ("z", Up::Z), ("-x", Up::DownX), ("-y", Up::DownY), ("-z", Up::DownZ)];

/// The least size of a model, mm: a hand cannot fold a smaller one.
const LEAST_SIZE_MM: f64 = 10.0;
/// The largest size of a model, mm: more is a typing error.
const MOST_SIZE_MM: f64 = 10_000.0;

/// The most sheets that may be asked for.
const MOST_SHEETS: usize = 10_000;

/// The fewest top edges of a component, and the fewest vertices of a profile.
const LEAST_COUNT: usize = 3;
/// The most of either that is any use on paper.
const MOST_COUNT: usize = 64;

/// The axis that points up.
pub static UP: Entry = Entry {
    key: Key::new("", "up"),
    flag: Some(Flag { may_begin_with_dash: true, ..Flag::named("up", "AXIS", None) }),
    scope: Scope::Mesh,
    kind: Kind::Text(Text {
        names: || AXES.map(|(name, _)| name).to_vec(),
        other: "",
        such_as: "z",
        get: |s| AXES.iter().find(|(_, up)| *up == s.model.up).map(|(name, _)| (*name).to_owned()),
        set: |s, text| {
            let found = AXES.iter().find(|(name, _)| name.eq_ignore_ascii_case(text));
            let found = found.ok_or("the axis that points up must be one of x, y, z, -x, -y, -z")?;
            put(&mut s.model.up, found.1)
        },
    }),
    short: "Axis of the mesh that points up: {names}",
    long: "The model is rotated so that this axis points up; with -y, y points down.",
    example: "--up z",
    meaning: "axis of the mesh that points up",
    dial: Dial::new("Up axis"),
    ..Entry::BLANK
};

/// Longest side of the model.
pub static SIZE: Entry = Entry {
    key: Key::new("", "size"),
    flag: Some(Flag {
        more: "Without this option a mesh gets a size from 100 to 300 mm at which most models take three to five \
               sheets of A4; a project file that says nothing gets 200 mm. Sizes a little apart give the same \
               design: it changes at 100, 110, 120, 140, 160, 180, 200, 220, 250, 280, 300 mm and so on.",
        ..Flag::named("size", "LENGTH", None)
    }),
    kind: Kind::Number(Number {
        unit: Unit::Length,
        range: Range::Within(LEAST_SIZE_MM, MOST_SIZE_MM),
        fault: "the size must be from {least} to {most} mm",
        such_as: 200.0,
        get: |s| Some(s.model.size_mm),
        set: |s, mm| put(&mut s.model.size_mm, mm),
    }),
    short: "Longest side of the model's bounding box",
    long: "A number with mm, cm, m or in; without a unit, mm.",
    example: "--size 30cm",
    automatic: "by the shape",
    meaning: "longest side of the finished model's bounding box. A mesh without a project file gets a size from 100 to \
              300 mm at which most models take three to five sheets of A4; a project file without it gets `200mm`",
    dial: Dial::spanning("Size", 10.0, 2000.0, 0),
    ..Entry::BLANK
};

/// Most sheets of the model.
pub static SHEETS_MAX: Entry = Entry {
    key: Key::new("", "sheets_max"),
    flag: Flag::new("sheets-max", "N"),
    kind: Kind::Count(Count {
        least: 1,
        most: MOST_SHEETS,
        fault: FROM_TO,
        such_as: 2,
        get: |s| s.most_sheets,
        set: |s, n| put(&mut s.most_sheets, Some(n)),
    }),
    short: "Makes the model smaller until it takes at most this many sheets",
    long: "tatamu tries smaller sizes, in steps of 5 mm, and says which one it took. It makes no model larger than the \
           size that you set.",
    example: "--size 40cm --sheets-max 4",
    automatic: "no limit",
    meaning: "the most sheets: tatamu makes the model smaller than `size`, in steps of 5 mm, until it takes no more",
    dial: Some(Dial {
        tip: Some(
            "Most sheets that the model may take. Where it takes more, a button makes it smaller until it fits.",
        ),
        off: "no limit",
        ..Dial::plain("Sheets max")
    }),
    ..Entry::BLANK
};

/// How much work the model may be.
pub static LEVEL: Entry = Entry {
    key: Key::new("defaults", "level"),
    flag: Flag::new("level", "LEVEL"),
    scope: Scope::Mesh,
    kind: Kind::Text(Text {
        names: || Level::ALL.map(Level::name).to_vec(),
        other: "",
        such_as: "easy",
        get: |s| Some(s.model.level.name().to_owned()),
        set: |s, text| put(&mut s.model.level, text.parse()?),
    }),
    short: "Difficulty of the model: {names}",
    long: "Compared with normal, \"easy\" has about half of the panels, \"fine\" up to two thirds more. Big parts get \
           most of them.",
    example: "--level easy",
    meaning: "difficulty of the model. Big parts get most of the panels; panels that add little are left out",
    dial: Dial::new("Level"),
    ..Entry::BLANK
};

/// Edges of top panels.
pub static TOP_EDGES: Entry = Entry {
    key: Key::new("defaults", "top_edges"),
    flag: Flag::new("top-edges", "N"),
    scope: Scope::Mesh,
    kind: Kind::Count(Count {
        least: LEAST_COUNT,
        most: MOST_COUNT,
        fault: FROM_TO,
        such_as: 6,
        get: |s| s.model.top_edges,
        set: |s, n| put(&mut s.model.top_edges, Some(n)),
    }),
    short: "Edges of each component's top panel, {least} or more",
    long: "More edges follow the shape better; fewer fold faster.",
    example: "--top-edges 8",
    automatic: "by level and the part's size",
    meaning: "edges of each top panel, and so the number of chains. More follow the shape better, fewer fold faster",
    dial: Dial::new("Top edges"),
};

/// Vertices of profiles.
pub static PROFILE_VERTICES: Entry = Entry {
    key: Key::new("defaults", "profile_vertices"),
    flag: Flag::new("profile-vertices", "N"),
    scope: Scope::Mesh,
    kind: Kind::Count(Count {
        least: LEAST_COUNT,
        most: MOST_COUNT,
        fault: FROM_TO,
        such_as: 6,
        get: |s| s.model.profile_vertices,
        set: |s, n| put(&mut s.model.profile_vertices, Some(n)),
    }),
    short: "Most vertices of each profile, {least} or more",
    long: "A profile is the outline of a strip of side panels. More vertices follow the shape better; fewer fold \
           faster.",
    example: "--profile-vertices 4",
    automatic: "by level and the part's size",
    meaning: "most vertices of each chain's profile",
    dial: Dial::new("Profile vertices"),
};

/// How close components come to their shapes.
pub static TOLERANCE: Entry = Entry {
    key: Key::new("defaults", "tolerance"),
    flag: Flag::new("tolerance", "LENGTH"),
    scope: Scope::Mesh,
    kind: Kind::Number(Number {
        unit: Unit::Length,
        range: Range::Positive,
        fault: "",
        such_as: 2.0,
        get: |s| s.model.tolerance_mm,
        set: |s, mm| put(&mut s.model.tolerance_mm, Some(mm)),
    }),
    short: "Largest distance of each component from its convex hull",
    long: "tatamu uses as few top edges and profile vertices as possible, at most the numbers that you set, or 12 and \
           10 by default.",
    example: "--tolerance 2mm",
    meaning: "largest distance of each component from its convex hull, instead of the two counts. tatamu uses as few \
              edges and vertices as possible, at most the two counts, or 12 and 10 by default",
    dial: Dial::spanning("Tolerance", 0.1, 50.0, 1),
    ..Entry::BLANK
};
