//! A box with a grid on its faces.

use std::collections::BTreeMap;

use glam::{DVec3, I64Vec3};

use super::mesh::Mesh;

/// A box of `cells` cubes of `cell` mm along each axis; only its outside has faces.
pub fn block(cells: I64Vec3, cell: f64) -> Mesh {
    let mut numbers = BTreeMap::new();
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    let axes = [I64Vec3::X, I64Vec3::Y, I64Vec3::Z];
    for k in 0..3 {
        let (along, first, second) = (axes[k], axes[(k + 1) % 3], axes[(k + 2) % 3]);
        for (is_far, base) in [(false, I64Vec3::ZERO), (true, along * cells)] {
            for (i, j) in (0..cells.dot(first)).flat_map(|i| (0..cells.dot(second)).map(move |j| (i, j))) {
                let corner = base + i * first + j * second;
                let mut quad = [corner, corner + first, corner + first + second, corner + second].map(|at| {
                    *numbers.entry(at.to_array()).or_insert_with(|| {
                        vertices.push(cell * (at.as_dvec3() - 0.5 * cells.as_dvec3()));
                        vertices.len() - 1
                    })
                });
                if !is_far {
                    quad.reverse();
                }
                let [a, b, c, d]: [usize; 4] = quad;
                faces.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    Mesh { vertices: vertices as Vec<DVec3>, faces }
}
