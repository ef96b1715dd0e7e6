//! Sentences for warnings, and for what can be done about them, with the names that a front has for its
//! settings.

use tatamu::listing;
use tatamu::pipeline::{Change, Warning};
use tatamu::plotter::profile::Handshake;
use tatamu::project::options::{
    CARD, COLOR, Entry, LEVEL, MARGIN, MIN_PANEL_WIDTH, PAPER, PARTS, PROFILE_VERTICES, SHEETS_MAX, SIDE,
    SIZE, SPLIT, THICK, TOP_EDGES,
};
use tatamu::remedy::Remedy;

/// The sentence for a warning.
pub type Say = fn(&Warning) -> String;

/// What a front calls what its user can change.
pub trait Names {
    /// An option.
    fn option(&self, option: &Entry) -> String;

    /// An option with a length, mm.
    fn length(&self, option: &Entry, mm: f64) -> String;

    /// An option whose contrary is to be undone.
    fn undo(&self, option: &Entry) -> String;

    /// Where the ways are listed in which a drawn profile can fold.
    fn list_of_ways(&self) -> &'static str;

    /// How a pin is taken away that no piece has.
    fn remove_pin(&self) -> &'static str;

    /// Where a job's handshake is chosen: one of these.
    fn handshake(&self, names: &str) -> String;

    /// Where the speed of a port is chosen.
    fn speed(&self) -> &'static str;
}

/// What was found, and what can be done about it.
pub fn warning(warning: &Warning, names: &dyn Names) -> String {
    let found = match warning {
        Warning::Trial(trial) => trial.sentence(&|change| changed(change, names)),
        _ => warning.to_string(),
    };
    with_remedies(found, &warning.remedies(), names)
}

/// A sentence, with what can be done about what it says.
pub fn with_remedies(found: String, remedies: &[Remedy], names: &dyn Names) -> String {
    let phrases: Vec<String> = remedies.iter().map(|remedy| phrase(remedy, names)).collect();
    let Some((first, others)) = phrases.split_first() else { return found };
    let others: String = others
        .iter()
        // "use a smaller margin, or larger paper"
        .map(|other| format!(", or {}", other.strip_prefix("use ").unwrap_or(other)))
        .collect();
    format!("{found}; {first}{others}")
}

/// A choice for the whole model.
fn changed(change: Change, names: &dyn Names) -> String {
    match change {
        Change::Level(level) => format!("{} {}", names.option(&LEVEL), level.name()),
        Change::TopEdges(count) => format!("{} {count}", names.option(&TOP_EDGES)),
        Change::ProfileVertices(count) => format!("{} {count}", names.option(&PROFILE_VERTICES)),
        Change::Parts(count) => format!("{} {count}", names.option(&PARTS)),
        Change::Size(mm) => names.length(&SIZE, mm),
    }
}

/// What can be done, as an imperative.
fn phrase(remedy: &Remedy, names: &dyn Names) -> String {
    let name = |option: &Entry| names.option(option);
    let by_hand = match remedy {
        Remedy::LargerSize => return format!("use a larger {}", name(&SIZE)),
        Remedy::SmallerSize => return format!("use a smaller {}", name(&SIZE)),
        Remedy::SizeAtMost(mm) => return format!("use {} at most", names.length(&SIZE, *mm)),
        Remedy::LargerPaper => return format!("use larger {}", name(&PAPER)),
        Remedy::SmallerPaper => return format!("use smaller {}", name(&PAPER)),
        Remedy::SmallerMargin => return format!("use a smaller {}", name(&MARGIN)),
        Remedy::NameCards => return format!("name the colour of each component with {}", name(&CARD)),
        Remedy::MoreSheets => return format!("allow more with {}", name(&SHEETS_MAX)),
        Remedy::LargerMargin => return format!("use a larger {}", name(&MARGIN)),
        Remedy::SplitPanels => return names.undo(&SPLIT),
        Remedy::NarrowerPanels(mm) => {
            return format!("use a smaller {} than {mm} mm", name(&MIN_PANEL_WIDTH));
        }
        Remedy::OtherWay => return format!("choose another way to fold ({})", names.list_of_ways()),
        Remedy::NoBoards => return format!("leave out {}", name(&THICK)),
        Remedy::LeaveOut(part) => return format!("leave out the part {part}"),
        Remedy::NoColours => return format!("leave out {}", name(&COLOR)),
        Remedy::BothSides => return format!("use {} both", name(&SIDE)),
        Remedy::PacedHandshake => return format!("try {}", names.handshake(Handshake::Paced.name())),
        Remedy::OtherHandshake => {
            let two = listing::with_or(&[Handshake::Paced, Handshake::RtsCts].map(Handshake::name));
            return format!("try {}", names.handshake(&two));
        }
        Remedy::CheckSpeed => return format!("check {}, the port, its parity and the cable", names.speed()),
        Remedy::LiftTop { chains } => {
            return format!("lift the top, and pull each of its {chains} chains by hand past this point");
        }
        Remedy::LargerMachine => "use a larger machine",
        Remedy::FewerPanels => "use fewer top edges or profile vertices for it",
        Remedy::MorePanels => "allow more top edges or profile vertices, or narrower panels",
        Remedy::EqualFolds => "draw profiles that fold equally often",
        Remedy::DrawApart => "draw them farther apart",
        Remedy::ThinnerBoard => "use thinner board",
        Remedy::TapeJoint => "tape it as well",
        Remedy::TapeBehind => "join its two edges with tape from behind",
        Remedy::CoverOpening => "cover it from inside with a flap of paper that is glued on one side only",
        Remedy::TapeHinge => "join it with tape so that it can move",
        Remedy::GlueWithCare => "glue it with care",
        Remedy::FoldWithCare => "fold it with care",
        Remedy::BendApart => "bend them apart a little there",
        Remedy::BendAside => "bend one of them aside by hand there",
        Remedy::CutNotch => "cut a notch into one of them there",
        Remedy::WidenSlit => "cut the slit between them wider",
        Remedy::PullOutwards => {
            "pull its dents outwards by hand, one chain after the other, or neighbouring panels collide"
        }
        Remedy::RemovePin => names.remove_pin(),
        Remedy::MovePin => "move it or another pin",
        Remedy::CheckFile => "make sure that this is the one you mean",
    };
    by_hand.to_owned()
}
