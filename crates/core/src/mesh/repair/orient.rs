//! Turning faces to agree with their neighbours and to face outwards.

use super::Repairs;
use crate::mesh::Edges;
use glam::DVec3;

/// A patch whose vector area is below this share of its area is closed, so that its volume does
/// not depend on the point that it is measured from. Rounding leaves about 1e-12 for a million
/// faces.
const CLOSED: f64 = 1e-9;

/// An open patch tells inside from outside when the volume about the centroid of its component is
/// at least this share of area^1.5: a sphere has 0.094, a hemisphere 0.1, a quarter of a sphere
/// still 0.05, a sheet with bumps of a tenth of its width less than 0.01.
const CURVED: f64 = 0.01;

/// Turns faces over manifold edges until neighbours agree, patch by patch (a patch is what hangs
/// together over manifold edges), then turns each patch outwards: by its volume where it is
/// closed or clearly curved round the middle of its component, else as most of its faces were.
/// Counts turned faces and components.
pub(super) fn orient(positions: &[DVec3], faces: &mut [[u32; 3]], edges: &Edges, repairs: &mut Repairs) {
    let (component_of, component_count) = components(faces.len(), edges);
    repairs.components = component_count;
    let centroids = centroids(positions, faces, &component_of, component_count);
    let mut turned: Vec<Option<bool>> = vec![None; faces.len()];
    let mut patch = Vec::new();
    for seed in 0..faces.len() {
        if turned[seed].is_some() {
            continue;
        }
        grow(seed, faces, edges, &mut turned, &mut patch);
        let centre = centroids[component_of[seed] as usize];
        let is_turned = |f: usize| turned[f] == Some(true);
        if is_inside_out(positions, faces, &patch, &is_turned, centre) {
            for &f in &patch {
                turned[f] = turned[f].map(|t| !t);
            }
        }
    }
    for (face, turned) in faces.iter_mut().zip(turned) {
        if turned == Some(true) {
            face.swap(1, 2);
            repairs.flipped_faces += 1;
        }
    }
}

/// Numbers the connected components of faces over edges of any kind.
pub(super) fn components(face_count: usize, edges: &Edges) -> (Vec<u32>, usize) {
    let mut component_of = vec![u32::MAX; face_count];
    let mut is_done = vec![false; edges.count()];
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in 0..face_count {
        if component_of[seed] != u32::MAX {
            continue;
        }
        component_of[seed] = count;
        stack.push(seed);
        while let Some(f) = stack.pop() {
            for k in 0..3 {
                let e = edges.of(f, k);
                // An edge with many faces is looked at once, not once for each of them.
                if std::mem::replace(&mut is_done[e], true) {
                    continue;
                }
                for &side in edges.sides(e) {
                    let other = side as usize / 3;
                    if component_of[other] == u32::MAX {
                        component_of[other] = count;
                        stack.push(other);
                    }
                }
            }
        }
        count += 1;
    }
    (component_of, count as usize)
}

/// The centroid of each component's surface.
fn centroids(positions: &[DVec3], faces: &[[u32; 3]], component_of: &[u32], count: usize) -> Vec<DVec3> {
    let mut sums = vec![(DVec3::ZERO, 0.0); count];
    for (face, &component) in faces.iter().zip(component_of) {
        let [a, b, c] = face.map(|v| positions[v as usize]);
        let area = (b - a).cross(c - a).length();
        let sum = &mut sums[component as usize];
        sum.0 += (a + b + c) / 3.0 * area;
        sum.1 += area;
    }
    sums.into_iter().map(|(sum, area)| sum / area).collect()
}

/// Collects the patch of `seed`, and which of its faces must be turned to agree with `seed`.
/// Where the surface is one-sided, the first way to reach a face decides.
fn grow(seed: usize, faces: &[[u32; 3]], edges: &Edges, turned: &mut [Option<bool>], patch: &mut Vec<usize>) {
    patch.clear();
    patch.push(seed);
    turned[seed] = Some(false);
    let mut next = 0;
    while next < patch.len() {
        let f = patch[next];
        next += 1;
        for k in 0..3 {
            let Some((other, side)) = edges.opposite(f, k) else {
                continue;
            };
            if turned[other].is_none() {
                let runs_alike = faces[f][k] == faces[other][side];
                turned[other] = turned[f].map(|t| t != runs_alike);
                patch.push(other);
            }
        }
    }
}

fn is_inside_out(
    positions: &[DVec3],
    faces: &[[u32; 3]],
    patch: &[usize],
    is_turned: &dyn Fn(usize) -> bool,
    centre: DVec3,
) -> bool {
    let (mut volume, mut area, mut vector_area) = (0.0, 0.0, DVec3::ZERO);
    for &f in patch {
        let [a, b, c] = faces[f].map(|v| positions[v as usize] - centre);
        let sign = if is_turned(f) { -0.5 } else { 0.5 };
        let vector = (b - a).cross(c - a) * sign;
        volume += a.dot(vector) / 3.0;
        area += vector.length();
        vector_area += vector;
    }
    let is_closed = vector_area.length() <= CLOSED * area;
    if is_closed && volume != 0.0 || volume.abs() >= CURVED * libm::pow(area, 1.5) {
        return volume < 0.0;
    }
    let turned_count = patch.iter().filter(|&&f| is_turned(f)).count();
    2 * turned_count > patch.len()
}
