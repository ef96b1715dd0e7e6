//! One flat-foldable convex component (§4.2–4.4).

mod panel;

pub use panel::{Hinge, HingeId, HingeSide, Panel, PanelId, PanelKind, PanelSet};
