//! What the user should know about a mesh that was repaired, with the number of each.

use super::Repairs;
use crate::codes;
use crate::remedy::Remedy;
use std::fmt;

/// What the repair found and did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshWarning {
    /// Edges with one face.
    OpenEdges(usize),
    /// Edges with more than two faces.
    NonManifoldEdges(usize),
    /// Bodies besides the first.
    SeveralBodies(usize),
    /// Faces without area, which were dropped.
    DegenerateFaces(usize),
    /// Repeated faces, which were dropped.
    DuplicateFaces(usize),
    /// Bodies that are too small or too many, which were dropped.
    LooseBodies(usize),
    /// Faces that faced inwards, and were turned.
    FlippedFaces(usize),
}

codes!(MeshWarning {
    OpenEdges => "open_edges",
    NonManifoldEdges => "non_manifold_edges",
    SeveralBodies => "several_bodies",
    DegenerateFaces => "degenerate_faces",
    DuplicateFaces => "duplicate_faces",
    LooseBodies => "loose_bodies",
    FlippedFaces => "flipped_faces",
});

impl Repairs {
    /// What the user should know.
    pub fn warnings(&self) -> Vec<MeshWarning> {
        let all = [
            MeshWarning::OpenEdges(self.boundary_edges),
            MeshWarning::NonManifoldEdges(self.non_manifold_edges),
            MeshWarning::SeveralBodies(self.components.saturating_sub(1)),
            MeshWarning::DegenerateFaces(self.degenerate_faces),
            MeshWarning::DuplicateFaces(self.duplicate_faces),
            MeshWarning::LooseBodies(self.loose_bodies),
            MeshWarning::FlippedFaces(self.flipped_faces),
        ];
        all.into_iter().filter(|warning| warning.count() > 0).collect()
    }
}

impl MeshWarning {
    /// None: the mesh was repaired as well as it can be.
    pub fn remedies(self) -> Vec<Remedy> {
        Vec::new()
    }

    /// How many there are.
    pub fn count(self) -> usize {
        match self {
            Self::OpenEdges(count)
            | Self::NonManifoldEdges(count)
            | Self::SeveralBodies(count)
            | Self::DegenerateFaces(count)
            | Self::DuplicateFaces(count)
            | Self::LooseBodies(count)
            | Self::FlippedFaces(count) => count,
        }
    }
}

impl fmt::Display for MeshWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, effect) = match self {
            Self::OpenEdges(_) => ("open edges", "thickness near them is a guess"),
            Self::NonManifoldEdges(_) => {
                ("edges with more than two faces", "components may be divided there")
            }
            Self::SeveralBodies(_) => ("bodies besides the first", "joined where they touch"),
            Self::DegenerateFaces(_) => ("faces without area", "dropped"),
            Self::DuplicateFaces(_) => ("repeated faces", "dropped"),
            Self::LooseBodies(_) => ("bodies that are too small or too many", "dropped"),
            Self::FlippedFaces(_) => ("faces that faced inwards", "turned"),
        };
        write!(f, "the mesh has {what}: {} ({effect})", self.count())
    }
}
