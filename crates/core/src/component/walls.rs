//! The walls of a component: chains of panels extruded from profiles along the edges of the top
//! panel and trimmed with one another. At height v the component is { x : n_j·x <= u_j(v) }.

use super::panel::ChainId;
use super::profile::Profile;
use super::shape::section_corner;
use super::symmetry::Symmetry;
use glam::DVec2;

/// Profiles with the directions of their edges.
///
/// # Guarantees
/// As many profiles as directions, at least three; directions go round counter-clockwise; all
/// profiles begin at one height and end at one height.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Walls {
    normals: Vec<DVec2>,
    profiles: Vec<Profile>,
    /// The plane in which they are their own mirror image.
    symmetry: Option<Symmetry>,
}

impl Walls {
    /// Takes directions of the edges' outward normals and profiles that keep the guarantees.
    pub(super) fn new(normals: Vec<DVec2>, profiles: Vec<Profile>) -> Self {
        debug_assert!(normals.len() == profiles.len() && normals.len() > 2);
        Self { normals, profiles, symmetry: None }
    }

    /// The same, known to be their own mirror image.
    pub(super) fn mirrored_in(self, symmetry: Option<Symmetry>) -> Self {
        Self { symmetry, ..self }
    }

    /// The plane in which they are their own mirror image.
    pub(super) fn symmetry(&self) -> Option<Symmetry> {
        self.symmetry
    }

    /// The images, in upright mirror planes, of the corner of chain j with the next: their chains, and
    /// whether they are reflected.
    pub(super) fn corner_images(&self, j: ChainId) -> impl Iterator<Item = (ChainId, bool)> + '_ {
        let images = move |symmetry: Symmetry| {
            let [own, next] = [j, self.next(j)].map(|k| symmetry.normals(self.normals[k.0]));
            own.zip(next).map(|(own, next)| if next.1 { next } else { own })
        };
        let chain = move |n: DVec2| {
            let along = |k: &ChainId| n.dot(self.normals[k.0]);
            self.ids().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or(j)
        };
        self.symmetry.into_iter().flat_map(images).map(move |(n, is_reflected)| (chain(n), is_reflected))
    }

    /// Number of chains.
    pub(super) fn count(&self) -> usize {
        self.normals.len()
    }

    /// The chains' ids, counter-clockwise.
    pub(super) fn ids(&self) -> impl Iterator<Item = ChainId> + use<> {
        (0..self.count()).map(ChainId)
    }

    /// Chain after chain `j`, counter-clockwise.
    pub(super) fn next(&self, j: ChainId) -> ChainId {
        ChainId((j.0 + 1) % self.count())
    }

    /// Chain before chain `j`.
    pub(super) fn previous(&self, j: ChainId) -> ChainId {
        ChainId((j.0 + self.count() - 1) % self.count())
    }

    pub(super) fn profiles(&self) -> &[Profile] {
        &self.profiles
    }

    pub(super) fn profile(&self, j: ChainId) -> &Profile {
        &self.profiles[j.0]
    }

    pub(super) fn normal(&self, j: ChainId) -> DVec2 {
        self.normals[j.0]
    }

    /// Direction of the edge, counter-clockwise round the top panel.
    pub(super) fn tangent(&self, j: ChainId) -> DVec2 {
        self.normals[j.0].perp()
    }

    pub(super) fn top_mm(&self) -> f64 {
        self.profiles[0].points()[0].y
    }

    pub(super) fn bottom_mm(&self) -> f64 {
        let points = self.profiles[0].points();
        points[points.len() - 1].y
    }

    /// Where the edge of chain j meets that of the next chain in the section at height v.
    pub(super) fn corner_at(&self, j: ChainId, v_mm: f64) -> DVec2 {
        let k = self.next(j);
        let edge = |j: ChainId| (self.normal(j), self.profile(j).u_at(v_mm));
        section_corner(edge(j), edge(k))
    }

    /// Width of chain j at height v: the length of its edge of the section there, negative where
    /// there is none.
    pub(super) fn width_at(&self, j: ChainId, v_mm: f64) -> f64 {
        self.tangent(j).dot(self.corner_at(j, v_mm) - self.corner_at(self.previous(j), v_mm))
    }

    /// The narrowest place: chain, height and width. Widths are linear between the heights of
    /// vertices, so this is exact (the exact form of Eq. (14)).
    pub(super) fn narrowest(&self) -> (ChainId, f64, f64) {
        let heights: Vec<f64> = self.profiles.iter().flat_map(|p| p.points()).map(|p| p.y).collect();
        let places = self.ids().flat_map(|j| heights.iter().map(move |&v| (j, v)));
        places
            .map(|(j, v)| (j, v, self.width_at(j, v)))
            .fold((ChainId(0), 0.0, f64::INFINITY), |least, next| if next.2 < least.2 { next } else { least })
    }
}
