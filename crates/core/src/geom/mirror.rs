//! Reflection in a plane.

use super::Plane;
use glam::{DAffine3, DVec3};

/// Reflection in a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mirror {
    plane: Plane,
}

impl Mirror {
    /// The reflection in `plane`.
    pub fn new(plane: Plane) -> Self {
        Self { plane }
    }

    /// The reflection in the plane after a motion, or a change of size.
    #[must_use]
    pub fn moved(&self, motion: &DAffine3) -> Self {
        Self { plane: self.plane.moved(motion) }
    }

    /// The plane that stays where it is.
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// The image of a point.
    pub fn point(&self, point: DVec3) -> DVec3 {
        point - self.plane.normal() * (2.0 * self.plane.distance(point))
    }

    /// The image of a direction.
    pub fn direction(&self, direction: DVec3) -> DVec3 {
        direction - self.plane.normal() * (2.0 * self.plane.normal().dot(direction))
    }

    /// The part of a direction that lies in the plane.
    pub fn along(&self, direction: DVec3) -> DVec3 {
        direction - self.plane.normal() * self.plane.normal().dot(direction)
    }

    /// The image of a plane; what was behind it is behind its image.
    pub fn image(&self, plane: &Plane) -> Plane {
        let normal = self.direction(plane.normal());
        let point = self.point(plane.normal() * plane.offset());
        // A reflection keeps lengths, so there always is such a plane.
        Plane::through(point, normal).unwrap_or(*plane)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::geom) fn mirror() -> Mirror {
        Mirror::new(Plane::through(DVec3::new(3.0, -1.0, 2.0), DVec3::new(0.3, 1.0, -0.4)).unwrap())
    }

    pub(in crate::geom) fn points(seed: u64, count: usize) -> Vec<DVec3> {
        let mut random = fastrand::Rng::with_seed(seed);
        (0..count).map(|_| DVec3::from_array([(); 3].map(|()| random.f64() * 20.0 - 10.0))).collect()
    }

    #[test]
    fn an_image_of_a_plane_has_the_images_of_its_points() {
        let mirror = mirror();
        for p in points(2, 30) {
            let plane = Plane::through(p, p.cross(DVec3::new(1.0, 2.0, 5.0))).unwrap();
            let image = mirror.image(&plane);
            for q in points(3, 10) {
                assert!((plane.distance(q) - image.distance(mirror.point(q))).abs() < 1e-12);
            }
        }
    }
}
