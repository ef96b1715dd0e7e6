//! Results.

use super::merge::Merge;
use super::{Options, Source, Warning};
use glam::DAffine3;
use std::sync::Arc;
use tatamu_core::fold::FoldPlan;
use tatamu_core::mesh::{Mesh, MirrorPlane};
use tatamu_core::model::Model;
use tatamu_net::net::Net;
use tatamu_net::sheet::Layout;

/// The first half of a run: all that shows what the model will look like.
#[derive(Debug, Clone)]
pub struct Shaped {
    pub(super) options: Arc<Options>,
    pub(super) source: Source,
    pub(super) model: Arc<Model>,
    /// Warnings about the components.
    pub(super) notes: Vec<Warning>,
    /// What was done without a warning, such as a merge, and how to undo it.
    pub(super) remarks: Vec<String>,
    /// Parts that were made one.
    pub(super) merges: Vec<Merge>,
}

impl Shaped {
    /// What the run was asked for.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// What the components are made from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The components in their places.
    pub fn model(&self) -> &Model {
        &self.model
    }
}

/// The result of all stages.
#[derive(Debug, Clone)]
pub struct Output {
    pub(super) shaped: Shaped,
    pub(super) fold_plan: Arc<FoldPlan>,
    pub(super) nets: Arc<Vec<Net>>,
    pub(super) layout: Arc<Layout>,
    pub(super) warnings: Arc<Vec<Warning>>,
}

impl Output {
    /// What the run was asked for.
    pub fn options(&self) -> &Options {
        &self.shaped.options
    }

    /// The first half of the run.
    pub fn shaped(&self) -> &Shaped {
        &self.shaped
    }

    /// The mesh at the size of the model.
    pub fn mesh(&self) -> &Mesh {
        self.shaped.source.mesh()
    }

    /// From the file's coordinates to those of [`Output::mesh`].
    pub fn to_model(&self) -> DAffine3 {
        self.shaped.source.to_model()
    }

    /// The mirror plane of the model; none where it is not symmetric.
    pub fn mirror_plane(&self) -> Option<&MirrorPlane> {
        self.shaped.source.parts()?.mirror_plane()
    }

    /// The component of each face of [`Output::mesh`]; none where its segment became none.
    pub fn face_parts(&self) -> &[Option<u32>] {
        self.shaped.source.face_parts()
    }

    /// Number of faces of each component's segment.
    pub fn part_faces(&self) -> &[usize] {
        self.shaped.source.part_faces()
    }

    /// The components in their places.
    pub fn model(&self) -> &Model {
        &self.shaped.model
    }

    /// How the model folds.
    pub fn fold_plan(&self) -> &FoldPlan {
        &self.fold_plan
    }

    /// Their nets, in the same order.
    pub fn nets(&self) -> &[Net] {
        &self.nets
    }

    /// The pieces on their sheets.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// What was done without a warning, such as a component with dents or a merge.
    pub fn remarks(&self) -> &[String] {
        &self.shaped.remarks
    }

    /// Names of parts that were merged because they clash or lack glue as two: with these merges among the
    /// edits of the options, the same model comes out.
    pub fn merges(&self) -> &[Vec<String>] {
        &self.shaped.merges
    }

    /// With the order of folding, and what that means for the user.
    pub(super) fn with_plan(self, fold_plan: Arc<FoldPlan>) -> Self {
        let folding = fold_plan.warnings(self.model()).into_iter().map(Warning::from);
        let warnings = self.warnings.iter().cloned().chain(folding).collect();
        Self { fold_plan, warnings: Arc::new(warnings), ..self }
    }

    /// With one warning more.
    pub(super) fn with_warning(self, warning: Warning) -> Self {
        let warnings = self.warnings.iter().cloned().chain([warning]).collect();
        Self { warnings: Arc::new(warnings), ..self }
    }

    /// What the user should know.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }
}
