//! A mesh divided into named parts.

use super::middle::middle;
use super::solids::Solids;
use super::surface::Surface;
use super::{SegmentId, Segmentation, naming};
use crate::mesh::{Mesh, MirrorPlane};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// A mesh divided into parts with names.
///
/// # Guarantees
/// One name for each segment, all different. The parts are in the order of their area, biggest
/// first, but for the root, which is the first: one that was chosen, or the one in the middle.
#[derive(Debug, Clone, PartialEq)]
pub struct Parts {
    mesh: Arc<Mesh>,
    segmentation: Segmentation,
    names: Vec<String>,
}

impl Parts {
    /// Makes the segment in the middle the first, and names all by their place. The viewer looks
    /// along +y, with z up.
    pub fn new(mesh: Arc<Mesh>, segmentation: Segmentation) -> Self {
        let names = vec![String::new(); segmentation.count()];
        let mut parts = Self { mesh, segmentation, names }.with_root_in_the_middle();
        parts.names = naming::names(&parts.mesh, &parts.segmentation, &parts.area_shares());
        parts
    }

    /// Parts from a label for each face and a name for each label; labels without a face are
    /// dropped.
    pub(super) fn of_labels(
        mesh: Arc<Mesh>,
        labels: &[u32],
        names: &[String],
        mirror: Option<MirrorPlane>,
    ) -> Self {
        let segmentation = Segmentation::of_labels(&mesh, labels, names.len(), mirror);
        let mut ordered = vec![String::new(); segmentation.count()];
        for (id, &label) in segmentation.face_segments().iter().zip(labels) {
            let name = &mut ordered[id.0 as usize];
            if name.is_empty() {
                name.clone_from(&names[label as usize]);
            }
        }
        Self { mesh, segmentation, names: ordered }
    }

    /// The same parts with one of them first.
    pub(super) fn with_first(mut self, part: usize) -> Self {
        let renumbered = |id: usize| match id {
            _ if id == part => 0,
            _ if id < part => id as u32 + 1,
            _ => id as u32,
        };
        for id in &mut self.segmentation.face_segment {
            *id = SegmentId(renumbered(id.0 as usize));
        }
        self.names[..=part].rotate_right(1);
        self
    }

    /// The same with some parts merged, by their numbers; all parts get new names.
    #[must_use]
    pub fn fused(self, pairs: &[(usize, usize)]) -> Self {
        let mut label: Vec<u32> = (0..self.names.len() as u32).collect();
        for &(a, b) in pairs {
            let (kept, gone) = (label[a], label[b]);
            label.iter_mut().filter(|l| **l == gone).for_each(|l| *l = kept);
        }
        let of_face: Vec<u32> =
            self.segmentation.face_segments().iter().map(|id| label[id.0 as usize]).collect();
        let mirror = self.segmentation.mirror().copied();
        let segmentation = Segmentation::of_labels(&self.mesh, &of_face, label.len(), mirror);
        Self::new(self.mesh, segmentation)
    }

    /// The same parts of the mesh with all lengths times `factor`, about the origin.
    #[must_use]
    pub fn resized(&self, factor: f64) -> Self {
        let scale = DAffine3::from_scale(DVec3::splat(factor));
        let mirror = self.segmentation.mirror().map(|plane| plane.moved(&scale));
        let segmentation = self.segmentation.clone().mirrored_in(mirror);
        Self { mesh: Arc::new(self.mesh.resized(factor)), segmentation, names: self.names.clone() }
    }

    /// The same parts with the one in the middle first.
    #[must_use]
    pub fn with_root_in_the_middle(self) -> Self {
        match middle(&self.mesh, &self.segmentation, &self.area_shares()) {
            0 => self,
            part => self.with_first(part),
        }
    }

    /// The mesh. Where a part was split, its faces are cut.
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// Its segments.
    pub fn segmentation(&self) -> &Segmentation {
        &self.segmentation
    }

    /// Their names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The convex hull of each part, and where parts touch.
    pub fn solids(&self) -> Solids {
        Solids::new(&self.mesh, &self.segmentation)
    }

    /// Number of faces of each part.
    pub fn face_counts(&self) -> Vec<usize> {
        let mut counts = vec![0; self.names.len()];
        self.segmentation.face_segments().iter().for_each(|id| counts[id.0 as usize] += 1);
        counts
    }

    /// Share of the surface that each part has.
    pub fn area_shares(&self) -> Vec<f64> {
        let mut shares = vec![0.0; self.names.len()];
        let areas = Surface::face_areas(self.mesh.positions(), self.mesh.faces());
        let total: f64 = areas.iter().sum();
        for (id, area) in self.segmentation.face_segments().iter().zip(areas) {
            shares[id.0 as usize] += area / total;
        }
        shares
    }
}
