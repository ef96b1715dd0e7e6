//! Planes, convex hulls and polygons: the geometry that every stage shares.

pub mod eigen;
mod hull;
pub(crate) mod nearest;
mod plane;
pub mod polygon;
mod quickhull;
mod sphere;

pub use hull::{Facet, Hull, HullError};
pub use plane::Plane;
pub use sphere::directions;
