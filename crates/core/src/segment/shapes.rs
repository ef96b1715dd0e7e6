//! Small closed meshes for the tests of this module.

use crate::mesh::Mesh;
use glam::DVec3;
use std::collections::BTreeMap;

/// Positions and faces.
pub(super) type Shape = (Vec<DVec3>, Vec<[u32; 3]>);

/// Balls in a row along z, as (centre, radius), as one closed surface of revolution.
pub(super) fn balls_in_a_row(balls: &[(f64, f64)], rings: usize, around: usize) -> Shape {
    let lo = balls.iter().map(|b| b.0 - b.1).fold(f64::INFINITY, f64::min);
    let hi = balls.iter().map(|b| b.0 + b.1).fold(f64::NEG_INFINITY, f64::max);
    let radius =
        |z: f64| balls.iter().map(|b| (b.1 * b.1 - (z - b.0).powi(2)).max(0.0).sqrt()).fold(0.0, f64::max);
    let ring = |ring: usize| {
        let t = std::f64::consts::PI * ring as f64 / rings as f64;
        let z = lo + (hi - lo) * (1.0 - libm::cos(t)) / 2.0;
        (radius(z), z)
    };
    turned((lo, hi), &(1..rings).map(ring).collect::<Vec<_>>(), around)
}

/// A closed surface of revolution about z, from its lower end over rings of radius and height to its upper end.
pub(super) fn turned((lo, hi): (f64, f64), rings: &[(f64, f64)], around: usize) -> Shape {
    let mut positions = vec![DVec3::new(0.0, 0.0, lo)];
    for &(radius, z) in rings {
        for k in 0..around {
            let (sin, cos) = libm::sincos(k as f64 / around as f64 * std::f64::consts::TAU);
            positions.push(DVec3::new(cos * radius, sin * radius, z));
        }
    }
    positions.push(DVec3::new(0.0, 0.0, hi));
    let at = |ring: usize, k: usize| (1 + (ring - 1) * around + k % around) as u32;
    let last = positions.len() as u32 - 1;
    let mut faces = Vec::new();
    for k in 0..around {
        faces.push([0, at(1, k + 1), at(1, k)]);
        faces.push([last, at(rings.len(), k), at(rings.len(), k + 1)]);
        for ring in 1..rings.len() {
            let [a, b] = [at(ring, k), at(ring, k + 1)];
            let [c, d] = [at(ring + 1, k), at(ring + 1, k + 1)];
            faces.extend([[a, b, d], [a, d, c]]);
        }
    }
    (positions, faces)
}

/// Points of a half plane along a straight line, without its end.
pub(super) fn line(from: (f64, f64), to: (f64, f64), steps: u32) -> impl Iterator<Item = (f64, f64)> {
    (0..steps).map(move |k| {
        let t = f64::from(k) / f64::from(steps);
        (from.0 + (to.0 - from.0) * t, from.1 + (to.1 - from.1) * t)
    })
}

/// A box from its least corner to its largest.
pub(super) fn cuboid(low: DVec3, high: DVec3) -> Shape {
    let corner =
        |k: usize| DVec3::new([low.x, high.x][k & 1], [low.y, high.y][k >> 1 & 1], [low.z, high.z][k >> 2]);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    ((0..8).map(corner).collect(), faces)
}

/// The surface of the cubes of size 1 between 0 and `size` that are taken, rounded: in each round every vertex moves half of
/// the way to the middle of its neighbours.
pub(super) fn rounded_cubes(size: [i32; 3], is_taken: impl Fn([i32; 3]) -> bool, rounds: usize) -> Shape {
    let is_in = |cube: [i32; 3]| (0..3).all(|k| (0..size[k]).contains(&cube[k])) && is_taken(cube);
    let cubes =
        (0..size[0]).flat_map(|x| (0..size[1]).flat_map(move |y| (0..size[2]).map(move |z| [x, y, z])));
    let mut vertices: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let mut quads: Vec<[u32; 4]> = Vec::new();
    for cube in cubes.filter(|cube| is_in(*cube)) {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut next = cube;
            next[axis] += 2 * side - 1;
            if is_in(next) {
                continue;
            }
            let mut corner = |[u, v]: [i32; 2]| {
                let mut at = cube;
                at[axis] += side;
                at[(axis + 1) % 3] += u;
                at[(axis + 2) % 3] += v;
                let count = vertices.len() as u32;
                *vertices.entry(at).or_insert(count)
            };
            let quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(&mut corner);
            quads.push(if side == 1 { quad } else { [quad[3], quad[2], quad[1], quad[0]] });
        }
    }
    let mut positions = vec![DVec3::ZERO; vertices.len()];
    vertices.iter().for_each(|(at, &vertex)| positions[vertex as usize] = DVec3::from(at.map(f64::from)));
    for _ in 0..rounds {
        let mut around = vec![(DVec3::ZERO, 0.0); positions.len()];
        // Each edge is on two quads, once in either direction.
        for [from, to] in quads.iter().flat_map(|&[a, b, c, d]| [[a, b], [b, c], [c, d], [d, a]]) {
            around[from as usize].0 += positions[to as usize];
            around[from as usize].1 += 1.0;
        }
        positions.iter_mut().zip(around).for_each(|(p, (sum, count))| *p = p.lerp(sum / count, 0.5));
    }
    (positions, quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect())
}

/// Several bodies in one mesh.
pub(super) fn together(shapes: &[Shape]) -> Shape {
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for (p, f) in shapes {
        let base = positions.len() as u32;
        positions.extend(p);
        faces.extend(f.iter().map(|t| t.map(|v| v + base)));
    }
    (positions, faces)
}

/// A shape moved point by point.
pub(super) fn moved(shape: &Shape, to: impl Fn(DVec3) -> DVec3) -> Shape {
    (shape.0.iter().map(|&p| to(p)).collect(), shape.1.clone())
}

/// As a mesh.
pub(super) fn mesh((positions, faces): &Shape) -> Mesh {
    Mesh::for_tests(positions.clone(), faces.clone())
}
