//! A quick inner approximation of a convex hull, by the extreme points in fixed directions. It is
//! good for ranking: the hulls that become components are the exact ones of `geom::Hull`.

use crate::geom::{bounds, directions};
use glam::DVec3;

/// Directions of support. A sphere's hull over 128 extreme points has 96% of its volume.
const DIRECTIONS: usize = 128;

/// Points are moved by this share of the size, so that no four lie in one plane.
const JOGGLE: f64 = 1e-7;

/// What is thinner than this share of its size has no volume.
const FLAT: f64 = 1e-5;

/// The extreme vertex of a set in each direction. The union of two sets is a comparison per
/// direction.
#[derive(Debug, Clone)]
pub(super) struct Extremes {
    best: Vec<(f64, u32)>,
}

impl Extremes {
    /// The extreme ones of vertices; there may be none.
    pub fn of_vertices(positions: &[DVec3], vertices: &[u32]) -> Self {
        let best = directions(DIRECTIONS).map(|d| {
            let reach = |&v: &u32| (d.dot(positions[v as usize]), v);
            vertices.iter().map(reach).fold((f64::NEG_INFINITY, u32::MAX), farther)
        });
        Self { best: best.collect() }
    }

    /// The extreme ones of both sets.
    pub fn union(&self, other: &Self) -> Self {
        Self { best: self.best.iter().zip(&other.best).map(|(&a, &b)| farther(a, b)).collect() }
    }

    /// The hull; `None` where it has no volume.
    pub fn hull(&self, positions: &[DVec3]) -> Option<RoughHull> {
        let mut vertices: Vec<u32> = self.best.iter().filter(|b| b.0.is_finite()).map(|b| b.1).collect();
        vertices.sort_unstable();
        vertices.dedup();
        RoughHull::of_points(vertices.iter().map(|&v| positions[v as usize]).collect())
    }
}

/// The point that reaches farther; of two equal ones that with the smaller index.
fn farther(a: (f64, u32), b: (f64, u32)) -> (f64, u32) {
    if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) { b } else { a }
}

/// A convex polyhedron as outward triangles.
#[derive(Debug, Clone)]
pub(super) struct RoughHull {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl RoughHull {
    /// Corners of the outward triangles.
    pub fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.triangles.iter().map(|t| t.map(|v| self.points[v as usize]))
    }

    /// Enclosed volume.
    pub fn volume(&self) -> f64 {
        let o = self.points[0];
        self.triangles().map(|[a, b, c]| (a - o).dot((b - o).cross(c - o)) / 6.0).sum()
    }

    /// Incremental hull of joggled points: with at most 128 of them plain search is fastest.
    fn of_points(mut points: Vec<DVec3>) -> Option<Self> {
        let (lo, hi) = bounds(points.iter().copied());
        let size = (hi - lo).max_element();
        let start = tetrahedron(&points, size)?;
        for (i, p) in points.iter_mut().enumerate() {
            *p += joggle(i as u32) * (JOGGLE * size);
        }
        let mut build = Builder::new(&points, start);
        for p in 0..points.len() as u32 {
            if !start.contains(&p) {
                build.insert(p);
            }
        }
        let triangles = build.faces.iter().filter(|f| f.alive).map(|f| f.corners).collect();
        Some(Self { points, triangles })
    }
}

/// A vector in −0.5..0.5 that depends on the index alone (PCG hash).
fn joggle(index: u32) -> DVec3 {
    let mut state = index.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let mut next = || {
        state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        f64::from((word >> 22) ^ word) / f64::from(u32::MAX) - 0.5
    };
    DVec3::new(next(), next(), next())
}

/// Four points far from each other, the first three counter-clockwise seen from the side away
/// from the fourth; `None` where all are in one plane.
fn tetrahedron(points: &[DVec3], size: f64) -> Option<[u32; 4]> {
    let farthest = |measure: &dyn Fn(DVec3) -> f64| {
        (0..points.len()).map(|i| (measure(points[i]), i as u32)).fold((-1.0, 0), farther)
    };
    let a = *points.first()?;
    let (_, ib) = farthest(&|p| p.distance_squared(a));
    let b = points[ib as usize];
    let along = (b - a).try_normalize()?;
    let (_, ic) = farthest(&|p| (p - a).cross(along).length_squared());
    let c = points[ic as usize];
    let normal = (b - a).cross(c - a).try_normalize()?;
    let (height, id) = farthest(&|p| (p - a).dot(normal).abs());
    let ordered = if (points[id as usize] - a).dot(normal) > 0.0 { [0, ic, ib, id] } else { [0, ib, ic, id] };
    (height > FLAT * size).then_some(ordered)
}

#[derive(Debug, Clone, Copy)]
struct Face {
    corners: [u32; 3],
    normal: DVec3,
    offset: f64,
    alive: bool,
}

