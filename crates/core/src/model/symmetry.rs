//! Which parts of a model are mirror images of each other.

use super::PartId;
use crate::geom::{Hull, Mirror, directions};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// The mirror plane of a model, and what becomes of each part in it.
///
/// # Guarantees
/// The twin of a twin is the part itself; a part that is its own twin lies across the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetry {
    mirror: Mirror,
    twin: Vec<PartId>,
    crossing: Option<Crossing>,
}

/// Another mirror plane at a right angle to that of a model, and which parts lie across it.
#[derive(Debug, Clone, PartialEq)]
struct Crossing {
    mirror: Mirror,
    is_across: Vec<bool>,
}

/// A part that is nearer to its image than this, as a share of its size, lies across a crossing plane. Hulls of a
/// snowman miss by 0.01: its mesh was cut down, and one side has other corners. Not bounded from above by a case
/// yet.
const ALIKE: f64 = 0.03;
/// In this many directions.
const DIRECTIONS: usize = 150;

impl Symmetry {
    /// Of the twin of each part, by id; a part across the plane is its own. `None` where that is
    /// not mutual.
    pub fn new(mirror: Mirror, twin: Vec<PartId>) -> Option<Self> {
        let is_mutual = twin.iter().enumerate().all(|(part, other)| twin.get(other.0) == Some(&PartId(part)));
        is_mutual.then_some(Self { mirror, twin, crossing: None })
    }

    /// With another mirror plane at a right angle to the first: those of the hulls that are almost their own images in
    /// it become so exactly.
    #[must_use]
    pub fn crossed(self, mirror: Mirror, hulls: &mut [Hull]) -> Self {
        let plane = *mirror.plane();
        let is_alike = |hull: &Hull| {
            // The support function of the image exceeds that of the hull, in the image of the direction, by this.
            let beyond = |d: DVec3| 2.0 * plane.offset() * plane.normal().dot(d);
            let off = |d: DVec3| hull.support(d) - hull.support(mirror.direction(d)) - beyond(d);
            let off_mm = directions(DIRECTIONS).map(|d| off(d).abs()).fold(0.0, f64::max);
            off_mm < ALIKE * libm::cbrt(hull.volume())
        };
        let mut is_across: Vec<bool> = hulls.iter().map(is_alike).collect();
        for part in 0..hulls.len() {
            is_across[part] &= is_across[self.twin[part].0];
        }
        let crossed = Self { crossing: Some(Crossing { mirror, is_across }), ..self };
        crossed.make_alike(hulls, &(0..hulls.len()).map(PartId).collect());
        crossed
    }

    /// The same of parts after a motion, or a change of size.
    #[must_use]
    pub fn moved(&self, motion: &DAffine3) -> Self {
        let moved = |crossing: &Crossing| Crossing {
            mirror: crossing.mirror.moved(motion),
            is_across: crossing.is_across.clone(),
        };
        let crossing = self.crossing.as_ref().map(moved);
        Self { mirror: self.mirror.moved(motion), twin: self.twin.clone(), crossing }
    }

    /// The reflection.
    pub fn mirror(&self) -> &Mirror {
        &self.mirror
    }

    /// The twin of each part.
    pub fn twins(&self) -> &[PartId] {
        &self.twin
    }

    /// The mirror image of a part, which may be the part itself.
    pub fn twin(&self, part: PartId) -> PartId {
        self.twin[part.0]
    }

    /// Whether a part is its own mirror image.
    pub fn is_across(&self, part: PartId) -> bool {
        self.twin(part) == part
    }

    /// The mirror plane at a right angle to the first that a part lies across, if any.
    pub fn crossing(&self, part: PartId) -> Option<&Mirror> {
        self.crossing.as_ref().filter(|crossing| crossing.is_across[part.0]).map(|crossing| &crossing.mirror)
    }

    /// The mirror planes that all of these parts lie across.
    pub(super) fn mirrors_across(&self, parts: &[PartId]) -> Vec<Mirror> {
        let own = parts.iter().all(|&p| self.is_across(p)).then_some(self.mirror);
        let crossing = parts.iter().map(|&p| self.crossing(p)).reduce(|a, b| a.and(b)).flatten();
        own.into_iter().chain(crossing.copied()).collect()
    }

    /// Of each two twins the first, and all parts across the mirror plane.
    pub fn representatives(&self) -> Vec<PartId> {
        (0..self.twin.len()).map(PartId).filter(|part| *part <= self.twin(*part)).collect()
    }

