//! Mesh in, foldable model out: the geometry of **tatamu**, without paper, files or pictures.

pub mod colour;
pub mod component;
pub mod design;
pub mod fold;
pub mod geom;
pub mod memory;
pub mod mesh;
pub mod model;
pub mod progress;
pub mod segment;
pub mod units;
