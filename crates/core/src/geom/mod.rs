//! Planes, convex hulls and polygons: the geometry that every stage shares.

mod bounds;
pub mod eigen;
mod flat;
mod hull;
mod mirror;
pub(crate) mod motion;
pub mod nearest;
mod plane;
pub(crate) mod points;
pub mod polygon;
mod quickhull;
mod sphere;
mod symmetrized;

pub use bounds::bounds;
pub use flat::{FlatSide, Patch};
pub use hull::{Facet, Hull, HullError};
pub use mirror::Mirror;
pub use plane::Plane;
pub use sphere::directions;
