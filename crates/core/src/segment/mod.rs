//! Segmentation of a mesh into few connected, nearly convex parts (§4.1).
//!
//! The shape diameter function of Shapira, Shamir and Cohen-Or (2008) is clustered and cut into
//! many patches, which are merged as long as their common convex hull leaves the solid least: each
//! segment becomes a hull of paper.

mod apart;
mod bodies;
mod choose;
mod clean;
mod coarsen;
mod contact;
mod cut;
mod details;
mod edit;
mod forest;
mod gmm;
mod grid;
mod halves;
mod hollow;
mod interface;
mod maxflow;
mod merge;
mod middle;
mod naming;
mod overlap;
mod parts;
mod patches;
mod plates;
mod refine;
mod rough_hull;
mod sdf;
#[cfg(test)]
mod shapes;
mod sheets;
mod slices;
mod smooth;
mod solids;
mod stage;
mod surface;
mod symmetry;
#[cfg(test)]
mod tests;
mod through;

pub use edit::{Edit, EditError};
pub use grid::Interior;
pub use interface::Interface;
pub use overlap::{Overlap, overlap};
pub use parts::Parts;
pub use solids::{Details, Solids};
pub use stage::segment;
pub use symmetry::{Axis, SymmetryChoice};

use self::surface::Surface;
use crate::mesh::{Mesh, MirrorPlane};
use crate::progress::Cancelled;
use std::collections::BTreeMap;

/// A segment, numbered from 0; [`segment`] gives the biggest surface the first number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SegmentId(pub u32);

/// How segments are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Patches merged by the growth of their hulls.
    Merge,
    /// The paper's: every connected component of a label is a segment.
    Sdf {
        /// Number of Gaussians, 1 to 32.
        clusters: usize,
        /// Weight of the borders, 0 or more.
        smoothing: f64,
    },
}

impl Method {
    /// Clusters of the paper's own method that do well on most meshes.
    pub const CLUSTERS: usize = 5;
    /// Smoothing of the paper's own method that does well on most meshes.
    pub const SMOOTHING: f64 = 0.3;
}

/// What the user can ask for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentOptions {
    /// Number of segments; `None` finds it. Only [`Method::Merge`] uses it.
    pub parts: Option<usize>,
    /// Where the number is found: from 0, few parts, to 1, many.
    pub detail: f64,
    /// How segments are found.
    pub method: Method,
    /// Whether the segments are mirror images of each other. Only [`Method::Merge`] uses it.
    pub symmetry: SymmetryChoice,
}

impl Default for SegmentOptions {
    fn default() -> Self {
        Self { parts: None, detail: 0.5, method: Method::Merge, symmetry: SymmetryChoice::Auto }
    }
}

/// Why there is no segmentation.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SegmentError {
    /// The mesh has no faces.
    #[error("the mesh has no faces")]
    Empty,
    /// The mesh lies in one plane.
    #[error("the mesh is flat: all of it is in one plane, so it has no solid parts")]
    Flat,
    /// A number of parts that cannot be.
    #[error("{0} parts are not possible; use 1 to {MOST_PARTS}")]
    Parts(usize),
    /// A detail that cannot be.
    #[error("the detail is {0}; it must be from 0 to 1")]
    Detail(f64),
    /// Settings of the method by SDF alone that cannot be.
    #[error(
        "{clusters} clusters with smoothing {smoothing} are not possible; use 1 to {MOST_CLUSTERS} clusters and a \
         smoothing of 0 or more"
    )]
    Clusters {
        /// Number of Gaussians.
        clusters: usize,
        /// Weight of the borders.
        smoothing: f64,
    },
    /// Stopped by the user.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// More parts than this are not made.
pub const MOST_PARTS: usize = 200;

/// More clusters than this are not fitted.
pub const MOST_CLUSTERS: usize = 32;

