//! Cutting faces along a plane.

use super::Mesh;
use crate::geom::Plane;
use std::collections::BTreeMap;

/// Vertices within this share of the diagonal from the plane are on it.
const ON_PLANE: f64 = 1e-7;

impl Mesh {
    /// The same surface, with the chosen faces cut where they cross a plane, so that none of them
    /// is on both sides; together with the face that each new face is a piece of. Neighbours get
    /// the new vertices as well, so that nothing comes apart.
    pub fn cut(&self, is_chosen: impl Fn(usize) -> bool, plane: &Plane) -> (Self, Vec<u32>) {
        let near = ON_PLANE * self.diagonal_mm();
        let height: Vec<f64> = self
            .positions
            .iter()
            .map(|&p| plane.distance(p))
            .map(|d| if d.abs() <= near { 0.0 } else { d })
            .collect();
        let mut positions = self.positions.clone();
        let mut middle: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for face in (0..self.faces.len()).filter(|&f| is_chosen(f)) {
            for edge in edges(self.faces[face]) {
                let [a, b] = edge.map(|v| height[v as usize]);
                if a * b < 0.0 && !middle.contains_key(&edge) {
                    let [p, q] = edge.map(|v| self.positions[v as usize]);
                    middle.insert(edge, positions.len() as u32);
                    positions.push(p.lerp(q, a / (a - b)));
                }
            }
        }
        let (mut faces, mut origin) = (Vec::new(), Vec::new());
        for (f, &face) in self.faces.iter().enumerate() {
            for piece in pieces(face, edges(face).map(|e| middle.get(&e).copied())) {
                faces.push(piece);
                origin.push(f as u32);
            }
        }
        let input_face = origin.iter().map(|&f| self.input_face[f as usize]).collect();
        (Self::of_parts(positions, faces, input_face), origin)
    }
}

/// The edges of a face from each corner to the next, the smaller vertex first.
fn edges(face: [u32; 3]) -> [[u32; 2]; 3] {
    [0, 1, 2].map(|k| {
        let (a, b) = (face[k], face[(k + 1) % 3]);
        [a.min(b), a.max(b)]
    })
}

/// A face cut at new vertices on its edges; a plane crosses at most two of them.
fn pieces(face: [u32; 3], middle: [Option<u32>; 3]) -> Vec<[u32; 3]> {
    for k in 0..3 {
        let [a, b, c] = [0, 1, 2].map(|i| face[(k + i) % 3]);
        match [middle[k], middle[(k + 1) % 3], middle[(k + 2) % 3]] {
            [Some(ab), None, Some(ca)] => return vec![[a, ab, ca], [ab, b, c], [ab, c, ca]],
            [Some(ab), None, None] => return vec![[a, ab, c], [ab, b, c]],
            _ => {}
        }
    }
    vec![face]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn cube() -> Mesh {
        let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Mesh::for_tests((0..8).map(corner).collect(), faces)
    }

    fn open_edges(mesh: &Mesh) -> usize {
        let edges = mesh.edges();
        (0..edges.count()).filter(|&e| edges.sides(e).len() == 1).count()
    }

    #[test]
    fn a_cube_cut_anywhere_stays_closed_with_its_volume() {
        for normal in [DVec3::X, DVec3::ONE, DVec3::new(0.3, -1.0, 0.2)] {
            let plane = Plane::through(DVec3::splat(0.5), normal).unwrap();
            let (mesh, origin) = cube().cut(|_| true, &plane);
            assert!((mesh.volume() - 1.0).abs() < 1e-12);
            assert_eq!(open_edges(&mesh), 0);
            assert_eq!(origin.len(), mesh.faces().len());
            for f in 0..mesh.faces().len() {
                let sides = mesh.corners(f).map(|c| plane.distance(c));
                assert!(sides.iter().all(|&s| s < 1e-9) || sides.iter().all(|&s| s > -1e-9));
            }
        }
    }

    #[test]
    fn only_chosen_faces_are_cut_and_neighbours_follow() {
        let plane = Plane::through(DVec3::splat(0.4), DVec3::X).unwrap();
        // The two triangles of the bottom: four of their edges cross, shared with two sides.
        let (mesh, _) = cube().cut(|f| f < 2, &plane);
        assert_eq!(mesh.positions().len(), 8 + 3);
        assert_eq!(open_edges(&mesh), 0);
        let (same, _) = cube().cut(|_| false, &plane);
        assert_eq!(same, cube());
    }
}
