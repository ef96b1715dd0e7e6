//! A mesh of few faces that looks like one of many.

use glam::DVec3;
use std::collections::BTreeMap;
use tatamu_core::geom::bounds;

/// Finest grid of vertices, cells along the longest side.
const FINEST: f64 = 160.0;
/// A grid this coarse is used whatever the number of faces.
const COARSEST: f64 = 12.0;

/// Vertices, triangles, and the triangle of the mesh that each comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Proxy {
    /// Vertices.
    pub vertices: Vec<DVec3>,
    /// Triangles.
    pub triangles: Vec<[u32; 3]>,
    /// Index of the triangle that each one stands for.
    pub origin: Vec<u32>,
    /// Whether it is the mesh itself.
    pub is_whole: bool,
}

/// The mesh itself where it has at most `most` triangles, else one whose vertices are joined by
/// the cells of a grid (Rossignac and Borrel 1993) that leaves about as many.
pub fn proxy(vertices: &[DVec3], triangles: &[[u32; 3]], most: usize) -> Proxy {
    if triangles.len() <= most {
        let origin = (0..triangles.len() as u32).collect();
        return Proxy { vertices: vertices.to_vec(), triangles: triangles.to_vec(), origin, is_whole: true };
    }
    let mut fineness = FINEST;
    loop {
        let clustered = cluster(vertices, triangles, fineness);
        let count = clustered.triangles.len();
        if count <= most || fineness <= COARSEST {
            return clustered;
        }
        // Faces grow with the square of the fineness.
        fineness *= (most as f64 / count as f64).sqrt().clamp(0.5, 0.95);
    }
}

fn cluster(vertices: &[DVec3], triangles: &[[u32; 3]], fineness: f64) -> Proxy {
    let (low, high) = bounds(vertices.iter().copied());
    let cell = (high - low).max_element().max(f64::MIN_POSITIVE) / fineness;
    let mut index: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let mut sums: Vec<(DVec3, f64)> = Vec::new();
    let of_vertex: Vec<u32> = vertices
        .iter()
        .map(|&p| {
            let key = ((p - low) / cell).floor().as_ivec3().to_array();
            let id = *index.entry(key).or_insert(sums.len() as u32);
            if id as usize == sums.len() {
                sums.push((DVec3::ZERO, 0.0));
            }
            let sum = &mut sums[id as usize];
            *sum = (sum.0 + p, sum.1 + 1.0);
            id
        })
        .collect();
    let mut seen = std::collections::BTreeSet::new();
    let (mut kept, mut origin) = (Vec::new(), Vec::new());
    for (t, triangle) in triangles.iter().enumerate() {
        let corners = triangle.map(|v| of_vertex[v as usize]);
        let [a, b, c] = corners;
        // The same orientation whatever the first corner.
        let first = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
        let turned = [corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]];
        if a != b && b != c && c != a && seen.insert(turned) {
            kept.push(corners);
            origin.push(t as u32);
        }
    }
    let vertices = sums.into_iter().map(|(sum, n)| sum / n).collect();
    Proxy { vertices, triangles: kept, origin, is_whole: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of n × n quads.
    fn sheet(n: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let at = |i: u32, j: u32| i * (n + 1) + j;
        let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| DVec3::new(i.into(), j.into(), 0.0)));
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let triangles = cells.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        (vertices.collect(), triangles.collect())
    }

    #[test]
    fn few_faces_are_kept_and_many_become_few_of_nearly_the_same_area() {
        let (vertices, triangles) = sheet(20);
        let same = proxy(&vertices, &triangles, 800);
        assert_eq!((same.vertices, same.triangles), (vertices, triangles));
        let (vertices, triangles) = sheet(100);
        let few = proxy(&vertices, &triangles, 2000);
        assert!((500..=2000).contains(&few.triangles.len()), "{}", few.triangles.len());
        let area = few.triangles.iter().map(|t| {
            let [a, b, c] = t.map(|v| few.vertices[v as usize]);
            (b - a).cross(c - a).z / 2.0
        });
        let share = area.sum::<f64>() / 10_000.0;
        assert!((0.9..=1.0).contains(&share), "{share}");
        assert!(few.origin.iter().all(|&t| (t as usize) < triangles.len()));
    }
}
