//! Quickhull (Barber, Dobkin and Huhdanpaa 1996) with exact predicates (Shewchuk 1997), so that it
//! never fails for rounding, and always in the same order, so that equal points give equal
//! triangles.

use glam::DVec3;
use robust::{Coord3D, orient3d};

/// Outward triangles of the convex hull of distinct points, as indices. Where more than three
/// points lie in one plane, the plane is divided into several triangles. `None` where the points
/// are all within `flat` of one plane.
pub(super) fn triangles(points: &[DVec3], flat: f64) -> Option<Vec<[usize; 3]>> {
    let mut hull = Quickhull::of_simplex(points, simplex(points, flat)?);
    let mut next = 0;
    while next < hull.facets.len() {
        if let Some(farthest) = hull.facets[next].take_farthest() {
            hull.add(farthest, next);
        } else {
            next += 1;
        }
    }
    Some(hull.facets.iter().filter(|f| !f.is_gone).map(|f| f.corners).collect())
}

/// Four points that span a volume, the first three counter-clockwise seen from outside.
fn simplex(points: &[DVec3], flat: f64) -> Option<[usize; 4]> {
    let farthest = |measure: &dyn Fn(DVec3) -> f64| {
        let far = |best: (usize, f64), (i, p): (usize, &DVec3)| {
            let reach = measure(*p);
            if reach > best.1 { (i, reach) } else { best }
        };
        points.iter().enumerate().fold((0, f64::NEG_INFINITY), far)
    };
    let a = *points.first()?;
    let (b_at, _) = farthest(&|p| p.distance_squared(a));
    let b = points[b_at];
    let (c_at, _) = farthest(&|p| (p - a).cross(b - a).length_squared());
    let normal = (b - a).cross(points[c_at] - a).try_normalize()?;
    let (d_at, height) = farthest(&|p| normal.dot(p - a).abs());
    if height <= flat {
        return None;
    }
    let side = above(points, [0, b_at, c_at], d_at);
    if side == 0.0 {
        None
    } else if side > 0.0 {
        Some([0, c_at, b_at, d_at])
    } else {
        Some([0, b_at, c_at, d_at])
    }
}

/// Positive where the point is above the triangle, on the side that sees it counter-clockwise; the
/// sign is exact, the value grows with the distance.
fn above(points: &[DVec3], triangle: [usize; 3], point: usize) -> f64 {
    let at = |i: usize| {
        let DVec3 { x, y, z } = points[i];
        Coord3D { x, y, z }
    };
    -orient3d(at(triangle[0]), at(triangle[1]), at(triangle[2]), at(point))
}

struct Facet {
    corners: [usize; 3],
    /// The facets beyond its edges, in the order of [`Facet::edges`].
    beyond: [usize; 3],
    /// Points above this facet that no other facet has, with their measure from [`above`].
    outside: Vec<(usize, f64)>,
    is_gone: bool,
}

impl Facet {
    fn edges(&self) -> [(usize, usize); 3] {
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)]
    }

    fn take_farthest(&mut self) -> Option<usize> {
        let far = |best: usize, k: usize| if self.outside[k].1 > self.outside[best].1 { k } else { best };
        let best = (0..self.outside.len()).reduce(far)?;
        Some(self.outside.remove(best).0)
    }
}

struct Quickhull<'a> {
    points: &'a [DVec3],
    facets: Vec<Facet>,
    /// While a cone is made: the facet whose edge on the horizon begins at a point.
    begins: Vec<usize>,
}

impl<'a> Quickhull<'a> {
    fn of_simplex(points: &'a [DVec3], [a, b, c, d]: [usize; 4]) -> Self {
        let mut hull = Self { points, facets: Vec::new(), begins: vec![0; points.len()] };
        hull.push([a, b, c], [1, 2, 3]);
        hull.push([a, d, b], [3, 2, 0]);
        hull.push([b, d, c], [1, 3, 0]);
        hull.push([c, d, a], [2, 1, 0]);
        hull.hand_out(0, (0..points.len()).filter(|i| ![a, b, c, d].contains(i)));
        hull
    }

    fn push(&mut self, corners: [usize; 3], beyond: [usize; 3]) {
        self.facets.push(Facet { corners, beyond, outside: Vec::new(), is_gone: false });
    }

