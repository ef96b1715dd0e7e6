//! Meshes a [`Solid`] by surface nets (Gibson 1998), then evens the mesh out on the surface.

use std::collections::BTreeMap;

use glam::{DVec3, I64Vec3};

use super::implicit::Solid;
use super::mesh::Mesh;

/// Rounds of evening out: enough for the grid's pattern to vanish from the samples.
const ROUNDS: usize = 40;

/// Steps onto the surface at the end: the last is below the files' precision.
const NEWTON_STEPS: usize = 4;

/// For each grid edge its direction and the two across it, right-handed.
const FRAMES: [[I64Vec3; 3]; 3] = [
    [I64Vec3::X, I64Vec3::Y, I64Vec3::Z],
    [I64Vec3::Y, I64Vec3::Z, I64Vec3::X],
    [I64Vec3::Z, I64Vec3::X, I64Vec3::Y],
];

/// A mesh of the solid, which must lie within `low..high`, with edges of about `cell` mm.
pub fn mesh(solid: &Solid, low: DVec3, high: DVec3, cell: f64) -> Mesh {
    let grid = Grid::sample(solid, low, high, cell);
    let (mut vertices, quads) = grid.surface();
    let neighbours = neighbours(vertices.len(), &quads);
    let reach = 0.3 * cell;
    for _ in 0..ROUNDS {
        even_out(solid, &mut vertices, &neighbours, reach);
    }
    for vertex in &mut vertices {
        for _ in 0..NEWTON_STEPS {
            *vertex -= to_surface(solid, *vertex, solid.gradient(*vertex), reach);
        }
    }
    let faces = quads.iter().flat_map(|&quad| split(solid, &vertices, quad)).collect();
    Mesh { vertices, faces }
}

struct Grid {
    low: DVec3,
    cell: f64,
    size: I64Vec3,
    values: Vec<f64>,
}

impl Grid {
    /// The grid is centred on `low..high`, so that a mirrored solid gets a mirrored mesh.
    fn sample(solid: &Solid, low: DVec3, high: DVec3, cell: f64) -> Self {
        let size = ((high - low) / cell).ceil().as_i64vec3() + 1;
        let low = 0.5 * (low + high) - 0.5 * cell * (size - 1).as_dvec3();
        let mut values = Vec::new();
        for z in 0..size.z {
            for y in 0..size.y {
                for x in 0..size.x {
                    let point = low + cell * I64Vec3::new(x, y, z).as_dvec3();
                    values.push(solid.distance(point));
                }
            }
        }
        Self { low, cell, size, values }
    }

    fn value(&self, at: I64Vec3) -> f64 {
        self.values[(at.x + self.size.x * (at.y + self.size.y * at.z)) as usize]
    }

    /// One vertex in each cell that the surface crosses, one quad round each grid edge that it
    /// crosses.
    fn surface(&self) -> (Vec<DVec3>, Vec<[usize; 4]>) {
        let mut numbers = BTreeMap::new();
        let mut vertices = Vec::new();
        let mut quads = Vec::new();
        for z in 1..self.size.z - 1 {
            for y in 1..self.size.y - 1 {
                for x in 1..self.size.x - 1 {
                    let at = I64Vec3::new(x, y, z);
                    for [along, first, second] in FRAMES {
                        let is_inside = self.value(at) < 0.0;
                        if is_inside == (self.value(at + along) < 0.0) {
                            continue;
                        }
                        let mut quad = [at - first - second, at - second, at, at - first].map(|c| {
                            *numbers.entry(c.to_array()).or_insert_with(|| {
                                vertices.push(self.crossing_mean(c));
                                vertices.len() - 1
                            })
                        });
                        if !is_inside {
                            quad.reverse();
                        }
                        quads.push(quad);
                    }
                }
            }
        }
        (vertices, quads)
    }

    /// Mean of the points where the surface crosses the edges of the cell.
    fn crossing_mean(&self, cell: I64Vec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        let mut count = 0.0;
        for [along, first, second] in FRAMES {
            for corner in [I64Vec3::ZERO, first, second, first + second] {
                let start = cell + corner;
                let (a, b) = (self.value(start), self.value(start + along));
                if (a < 0.0) != (b < 0.0) {
                    sum += start.as_dvec3() + along.as_dvec3() * (a / (a - b));
                    count += 1.0;
                }
            }
        }
        self.low + self.cell * sum / count
    }
}

/// For each vertex the vertices that share an edge of a quad with it.
fn neighbours(count: usize, quads: &[[usize; 4]]) -> Vec<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); count];
    for quad in quads {
        for k in 0..4 {
            neighbours[quad[k]].push(quad[(k + 1) % 4]);
        }
    }
    neighbours
}

/// Slides every vertex along the surface half-way to its neighbours' mean, and pulls it onto the
/// surface.
fn even_out(solid: &Solid, vertices: &mut [DVec3], neighbours: &[Vec<usize>], reach: f64) {
    let moved: Vec<DVec3> = neighbours
        .iter()
        .zip(vertices.iter())
        .map(|(around, &vertex)| {
            let sum: DVec3 = around.iter().map(|&n| vertices[n]).sum();
            let wish = sum / around.len() as f64 - vertex;
            let gradient = solid.gradient(vertex);
            let normal = gradient.normalize_or_zero();
            let slide = 0.5 * (wish - normal * normal.dot(wish));
            vertex + slide - to_surface(solid, vertex, gradient, reach)
        })
        .collect();
    vertices.copy_from_slice(&moved);
}

/// A Newton step along the gradient, no longer than `reach`.
fn to_surface(solid: &Solid, point: DVec3, gradient: DVec3, reach: f64) -> DVec3 {
    let step = gradient * (solid.distance(point) / gradient.length_squared().max(0.1));
    step.clamp_length_max(reach)
}

/// Two triangles, cut along the diagonal that is short and near the surface. Of two equal ones
/// the first is taken, whatever the last bits say.
fn split(solid: &Solid, vertices: &[DVec3], [a, b, c, d]: [usize; 4]) -> [[usize; 3]; 2] {
    const OFF_SURFACE_WEIGHT: f64 = 8.0;
    const TIE_MM: f64 = 1e-6;
    let cost = |i: usize, j: usize| {
        let (p, q) = (vertices[i], vertices[j]);
        p.distance(q) + OFF_SURFACE_WEIGHT * solid.distance(0.5 * (p + q)).abs()
    };
    if cost(a, c) <= cost(b, d) + TIE_MM { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
}
