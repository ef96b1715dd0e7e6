//! Development nets: which hinges are cut, tabs, labels, joint marks.
//!
//! ```text
//! PanelSet -> cuts -> layout -> tabs -> mesh of each piece -> contour, labels -> marks
//! ```
//!
//! Panels are a graph: top panel, chains, bottom panel. A net of one piece is a spanning tree of
//! it: one chain stays whole, each other chain is cut at one hinge and glued there by a tab. Where
//! a panel had to be split to fit the sheet the graph is any graph, and pieces are grown.

mod blank;
mod blank_net;
mod chains;
pub mod check;
mod contour;
mod cuts;
mod develop;
mod divide;
mod draft;
mod extent;
mod finish;
mod forest;
mod glue;
mod hand;
mod labels;
pub mod layout;
mod marks;
mod mesh;
mod net_error;
mod of_model;
mod options;
mod plugs;
mod ruling;
mod split;
mod tabs;
mod warning;

pub use blank::Blank;
pub use blank_net::BlankNet;
pub use develop::{alternatives, develop};
pub(crate) use labels::{CLEARLY_MM, line_to, upright};

pub use hand::{EdgeChoice, EdgeName, HandFault, NetHand, PIECES, TAB_WIDTHS_MM, TabSide};
pub use marks::{LabelPlace, Side};
pub use mesh::{Corner, Edge, EdgeKind, Face, FaceKind, PieceMesh, Vertex};
pub use net_error::NetError;
pub use of_model::{KnownNets, NetsError, develop_model, label_letters};
pub use options::{Naming, NetChoices, NetOptions};
pub use plugs::PlugLines;
pub use warning::NetWarning;

use glam::{DAffine2, DVec2};
use std::collections::BTreeMap;
use tatamu_core::component::{HingeId, PanelId, PanelKind, PanelSet};

/// One panel at its place in the development of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedPanel {
    /// The panel.
    pub panel: PanelId,
    /// What it is.
    pub kind: PanelKind,
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
    /// Trapezoid in the piece's coordinates, counter-clockwise; the first edge is the hinge.
    pub outline: [DVec2; 4],
    /// The same in the plane coordinates of the mate, behind which it is glued.
    pub on_mate: [DVec2; 4],
    /// The label that stands on the tab and inside its mate.
    pub label: String,
}

impl Tab {
    /// Its width, from the hinge to its far edge, mm.
    pub fn width_mm(&self) -> f64 {
        let [start, end, far, _] = self.outline;
        (end - start).normalize_or_zero().perp_dot(far - start).abs()
    }
}

/// The outline of a panel that lies on this one (or that this one lies on).
#[derive(Debug, Clone, PartialEq)]
pub struct JointMark {
    /// The panel that carries the mark.
    pub panel: PanelId,
    /// Convex outline of the partner in the panel's plane coordinates, counter-clockwise.
    pub outline: Vec<DVec2>,
    /// The point, in the panel's plane coordinates, to which the orientation mark points. Both
    /// partners name the same point of the model, off the middle of the outline.
    pub key: DVec2,
    /// Text: the partner's name.
    pub text: String,
    /// A shorter text, where the name has no room: the letter that the partner's labels begin with.
    pub short: String,
    /// What is cut there; none where the two are glued.
    pub plug: Option<PlugLines>,
}

/// A joint mark at its place on a piece.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedJoint {
    /// The panel that carries it.
    pub panel: PanelId,
    /// The part of the partner's outline that lies on the panel, in the piece's coordinates.
    pub outline: Vec<DVec2>,
    /// Triangle whose first corner points to the key: the two partners' tips meet when joined.
    pub key: [DVec2; 3],
    /// Whether it is glued; else it is plugged in.
    pub is_glued: bool,
}

/// What a label is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LabelKind {
    /// Of a tab.
    Tab,
    /// Of the panel behind which a tab is glued.
    Mate,
    /// Name of a joint's partner.
    Joint,
    /// Name of the piece.
    Name,
    /// Where the component is pushed down so that it folds flat: its top panel.
    Push,
    /// Angle of a crease in the deployed state.
    Angle,
}

/// A thin line from a text that had no room where it belongs to that place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leader {
    /// Index of the text among the piece's labels.
    pub label: usize,
    /// Beside the text.
    pub from: DVec2,
    /// The place that the text is about.
    pub to: DVec2,
}

/// Where glue or tape goes: along a panel's cut edge, behind it unless that is said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlueArea {
    /// The cut hinge.
    pub hinge: HingeId,
    /// Trapezoid in the piece's coordinates, counter-clockwise seen from outside; the first edge
    /// is the hinge.
    pub outline: [DVec2; 4],
    /// Whether it is on the outer face: the tape of a valley between boards.
    pub is_outside: bool,
}

