//! What benchmarks are given.

use tatamu::mesh::{self, Mesh};

/// The mesh of a file; none where it is not one that can be made.
pub fn read(path: &str) -> Option<Mesh> {
    let soup = mesh::read(&std::fs::read(path).ok()?).ok()?;
    Some(Mesh::from_soup(&soup).ok()?.0)
}
