//! A mesh divided into parts, whatever the size of the model, and the changes by hand.

use super::Error;
use super::touching::{Touching, without_needless_joints};
use glam::{DAffine3, DVec3};
use std::sync::Arc;
use tatamu_core::mesh::{Mesh, Up};
use tatamu_core::progress::Progress;
use tatamu_core::segment::{self, Edit, EditError, Parts, SegmentOptions};

/// A mesh is divided at this size, mm, and what it is divided into gets that of the model: every size rounds in its own
/// way, and of 138 meshes 73 were divided otherwise at 160, 203 or 300 mm than at 200.
const DIVIDED_MM: f64 = 200.0;

/// The parts of a mesh.
#[derive(Debug, Clone)]
pub(super) struct Segmented {
    pub(super) parts: Parts,
    /// From the coordinates of the mesh as it was read.
    pub(super) to_model: DAffine3,
    /// Their hulls, where these had to be looked at.
    pub(super) touching: Option<Touching>,
}

impl Segmented {
    /// The parts before they are changed by hand, at [`DIVIDED_MM`].
    ///
    /// # Errors
    /// [`Error::Segment`], [`Error::Cancelled`].
    pub(super) fn of_mesh(
        mesh: &Mesh,
        up: Up,
        options: &SegmentOptions,
        progress: &dyn Progress,
    ) -> Result<Self, Error> {
        let (mesh, to_model) = mesh.scaled(DIVIDED_MM, up);
        let symmetry = options.symmetry.moved(&to_model);
        let wanted = SegmentOptions { symmetry, ..*options };
        let segmentation = segment::segment(&mesh, &wanted, progress)?;
        let parts = Parts::new(Arc::new(mesh), segmentation).sliced(&wanted, progress)?;
        if wanted.parts.is_some() {
            return Ok(Self { parts, to_model, touching: None });
        }
        let (parts, touching) = without_needless_joints(parts.cut_where_they_pass_through());
        Ok(Self { parts, to_model, touching: Some(touching) })
    }

    /// The same for a model of this size, mm.
    pub(super) fn at_size(self: Arc<Self>, size_mm: f64) -> Self {
        match size_mm / DIVIDED_MM {
            1.0 => Arc::unwrap_or_clone(self),
            factor => Self {
                parts: self.parts.resized(factor),
                to_model: DAffine3::from_scale(DVec3::splat(factor)) * self.to_model,
                touching: self.touching.as_ref().map(|touching| touching.resized(factor)),
            },
        }
    }

    /// The same after changes by hand, with the part of this name as the root.
    ///
    /// # Errors
    /// [`EditError`].
    pub(super) fn edited(self, edits: &[Edit], root: Option<&str>) -> Result<Self, EditError> {
        if edits.is_empty() && root.is_none() {
            return Ok(self);
        }
        let Self { mut parts, to_model, .. } = self;
        for edit in edits {
            parts = parts.edited(&edit.moved(&to_model))?;
        }
        parts = match root {
            Some(root) => parts.with_root(root)?,
            None => parts.with_root_in_the_middle(),
        };
        Ok(Self { parts, to_model, touching: None })
    }
}
