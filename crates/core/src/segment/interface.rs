//! Where two segments meet (§4.2.1).

use super::forest::Forest;
use super::{SegmentId, Segmentation};
use crate::geom::{Plane, eigen};
use crate::mesh::Mesh;
use glam::DVec3;
use std::collections::BTreeMap;

/// The border of two neighbouring segments.
#[derive(Debug, Clone, PartialEq)]
pub struct Interface {
    vertices: Vec<u32>,
    length: f64,
    loops: usize,
}

impl Interface {
    /// Vertices on the border (indices into `mesh.positions()`), in ascending order.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// Length of the common border, in the mesh's unit.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Number of connected pieces of the border; 1 is what paper likes.
    pub fn pieces(&self) -> usize {
        self.loops
    }

    /// The least-squares plane of the border's vertices and the root mean square of their
    /// distances from it; `None` where the vertices lie on one line.
    pub fn plane(&self, mesh: &Mesh) -> Option<(Plane, f64)> {
        let points: Vec<DVec3> = self.vertices.iter().map(|&v| mesh.positions()[v as usize]).collect();
        fit_plane(&points)
    }
}

/// All interfaces, the smaller id first.
pub(super) fn interfaces(
    segmentation: &Segmentation,
    mesh: &Mesh,
) -> BTreeMap<(SegmentId, SegmentId), Interface> {
    let mut edges: BTreeMap<(SegmentId, SegmentId), Vec<[u32; 2]>> = BTreeMap::new();
    for (faces, edge) in super::surface::edge_pairs(mesh.faces()) {
        let [a, b] = faces.map(|f| segmentation.face_segments()[f as usize]);
        if a != b {
            edges.entry((a.min(b), a.max(b))).or_default().push(edge);
        }
    }
    edges.into_iter().map(|(pair, edges)| (pair, Interface::of_edges(mesh, edges))).collect()
}

impl Interface {
    fn of_edges(mesh: &Mesh, mut edges: Vec<[u32; 2]>) -> Self {
        edges.sort_unstable();
        edges.dedup();
        let mut vertices: Vec<u32> = edges.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let length = edges.iter().map(|e| {
            let [a, b] = e.map(|v| mesh.positions()[v as usize]);
            a.distance(b)
        });
        Self { length: length.sum(), loops: count_pieces(&vertices, &edges), vertices }
    }
}

fn count_pieces(vertices: &[u32], edges: &[[u32; 2]]) -> usize {
    let mut forest = Forest::new(vertices.len());
    for edge in edges {
        forest.join(edge.map(|v| vertices.binary_search(&v).unwrap_or(0) as u32));
    }
    forest.roots().len()
}

/// Least-squares plane and the root mean square of the distances from it; `None` for points on
/// one line.
pub(super) fn fit_plane(points: &[DVec3]) -> Option<(Plane, f64)> {
    let (values, vectors) = eigen::symmetric(eigen::covariance(points));
    if points.len() < 3 || values[1] <= 1e-12 * values[2] {
        return None;
    }
    let centre = points.iter().sum::<DVec3>() / points.len() as f64;
    Some((Plane::through(centre, vectors[0])?, values[0].max(0.0).sqrt()))
}

/// Root mean square distance of points along their second widest direction.
pub(super) fn spread(points: &[DVec3]) -> f64 {
    eigen::symmetric(eigen::covariance(points)).0[1].max(0.0).sqrt()
}
