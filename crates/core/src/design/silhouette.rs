//! Profiles of a body that may have dents: how far it reaches in each edge's direction, height by
//! height. Unlike the silhouette of its hull, this follows a neck or a waist.

use crate::component::ChainId;
use glam::{DVec2, DVec3};

/// Heights at which a body is cut.
const LEVELS: usize = 96;

/// Corners so near to a height are on it: joint panels come from other axes.
const SAME_MM: f64 = 1e-6;

/// What stays as it is: joint panels.
#[derive(Debug, Clone, Default)]
pub(super) struct Kept {
    /// Chains with the ends of the segments that are joint panels, (u, v), the upper one first.
    pub(super) sides: Vec<(ChainId, [DVec2; 2])>,
    /// Height of the top panel where it is one.
    pub(super) top_mm: Option<f64>,
    /// Height of the bottom panel where it is one.
    pub(super) bottom_mm: Option<f64>,
}

impl Kept {
    /// Where chain `j` is at a height, if that is kept.
    fn at(&self, j: ChainId, v_mm: f64) -> Option<DVec2> {
        let own = self.sides.iter().filter(|(chain, _)| *chain == j).map(|(_, ends)| *ends);
        let mut own = own.filter(|[upper, lower]| v_mm <= upper.y && v_mm >= lower.y);
        own.next().map(|[upper, lower]| match v_mm {
            v if v == upper.y => upper,
            v if v == lower.y => lower,
            v => upper.lerp(lower, (upper.y - v) / (upper.y - lower.y)),
        })
    }

    /// Whether a height lies within a panel of chain `j` that stays whole.
    fn is_within(&self, j: ChainId, v_mm: f64) -> bool {
        let own = self.sides.iter().filter(|(chain, _)| *chain == j);
        own.into_iter().any(|(_, [upper, lower])| v_mm < upper.y && v_mm > lower.y)
    }

    /// Heights at which profiles must have a vertex.
    fn heights(&self) -> impl Iterator<Item = f64> + '_ {
        let sides = self.sides.iter().flat_map(|(_, ends)| ends.map(|end| end.y));
        sides.chain(self.top_mm).chain(self.bottom_mm)
    }
}

/// A profile to be folded.
#[derive(Debug, Clone)]
pub(super) struct Drawn {
    pub(super) points: Vec<DVec2>,
    /// Which segments are joint panels.
    pub(super) whole: Vec<bool>,
}

/// How far a body reaches in some directions, at some heights.
#[derive(Debug, Clone)]
pub(super) struct Silhouette {
    /// From top to bottom.
    heights: Vec<f64>,
    /// By direction, then by height.
    reaches: Vec<Vec<f64>>,
    normals: Vec<DVec2>,
    /// Middle of the body, seen from above.
    middle: DVec2,
    kept: Kept,
}

