//! What can be done about a warning or an error. The program words it, with the names of its settings.

/// Something that the user can do.
#[derive(Debug, Clone, PartialEq)]
pub enum Remedy {
    /// Make the model larger.
    LargerSize,
    /// Make the model smaller.
    SmallerSize,
    /// Make the model no larger than this, mm.
    SizeAtMost(f64),
    /// Use larger paper.
    LargerPaper,
    /// Use smaller paper.
    SmallerPaper,
    /// Use a smaller margin.
    SmallerMargin,
    /// Use a larger margin.
    LargerMargin,
    /// Allow more sheets.
    MoreSheets,
    /// Name the colour of each component's card.
    NameCards,
    /// Use a larger machine.
    LargerMachine,
    /// Let panels that are larger than the sheet be split.
    SplitPanels,
    /// Allow panels that are narrower than this, mm.
    NarrowerPanels(f64),
    /// Give the component fewer panels.
    FewerPanels,
    /// Let the component have more panels, or narrower ones.
    MorePanels,
    /// Fold a drawn profile in another way.
    OtherWay,
    /// Draw profiles that fold equally often.
    EqualFolds,
    /// Draw panels farther apart.
    DrawApart,
    /// Use thinner board.
    ThinnerBoard,
    /// Fold paper rather than boards.
    NoBoards,
    /// Tape a joint that is glued.
    TapeJoint,
    /// Tape two edges together from behind.
    TapeBehind,
    /// Cover an opening at a slit.
    CoverOpening,
    /// Tape a hinge that moves.
    TapeHinge,
    /// Glue a narrow tab with care.
    GlueWithCare,
    /// Fold a component with care.
    FoldWithCare,
    /// Bend two components apart while they fold.
    BendApart,
    /// Bend one of two panels aside by hand.
    BendAside,
    /// Leave out the component of this name.
    LeaveOut(String),
    /// Cut a notch into one of two components.
    CutNotch,
    /// Cut the slit between two chains wider.
    WidenSlit,
    /// Lift the top, and pull each chain past the point where it is stuck.
    LiftTop {
        /// Number of chains.
        chains: usize,
    },
    /// Pull dents outwards by hand.
    PullOutwards,
    /// Take away a pin that no piece has.
    RemovePin,
    /// Move a pin, or another one.
    MovePin,
    /// Look whether a file is the one that is meant.
    CheckFile,
    /// Print without the mesh's colours.
    NoColours,
    /// Print on both sides of the paper.
    BothSides,
    /// Send a job at the pace of the machine.
    PacedHandshake,
    /// Send a job at the pace of the machine, or let the port steer the flow.
    OtherHandshake,
    /// Look whether a port has the speed of the machine.
    CheckSpeed,
}

/// Gives an enum of warnings the codes of its variants: the list of them, and the match, which the
/// compiler checks for completeness.
#[macro_export]
macro_rules! codes {
    ($warning:ident { $($variant:ident => $code:literal),+ $(,)? }) => {
        impl $warning {
            /// The codes of all variants.
            pub const CODES: &'static [&'static str] = &[$($code),+];

            /// Short constant name, for programs.
            pub fn code(&self) -> &'static str {
                match self { $(Self::$variant { .. } => $code),+ }
            }
        }
    };
}
