//! Planes, convex hulls and polygons: the geometry that every stage shares.

pub mod eigen;
mod hull;
mod plane;
pub mod polygon;
mod quickhull;

pub use hull::{Facet, Hull, HullError};
pub use plane::Plane;
