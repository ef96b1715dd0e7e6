//! One flat-foldable component: convex ones fitted to hulls (§4.2–4.4), and drawn ones of any shape.

mod assemble;
mod boards;
mod convert;
mod direction;
pub mod distance;
mod fit;
mod gradient;
mod grow;
mod layer;
mod likeness;
mod panel;
mod profile;
mod qp;
mod rows;
mod search;
mod seated;
mod shape;
mod solid;
mod spans;
mod start;
mod target;
mod tolerance;
mod walls;

pub use assemble::AssembleError;
pub use convert::{Component, ConvertError, choose, convert};
pub use direction::PrincipalAxis;
pub use panel::{Hinge, HingeId, HingeSide, Panel, PanelId, PanelKind, PanelSet};
pub use profile::{Fold, Profile, ProfileError};
pub use solid::{Chain, Clearance, Corner, FaceId, SideFacet, Solid};
pub use target::{JointTarget, Seat, Target};
pub use tolerance::fewest;
