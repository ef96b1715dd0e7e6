//! A small 3D renderer: flat polygons in space become a [`Drawing`](crate::drawing::Drawing), so
//! that every back end shows the same picture.
//!
//! A [`Scene`] holds convex planar faces, a [`View`] says from where they are seen and how large.
//! What hides what is exact: faces are sorted, and where need be cut, by a BSP tree. The model's y
//! axis points up in the picture.

mod best_view;
mod bsp;
mod callouts;
mod leaders;
pub mod light;
mod mesh;
mod orbit;
pub mod palette;
mod part_map;
mod parts;
mod picture;
mod proxy;
mod prune;
mod scene;
mod shadow;
mod view;
pub mod zbuffer;

pub use best_view::{Spot, best_view, clearness};
pub use callouts::callouts;
pub use leaders::Callout;
pub use orbit::{Eye, Orbit};
pub use part_map::{PartMap, Place};
pub use parts::{PartsPictureError, parts_picture};
pub use picture::{Look, picture};
pub use proxy::{Proxy, proxy};
pub use prune::seen;
pub use scene::{Edge, Face, Scene, SceneError};
pub use shadow::contact_shadow;
pub use view::{Camera, View, ViewError};
