//! Profiles of a body that may have dents: how far it reaches in each edge's direction, height by
//! height. Unlike the silhouette of its hull, this follows a neck or a waist.

use glam::{DVec2, DVec3};

/// Heights at which a body is cut.
const LEVELS: usize = 96;

/// How far a body reaches in some directions, at some heights.
#[derive(Debug, Clone)]
pub(super) struct Silhouette {
    /// From top to bottom.
    heights: Vec<f64>,
    /// By direction, then by height.
    reaches: Vec<Vec<f64>>,
    normals: Vec<DVec2>,
}

impl Silhouette {
    /// Cuts the triangles of a body at even heights.
    pub(super) fn new(triangles: &[[DVec3; 3]], normals: Vec<DVec2>) -> Self {
        let z = || triangles.iter().flatten().map(|p| p.z);
        let (low, high) = (z().fold(f64::INFINITY, f64::min), z().fold(f64::NEG_INFINITY, f64::max));
        let step = (high - low) / LEVELS as f64;
        // Off the ends by half a step, where a pointed body has no width.
        let heights: Vec<f64> = (0..LEVELS).map(|k| high - step * (k as f64 + 0.5)).collect();
        let mut reaches = vec![vec![f64::NEG_INFINITY; LEVELS]; normals.len()];
        for triangle in triangles {
            let top = triangle.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
            let bottom = triangle.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
            let first = (((high - top) / step - 0.5).ceil().max(0.0)) as usize;
            for (k, &v) in heights.iter().enumerate().skip(first).take_while(|(_, v)| **v >= bottom) {
                for (a, b) in (0..3).map(|i| (triangle[i], triangle[(i + 1) % 3])) {
                    if (a.z - v) * (b.z - v) <= 0.0 && a.z != b.z {
                        let at = a.lerp(b, (a.z - v) / (a.z - b.z)).truncate();
                        for (reach, normal) in reaches.iter_mut().zip(&normals) {
                            reach[k] = reach[k].max(normal.dot(at));
                        }
                    }
                }
            }
        }
        Self { heights, reaches, normals }
    }

    /// The least width of an edge of the section at a level.
    fn width(&self, k: usize) -> f64 {
        let n = self.normals.len();
        let corner = |j: usize| {
            let (a, b) = (self.normals[j % n], self.normals[(j + 1) % n]);
            let (ua, ub) = (self.reaches[j % n][k], self.reaches[(j + 1) % n][k]);
            DVec2::new(ua * b.y - ub * a.y, a.x * ub - b.x * ua) / a.perp_dot(b)
        };
        let width = |j: usize| self.normals[j].perp().dot(corner(j) - corner(j + n - 1));
        (0..n).map(width).fold(f64::INFINITY, f64::min)
    }

    /// The levels between which every section is at least so wide at every edge.
    fn usable(&self, least_mm: f64) -> Option<(usize, usize)> {
        let is_wide = |k: &usize| self.width(*k) >= least_mm;
        let first = (0..LEVELS).find(is_wide)?;
        let last = (0..LEVELS).rfind(is_wide)?;
        (last > first && (first..=last).all(|k| is_wide(&k))).then_some((first, last))
    }

    /// Profiles with `count` vertices each, all at the same heights, so that no panel has a neighbour
    /// that bends beside it: the heights for which the farthest distance of any profile from its
    /// silhouette is least. Their reach is `scale` times that of the body.
    pub(super) fn profiles(&self, count: usize, scale: f64, least_mm: f64) -> Option<Vec<Vec<DVec2>>> {
        let (first, last) = self.usable(least_mm)?;
        let levels = self.best_levels(first, last, count)?;
        let point = |j: usize, k: usize| DVec2::new(scale * self.reaches[j][k], self.heights[k]);
        Some((0..self.normals.len()).map(|j| levels.iter().map(|&k| point(j, k)).collect()).collect())
    }

    /// The best polyline with `count` vertices among the levels, by dynamic programming over its
    /// length and its last vertex.
    fn best_levels(&self, first: usize, last: usize, count: usize) -> Option<Vec<usize>> {
        let span = last - first + 1;
        if count < 2 || count > span {
            return None;
        }
        let errors: Vec<Vec<f64>> =
            (0..span).map(|a| (0..span).map(|b| self.chord_error(first + a, first + b)).collect()).collect();
        let mut best = vec![vec![(f64::INFINITY, 0); span]; count];
        best[0][0].0 = 0.0;
        for length in 1..count {
            for b in length..span {
                let options = (length - 1..b).map(|a| (best[length - 1][a].0.max(errors[a][b]), a));
                best[length][b] = options.fold((f64::INFINITY, 0), |x, y| if y.0 < x.0 { y } else { x });
            }
        }
        let mut levels = vec![span - 1];
        for length in (1..count).rev() {
            levels.push(best[length][levels[levels.len() - 1]].1);
        }
        Some(levels.into_iter().rev().map(|level| first + level).collect())
    }

    /// The farthest that any silhouette is from its chord between two levels.
    fn chord_error(&self, a: usize, b: usize) -> f64 {
        let error = |reach: &Vec<f64>| {
            let (p, q) = (DVec2::new(reach[a], self.heights[a]), DVec2::new(reach[b], self.heights[b]));
            let across = (q - p).normalize_or_zero().perp();
            let off = |k: usize| across.dot(DVec2::new(reach[k], self.heights[k]) - p).abs();
            (a + 1..b).map(off).fold(0.0, f64::max)
        };
        self.reaches.iter().map(error).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two frusta with a waist between, as triangles of a fan round the axis.
    fn hourglass() -> Vec<[DVec3; 3]> {
        let ring = |r: f64, z: f64, k: usize| {
            let (s, c) = (k as f64 * std::f64::consts::TAU / 64.0).sin_cos();
            DVec3::new(r * c, r * s, z)
        };
        let band = |a: (f64, f64), b: (f64, f64)| {
            (0..64).flat_map(move |k| {
                let [p, q] = [k, k + 1].map(|k| ring(a.0, a.1, k));
                let [r, s] = [k, k + 1].map(|k| ring(b.0, b.1, k));
                [[p, r, q], [q, r, s]]
            })
        };
        band((40.0, 100.0), (20.0, 50.0)).chain(band((20.0, 50.0), (40.0, 0.0))).collect()
    }

    #[test]
    fn a_waist_is_followed() {
        let normals: Vec<DVec2> =
            (0..6).map(|k| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 6.0)).collect();
        let silhouette = Silhouette::new(&hourglass(), normals);
        let profiles = silhouette.profiles(3, 1.0, 3.0).unwrap();
        for profile in profiles {
            assert!((profile[1].y - 50.0).abs() < 1.0 && (profile[1].x - 20.0).abs() < 0.6, "{profile:?}");
            assert!(profile[0].x > 39.0 && profile[2].x > 39.0);
        }
    }
}