impl Silhouette {
    /// Cuts the triangles of a body at even heights, and where joint panels end.
    pub(super) fn new(triangles: &[[DVec3; 3]], normals: Vec<DVec2>, kept: Kept) -> Self {
        let z = || triangles.iter().flatten().map(|p| p.z);
        let (low, high) = (z().fold(f64::INFINITY, f64::min), z().fold(f64::NEG_INFINITY, f64::max));
        let step = (high - low) / LEVELS as f64;
        // Off the ends by half a step, where a pointed body has no width.
        let is_free = |v: &f64| {
            kept.top_mm.is_none_or(|top| *v < top - 0.5 * step)
                && kept.bottom_mm.is_none_or(|bottom| *v > bottom + 0.5 * step)
                && kept.heights().all(|kept| (kept - v).abs() > 0.25 * step)
        };
        let even = (0..LEVELS).map(|k| high - step * (k as f64 + 0.5)).filter(is_free);
        let mut heights: Vec<f64> = even.chain(kept.heights()).collect();
        heights.sort_by(|a, b| b.total_cmp(a));
        heights.dedup();
        let mut reaches = vec![vec![f64::NEG_INFINITY; heights.len()]; normals.len()];
        for triangle in triangles {
            let top = triangle.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
            let bottom = triangle.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
            let first = heights.partition_point(|v| *v > top + SAME_MM);
            for (k, &v) in heights.iter().enumerate().skip(first).take_while(|(_, v)| **v >= bottom - SAME_MM)
            {
                for (a, b) in (0..3).map(|i| (triangle[i], triangle[(i + 1) % 3])) {
                    if (a.z - v).abs() <= SAME_MM {
                        for (reach, normal) in reaches.iter_mut().zip(&normals) {
                            reach[k] = reach[k].max(normal.dot(a.truncate()));
                        }
                    }
                    if (a.z - v) * (b.z - v) <= 0.0 && a.z != b.z {
                        let at = a.lerp(b, (a.z - v) / (a.z - b.z)).truncate();
                        for (reach, normal) in reaches.iter_mut().zip(&normals) {
                            reach[k] = reach[k].max(normal.dot(at));
                        }
                    }
                }
            }
        }
        for (j, reach) in reaches.iter_mut().enumerate() {
            for (u, &v) in reach.iter_mut().zip(&heights) {
                *u = kept.at(ChainId(j), v).map_or(*u, |at| at.x);
            }
        }
        let seen = || triangles.iter().flatten().map(|p| p.truncate());
        let low = seen().fold(DVec2::INFINITY, DVec2::min);
        let middle = low.midpoint(seen().fold(DVec2::NEG_INFINITY, DVec2::max));
        Self { heights, reaches, normals, middle, kept }
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

    /// The levels between which every section is at least this wide at every edge.
    fn usable(&self, least_mm: f64) -> Option<(usize, usize)> {
        // Where joint panels end, it is as wide as it is.
        let is_wide = |k: &usize| self.width(*k) >= least_mm || (self.is_kept(*k) && self.width(*k) > 0.0);
        let levels = 0..self.heights.len();
        let first = levels.clone().find(is_wide)?;
        let last = levels.clone().rfind(is_wide)?;
        let is_lost = levels.filter(|&k| self.is_kept(k)).any(|k| k < first || k > last);
        (last > first && !is_lost && (first..=last).all(|k| is_wide(&k))).then_some((first, last))
    }

    /// Profiles with `count` vertices each, all at the same heights, so that no panel has a neighbour
    /// that bends beside it: the heights for which the farthest distance of any profile from its
    /// silhouette is least. Their reach from its middle is `scale` times that of the body, but at the
    /// ends of joint panels, which stay whole where they are.
    pub(super) fn profiles(&self, count: usize, scale: f64, least_mm: f64) -> Option<Vec<Drawn>> {
        let (first, last) = self.usable(least_mm)?;
        let levels = self.best_levels(first, last, count)?;
        let point = |j: ChainId, k: usize| {
            let scale = if self.is_kept(k) { 1.0 } else { scale };
            let middle = self.normals[j.0].dot(self.middle);
            let scaled = DVec2::new(middle + scale * (self.reaches[j.0][k] - middle), self.heights[k]);
            self.kept.at(j, self.heights[k]).unwrap_or(scaled)
        };
        let drawn = |j: ChainId| {
            let own = levels.iter().filter(|&&k| !self.kept.is_within(j, self.heights[k]));
            let points: Vec<DVec2> = own.map(|&k| point(j, k)).collect();
            let is_kept = |w: &[DVec2]| self.kept.sides.contains(&(j, [w[0], w[1]]));
            Drawn { whole: points.windows(2).map(is_kept).collect(), points }
        };
        Some((0..self.normals.len()).map(ChainId).map(drawn).collect())
    }

    /// The best polyline with `count` vertices among the levels, by dynamic programming over its
    /// length and its last vertex.
    fn best_levels(&self, first: usize, last: usize, count: usize) -> Option<Vec<usize>> {
        let span = last - first + 1;
        if count < 2 || count > span {
            return None;
        }
        let error = |a: usize, b: usize| match self.is_kept_between(first + a, first + b) {
            true => f64::INFINITY,
            false => self.chord_error(first + a, first + b),
        };
        let errors: Vec<Vec<f64>> = (0..span).map(|a| (0..span).map(|b| error(a, b)).collect()).collect();
        let mut best = vec![vec![(f64::INFINITY, 0); span]; count];
        best[0][0].0 = 0.0;
        for length in 1..count {
            for b in length..span {
                let options = (length - 1..b).map(|a| (best[length - 1][a].0.max(errors[a][b]), a));
                best[length][b] = options.fold((f64::INFINITY, 0), |x, y| if y.0 < x.0 { y } else { x });
            }
        }
        if !best[count - 1][span - 1].0.is_finite() {
            return None;
        }
        let mut levels = vec![span - 1];
        for length in (1..count).rev() {
            levels.push(best[length][levels[levels.len() - 1]].1);
        }
        Some(levels.into_iter().rev().map(|level| first + level).collect())
    }

    /// Whether a level is one that needs a vertex.
    fn is_kept(&self, k: usize) -> bool {
        self.kept.heights().any(|v| v == self.heights[k])
    }

    /// Whether a height that needs a vertex lies between two levels.
    fn is_kept_between(&self, a: usize, b: usize) -> bool {
        self.kept.heights().any(|v| v < self.heights[a] && v > self.heights[b])
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
            let (s, c) = libm::sincos(k as f64 * std::f64::consts::TAU / 64.0);
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
        let silhouette = Silhouette::new(&hourglass(), normals, Kept::default());
        let profiles = silhouette.profiles(3, 1.0, 3.0).unwrap();
        for profile in profiles {
            let profile = profile.points;
            assert!((profile[1].y - 50.0).abs() < 1.0 && (profile[1].x - 20.0).abs() < 0.6, "{profile:?}");
            assert!(profile[0].x > 39.0 && profile[2].x > 39.0);
        }
    }
}