    /// Gives a part another hull, and its twin the image.
    pub fn set(&self, hulls: &mut [Hull], part: PartId, hull: Hull) {
        let twin = self.twin(part);
        if twin != part {
            hulls[twin.0] = hull.reflected(&self.mirror);
        }
        hulls[part.0] = hull;
    }

    /// Makes hulls that are almost mirror images of each other, or of themselves, exactly so. Those that are so but for
    /// what is `changed` keep their corners to the last bit.
    pub(super) fn make_alike(&self, hulls: &mut [Hull], changed: &BTreeSet<PartId>) {
        let is_changed = |part: &PartId| changed.contains(part) || changed.contains(&self.twin(*part));
        let alike = |part: PartId| {
            let symmetrized = |hull: Hull, mirror: Mirror| mirror.symmetrized(&hull).unwrap_or(hull);
            (part, self.mirrors_across(&[part]).into_iter().fold(hulls[part.0].clone(), symmetrized))
        };
        let alike: Vec<(PartId, Hull)> =
            self.representatives().into_par_iter().filter(is_changed).map(alike).collect();
        alike.into_iter().for_each(|(part, hull)| self.set(hulls, part, hull));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Plane;

    /// Two balls on a line, of which one has a nose: the other lies across a second plane.
    #[test]
    fn parts_without_a_nose_lie_across_a_second_plane() {
        let ball = |x: f64| directions(80).map(move |d| 10.0 * d + DVec3::new(x, 2.0, 3.0));
        let nose = DVec3::new(20.0, 16.0, 3.0);
        let mut hulls = [
            Hull::of_points(&ball(0.0).collect::<Vec<_>>()).unwrap(),
            Hull::of_points(&ball(20.0).chain([nose]).collect::<Vec<_>>()).unwrap(),
        ];
        let across = |normal: DVec3| Mirror::new(Plane::through(DVec3::new(0.0, 2.0, 3.0), normal).unwrap());
        let first = Symmetry::new(across(DVec3::Z), vec![PartId(0), PartId(1)]).unwrap();
        let crossed = first.crossed(across(DVec3::Y), &mut hulls);
        assert_eq!([0, 1].map(PartId).map(|part| crossed.crossing(part).is_some()), [true, false]);
        assert_eq!([0, 1].map(PartId).map(|part| crossed.mirrors_across(&[part]).len()), [2, 1]);
        assert_eq!(crossed.mirrors_across(&[PartId(0), PartId(1)]).len(), 1);
        for d in directions(50) {
            let image = crossed.crossing(PartId(0)).unwrap().direction(d);
            let centre = DVec3::new(0.0, 2.0, 3.0);
            let from = |d: DVec3| hulls[0].support(d) - centre.dot(d);
            assert!((from(d) - from(image)).abs() < 1e-9);
        }
    }

    #[test]
    fn only_what_changed_and_its_twin_is_made_alike() {
        let ball = |x: f64, radius: f64| {
            let points: Vec<DVec3> = directions(60).map(|d| radius * d + DVec3::X * x).collect();
            Hull::of_points(&points).unwrap()
        };
        let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
        let symmetry = Symmetry::new(mirror, vec![PartId(0), PartId(2), PartId(1)]).unwrap();
        // No direction of a ball has an exact image, nor is either twin the other's.
        let before = [ball(0.0, 5.0), ball(-20.0, 5.0), ball(20.0, 4.0)];
        let mut hulls = before.clone();
        symmetry.make_alike(&mut hulls, &BTreeSet::from([PartId(2)]));
        assert_eq!([&hulls[0], &hulls[1]], [&before[0], &before[1]]);
        assert_eq!(hulls[2], before[1].reflected(&mirror));
        symmetry.make_alike(&mut hulls, &BTreeSet::from([PartId(0)]));
        assert_ne!(hulls[0], before[0]);
        assert!(
            directions(50)
                .all(|d| (hulls[0].support(d) - hulls[0].support(mirror.direction(d))).abs() < 1e-9)
        );
    }

    #[test]
    fn twins_are_mutual() {
        let mirror = Mirror::new(Plane::horizontal(1.0));
        let symmetry = |twin: &[usize]| Symmetry::new(mirror, twin.iter().copied().map(PartId).collect());
        assert!(
            symmetry(&[0, 2, 1]).is_some_and(|s| s.is_across(PartId(0)) && s.twin(PartId(1)) == PartId(2))
        );
        for twin in [&[1, 2, 0][..], &[0, 0], &[3, 1, 2]] {
            assert_eq!(symmetry(twin), None);
        }
    }
}
