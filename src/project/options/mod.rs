//! The table of options: the only description of each option is its [`Entry`].
//!
//! The command line makes its flags of the table, the project file its keys, `tatamu init` its
//! comments, the studio its settings, and the reference pages their tables. An option is checked and
//! takes effect in one place: the function `set` of its [`Kind`].

mod component;
mod entry;
mod files;
mod film;
mod given;
mod kind;
mod machine;
mod model;
mod nets;
mod presets;
mod program;
mod read;
mod reference;
mod segmentation;
mod settings;
mod sheets;
#[cfg(test)]
mod tests;
mod words;

pub use component::{CARD, CONCAVE, DIRECTION, JOINT, RENAME};
pub use entry::{Dial, Entry, Flag, Key, Scope};
pub use files::{COLOR, GUIDE_LANGUAGE, STYLE};
pub use given::{Given, Written};
pub use kind::{Count, Kind, Number, Range, Switch, Text, Unit};
pub use machine::{CUTTER, MEDIA};
pub use model::{LEVEL, PROFILE_VERTICES, SHEETS_MAX, SIZE, TOLERANCE, TOP_EDGES, UP};
pub use nets::{ANGLES, EDGE_NAMES, GLUE_MARKS, HIDE_BELOW, MIN_PANEL_WIDTH, SPLIT, TAB_WIDTH};
pub use presets::FOR;
pub use program::Program;
pub use reference::{command_line_page, project_page};
pub use segmentation::{CLUSTERS, DETAIL, METHOD, PARTS, ROOT, SMOOTHING, SYMMETRY};
pub use settings::{Files, Settings};
pub use sheets::{CALIBRATE, EFFORT, GRAIN, LABELS, MARGIN, MARKS, PAPER, SIDE, SPACING, THICK, THICKNESS};

pub(super) use component::{check_degrees, checked_name};
pub(super) use given::quoted;
pub(super) use read::{KeyOf, ValueOf, read_table};

/// The options of the model with its pieces and sheets, in the order of help texts.
pub const MODEL: [&[&Entry]; 8] = [
    model::ORIENTATION,
    segmentation::ALL,
    component::ALL,
    model::SHAPE,
    nets::WIDTHS,
    sheets::PAPERS,
    nets::MARKS,
    sheets::ALL,
];

/// The options of a command that only divides the mesh.
pub const DIVISION: [&[&Entry]; 2] = [&[&UP], segmentation::ALL];

/// The options of the look and the content of files.
pub const FILES: [&[&Entry]; 2] = [&[&FOR], files::ALL];

/// The options of the assembly guide.
pub const GUIDE: [&[&Entry]; 1] = [files::GUIDE];

/// The options of animations and poses.
pub const FILM: [&[&Entry]; 1] = [film::ALL];

/// The options that choose a machine.
pub const MACHINE: [&[&Entry]; 1] = [machine::ALL];

/// All options, each before those that need it to be set first.
pub fn all() -> impl Iterator<Item = &'static Entry> {
    // A preset sets others, so that it comes first.
    let lists = [&FILES[..1], &MODEL, &FILES[1..], &GUIDE, &FILM, &MACHINE];
    lists.into_iter().flatten().flat_map(|list| list.iter().copied())
}

/// The options with a key in a table of project files, in the order of that file.
pub fn of_table(table: &str) -> impl Iterator<Item = &'static Entry> {
    all().filter(move |entry| entry.key.is_some_and(|key| key.table == table))
}
