//! Hulls that are their own mirror images.

use super::{Hull, HullError, Mirror, bounds};
use glam::DVec3;

/// Corners nearer to the mirror plane, or to one another's images, than this share of the hull's
/// size are on it, or images: rounding leaves 1e-15 of the size, clipping 1e-12; corners that are
/// different are farther than 1e-9 from each other.
const ON_PLANE: f64 = 1e-9;

/// Rounds in which corners without an image are left out.
const ROUNDS: usize = 4;

impl Mirror {
    /// The hull of the corners of `hull` and their images: its own image, up to rounding.
    ///
    /// # Errors
    /// [`HullError`], where rounding leaves nothing solid.
    pub fn symmetrized(&self, hull: &Hull) -> Result<Hull, HullError> {
        self.hull_with_images(hull.vertices())
    }

    /// The hull of points and their images: its own image, up to rounding.
    ///
    /// # Errors
    /// [`HullError`].
    pub(crate) fn hull_with_images(&self, points: &[DVec3]) -> Result<Hull, HullError> {
        let mut half: Vec<DVec3> = points.iter().map(|&p| self.folded(p)).collect();
        for _ in 0..ROUNDS {
            let hull = Hull::of_points(&self.unfolded(&half))?;
            let kept = self.paired_corners(&hull);
            if kept.len() == hull.vertices().len() {
                return Ok(hull);
            }
            // Of corners that lie on an edge or a facet, up to rounding, one side may have lost its own.
            half = kept.into_iter().filter(|&p| self.plane().distance(p) >= 0.0).collect();
        }
        Hull::of_points(&self.unfolded(&half))
    }

    /// The point or its image, whichever is in front of the plane.
    fn folded(&self, point: DVec3) -> DVec3 {
        if self.plane().distance(point) < 0.0 { self.point(point) } else { point }
    }

    /// Points in front of the plane, of which those that are alike become one, and their images.
    fn unfolded(&self, half: &[DVec3]) -> Vec<DVec3> {
        let near = self.near(half);
        let mut half: Vec<DVec3> = half
            .iter()
            .map(|&p| if self.plane().distance(p).abs() <= near { self.plane().project(p) } else { p })
            .collect();
        half.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z)));
        let mut kept: Vec<DVec3> = Vec::with_capacity(half.len() * 2);
        for p in half {
            let alike = |q: &DVec3| q.distance_squared(p) <= near * near;
            if !kept.iter().rev().take_while(|q| p.x - q.x <= near).any(alike) {
                kept.push(p);
            }
        }
        let images: Vec<DVec3> =
            kept.iter().filter(|&&p| self.plane().distance(p) > near / 2.0).map(|&p| self.point(p)).collect();
        kept.extend(images);
        kept
    }

    /// The corners of a hull whose images are corners too.
    fn paired_corners(&self, hull: &Hull) -> Vec<DVec3> {
        let near = self.near(hull.vertices());
        let mut sorted = hull.vertices().to_vec();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x));
        let has_image = |p: &DVec3| {
            let image = self.point(*p);
            let from = sorted.partition_point(|q| q.x < image.x - near);
            let close = sorted[from..].iter().take_while(|q| q.x <= image.x + near);
            close.into_iter().any(|q| q.distance_squared(image) <= near * near)
        };
        hull.vertices().iter().copied().filter(has_image).collect()
    }

    fn near(&self, points: &[DVec3]) -> f64 {
        let (lo, hi) = bounds(points.iter().copied());
        ON_PLANE * (hi - lo).max_element().max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::mirror::tests::{mirror, points};
    use super::*;
    use crate::geom::Plane;

    /// Largest distance of a corner of one hull from the nearest corner of the other.
    fn apart(a: &Hull, b: &Hull) -> f64 {
        let from = |p: &DVec3| b.vertices().iter().map(|q| q.distance(*p)).fold(f64::INFINITY, f64::min);
        a.vertices().iter().map(from).fold(0.0, f64::max)
    }

    #[test]
    fn an_image_faces_outwards_and_comes_back() {
        let mirror = mirror();
        let hull = Hull::of_points(&points(1, 60)).unwrap();
        let image = hull.reflected(&mirror);
        assert!((image.volume() - hull.volume()).abs() < 1e-9 * hull.volume());
        for facet in image.facets() {
            assert!(image.vertices().iter().all(|&p| facet.plane().distance(p) < 1e-9));
            let corners: Vec<DVec3> = image.facet_points(facet).collect();
            let turn = (corners[1] - corners[0]).cross(corners[2] - corners[1]);
            assert!(turn.dot(facet.plane().normal()) > 0.0);
        }
        assert!(apart(&image.reflected(&mirror), &hull) < 1e-12);
    }

    #[test]
    fn symmetrized_hulls_are_their_own_images() {
        let mirror = mirror();
        for seed in 0..40 {
            let hull = Hull::of_points(&points(seed, 5 + seed as usize * 7)).unwrap();
            let whole = mirror.symmetrized(&hull).unwrap();
            assert!(apart(&whole.reflected(&mirror), &whole) < 1e-9, "{seed}");
            assert!(whole.volume() >= hull.volume() * (1.0 - 1e-9));
            // What is symmetric stays.
            let again = mirror.symmetrized(&whole).unwrap();
            assert!(apart(&again, &whole).max(apart(&whole, &again)) < 1e-9);
        }
    }

    #[test]
    fn a_box_on_the_plane_keeps_eight_corners() {
        let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
        let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let half = Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap();
        let whole = mirror.symmetrized(&half).unwrap();
        assert_eq!((whole.vertices().len(), whole.facets().len()), (8, 6));
        assert!((whole.volume() - 2.0).abs() < 1e-12);
    }
}
