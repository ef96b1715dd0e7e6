//! Hulls cut by planes.

use super::{Facet, Hull};
use crate::geom::{Plane, polygon};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;
use std::collections::BTreeMap;

impl Hull {
    /// The part behind the plane (`normal · x <= offset`): facets are cut and the section becomes
    /// a facet. `None` where no volume is left.
    pub fn clip(&self, plane: &Plane) -> Option<Self> {
        let heights: Vec<f64> = self.vertices.iter().map(|&v| plane.distance(v)).collect();
        let size = heights.iter().fold(0.0f64, |m, d| m.max(d.abs()));
        let sides: Vec<Ordering> = heights.iter().map(|d| side(*d, ON_PLANE * size)).collect();
        if !sides.contains(&Ordering::Greater) {
            return Some(self.clone());
        }
        let mut cut = Clip { hull: self, heights: &heights, points: Vec::new(), of_edge: BTreeMap::new() };
        let mut facets = Vec::new();
        for facet in &self.facets {
            let outline = cut.outline(&facet.outline, &sides);
            if outline.len() >= 3 {
                facets.push(Facet { plane: facet.plane, outline });
            }
        }
        let cap = cut.cap(plane, &sides);
        (cap.len() >= 3 && facets.len() >= 3).then(|| {
            facets.push(Facet { plane: *plane, outline: cap });
            Self::compact(&cut.points, facets)
        })
    }

    /// Corners of the section by a plane, counter-clockwise seen from the side that the normal
    /// points to; empty where the plane misses the hull.
    pub fn section(&self, plane: &Plane) -> Vec<DVec3> {
        let heights: Vec<f64> = self.vertices.iter().map(|&v| plane.distance(v)).collect();
        let mut cut = Vec::new();
        for facet in &self.facets {
            for (k, &a) in facet.outline.iter().enumerate() {
                let b = facet.outline[(k + 1) % facet.outline.len()];
                if a > b {
                    continue;
                }
                let (dp, dq) = (heights[a as usize], heights[b as usize]);
                if (dp <= 0.0) != (dq <= 0.0) {
                    let (p, q) = (self.vertices[a as usize], self.vertices[b as usize]);
                    cut.push(plane.project(p + (q - p) * (dp / (dp - dq))));
                }
            }
        }
        let (x, y) = plane.basis();
        let flat: Vec<_> = cut.iter().map(|p| plane.flat(*p)).collect();
        let origin = plane.normal() * plane.offset();
        polygon::convex_hull(&flat).into_iter().map(|p| origin + x * p.x + y * p.y).collect()
    }
}

/// Vertices nearer to a clipping plane than this share of the size count as on it.
const ON_PLANE: f64 = 1e-9;

fn side(height: f64, tolerance: f64) -> Ordering {
    if height.abs() <= tolerance { Ordering::Equal } else { height.total_cmp(&0.0) }
}

/// A hull being clipped; its own vertices come first in `points`.
struct Clip<'a> {
    hull: &'a Hull,
    heights: &'a [f64],
    points: Vec<DVec3>,
    of_edge: BTreeMap<(u32, u32), u32>,
}

impl Clip<'_> {
    /// What is left of a facet's outline.
    fn outline(&mut self, outline: &[u32], sides: &[Ordering]) -> Vec<u32> {
        if self.points.is_empty() {
            self.points.clone_from(&self.hull.vertices);
        }
        let is_kept = |v: u32| sides[v as usize] != Ordering::Greater;
        if outline.iter().all(|&v| sides[v as usize] != Ordering::Less) {
            return Vec::new();
        }
        let mut out = Vec::with_capacity(outline.len() + 2);
        for (k, &a) in outline.iter().enumerate() {
            let b = outline[(k + 1) % outline.len()];
            if is_kept(a) {
                out.push(a);
            }
            let (from, to) = (sides[a as usize], sides[b as usize]);
            if from != Ordering::Equal && to != Ordering::Equal && from != to {
                out.push(self.crossing(a, b));
            }
        }
        out
    }

    fn crossing(&mut self, a: u32, b: u32) -> u32 {
        let (low, high) = (a.min(b), a.max(b));
        let (p, q) = (self.points[low as usize], self.points[high as usize]);
        let (dp, dq) = (self.heights[low as usize], self.heights[high as usize]);
        let points = &mut self.points;
        *self.of_edge.entry((low, high)).or_insert_with(|| {
            points.push(p + (q - p) * (dp / (dp - dq)));
            points.len() as u32 - 1
        })
    }

    /// Vertices of the section, counter-clockwise seen from the side that is cut away.
    fn cap(&self, plane: &Plane, sides: &[Ordering]) -> Vec<u32> {
        let on = (0..sides.len() as u32).filter(|&v| sides[v as usize] == Ordering::Equal);
        let ring: Vec<u32> = on.chain(self.of_edge.values().copied()).collect();
        let flat = |v: u32| plane.flat(self.points[v as usize]);
        let middle = ring.iter().map(|&v| flat(v)).sum::<DVec2>() / ring.len().max(1) as f64;
        let mut ring: Vec<(f64, u32)> =
            ring.into_iter().map(|v| ((flat(v) - middle).to_angle(), v)).collect();
        ring.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        ring.into_iter().map(|r| r.1).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::grid_cube;
    use super::*;

    #[test]
    fn clipping_halves_a_cube() {
        let hull = Hull::of_points(&grid_cube(2)).unwrap();
        let plane = Plane::through(hull.centroid(), DVec3::new(1.0, 2.0, 3.0)).unwrap();
        let half = hull.clip(&plane).unwrap();
        assert!((half.volume() - 0.5).abs() < 1e-7);
        assert!(half.vertices().iter().all(|&v| plane.distance(v) < 1e-7));
        let section = hull.section(&plane);
        assert!(section.len() >= 3 && section.iter().all(|&p| plane.distance(p).abs() < 1e-12));
    }

    #[test]
    fn clipping_agrees_with_the_hull_of_what_is_left() {
        let mut hull = Hull::of_points(&grid_cube(3)).unwrap();
        for k in 0..12 {
            let t = f64::from(k);
            let normal = DVec3::new(libm::sin(t), libm::cos(1.7 * t), libm::sin(0.6 * t));
            let plane = Plane::through(hull.centroid() + normal.normalize() * 0.2, normal).unwrap();
            let clipped = hull.clip(&plane).unwrap();
            let rebuilt = Hull::of_points(clipped.vertices()).unwrap();
            assert!((clipped.volume() - rebuilt.volume()).abs() < 1e-8);
            let corners: usize = clipped.facets().iter().map(|f| f.outline().len()).sum();
            assert_eq!(clipped.vertices().len() + clipped.facets().len(), corners / 2 + 2, "Euler");
            hull = clipped;
        }
        let away = Plane::through(hull.centroid() + DVec3::X * 10.0, DVec3::NEG_X).unwrap();
        assert!(hull.clip(&away).is_none());
    }
}