    /// Gives each point to the first facet from `first` on that it is above; the others are inside.
    fn hand_out(&mut self, first: usize, loose: impl Iterator<Item = usize>) {
        for point in loose {
            let mut fresh = self.facets[first..].iter_mut();
            let found = fresh.find_map(|facet| {
                let height = above(self.points, facet.corners, point);
                (height > 0.0).then_some((facet, height))
            });
            if let Some((facet, height)) = found {
                facet.outside.push((point, height));
            }
        }
    }

    /// Replaces all facets that see `point`, `seen` among them, by a cone from their horizon.
    fn add(&mut self, point: usize, seen: usize) {
        self.facets[seen].is_gone = true;
        let mut visible = vec![seen];
        let mut horizon = Vec::new();
        let mut at = 0;
        while at < visible.len() {
            let facet = &self.facets[visible[at]];
            for (edge, other) in facet.edges().into_iter().zip(facet.beyond) {
                if self.facets[other].is_gone {
                    continue;
                }
                if above(self.points, self.facets[other].corners, point) > 0.0 {
                    self.facets[other].is_gone = true;
                    visible.push(other);
                } else {
                    horizon.push((edge, other));
                }
            }
            at += 1;
        }
        let first = self.facets.len();
        self.push_cone(point, &horizon);
        for facet in visible {
            let loose = std::mem::take(&mut self.facets[facet].outside);
            self.hand_out(first, loose.into_iter().map(|(i, _)| i));
        }
    }

    /// The facets between a point and the edges of its horizon, each given with the facet beyond it.
    fn push_cone(&mut self, point: usize, horizon: &[((usize, usize), usize)]) {
        let first = self.facets.len();
        for (k, &((a, b), other)) in horizon.iter().enumerate() {
            self.begins[a] = first + k;
            let side = self.facets[other].edges().iter().position(|&edge| edge == (b, a));
            self.facets[other].beyond[side.unwrap_or(0)] = first + k;
            self.push([a, b, point], [other, first, first]);
        }
        for (k, &((_, b), _)) in horizon.iter().enumerate() {
            let after = self.begins[b];
            self.facets[first + k].beyond[1] = after;
            self.facets[after].beyond[2] = first + k;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed, and no point above any triangle.
    fn assert_is_hull(points: &[DVec3], triangles: &[[usize; 3]]) {
        let edges: std::collections::BTreeSet<(usize, usize)> =
            triangles.iter().flat_map(|t| (0..3).map(|k| (t[k], t[(k + 1) % 3]))).collect();
        assert_eq!(edges.len(), 3 * triangles.len());
        assert!(edges.iter().all(|&(a, b)| edges.contains(&(b, a))));
        let corners: std::collections::BTreeSet<usize> = triangles.iter().flatten().copied().collect();
        assert_eq!(corners.len() + triangles.len(), edges.len() / 2 + 2);
        for &t in triangles {
            assert!((0..points.len()).all(|p| above(points, t, p) <= 0.0));
        }
    }

    #[test]
    fn points_of_a_grid_are_no_trouble() {
        let points: Vec<DVec3> = (0..125)
            .map(|k| DVec3::new(f64::from(k % 5), f64::from(k / 5 % 5), f64::from(k / 25)) * 0.1)
            .collect();
        assert_is_hull(&points, &triangles(&points, 1e-9).unwrap());
    }

    #[test]
    fn rings_of_a_cylinder_are_no_trouble() {
        let points: Vec<DVec3> = (0..400)
            .map(|k| {
                let angle = f64::from(k % 40) * std::f64::consts::TAU / 40.0;
                DVec3::new(libm::cos(angle), f64::from(k / 40), libm::sin(angle))
            })
            .collect();
        assert_is_hull(&points, &triangles(&points, 1e-9).unwrap());
    }

    #[test]
    fn random_points_have_their_hull() {
        let mut rng = fastrand::Rng::with_seed(7);
        for _ in 0..20 {
            let points: Vec<DVec3> =
                (0..60).map(|_| DVec3::from_array([(); 3].map(|()| rng.f64()))).collect();
            assert_is_hull(&points, &triangles(&points, 1e-9).unwrap());
        }
    }

    #[test]
    fn flat_points_have_none() {
        let points: Vec<DVec3> =
            (0..9).map(|k| DVec3::new(f64::from(k % 3), f64::from(k / 3), 0.0)).collect();
        assert_eq!(triangles(&points, 1e-9), None);
        assert_eq!(triangles(&points[..3], 1e-9), None);
        assert_eq!(triangles(&[], 1e-9), None);
    }
}
