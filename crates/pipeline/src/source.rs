//! What a model is made from: a mesh that is divided into parts, or drawn components.

use super::touching::Touching;
use super::{Error, Hulls};
use glam::{DAffine3, DVec3};
use std::sync::Arc;
use tatamu_core::geom::Hull;
use tatamu_core::mesh::{Mesh, MirrorPlane};
use tatamu_core::segment::{Details, Parts};

/// What a model is made from.
#[derive(Debug, Clone)]
pub enum Source {
    /// A mesh.
    Mesh(Arc<MeshParts>),
    /// Drawn components.
    Drawing(Arc<Drawing>),
}

impl Source {
    /// The surface at the size of the model: that of the mesh, or of the drawn components.
    pub fn mesh(&self) -> &Mesh {
        &self.surface().mesh
    }

    /// From the file's coordinates to those of [`Source::mesh`]; drawn components are where they are drawn.
    pub fn to_model(&self) -> DAffine3 {
        match self {
            Self::Mesh(parts) => parts.to_model,
            Self::Drawing(_) => DAffine3::IDENTITY,
        }
    }

    /// The names of the components before they are renamed: those that options and edits go by.
    pub fn names(&self) -> &[String] {
        match self {
            Self::Mesh(parts) => &parts.names,
            Self::Drawing(drawing) => &drawing.names,
        }
    }

    /// The hulls of the parts of a mesh, that components are made from; none for drawn components.
    pub fn hulls(&self) -> &[Hull] {
        self.parts().map_or(&[], |parts| &parts.hulls)
    }

    /// The parts of a mesh; none for drawn components.
    pub(super) fn parts(&self) -> Option<&MeshParts> {
        match self {
            Self::Mesh(parts) => Some(parts),
            Self::Drawing(_) => None,
        }
    }

    /// The component of each face of [`Source::mesh`]; none where its segment has no volume.
    pub fn face_parts(&self) -> &[Option<u32>] {
        &self.surface().face_part
    }

    /// Number of faces of each component.
    pub fn part_faces(&self) -> &[usize] {
        &self.surface().part_faces
    }

    fn surface(&self) -> &Surface {
        match self {
            Self::Mesh(parts) => &parts.surface,
            Self::Drawing(drawing) => &drawing.surface,
        }
    }
}

/// Faces at the size of the model, each with the component that it belongs to.
#[derive(Debug, Clone)]
struct Surface {
    mesh: Arc<Mesh>,
    face_part: Arc<Vec<Option<u32>>>,
    part_faces: Vec<usize>,
}

impl Surface {
    fn new(mesh: Arc<Mesh>, face_part: Vec<Option<u32>>, parts: usize) -> Self {
        let mut part_faces = vec![0; parts];
        face_part.iter().flatten().for_each(|&part| part_faces[part as usize] += 1);
        Self { mesh, face_part: Arc::new(face_part), part_faces }
    }
}

/// A mesh with its parts and their hulls, at the size at which the model is designed.
#[derive(Debug)]
pub struct Divided {
    surface: Surface,
    to_model: DAffine3,
    hulls: Hulls,
}

impl Divided {
    /// Finds the hulls; `touching` are those of the same parts before they leave each other room, where they are known.
    pub(super) fn new(parts: &Parts, to_model: DAffine3, touching: Option<Touching>) -> Result<Self, Error> {
        let hulls = match touching {
            Some(touching) => Hulls::parted(parts, touching)?,
            None => Hulls::new(parts)?,
        };
        let segments = parts.segmentation().face_segments();
        let face_part = segments.iter().map(|&segment| hulls.part_of(segment).map(|p| p.0 as u32)).collect();
        let surface = Surface::new(parts.mesh().clone(), face_part, hulls.hulls().len());
        Ok(Self { surface, to_model, hulls })
    }

    /// The same parts with other hulls, or other joints between them.
    pub(super) fn with_hulls(&self, hulls: Hulls) -> Self {
        Self { surface: self.surface.clone(), to_model: self.to_model, hulls }
    }

    /// The hulls of the parts.
    pub fn hulls(&self) -> &Hulls {
        &self.hulls
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.surface.mesh
    }

    /// What the model was made from, with all lengths times `factor`.
    pub(super) fn resized(&self, factor: f64) -> MeshParts {
        let scale = DAffine3::from_scale(DVec3::splat(factor));
        let hulls = &self.hulls;
        let surface = match factor {
            1.0 => self.surface.clone(),
            _ => Surface { mesh: Arc::new(self.mesh().resized(factor)), ..self.surface.clone() },
        };
        MeshParts {
            surface,
            to_model: scale * self.to_model,
            names: hulls.names().to_vec(),
            hulls: hulls.hulls().iter().map(|hull| hull.moved(&scale)).collect(),
            mirror_plane: hulls.mirror_plane().map(|plane| plane.moved(&scale)),
            flat_faces: hulls.flat_faces().to_vec(),
            details: hulls.details(),
        }
    }
}

/// A mesh at the size of the model, and the parts that the model was made from.
#[derive(Debug)]
pub struct MeshParts {
    surface: Surface,
    to_model: DAffine3,
    names: Vec<String>,
    hulls: Vec<Hull>,
    mirror_plane: Option<MirrorPlane>,
    flat_faces: Vec<usize>,
    details: Details,
}

impl MeshParts {
    /// The mesh.
    pub(super) fn mesh(&self) -> &Mesh {
        &self.surface.mesh
    }

    /// The part of each of its faces; none where the segment has no volume.
    pub(super) fn face_parts(&self) -> &[Option<u32>] {
        &self.surface.face_part
    }

    /// The mirror plane of the mesh, where the hulls are mirror images of each other.
    pub(super) fn mirror_plane(&self) -> Option<&MirrorPlane> {
        self.mirror_plane.as_ref()
    }

    /// Number of faces of each segment that is flat.
    pub(super) fn flat_faces(&self) -> &[usize] {
        &self.flat_faces
    }

    /// What sticks out of the parts and was left out.
    pub(super) fn details(&self) -> Details {
        self.details
    }
}

/// Drawn components.
#[derive(Debug)]
pub struct Drawing {
    surface: Surface,
    names: Vec<String>,
}

impl Drawing {
    /// Components with these names, and the surface of their deployed panels.
    pub(super) fn new(mesh: Mesh, face_part: Vec<Option<u32>>, names: Vec<String>) -> Self {
        Self { surface: Surface::new(Arc::new(mesh), face_part, names.len()), names }
    }
}
