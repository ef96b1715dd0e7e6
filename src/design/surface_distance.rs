//! Distance between two surfaces of triangles, which need not be convex.

use glam::DVec3;
use rayon::prelude::*;

/// A triangle with a ball round it.
#[derive(Debug, Clone, Copy)]
struct Facet {
    corners: [DVec3; 3],
    centre: DVec3,
    radius_mm: f64,
}

/// A surface that distances are measured to.
#[derive(Debug, Clone)]
pub(super) struct Facets(Vec<Facet>);

impl Facets {
    pub(super) fn new(triangles: &[[DVec3; 3]]) -> Self {
        let facet = |corners: &[DVec3; 3]| {
            let centre = corners.iter().sum::<DVec3>() / 3.0;
            let radius_mm = corners.iter().map(|c| c.distance(centre)).fold(0.0, f64::max);
            Facet { corners: *corners, centre, radius_mm }
        };
        Self(triangles.iter().map(facet).collect())
    }

    fn distance(&self, point: DVec3) -> f64 {
        let mut best = f64::INFINITY;
        for facet in &self.0 {
            let reach = best + facet.radius_mm;
            if point.distance_squared(facet.centre) < reach * reach {
                best = best.min(point.distance(nearest(facet.corners, point)));
            }
        }
        best
    }

    /// The farthest that any of the points is from the surface.
    pub(super) fn farthest(&self, points: &[DVec3]) -> f64 {
        points.par_iter().map(|p| self.distance(*p)).reduce(|| 0.0, f64::max)
    }
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

/// The point of a triangle nearest to a point (Ericson, Real-Time Collision Detection, 5.1.5).
fn nearest([a, b, c]: [DVec3; 3], p: DVec3) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_as_far_as_a_fine_sampling_says() {
        let triangle = [DVec3::ZERO, DVec3::new(8.0, 1.0, 0.0), DVec3::new(2.0, 5.0, 3.0)];
        let facets = Facets::new(&[triangle]);
        let dense = samples(&[triangle], 0.02);
        for k in 0..200 {
            let t = f64::from(k);
            let p = DVec3::new(9.0 * (t * 0.7).sin(), 7.0 * (t * 1.3).cos(), 5.0 * (t * 0.31).sin());
            let sampled = dense.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            let exact = facets.farthest(&[p]);
            assert!(exact <= sampled + 1e-12 && sampled - exact < 0.02, "{exact} {sampled}");
        }
    }
}
