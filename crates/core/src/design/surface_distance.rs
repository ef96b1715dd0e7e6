//! Distance between two surfaces of triangles, which need not be convex.

use crate::geom::nearest::Tree;
use glam::DVec3;
use rayon::prelude::*;

/// The farthest that any of the points is from a surface of at least one triangle.
pub(super) fn farthest(points: &[DVec3], surface: &Tree) -> f64 {
    let squared = points.par_iter().map(|p| surface.nearest(*p, 0).distance_squared);
    squared.reduce(|| 0.0, f64::max).sqrt()
}

/// Points of triangles, at most `step_mm` apart along their edges, corners among them.
pub(super) fn samples(triangles: &[[DVec3; 3]], step_mm: f64) -> Vec<DVec3> {
    let mut points = Vec::new();
    for [a, b, c] in triangles {
        let longest = a.distance(*b).max(b.distance(*c)).max(c.distance(*a));
        let parts = (longest / step_mm).ceil().max(1.0) as usize;
        for i in 0..=parts {
            for j in 0..=parts - i {
                let (s, t) = (i as f64 / parts as f64, j as f64 / parts as f64);
                points.push(*a + (*b - *a) * s + (*c - *a) * t);
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_as_far_as_a_fine_sampling_says() {
        let triangle = [DVec3::ZERO, DVec3::new(8.0, 1.0, 0.0), DVec3::new(2.0, 5.0, 3.0)];
        let surface = Tree::new(vec![triangle]);
        let dense = samples(&[triangle], 0.02);
        for k in 0..200 {
            let t = f64::from(k);
            let p = DVec3::new(9.0 * libm::sin(t * 0.7), 7.0 * libm::cos(t * 1.3), 5.0 * libm::sin(t * 0.31));
            let sampled = dense.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            let exact = farthest(&[p], &surface);
            assert!(exact <= sampled + 1e-12 && sampled - exact < 0.02, "{exact} {sampled}");
        }
    }
}
