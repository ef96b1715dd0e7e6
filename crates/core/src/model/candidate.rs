//! A part's candidates: finished components in several fold directions, each with its joint planes.

use super::seat::Snap;
use super::{ModelPart, Part, PartId, Symmetry};
use crate::component::{Component, PanelId, PrincipalAxis};
use crate::geom::Plane;
use glam::{DAffine3, DMat3, DVec3};
use std::sync::Arc;

/// In a search for firm joints these count this many times as much: with 1 nine joints of a scorpion are weak, with 6
/// four. Not bounded from above by a case yet.
const FIRMNESS: f64 = 6.0;
/// Set in the ids of mirror images.
const IMAGE: u64 = 1 << 63;
/// Directions nearer to a mirror plane than this lie in it.
pub(super) const IN_PLANE: f64 = 1e-6;

/// A part's component in one fold direction, before it is placed.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    /// Unlike that of every other candidate that one [`super::Known`] has made.
    pub(super) id: u64,
    pub(super) component: Arc<Component>,
    /// From the component's axes to the mesh's.
    pub(super) frame: DAffine3,
    pub(super) direction_rad: f64,
    /// Whether it is its own image in the mirror plane of the model.
    pub(super) is_own_image: bool,
    /// What the shape costs by itself, mm of error.
    pub(super) cost_mm: f64,
    /// Joint planes in the mesh's axes, outwards, and the panels on them: by the other part.
    pub(super) joints: Vec<(PartId, Plane, PanelId)>,
}

impl Candidate {
    /// The mirror image, for the twin of its part.
    pub(super) fn mirrored(&self, symmetry: &Symmetry, twin: &Part) -> Self {
        let mirror = symmetry.mirror();
        let (component, ids) = self.component.mirrored();
        let column = |k: usize| mirror.direction(self.frame.matrix3.col(k));
        let frame = DAffine3::from_mat3_translation(
            DMat3::from_cols(-column(0), column(1), column(2)),
            mirror.point(self.frame.translation),
        );
        let joint = |&(other, plane, panel): &(PartId, Plane, PanelId)| {
            (symmetry.twin(other), mirror.image(&plane), ids[panel.0])
        };
        let principal = PrincipalAxis::of_hull(&twin.hull);
        Self {
            id: self.id | IMAGE,
            component: Arc::new(component),
            frame,
            direction_rad: principal.angle_rad(frame.transform_vector3(DVec3::Z)),
            is_own_image: self.is_own_image,
            cost_mm: self.cost_mm,
            joints: self.joints.iter().map(joint).collect(),
        }
    }

    /// Whether one of the two was made as the image of the other.
    pub(super) fn is_image_of(&self, other: &Self) -> bool {
        self.id ^ other.id == IMAGE
    }

    pub(super) fn joint(&self, other: PartId) -> Option<(Plane, PanelId)> {
        self.joints.iter().find(|j| j.0 == other).map(|j| (j.1, j.2))
    }

    /// The part before it is placed.
    pub(super) fn unplaced(&self, part: &Part) -> ModelPart {
        ModelPart {
            name: part.options.name.clone(),
            component: self.component.clone(),
            frame: self.frame,
            placement: DAffine3::IDENTITY,
            flat: DAffine3::from_translation(DVec3::Z * -self.component.bottom_mm()),
            direction_rad: self.direction_rad,
            joint: None,
        }
    }

    /// Corners of a panel in the mesh's axes.
    pub(super) fn panel_outline(&self, panel: PanelId) -> Vec<DVec3> {
        let panel = self.component.panels().panel(panel);
        panel.deployed_outline().into_iter().map(|p| self.frame.transform_point3(p)).collect()
    }
}

/// How far the search for the candidates of a part goes; each goes on from what the one before it has found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Search {
    /// Directions about the longest axis.
    Promising,
    /// That axis, too: the part bumps into another.
    Wide,
    /// In all of them joints count more, too: one of the part's joints is weak.
    Firm,
}

impl Search {
    /// The search that this one goes on from.
    pub(super) fn before(self) -> Option<Self> {
        match self {
            Self::Promising => None,
            Self::Wide => Some(Self::Promising),
            Self::Firm => Some(Self::Wide),
        }
    }

    /// How many times as much joints count.
    pub(super) fn firmness(self) -> f64 {
        if self == Self::Firm { FIRMNESS } else { 1.0 }
    }

    /// How far planes are turned to be seated.
    pub(super) fn snap(self) -> Snap {
        if self == Self::Firm { Snap::NARROW } else { Snap::WIDE }
    }
}
