//! Reading a triangle mesh from any common file and making it clean.

use glam::DVec3;

/// A clean triangle mesh.
///
/// # Guarantees
/// * every coordinate is finite;
/// * every face has three different vertices, and no two faces have the same three;
/// * every vertex belongs to a face;
/// * within each connected component all faces have a consistent orientation where the surface
///   allows one, outwards for closed components.
///
/// It may still be open, non-manifold or in several bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    positions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    input_face: Vec<u32>,
}

impl Mesh {
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
}

#[cfg(test)]
impl Mesh {
    /// A mesh as it is, unchecked, for the tests of other modules.
    pub(crate) fn for_tests(positions: Vec<DVec3>, faces: Vec<[u32; 3]>) -> Self {
        let input_face = (0..faces.len() as u32).collect();
        Self { positions, faces, input_face }
    }
}