impl SegmentOptions {
    fn check(&self) -> Result<(), SegmentError> {
        if let Some(parts) = self.parts
            && !(1..=MOST_PARTS).contains(&parts)
        {
            return Err(SegmentError::Parts(parts));
        }
        if !(0.0..=1.0).contains(&self.detail) {
            return Err(SegmentError::Detail(self.detail));
        }
        if let Method::Sdf { clusters, smoothing } = self.method
            && !((1..=MOST_CLUSTERS).contains(&clusters) && (0.0..f64::INFINITY).contains(&smoothing))
        {
            return Err(SegmentError::Clusters { clusters, smoothing });
        }
        Ok(())
    }
}

/// A partition of a mesh's faces.
///
/// # Guarantees
/// One id for each face of the mesh; ids are `0..count`; each is used.
#[derive(Debug, Clone, PartialEq)]
pub struct Segmentation {
    face_segment: Vec<SegmentId>,
    count: usize,
    mirror: Option<MirrorPlane>,
}

impl Segmentation {
    /// Numbers the sets of faces by falling area, sets of equal area by their first face.
    fn numbered(set_of_face: &[u32], sets: usize, face_areas: &[f64]) -> Self {
        let mut ranking: Vec<(f64, usize, usize)> = vec![(0.0, usize::MAX, 0); sets];
        for (f, &s) in set_of_face.iter().enumerate() {
            let rank = &mut ranking[s as usize];
            *rank = (rank.0 + face_areas[f], rank.1.min(f), s as usize);
        }
        ranking.retain(|r| r.1 != usize::MAX);
        ranking.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut id = vec![SegmentId(0); sets];
        for (i, &(_, _, set)) in ranking.iter().enumerate() {
            id[set] = SegmentId(i as u32);
        }
        let face_segment = set_of_face.iter().map(|&s| id[s as usize]).collect();
        Self { face_segment, count: ranking.len(), mirror: None }
    }

    /// The same of the faces of a mesh, with the mirror plane that they were made for.
    fn of_labels(mesh: &Mesh, labels: &[u32], sets: usize, mirror: Option<MirrorPlane>) -> Self {
        let areas = Surface::face_areas(mesh.positions(), mesh.faces());
        Self::numbered(labels, sets, &areas).mirrored_in(mirror)
    }

    /// The number of the segment of each face.
    fn labels(&self) -> Vec<u32> {
        self.face_segment.iter().map(|id| id.0).collect()
    }

    /// The segment of each face.
    pub fn face_segments(&self) -> &[SegmentId] {
        &self.face_segment
    }

    /// Number of segments.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The same segments, with the mirror plane that they were made for.
    #[must_use]
    fn mirrored_in(self, mirror: Option<MirrorPlane>) -> Self {
        Self { mirror, ..self }
    }

    /// The mirror plane that the segments were made for.
    pub fn mirror(&self) -> Option<&MirrorPlane> {
        self.mirror.as_ref()
    }

    /// The mirror image of each segment, itself for one across the mirror plane; `None` where there
    /// is no plane, or where some segment has no image, as after a change by hand to one side.
    ///
    /// # Guarantees
    /// The twin of a twin is the segment itself.
    pub fn twins(&self, mesh: &Mesh) -> Option<Vec<SegmentId>> {
        symmetry::twins(self, mesh, &self.mirror?.mirror)
    }

    /// Vertices (indices into `mesh.positions()`) on the interface of each pair of neighbouring
    /// segments, the smaller id first, in ascending order (§4.2.1).
    pub fn interfaces(&self, mesh: &Mesh) -> BTreeMap<(SegmentId, SegmentId), Vec<u32>> {
        self.borders(mesh).into_iter().map(|(pair, i)| (pair, i.vertices().to_vec())).collect()
    }

    /// The interface of each pair of neighbouring segments with its length and plane.
    pub fn borders(&self, mesh: &Mesh) -> BTreeMap<(SegmentId, SegmentId), Interface> {
        interface::interfaces(self, mesh)
    }
}
