//! Which parts of a model are mirror images of each other.

use crate::geom::{Hull, Mirror};

/// The mirror plane of a model, and what becomes of each part in it.
///
/// # Guarantees
/// The twin of a twin is the part itself; a part that is its own twin lies across the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetry {
    mirror: Mirror,
    twin: Vec<usize>,
}

impl Symmetry {
    /// Of the twin of each part, by index; a part across the plane is its own. `None` where that is
    /// not mutual.
    pub fn new(mirror: Mirror, twin: Vec<usize>) -> Option<Self> {
        let is_mutual = twin.iter().enumerate().all(|(part, &other)| twin.get(other) == Some(&part));
        is_mutual.then_some(Self { mirror, twin })
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

    /// Makes hulls that are almost mirror images of each other, or of themselves, exactly so.
    pub(super) fn make_alike(&self, hulls: &mut [Hull]) {
        for part in 0..hulls.len() {
            let twin = self.twin(part);
            if twin > part {
                hulls[twin] = hulls[part].reflected(&self.mirror);
            } else if twin == part
                && let Ok(hull) = self.mirror.symmetrized(&hulls[part])
            {
                hulls[part] = hull;
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
