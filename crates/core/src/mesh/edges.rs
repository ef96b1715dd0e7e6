//! Which faces meet at which edge.

use rayon::prelude::*;

/// The edges of a list of triangles.
///
/// A *side* is one of a triangle's three borders: side `3 f + k` leads from corner `k` of face `f`
/// to its corner `(k + 1) % 3`. An edge is the set of all sides between the same two vertices: one
/// side at a border, two on a manifold surface, more elsewhere.
///
/// # Guarantees
/// Edges are in ascending order of their vertices; the sides of an edge in ascending order.
#[derive(Debug, Clone, PartialEq)]
pub struct Edges {
    vertices: Vec<[u32; 2]>,
    first: Vec<u32>,
    sides: Vec<u32>,
    of_side: Vec<u32>,
}

impl Edges {
    /// Collects the edges of triangles. There must be fewer than 2³² sides.
    pub fn new(faces: &[[u32; 3]]) -> Self {
        let mut keyed: Vec<(u64, u32)> = faces
            .par_iter()
            .enumerate()
            .flat_map_iter(|(f, t)| {
                (0..3).map(move |k| {
                    let (a, b) = (t[k], t[(k + 1) % 3]);
                    let key = (u64::from(a.min(b)) << 32) | u64::from(a.max(b));
                    (key, (3 * f + k) as u32)
                })
            })
            .collect();
        keyed.par_sort_unstable();
        let mut edges = Self {
            vertices: Vec::new(),
            first: Vec::new(),
            sides: Vec::with_capacity(keyed.len()),
            of_side: vec![0; keyed.len()],
        };
        let mut last = None;
        for (key, side) in keyed {
            if last != Some(key) {
                last = Some(key);
                edges.first.push(edges.sides.len() as u32);
                edges.vertices.push([(key >> 32) as u32, key as u32]);
            }
            edges.of_side[side as usize] = (edges.vertices.len() - 1) as u32;
            edges.sides.push(side);
        }
        edges.first.push(edges.sides.len() as u32);
        edges
    }

    /// Number of edges.
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// The two vertices of edge `e`, the smaller index first.
    pub fn vertices(&self, e: usize) -> [u32; 2] {
        self.vertices[e]
    }

    /// The edge between two vertices, the smaller index first.
    pub fn find(&self, vertices: [u32; 2]) -> Option<usize> {
        self.vertices.binary_search(&vertices).ok()
    }

    /// The sides of edge `e`.
    pub fn sides(&self, e: usize) -> &[u32] {
        &self.sides[self.first[e] as usize..self.first[e + 1] as usize]
    }

    /// The edge of side `k` of face `f`.
    pub fn of(&self, f: usize, k: usize) -> usize {
        self.of_side[3 * f + k] as usize
    }

    /// The other side of side `k` of face `f`, as face and side, where exactly two sides meet.
    pub(crate) fn opposite(&self, f: usize, k: usize) -> Option<(usize, usize)> {
        match *self.sides(self.of(f, k)) {
            [a, b] => {
                let other = if a as usize == 3 * f + k { b } else { a } as usize;
                Some((other / 3, other % 3))
            }
            _ => None,
        }
    }

    /// The faces that share an edge with face `f`, in the order of its sides; a face that shares
    /// two edges comes twice.
    pub fn neighbours(&self, f: usize) -> impl Iterator<Item = usize> + '_ {
        (0..3)
            .flat_map(move |k| self.sides(self.of(f, k)))
            .map(|&side| side as usize / 3)
            .filter(move |&other| other != f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_and_a_fin() {
        let edges = Edges::new(&[[0, 1, 2], [2, 1, 3], [1, 2, 4], [4, 5, 6]]);
        let shared = edges.of(0, 1);
        assert_eq!(edges.vertices(shared), [1, 2]);
        assert_eq!(edges.find([1, 2]), Some(shared));
        assert_eq!(edges.find([0, 3]), None);
        assert_eq!(edges.sides(shared), [1, 3, 6]);
        assert_eq!(edges.neighbours(0).collect::<Vec<_>>(), [1, 2]);
        assert_eq!(edges.neighbours(3).count(), 0);
        assert_eq!(edges.opposite(0, 1), None);
        assert_eq!(edges.count(), 1 + 2 + 2 + 2 + 3);
    }

    #[test]
    fn two_faces_are_opposite_each_other() {
        let edges = Edges::new(&[[0, 1, 2], [2, 1, 3]]);
        assert_eq!(edges.opposite(0, 1), Some((1, 0)));
        assert_eq!(edges.opposite(1, 0), Some((0, 1)));
        assert_eq!(edges.opposite(0, 0), None);
    }
}
