//! Segmentation of a mesh into few connected, nearly convex parts (§4.1).

use crate::mesh::Mesh;

/// A segment, numbered from 0, biggest surface first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SegmentId(pub u32);

/// A partition of a mesh's faces.
///
/// # Guarantees
/// One id for each face of the mesh; ids are `0..count`; each is used.
#[derive(Debug, Clone, PartialEq)]
pub struct Segmentation {
    face_segment: Vec<SegmentId>,
    count: usize,
}

impl Segmentation {
    /// The segment of each face.
    pub fn face_segments(&self) -> &[SegmentId] {
        &self.face_segment
    }

    /// Number of segments.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Vertices (indices into `mesh.positions()`) on the interface of each pair of neighbouring
    /// segments, the smaller id first, in ascending order (§4.2.1).
    pub fn interfaces(&self, mesh: &Mesh) -> std::collections::BTreeMap<(SegmentId, SegmentId), Vec<u32>> {
        let _ = mesh;
        todo!()
    }
}
