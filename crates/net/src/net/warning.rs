//! What the maker of a net should know.

use std::fmt;
use tatamu_core::codes;
use tatamu_core::component::PanelKind;
use tatamu_core::remedy::Remedy;

/// Something about a net that its maker should know.
#[derive(Debug, Clone, PartialEq)]
pub enum NetWarning {
    /// A tab is narrower than can be glued well.
    NarrowTab {
        /// Its label.
        label: String,
        /// Its width.
        width_mm: f64,
    },
    /// A cut hinge has no room for a tab on either side: both edges carry this label, and the place
    /// for a strip of tape behind them.
    NoTab {
        /// The label.
        label: String,
    },
    /// A fold hinge is cut and glued.
    CutFoldHinge {
        /// Its label.
        label: String,
    },
    /// A panel is larger than the sheet and was split.
    SplitPanel {
        /// The component.
        name: String,
        /// The panel.
        panel: PanelKind,
        /// Number of its parts.
        parts: usize,
    },
    /// A label had no room on its piece.
    UnplacedLabel {
        /// The piece.
        piece: String,
        /// The text.
        text: String,
    },
}

codes!(NetWarning {
    NarrowTab => "narrow_tab",
    NoTab => "no_tab",
    CutFoldHinge => "cut_fold_hinge",
    SplitPanel => "split_panel",
    UnplacedLabel => "unplaced_label",
});

impl NetWarning {
    /// What can be done by hand.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::NarrowTab { .. } => vec![Remedy::GlueWithCare],
            Self::NoTab { .. } => vec![Remedy::TapeBehind],
            Self::CutFoldHinge { .. } => vec![Remedy::TapeHinge],
            Self::SplitPanel { .. } | Self::UnplacedLabel { .. } => Vec::new(),
        }
    }
}

impl fmt::Display for NetWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NarrowTab { label, width_mm } => write!(f, "tab {label} is only {width_mm:.1} mm wide"),
            Self::NoTab { label } => write!(f, "there is no room for a tab at {label}"),
            Self::CutFoldHinge { label } => write!(f, "the hinge at {label} folds flat and is cut"),
            Self::SplitPanel { name, panel, parts } => {
                write!(f, "{name}: {panel} is larger than the sheet and is glued from {parts} parts")
            }
            Self::UnplacedLabel { piece, text } => {
                write!(f, "the label {text} has no room on {piece}; it is listed on its sheet")
            }
        }
    }
}
