//! Options of pieces.

use super::settings::put;
use super::{Dial, Entry, Flag, Key, Kind, Number, Range, Switch, Unit};

pub(super) const WIDTHS: &[&Entry] = &[&MIN_PANEL_WIDTH, &TAB_WIDTH];
pub(super) const MARKS: &[&Entry] = &[&SPLIT, &GLUE_MARKS, &ANGLES, &EDGE_NAMES, &HIDE_BELOW];

const HEADING: &str = "Pieces";
/// The largest angle below which creases may be hidden, degrees: more would hide real folds.
const MOST_HIDDEN_DEG: f64 = 45.0;

/// Least width of panels.
pub static MIN_PANEL_WIDTH: Entry = Entry {
    key: Key::new("defaults", "min_panel_width_mm"),
    flag: Flag::new("min-panel-width", "LENGTH"),
    kind: Kind::Number(Number {
        unit: Unit::Length,
        range: Range::Positive,
        fault: "",
        such_as: 4.0,
        get: |s| Some(s.model.min_panel_width_mm),
        set: |s, mm| put(&mut s.model.min_panel_width_mm, mm),
    }),
    short: "Least width and height of a panel",
    long: "Narrower panels are hard to fold by hand. If the shape allows no wider panel, a warning names it. At most half \
           of the sheet's shorter side.",
    example: "--min-panel-width 4mm",
    meaning: "least width and height of a panel, at most half of the sheet's shorter side; a warning names smaller panels",
    dial: Dial::spanning("Least panel width", 0.5, 30.0, 1),
    ..Entry::BLANK
};

/// Width of glue tabs.
pub static TAB_WIDTH: Entry = Entry {
    key: Key::new("defaults", "tab_width_mm"),
    flag: Flag::new("tab-width", "LENGTH"),
    kind: Kind::Number(Number {
        unit: Unit::Length,
        range: Range::Positive,
        fault: "",
        such_as: 8.0,
        get: |s| Some(s.model.tab_width_mm),
        set: |s, mm| put(&mut s.model.tab_width_mm, mm),
    }),
    short: "Width of the glue tabs",
    long: "Tabs are narrower where there is less room. At most half of the sheet's shorter side.",
    example: "--tab-width 8mm",
    meaning: "width of the glue tabs, at most half of the sheet's shorter side; narrower where there is less room",
    dial: Dial::spanning("Tab width", 1.0, 30.0, 1),
    ..Entry::BLANK
};

/// Whether large panels are split.
pub static SPLIT: Entry = Entry {
    key: Key::new("nets", "split"),
    flag: Some(Flag {
        short: Some("Stops if a panel is larger than the sheet, instead of splitting it"),
        is_inverse: true,
        ..Flag::named("no-split", "BOOL", Some(HEADING))
    }),
    kind: Kind::Switch(Switch {
        get: |s| s.model.nets.may_split,
        set: |s, is_on| put(&mut s.model.nets.may_split, is_on),
    }),
    short: "Splits panels that are larger than the sheet",
    long: "tatamu divides such a panel into parts with tabs and labels; glue these first. Without splitting, such a \
           panel is an error, which names the largest size that fits.",
    meaning: "splits panels that are larger than the sheet; if false, such a panel is an error",
    dial: Dial::new("Split large panels"),
    ..Entry::BLANK
};

/// Whether places of tabs are drawn.
pub static GLUE_MARKS: Entry = Entry {
    key: Key::new("nets", "glue_marks"),
    flag: Flag::under(HEADING, "glue-marks", "BOOL"),
    kind: Kind::Switch(Switch {
        get: |s| s.model.nets.glue_marks,
        set: |s, is_on| put(&mut s.model.nets.glue_marks, is_on),
    }),
    short: "Draws where each tab is glued",
    meaning: "draws where each tab is glued",
    dial: Dial::new("Glue marks"),
    ..Entry::BLANK
};

/// Whether angles are written.
pub static ANGLES: Entry = Entry {
    key: Key::new("nets", "angles"),
    flag: Flag::under(HEADING, "angles", "BOOL"),
    kind: Kind::Switch(Switch {
        get: |s| s.model.nets.angles,
        set: |s, is_on| put(&mut s.model.nets.angles, is_on),
    }),
    short: "Prints the fold angle beside each crease, where there is room",
    long: "This is the angle in the unfolded model; 0° is flat paper.",
    meaning: "prints the fold angle beside each crease",
    dial: Dial::new("Fold angles"),
    ..Entry::BLANK
};

/// Whether names of edges are printed.
pub static EDGE_NAMES: Entry = Entry {
    key: Key::new("nets", "edge_names"),
    flag: Flag::under(HEADING, "edge-names", "BOOL"),
    kind: Kind::Switch(Switch {
        get: |s| s.model.nets.edge_names,
        set: |s, is_on| put(&mut s.model.nets.edge_names, is_on),
    }),
    short: "Prints the name of each edge beside it, for tables [[net]] of a project",
    long: "2.3 is the third edge of chain 2, counted from the top panel. A project says by these names where a net \
           is cut and which side has the tab.",
    meaning: "prints the name of each edge beside it, for [`[[net]]`](project.md#net), such as 2.3",
    dial: Dial::new("Edge names"),
    ..Entry::BLANK
};

/// Below which angle creases are left out.
pub static HIDE_BELOW: Entry = Entry {
    key: Key::new("nets", "hide_below"),
    flag: Flag::under(HEADING, "hide-below", "DEGREES"),
    kind: Kind::Number(Number {
        unit: Unit::Degrees,
        range: Range::Within(0.0, MOST_HIDDEN_DEG),
        fault: "the angle must be a number of degrees, from {least} to {most}",
        such_as: 3.0,
        // To a billionth, so that 3 stays 3.
        get: |s| Some((s.model.nets.hide_below_rad.to_degrees() * 1e9).round() / 1e9),
        set: |s, degrees| put(&mut s.model.nets.hide_below_rad, degrees.to_radians()),
    }),
    short: "Leaves out creases that fold by less, in degrees",
    long: "This is the angle in the unfolded model. Creases that fold flat are always drawn.",
    example: "--hide-below 3",
    meaning: "leaves out creases that fold by less, in degrees",
    dial: Dial::spanning("Hide creases below", 0.0, MOST_HIDDEN_DEG, 1),
    ..Entry::BLANK
};
