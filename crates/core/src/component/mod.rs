//! One flat-foldable component: convex ones fitted to hulls (§4.2–4.4), and drawn ones of any shape.

mod angles;
mod assemble;
mod assemble_error;
mod boards;
mod convert;
mod convert_error;
mod direction;
pub mod distance;
mod even;
mod filling;
mod fit;
mod gradient;
mod grow;
mod layer;
mod likeness;
mod linearize;
#[cfg(test)]
mod mirror_tests;
mod panel;
mod profile;
mod qp;
mod search;
mod seated;
mod shape;
mod solid;
mod spans;
mod start;
mod straight;
mod symmetry;
mod target;
mod tolerance;
mod walls;
mod worth;

pub use assemble_error::AssembleError;
pub use convert::{Component, Finished, choose, convert, finished};
pub use convert_error::ConvertError;
pub use direction::PrincipalAxis;
pub use filling::Filling;
pub use panel::{ChainId, Hinge, HingeId, HingeSide, Panel, PanelId, PanelKind, PanelSet};
pub use profile::{Fold, Profile, ProfileError};
pub(crate) use solid::side_normal;
pub use solid::{Chain, FaceId, SideFacet, Solid};
pub use symmetry::{Crossing, Symmetry, Turning};
pub use target::{JointTarget, Seat, Target};
pub use tolerance::{Counts, fewest};
