//! Triangle meshes: from the polygons of a file to a repaired mesh.
//!
//! ```text
//! bytes -> read -> Soup (polygons as in the file) -> Mesh::from_soup -> Mesh -> Mesh::scaled
//! ```

mod cut;
mod edges;
mod placement;
mod repair;
mod soup;
mod symmetry;
mod views;

pub use edges::Edges;
pub use placement::Up;
pub use repair::{MeshError, MeshWarning, Repairs};
pub use soup::{Soup, SoupError};
pub use symmetry::MirrorPlane;
pub use views::{Cover, Outlines, Views};

use crate::geom::bounds;
use glam::DVec3;

/// A clean triangle mesh.
///
/// # Guarantees
/// * every coordinate is finite;
/// * every face has three different vertices, and no two faces have the same three;
/// * every vertex belongs to a face;
/// * there are at least four faces, and not all vertices are in one plane;
/// * within each connected component all faces have a consistent orientation where the surface
///   allows one, outwards for closed components.
///
/// It may still be open, non-manifold or in several bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    positions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    input_face: Vec<u32>,
    bounds: (DVec3, DVec3),
}

impl Mesh {
    /// The caller keeps the guarantees.
    fn of_parts(positions: Vec<DVec3>, faces: Vec<[u32; 3]>, input_face: Vec<u32>) -> Self {
        let bounds = bounds(positions.iter().copied());
        Self { positions, faces, input_face, bounds }
    }

    /// Vertex positions.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Vertex indices of each face, counter-clockwise seen from outside.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// For each face, the index of the polygon in the input file that it comes from.
    pub fn input_faces(&self) -> &[u32] {
        &self.input_face
    }

    /// Corners of face `f`.
    pub fn corners(&self, f: usize) -> [DVec3; 3] {
        self.faces[f].map(|v| self.positions[v as usize])
    }

    /// The edges, and which faces meet at each.
    pub fn edges(&self) -> Edges {
        Edges::new(&self.faces)
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        self.bounds
    }

    /// Diagonal of the bounding box; millimetres once the mesh is scaled.
    pub fn diagonal_mm(&self) -> f64 {
        let (low, high) = self.bounds;
        low.distance(high)
    }

    /// Gives labels of faces to the polygons of the input file: to each the label of most of its
    /// area, the smaller label where two are equal, `None` to a polygon without a face.
    ///
    /// `labels` has one entry for each face, which may be `None`; `input_count` is
    /// [`Repairs::input_faces`].
    pub fn labels_of_input(&self, labels: &[Option<u32>], input_count: usize) -> Vec<Option<u32>> {
        let area = |f: usize| {
            let [a, b, c] = self.corners(f);
            (b - a).cross(c - a).length()
        };
        let mut parts: Vec<(u32, Option<u32>, f64)> = (0..self.faces.len())
            .zip(labels)
            .map(|(f, &label)| (self.input_face[f], label, area(f)))
            .collect();
        parts.sort_by_key(|&(input, label, _)| (input, label));
        let mut best = vec![None; input_count];
        for of_input in parts.chunk_by(|a, b| a.0 == b.0) {
            let sums = of_input.chunk_by(|a, b| a.1 == b.1).map(|of_label| {
                let sum: f64 = of_label.iter().map(|part| part.2).sum();
                (of_label[0].1, sum)
            });
            let largest = sums.reduce(|best, next| if next.1 > best.1 { next } else { best });
            if let Some(slot) = best.get_mut(of_input[0].0 as usize) {
                *slot = largest.and_then(|(label, _)| label);
            }
        }
        best
    }

    /// Signed volume; meaningful for closed meshes, where it is positive for an outward
    /// orientation.
    pub fn volume(&self) -> f64 {
        let (low, high) = self.bounds;
        let centre = low.midpoint(high);
        let six = |[a, b, c]: [DVec3; 3]| (a - centre).dot((b - centre).cross(c - centre));
        (0..self.faces.len()).map(|f| six(self.corners(f))).sum::<f64>() / 6.0
    }
}

#[cfg(test)]
impl Mesh {
    /// A mesh as it is, unchecked, for the tests of other modules.
    pub(crate) fn for_tests(positions: Vec<DVec3>, faces: Vec<[u32; 3]>) -> Self {
        let input_face = (0..faces.len() as u32).collect();
        Self::of_parts(positions, faces, input_face)
    }
}
