//! Options that choose a cutter and a medium, by the names of their profiles.

use super::settings::put;
use super::{Entry, Flag, Kind, Scope, Text};

pub(super) const ALL: &[&Entry] = &[&CUTTER, &MEDIA];

const HEADING: &str = "Cutter";

/// The cutter.
pub static CUTTER: Entry = Entry {
    flag: Flag::under(HEADING, "cutter", "NAME|FILE"),
    scope: Scope::Machine,
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "text",
        such_as: "hp-7475a",
        get: |s| s.files.cutter.clone(),
        set: |s, name| put(&mut s.files.cutter, Some(name.to_owned())),
    }),
    short: "Cutter or plotter: the name of a profile, or a file (TOML)",
    long: "\"tatamu profiles list\" lists the profiles; \"tatamu profiles show NAME\" prints one, as a start for your own \
           file.",
    example: "--cutter hp-7475a, --cutter mine.toml",
    automatic: "generic-hpgl",
    meaning: "cutter [profile](profiles.md) of `.plt` and `.gcode` files",
    ..Entry::BLANK
};

/// What is cut.
pub static MEDIA: Entry = Entry {
    flag: Flag::under(HEADING, "media", "NAME|FILE"),
    scope: Scope::Machine,
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "text",
        such_as: "cardstock-300",
        get: |s| s.files.media.clone(),
        set: |s, name| put(&mut s.files.media, Some(name.to_owned())),
    }),
    short: "Material: the name of a profile, or a file (TOML)",
    long: "It sets force, speed, passes, overcut, and how creases are scored or perforated.",
    example: "--media cardstock-300",
    automatic: "cardstock-200",
    meaning: "media profile of `.plt` and `.gcode` files",
    ..Entry::BLANK
};