/// A text on a piece.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// What it is for.
    pub kind: LabelKind,
    /// What it says.
    pub text: String,
    /// Middle of the base line, in the piece's coordinates.
    pub anchor: DVec2,
    /// Turn, counter-clockwise, radians.
    pub angle_rad: f64,
    /// Height of a capital, mm.
    pub cap_height_mm: f64,
    /// Length of the text, mm.
    pub width_mm: f64,
    /// Paper between the text and the frame round it, mm; 0 without a frame.
    pub frame_mm: f64,
}

/// One connected cut-out.
///
/// # Guarantees
/// No two faces (panels and tabs) overlap; the bounding box starts at the origin and, as it is,
/// fits the sheet that the net was made for; the outline is one closed walk.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    blank: Blank,
    joints: Vec<PlacedJoint>,
    labels: Vec<Label>,
    leaders: Vec<Leader>,
    unplaced_labels: Vec<String>,
}

impl Piece {
    /// The piece without its texts.
    pub fn blank(&self) -> &Blank {
        &self.blank
    }

    /// `head 1/2`, or `head` where there is only one.
    pub fn name(&self) -> &str {
        self.blank.name()
    }

    /// Its panels.
    pub fn panels(&self) -> &[PlacedPanel] {
        &self.blank.panels
    }

    /// Hinges that stay joined in it.
    pub fn creases(&self) -> &[HingeId] {
        &self.blank.creases
    }

    /// Its tabs.
    pub fn tabs(&self) -> &[Tab] {
        &self.blank.tabs
    }

    /// What lies on its panels.
    pub fn joints(&self) -> &[PlacedJoint] {
        &self.joints
    }

    /// Texts on it.
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// Lines from texts that stand elsewhere to what they are about.
    pub fn leaders(&self) -> &[Leader] {
        &self.leaders
    }

    /// Where tabs come to lie behind its panels, if that was asked for, and where tape goes.
    pub fn glue_areas(&self) -> &[GlueArea] {
        &self.blank.glue_areas
    }

    /// Texts that found no place on it; they must be listed on the sheet.
    pub fn unplaced_labels(&self) -> &[String] {
        &self.unplaced_labels
    }

    /// Panels and tabs as faces that share vertices where paper joins them.
    pub fn mesh(&self) -> &PieceMesh {
        &self.blank.mesh
    }

    /// The outer contour of panels and tabs, counter-clockwise: what nesting has to place.
    pub fn outline(&self) -> &[DVec2] {
        self.blank.outline()
    }

    /// Cuts that lie inside the outline: slits whose two sides touch.
    pub fn slits(&self) -> &[Vec<DVec2>] {
        &self.blank.slits
    }

    /// Lines of joints that can be unplugged.
    pub fn plugs(&self) -> &[PlugLines] {
        &self.blank.plugs
    }

    /// Length of everything that is cut, mm.
    pub fn cut_mm(&self) -> f64 {
        let outline: f64 =
            tatamu_core::geom::polygon::edges(self.outline()).map(|(a, b)| a.distance(b)).sum();
        let plugs = self.blank.plugs.iter().flat_map(|plug| &plug.cuts);
        let slits = self.blank.slits.iter().chain(plugs).flat_map(|slit| slit.windows(2));
        outline + slits.map(|w| w[0].distance(w[1])).sum::<f64>()
    }

    /// Length of everything that is folded, mm: hinges, and the bases of tabs and plugs.
    pub fn crease_mm(&self) -> f64 {
        self.blank.crease_lines.iter().map(marks::Crease::length_mm).sum()
    }

    /// Width and height of the bounding box, mm.
    pub fn size_mm(&self) -> DVec2 {
        tatamu_core::geom::polygon::bounds(self.outline().iter().copied())
            .map_or(DVec2::ZERO, |(lo, hi)| hi - lo)
    }
}

/// All pieces of one component.
#[derive(Debug, Clone, PartialEq)]
pub struct Net {
    pieces: Vec<Piece>,
    warnings: Vec<NetWarning>,
    labels: BTreeMap<HingeId, String>,
    set: PanelSet,
    source: Vec<PanelId>,
}

impl Net {
    /// The pieces, most panels first.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The panels that its ids mean: the component's own, but for those that were split to fit
    /// the sheet. The first part of a split panel has the panel's id.
    pub fn panels(&self) -> &PanelSet {
        &self.set
    }

    /// The component's panel of which a panel of [`Net::panels`] is, or is a part. Both have the
    /// same plane coordinates.
    pub fn source(&self, panel: PanelId) -> PanelId {
        self.source[panel.0]
    }

    /// What to tell the user.
    pub fn warnings(&self) -> &[NetWarning] {
        &self.warnings
    }

    /// The label of a cut hinge; none for one that stays joined.
    pub fn label(&self, hinge: HingeId) -> Option<&str> {
        self.labels.get(&hinge).map(String::as_str)
    }
}
