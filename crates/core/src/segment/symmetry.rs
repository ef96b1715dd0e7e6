//! Which segments are mirror images of each other.

use super::surface::Surface;
use super::{SegmentId, Segmentation};
use crate::geom::Mirror;
use crate::geom::points::PointTree;
use crate::mesh::Mesh;
use glam::{DAffine3, DVec3};
use std::collections::BTreeMap;

/// Whether the two sides of a model are mirror images of each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SymmetryChoice {
    /// Where the mesh is symmetric.
    #[default]
    Auto,
    /// Each side by itself.
    Off,
    /// In the plane through the middle of the mesh with this normal, symmetric or not.
    Across(Axis),
}

/// A coordinate axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl Axis {
    const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// 0, 1 or 2.
    pub fn index(self) -> usize {
        self as usize
    }
}

impl SymmetryChoice {
    /// All, in the order in which they are offered.
    pub const ALL: [Self; 5] =
        [Self::Auto, Self::Off, Self::Across(Axis::X), Self::Across(Axis::Y), Self::Across(Axis::Z)];

    /// The name by which users choose it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Off => "off",
            Self::Across(Axis::X) => "x",
            Self::Across(Axis::Y) => "y",
            Self::Across(Axis::Z) => "z",
        }
    }

    /// The same for a mesh that was turned so that its axes lie along others.
    #[must_use]
    pub fn moved(self, motion: &DAffine3) -> Self {
        match self {
            Self::Across(axis) => {
                let normal = motion.transform_vector3(DVec3::AXES[axis.index()]);
                Self::Across(Axis::ALL[normal.abs().max_position()])
            }
            other => other,
        }
    }
}

/// Most faces of each segment that are compared.
const FACES: usize = 600;

/// What faces as the image of a face does is at most this far from it, as a share of the size. Of a fin in the mirror plane
/// that is a sheet, or thin, nothing near its image faces the same way, and a fish with such a fin had no twins. Not bounded
/// from above by a case.
pub(super) const FAR: f64 = 0.025;

/// The twin of each segment, where all have one.
pub(super) fn twins(segmentation: &Segmentation, mesh: &Mesh, mirror: &Mirror) -> Option<Vec<SegmentId>> {
    let segments = segmentation.face_segments();
    let mut faces: Vec<Vec<usize>> = vec![Vec::new(); segmentation.count()];
    segments.iter().enumerate().for_each(|(f, id)| faces[id.0 as usize].push(f));
    let spread = |own: &Vec<usize>| {
        let every = own.len().div_ceil(FACES).max(1);
        let start = every / 2;
        own.iter().skip(start).step_by(every).copied().collect::<Vec<_>>()
    };
    let faces: Vec<usize> = faces.iter().flat_map(spread).collect();
    let compared: Vec<[u32; 3]> = faces.iter().map(|&f| mesh.faces()[f]).collect();
    let areas = Surface::face_areas(mesh.positions(), &compared);
    let corners: Vec<[DVec3; 3]> = faces.iter().map(|&f| mesh.corners(f)).collect();
    let centre = |k: usize| corners[k].iter().sum::<DVec3>() / 3.0;
    let normal = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
    let tree = PointTree::new((0..faces.len()).map(|k| (centre(k), k as u32)).collect());
    let far_mm = FAR * mesh.diagonal_mm();
    let mut votes = Votes::new(segmentation.count());
    for k in 0..faces.len() {
        let (image, outwards) = (mirror.point(centre(k)), mirror.direction(normal(corners[k])));
        let is_same_side = |other: u32| normal(corners[other as usize]).dot(outwards) > 0.0;
        let facing = tree.nearest_within(image, far_mm, is_same_side);
        if let Some(other) = facing.or_else(|| tree.nearest(image, |_| true)) {
            votes.add(segments[faces[k]].0, segments[faces[other as usize]].0, areas[k]);
        }
    }
    Some(votes.twins()?.into_iter().map(SegmentId).collect())
}

/// How much of each set's image lies on each other.
pub(super) struct Votes {
    of_set: Vec<BTreeMap<u32, f64>>,
}

impl Votes {
    /// Empty lists for `sets` sets.
    pub fn new(sets: usize) -> Self {
        Self { of_set: vec![BTreeMap::new(); sets] }
    }

    /// Counts an area of a set whose image is on another.
    pub fn add(&mut self, set: u32, image: u32, area: f64) {
        *self.of_set[set as usize].entry(image).or_insert(0.0) += area;
    }

    /// The set that most of a set's image is on; `None` where nothing was counted.
    pub fn most(&self, set: usize) -> Option<u32> {
        let votes = self.of_set[set].iter();
        votes.max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(a.0))).map(|(&set, _)| set)
    }

    /// The set that most of each one's image is on; `None` where that is not mutual.
    pub fn twins(&self) -> Option<Vec<u32>> {
        let twins: Option<Vec<u32>> = (0..self.of_set.len()).map(|set| self.most(set)).collect();
        twins.filter(|twins| (0..).zip(twins).all(|(set, &twin)| twins[twin as usize] == set))
    }
}
