//! Which parts of a model are mirror images of each other.

use crate::geom::{Hull, Mirror};
use glam::DVec3;

/// The mirror plane of a model, and what becomes of each part in it.
///
/// # Guarantees
/// The twin of a twin is the part itself; a part that is its own twin lies across the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetry {
    mirror: Mirror,
    twin: Vec<usize>,
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

impl Symmetry {
    /// Of the twin of each part, by index; a part across the plane is its own. `None` where that is
    /// not mutual.
    pub fn new(mirror: Mirror, twin: Vec<usize>) -> Option<Self> {
        let is_mutual = twin.iter().enumerate().all(|(part, &other)| twin.get(other) == Some(&part));
        is_mutual.then_some(Self { mirror, twin, crossing: None })
    }

    /// With another mirror plane at a right angle to the first: those of the hulls that are almost their own images in
    /// it become so exactly.
    #[must_use]
    pub fn crossed(self, mirror: Mirror, hulls: &mut [Hull]) -> Self {
        let is_alike = |hull: &Hull| {
            let far = |p: &DVec3| {
                hull.facets().iter().map(|f| f.plane().distance(mirror.point(*p))).fold(0.0, f64::max)
            };
            hull.vertices().iter().map(far).fold(0.0, f64::max) < ALIKE * libm::cbrt(hull.volume())
        };
        let mut is_across: Vec<bool> = hulls.iter().map(is_alike).collect();
        for part in 0..hulls.len() {
            is_across[part] &= is_across[self.twin(part)];
        }
        let crossed = Self { crossing: Some(Crossing { mirror, is_across }), ..self };
        crossed.make_alike(hulls);
        crossed
    }

    /// The reflection.
    pub fn mirror(&self) -> &Mirror {
        &self.mirror
    }

    /// The twin of each part.
    pub fn twins(&self) -> &[usize] {
        &self.twin
    }

    /// The mirror image of a part, which may be the part itself.
    pub fn twin(&self, part: usize) -> usize {
        self.twin[part]
    }

    /// Whether a part is its own mirror image.
    pub fn is_across(&self, part: usize) -> bool {
        self.twin[part] == part
    }

    /// The mirror plane at a right angle to the first that a part lies across, if any.
    pub fn crossing(&self, part: usize) -> Option<&Mirror> {
        self.crossing.as_ref().filter(|crossing| crossing.is_across[part]).map(|crossing| &crossing.mirror)
    }

    /// The mirror planes that all of these parts lie across.
    pub(super) fn mirrors_across(&self, parts: &[usize]) -> Vec<Mirror> {
        let own = parts.iter().all(|&p| self.is_across(p)).then_some(self.mirror);
        let crossing = parts.iter().map(|&p| self.crossing(p)).reduce(|a, b| a.and(b)).flatten();
        own.into_iter().chain(crossing.copied()).collect()
    }

    /// Makes hulls that are almost mirror images of each other, or of themselves, exactly so.
    pub(super) fn make_alike(&self, hulls: &mut [Hull]) {
        for part in 0..hulls.len() {
            let twin = self.twin(part);
            if twin < part {
                continue;
            }
            for mirror in self.mirrors_across(&[part]) {
                if let Ok(hull) = mirror.symmetrized(&hulls[part]) {
                    hulls[part] = hull;
                }
            }
            if twin > part {
                hulls[twin] = hulls[part].reflected(&self.mirror);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Plane;

    #[test]
    fn twins_are_mutual() {
        let mirror = Mirror::new(Plane::horizontal(1.0));
        assert!(Symmetry::new(mirror, vec![0, 2, 1]).is_some_and(|s| s.is_across(0) && s.twin(1) == 2));
        for twin in [vec![1, 2, 0], vec![0, 0], vec![3, 1, 2]] {
            assert_eq!(Symmetry::new(mirror, twin), None);
        }
    }
}
