//! Development nets: which hinges are cut, tabs, labels, joint marks.

use crate::component::{HingeId, PanelId};
use glam::{DAffine2, DVec2};

/// One panel at its place in the development of a piece.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedPanel {
    /// The panel.
    pub panel: PanelId,
    /// Rigid motion (no mirror) from the panel's plane coordinates to the piece's.
    pub place: DAffine2,
}

/// A glue flap on a cut hinge.
#[derive(Debug, Clone, PartialEq)]
pub struct Tab {
    /// The cut hinge.
    pub hinge: HingeId,
    /// Which of the hinge's two sides carries the tab (0 or 1); the other panel is its mate.
    pub side: usize,
    /// Convex outline in the piece's coordinates, counter-clockwise; the first edge is the hinge.
    pub outline: Vec<DVec2>,
    /// The label that stands on the tab and inside its mate.
    pub label: String,
}

/// The outline of a panel that is glued on this one (or that this one is glued on).
#[derive(Debug, Clone, PartialEq)]
pub struct JointMark {
    /// The panel that carries the mark.
    pub panel: PanelId,
    /// Outline of the partner in the panel's plane coordinates.
    pub outline: Vec<DVec2>,
    /// Text: the partner's name.
    pub text: String,
}

/// One connected cut-out.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// `head 1/2`
    pub name: String,
    /// Its panels.
    pub panels: Vec<PlacedPanel>,
    /// Its tabs.
    pub tabs: Vec<Tab>,
}

/// All pieces of one component.
#[derive(Debug, Clone, PartialEq)]
pub struct Net {
    /// The pieces, biggest first.
    pub pieces: Vec<Piece>,
}
