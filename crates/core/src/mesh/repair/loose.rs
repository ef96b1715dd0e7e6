//! Leaving out bodies that no paper model can have.

use super::orient::components;
use super::{Repairs, Triangle};
use crate::geom::bounds;
use crate::mesh::Edges;
use glam::DVec3;

/// Bodies smaller than this share of the mesh's diagonal are dropped. At 200 mm it is 2 mm, less than the
/// narrowest panel by default.
const SPECK: f64 = 0.01;

/// The largest bodies are kept: a model has no more parts than this, and 10⁵ bodies took more than a minute.
const MOST_BODIES: usize = 200;

/// Where there are more, bodies of fewer triangles are scraps of a surface, which no part can be made of.
const LEAST_FACES: usize = 4;

/// Drops specks; of very many bodies also scraps, and all but the largest. Counts them.
pub(super) fn drop_loose(positions: &[DVec3], triangles: &mut Vec<Triangle>, repairs: &mut Repairs) {
    let faces: Vec<[u32; 3]> = triangles.iter().map(|t| t.corners).collect();
    let (body_of, count) = components(faces.len(), &Edges::new(&faces));
    if count < 2 {
        return;
    }
    let mut face_counts = vec![0; count];
    body_of.iter().for_each(|&body| face_counts[body as usize] += 1);
    let is_scrap = |body: usize| count > MOST_BODIES && face_counts[body] < LEAST_FACES;
    let mut boxes = vec![(DVec3::INFINITY, DVec3::NEG_INFINITY); count];
    for (face, &body) in faces.iter().zip(&body_of) {
        for p in face.map(|v| positions[v as usize]) {
            let (low, high) = &mut boxes[body as usize];
            (*low, *high) = (low.min(p), high.max(p));
        }
    }
    let sizes: Vec<f64> = boxes.iter().map(|(low, high)| low.distance(*high)).collect();
    let corners: Vec<DVec3> = boxes.iter().flat_map(|(low, high)| [*low, *high]).collect();
    let (low, high) = bounds(corners);
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| is_scrap(a).cmp(&is_scrap(b)).then(sizes[b].total_cmp(&sizes[a])).then(a.cmp(&b)));
    let mut is_kept = vec![false; count];
    for (rank, &body) in order.iter().enumerate() {
        let is_large = rank < MOST_BODIES && sizes[body] >= SPECK * low.distance(high);
        is_kept[body] = rank == 0 || is_large && !is_scrap(body);
    }
    repairs.loose_bodies = is_kept.iter().filter(|kept| !**kept).count();
    let mut bodies = body_of.iter();
    triangles.retain(|_| bodies.next().is_some_and(|&body| is_kept[body as usize]));
}
