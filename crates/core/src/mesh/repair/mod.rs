//! From the polygons of a file to a clean mesh.

mod clean;
mod large;
mod loose;
mod orient;
mod triangulate;
mod warning;
mod weld;

pub use warning::MeshWarning;

use super::{Edges, Mesh, Soup};
use crate::geom::{Plane, bounds};
use glam::DVec3;

/// Vertices nearer than this share of the bounding box's diagonal are one vertex, and edges are turned
/// where triangles are lower. Bounded from below by the rounding of coordinates kept as 32-bit
/// floats (6e-8), from above by the finest detail of scans (a bunny of 70,000 faces has edges of
/// 2e-3).
const WELD: f64 = 1e-7;

/// A mesh thinner than this share of its diagonal lies in a plane.
const THIN: f64 = 1e-6;

/// Diagonals outside this range would lose their products to overflow or underflow.
const DIAGONALS: std::ops::RangeInclusive<f64> = 1e-60..=1e60;

/// What [`Mesh::from_soup`] did, and what it found and left as it is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Repairs {
    /// Polygons in the file.
    pub input_faces: usize,
    /// Vertices that were joined to another one at the same place.
    pub welded_vertices: usize,
    /// Faces that were dropped because they have no area, or fewer than three corners.
    pub degenerate_faces: usize,
    /// Faces that were dropped because another one has the same corners.
    pub duplicate_faces: usize,
    /// Bodies that were dropped because they are specks, or because there are more than a model can have.
    pub loose_bodies: usize,
    /// Triangles that were turned round to face outwards like their neighbours.
    pub flipped_faces: usize,
    /// Connected bodies or sheets (over edges).
    pub components: usize,
    /// Edges with one face: the mesh is open there.
    pub boundary_edges: usize,
    /// Edges with more than two faces.
    pub non_manifold_edges: usize,
}

/// Why polygons do not make a mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// All vertices of all faces are at one point.
    #[error("all vertices of the mesh are at the same point; export the mesh again")]
    OnePoint,
    /// The size cannot be calculated with.
    #[error(
        "the mesh measures {diagonal:e} units from corner to corner, too {} to calculate with; \
         scale it to a usual size first",
        if *diagonal < 1.0 { "small" } else { "large" }
    )]
    Extent {
        /// Diagonal of the bounding box.
        diagonal: f64,
    },
    /// Fewer triangles than a solid has.
    #[error(
        "usable triangles in the mesh: {faces}, from {input} faces in the file; a solid has at \
         least 4, so export a whole surface"
    )]
    TooFewFaces {
        /// Triangles that are left.
        faces: usize,
        /// Polygons in the file.
        input: usize,
    },
    /// All in one plane.
    #[error("the mesh is flat: all its vertices are in one plane; give it some thickness first")]
    Planar,
}

/// A triangle with the polygon that it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Triangle {
    corners: [u32; 3],
    polygon: u32,
}

impl Mesh {
    /// Makes a clean mesh of polygons: joins vertices at the same place, cuts polygons into
    /// triangles, drops triangles without area and repeated ones, turns faces to agree with their
    /// neighbours and to face outwards, and drops unused vertices.
    ///
    /// # Errors
    /// See [`MeshError`]. Open, non-manifold meshes and several bodies are no errors but counted
    /// in [`Repairs`].
    pub fn from_soup(soup: &Soup) -> Result<(Self, Repairs), MeshError> {
        let is_used = used_vertices(soup);
        let tolerance = WELD * checked_diagonal(soup, &is_used)?;
        let mut repairs = Repairs { input_faces: soup.polygon_count(), ..Repairs::default() };
        let (mut positions, of_input) = weld::weld(soup.positions(), &is_used, tolerance);
        let used_count = is_used.iter().filter(|&&used| used).count();
        repairs.welded_vertices = used_count - positions.len();
        let mut triangles = triangulate::triangulate(soup, &positions, &of_input, &mut repairs);
        clean::drop_duplicates(&mut triangles, &mut repairs);
        clean::drop_flat(&positions, &mut triangles, tolerance, &mut repairs);
        loose::drop_loose(&positions, &mut triangles, &mut repairs);
        if triangles.len() < 4 {
            return Err(MeshError::TooFewFaces { faces: triangles.len(), input: repairs.input_faces });
        }
        clean::drop_unused(&mut positions, &mut triangles);
        if is_planar(&positions) {
            return Err(MeshError::Planar);
        }
        let mut faces: Vec<[u32; 3]> = triangles.iter().map(|t| t.corners).collect();
        let edges = Edges::new(&faces);
        orient::orient(&positions, &mut faces, &edges, &mut repairs);
        let uses = |e: usize| edges.sides(e).len();
        repairs.boundary_edges = (0..edges.count()).filter(|&e| uses(e) == 1).count();
        repairs.non_manifold_edges = (0..edges.count()).filter(|&e| uses(e) > 2).count();
        let mesh = Self::of_parts(positions, faces, triangles.iter().map(|t| t.polygon).collect());
        Ok((mesh, repairs))
    }
}

/// Whether a face uses each vertex.
fn used_vertices(soup: &Soup) -> Vec<bool> {
    let mut is_used = vec![false; soup.positions().len()];
    for &v in soup.polygons().flatten() {
        is_used[v as usize] = true;
    }
    is_used
}

/// The diagonal of the bounding box of all used vertices.
fn checked_diagonal(soup: &Soup, is_used: &[bool]) -> Result<f64, MeshError> {
    let used: Vec<DVec3> =
        soup.positions().iter().zip(is_used).filter_map(|(&p, &used)| used.then_some(p)).collect();
    let (low, high) = bounds(used.iter().copied());
    let diagonal = (high - low).length();
    if used.is_empty() || low == high {
        return Err(MeshError::OnePoint);
    }
    if !DIAGONALS.contains(&diagonal) {
        return Err(MeshError::Extent { diagonal });
    }
    Ok(diagonal)
}

fn is_planar(positions: &[DVec3]) -> bool {
    let (low, high) = bounds(positions.iter().copied());
    let diagonal = low.distance(high);
    let unit: Vec<DVec3> = positions.iter().map(|&p| (p - low) / diagonal).collect();
    Plane::fit(&unit).is_none_or(|(plane, _)| {
        let heights = || unit.iter().map(|&p| plane.distance(p));
        let high = heights().fold(f64::NEG_INFINITY, f64::max);
        let low = heights().fold(f64::INFINITY, f64::min);
        high - low <= THIN
    })
}

#[cfg(test)]
mod tests;