struct Builder<'a> {
    points: &'a [DVec3],
    faces: Vec<Face>,
    /// The face to the left of each directed edge.
    left: Vec<u32>,
    /// Faces that the current point sees, and the edges round them.
    seen: Vec<u32>,
    rim: Vec<[u32; 2]>,
}

impl<'a> Builder<'a> {
    fn new(points: &'a [DVec3], [a, b, c, d]: [u32; 4]) -> Self {
        let left = vec![u32::MAX; points.len() * points.len()];
        let mut build = Self { points, faces: Vec::new(), left, seen: Vec::new(), rim: Vec::new() };
        for corners in [[a, b, c], [a, d, b], [b, d, c], [c, d, a]] {
            build.add(corners);
        }
        build
    }

    fn slot(&self, a: u32, b: u32) -> usize {
        a as usize * self.points.len() + b as usize
    }

    fn add(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|v| self.points[v as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let index = self.faces.len() as u32;
        self.faces.push(Face { corners, normal, offset: normal.dot(a), alive: true });
        for k in 0..3 {
            let slot = self.slot(corners[k], corners[(k + 1) % 3]);
            self.left[slot] = index;
        }
    }

    /// Replaces the faces that a point sees by a fan from it. A point whose rim is not one simple
    /// loop (rounding) is left out.
    fn insert(&mut self, p: u32) {
        let point = self.points[p as usize];
        self.seen.clear();
        self.rim.clear();
        for (i, f) in self.faces.iter_mut().enumerate() {
            if f.alive && f.normal.dot(point) > f.offset {
                f.alive = false;
                self.seen.push(i as u32);
            }
        }
        for &i in &self.seen {
            let [a, b, c] = self.faces[i as usize].corners;
            for [u, v] in [[a, b], [b, c], [c, a]] {
                let across = self.left[self.slot(v, u)];
                if self.faces[across as usize].alive {
                    self.rim.push([u, v]);
                }
            }
        }
        if self.rim.len() < 3 || !self.is_loop() {
            for &i in &self.seen {
                self.faces[i as usize].alive = true;
            }
            return;
        }
        for k in 0..self.rim.len() {
            let [u, v] = self.rim[k];
            self.add([u, v, p]);
        }
    }

    fn is_loop(&self) -> bool {
        let (start, mut at, mut steps) = (self.rim[0][0], self.rim[0][1], 1);
        while at != start && steps <= self.rim.len() {
            match self.rim.iter().find(|e| e[0] == at) {
                Some(e) => at = e[1],
                None => return false,
            }
            steps += 1;
        }
        at == start && steps == self.rim.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hull_volume(points: &[DVec3]) -> Option<f64> {
        let all: Vec<u32> = (0..points.len() as u32).collect();
        Extremes::of_vertices(points, &all).hull(points).map(|h| h.volume())
    }

    #[test]
    fn a_gridded_turned_cube_has_its_volume() {
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 1.1, -0.7);
        let mut points = Vec::new();
        for i in 0..1000 {
            let [x, y, z] = [i % 10, i / 10 % 10, i / 100].map(|k| k as f64 / 9.0);
            points.push(turn * DVec3::new(x, y, z) + DVec3::splat(5.0));
        }
        assert!((hull_volume(&points).unwrap() - 1.0).abs() < 1e-5);
    }

    #[test]
    fn a_sphere_keeps_most_of_its_volume() {
        let golden_rad = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        let points: Vec<DVec3> = (0..3000)
            .map(|k| {
                let z = 1.0 - (2.0 * k as f64 + 1.0) / 3000.0;
                let (sin, cos) = libm::sincos(golden_rad * k as f64);
                DVec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z
            })
            .collect();
        let share = hull_volume(&points).unwrap() / (4.0 / 3.0 * std::f64::consts::PI);
        assert!((0.94..1.0).contains(&share), "{share}");
    }

    #[test]
    fn a_sheet_has_no_hull() {
        let points: Vec<DVec3> =
            (0..100).map(|i| DVec3::new((i % 10) as f64, (i / 10) as f64, 0.0)).collect();
        assert_eq!(hull_volume(&points), None);
    }

    /// All faces of a patch may be details that hulls leave out.
    #[test]
    fn nothing_has_no_hull_and_adds_nothing() {
        let corners: Vec<DVec3> =
            (0..8).map(|k| DVec3::from([k & 1, k >> 1 & 1, k >> 2].map(f64::from))).collect();
        let nothing = Extremes::of_vertices(&corners, &[]);
        assert!(nothing.hull(&corners).is_none());
        let cube = nothing.union(&Extremes::of_vertices(&corners, &[0, 1, 2, 3, 4, 5, 6, 7]));
        assert!((cube.hull(&corners).unwrap().volume() - 1.0).abs() < 1e-5);
    }
}
