//! Parts, as the model takes them.

use crate::component::{ConvertError, Filling};
use crate::geom::{Hull, Plane};
use crate::progress::Cancelled;
use std::sync::Arc;

/// What the user may set for one part.
#[derive(Debug, Clone, PartialEq)]
pub struct PartOptions {
    /// Name.
    pub name: String,
    /// Angle of the fold axis about the hull's first principal axis; found when not given.
    pub direction_rad: Option<f64>,
    /// Number of top edges; see [`PartOptions::most_top_edges`].
    pub top_edges: usize,
    /// Most vertices of a profile.
    pub profile_vertices: usize,
    /// Distance from the hull that is close enough; then the two numbers above are the most that
    /// is used, and as few are used as will do.
    pub tolerance_mm: Option<f64>,
    /// A panel that makes the component less alike by less than this share of its size, the cube root of
    /// its volume, is left out; 0 keeps all.
    pub panel_worth: f64,
    /// Size below which panels are made fewer rather than smaller, mm.
    pub comfortable_mm: f64,
}

/// With this many top edges, a shape that is its own mirror image has a ridge opposite a panel, and looks pointed: heads of
/// people. With one more for seven, too, a teddy has 11 panels more and looks the same.
const POINTED_EDGES: usize = 5;

impl PartOptions {
    /// The most top edges of a component: one more where it is a `mirrored_end`, its own mirror image with one joint, and would
    /// look pointed opposite that. A number that the user set, with all panels kept, stands.
    pub fn most_top_edges(&self, mirrored_end: bool) -> usize {
        let is_pointed = mirrored_end && self.top_edges == POINTED_EDGES && self.panel_worth > 0.0;
        self.top_edges + usize::from(is_pointed)
    }
}

/// One segment to become a component.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Convex hull of the segment, in the mesh's scaled axes.
    pub hull: Hull,
    /// What of it is solid, in the same axes; nothing where all of it counts.
    pub filling: Option<Arc<Filling>>,
    /// Planes beyond which other parts are that it is not joined to, in the same axes, normals outwards.
    pub borders: Vec<Plane>,
    /// The user's wishes.
    pub options: PartOptions,
}

/// Why no model could be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// A component failed.
    #[error("component \"{name}\": {error}")]
    Component {
        /// Its name.
        name: String,
        /// What went wrong.
        error: ConvertError,
    },
    /// A joint panel got lost in the conversion.
    #[error("component \"{0}\" has no panel for its joint; give it another direction or more top edges")]
    NoJointPanel(String),
    /// The user stopped the work.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
