//! Results.

use super::bodies::Touching;
use super::{Error, Hulls, Options, Warning};
use glam::DAffine3;
use std::sync::Arc;
use tatamu_core::fold::FoldPlan;
use tatamu_core::mesh::{Mesh, MirrorPlane};
use tatamu_core::model::Model;
use tatamu_core::segment::Parts;
use tatamu_net::net::Net;
use tatamu_net::sheet::Layout;

/// A mesh at the size of the model with its parts and their hulls.
#[derive(Debug)]
pub struct Divided {
    mesh: Arc<Mesh>,
    to_model: DAffine3,
    hulls: Hulls,
    face_part: Arc<Vec<Option<u32>>>,
    part_faces: Vec<usize>,
}

impl Divided {
    /// Finds the hulls; `touching` are those of the same parts before they leave each other room, where they are known.
    pub(super) fn new(parts: Parts, to_model: DAffine3, touching: Option<Touching>) -> Result<Self, Error> {
        let hulls = match touching {
            Some(touching) => Hulls::parted(&parts, touching)?,
            None => Hulls::new(&parts)?,
        };
        let segments = parts.segmentation().face_segments();
        let face_part: Vec<Option<u32>> =
            segments.iter().map(|&segment| hulls.part_of(segment).map(|p| p as u32)).collect();
        let mut part_faces = vec![0; hulls.hulls().len()];
        face_part.iter().flatten().for_each(|&p| part_faces[p as usize] += 1);
        let (mesh, face_part) = (Arc::new(parts.into_mesh()), Arc::new(face_part));
        Ok(Self { mesh, to_model, hulls, face_part, part_faces })
    }

    /// The surface of drawn components, which nothing was divided into.
    pub(super) fn drawn(mesh: Mesh, face_part: Vec<Option<u32>>, names: Vec<String>) -> Self {
        let mut part_faces = vec![0; names.len()];
        face_part.iter().flatten().for_each(|&p| part_faces[p as usize] += 1);
        let (mesh, face_part) = (Arc::new(mesh), Arc::new(face_part));
        Self { mesh, to_model: DAffine3::IDENTITY, hulls: Hulls::drawn(names), face_part, part_faces }
    }

    /// The same parts with other hulls, or other joints between them.
    pub(super) fn with_hulls(&self, hulls: Hulls) -> Self {
        let (mesh, face_part) = (self.mesh.clone(), self.face_part.clone());
        Self { mesh, to_model: self.to_model, hulls, face_part, part_faces: self.part_faces.clone() }
    }

    /// The hulls of the parts.
    pub fn hulls(&self) -> &Hulls {
        &self.hulls
    }

    /// The mesh at the size of the model.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// From the file's coordinates to those of [`Divided::mesh`].
    pub fn to_model(&self) -> &DAffine3 {
        &self.to_model
    }

    /// The part of each face of [`Divided::mesh`]; none where its segment has no volume.
    pub fn face_parts(&self) -> &[Option<u32>] {
        &self.face_part
    }
}

/// The first half of a run: all that shows what the model will look like.
#[derive(Debug, Clone)]
pub struct Shaped {
    pub(super) options: Arc<Options>,
    pub(super) divided: Arc<Divided>,
    pub(super) model: Arc<Model>,
    /// What is to be told of the components.
    pub(super) notes: Vec<Warning>,
    /// What was done as it was asked for.
    pub(super) remarks: Vec<String>,
}

impl Shaped {
    /// What the run was asked for.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The mesh and its parts.
    pub fn divided(&self) -> &Divided {
        &self.divided
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
        self.shaped.divided.mesh()
    }

    /// From the file's coordinates to those of [`Output::mesh`].
    pub fn to_model(&self) -> &DAffine3 {
        self.shaped.divided.to_model()
    }

    /// The mirror plane of the model; none where it is not symmetric.
    pub fn mirror_plane(&self) -> Option<&MirrorPlane> {
        self.shaped.divided.hulls().mirror_plane()
    }

    /// The component of each face of [`Output::mesh`]; none where its segment became none.
    pub fn face_parts(&self) -> &[Option<u32>] {
        self.shaped.divided.face_parts()
    }

    /// Number of faces of each component's segment.
    pub fn part_faces(&self) -> &[usize] {
        &self.shaped.divided.part_faces
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

    /// What was done as the user asked for it, such as a component with dents.
    pub fn remarks(&self) -> &[String] {
        &self.shaped.remarks
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
