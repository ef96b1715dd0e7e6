//! Where separate bodies touch, or nearly do.

use super::surface::Surface;
use super::{SegmentId, Segmentation};
use crate::mesh::Mesh;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};

/// Bodies nearer to each other than this share of the diagonal touch. Models made for screens push
/// parts into each other or leave such gaps; in paper it is a millimetre or two.
const GAP: f64 = 0.01;

/// Faces are sampled at this share of the gap, but no finer than so many points along an edge.
const SPACING: f64 = 0.7;
const FINEST: f64 = 250.0;

/// A point of the surface.
struct Sample {
    at: DVec3,
    body: u32,
    segment: SegmentId,
}

/// For each pair of segments of different bodies that touch, nearly touch or run into each other,
/// points midway between the two surfaces; the smaller id first, in ascending order.
pub fn near_contacts(
    mesh: &Mesh,
    segmentation: &Segmentation,
) -> BTreeMap<(SegmentId, SegmentId), Vec<DVec3>> {
    let (body, bodies) = Surface::of_faces(mesh.positions(), mesh.faces()).components(|_| 0);
    let mut contacts: BTreeMap<(SegmentId, SegmentId), Vec<DVec3>> = BTreeMap::new();
    if bodies < 2 {
        return contacts;
    }
    let gap = GAP * mesh.diagonal_mm();
    let samples = sample(mesh, segmentation, &body, SPACING * gap);
    // Two surfaces at a gap have samples up to a spacing farther apart.
    let reach = gap * (1.0 + SPACING);
    let cell = |p: DVec3| (p / reach).floor().as_i64vec3().to_array();
    let mut grid: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    for (i, s) in samples.iter().enumerate() {
        grid.entry(cell(s.at)).or_default().push(i as u32);
    }
    // All samples of a cell have the same cells around them.
    let nearest_of = |(&[x, y, z], own): (&[i64; 3], &Vec<u32>)| {
        let cells = (0..27).filter_map(|k| grid.get(&[x + k / 9 - 1, y + k / 3 % 3 - 1, z + k % 3 - 1]));
        let around: Vec<u32> = cells.flatten().copied().collect();
        let nearest = |&i: &u32| {
            let s = &samples[i as usize];
            let others = around.iter().filter(|&&o| samples[o as usize].body != s.body);
            let apart = others.map(|&o| (samples[o as usize].at.distance_squared(s.at), o));
            let nearest = apart.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            nearest.filter(|n| n.0 <= reach * reach).map(|n| (i, n.1))
        };
        own.iter().filter_map(nearest).collect::<Vec<_>>()
    };
    let mut near: Vec<(u32, u32)> = grid.par_iter().flat_map_iter(nearest_of).collect();
    near.sort_unstable();
    for [s, other] in near.into_iter().map(|(i, o)| [i, o].map(|k| &samples[k as usize])) {
        if other.segment != s.segment {
            let pair = (s.segment.min(other.segment), s.segment.max(other.segment));
            contacts.entry(pair).or_default().push(s.at.midpoint(other.at));
        }
    }
    contacts
}

/// Points of all faces, `spacing` apart or less: centres of equal parts of each.
fn sample(mesh: &Mesh, segmentation: &Segmentation, body: &[u32], spacing: f64) -> Vec<Sample> {
    let mut samples = Vec::new();
    for (f, &segment) in segmentation.face_segments().iter().enumerate() {
        let [a, b, c] = mesh.corners(f);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let n = (longest / spacing).ceil().clamp(1.0, FINEST);
        for i in 0..n as u32 {
            for j in 0..n as u32 - i {
                let mut push = |u: f64, v: f64| {
                    let at = a + (b - a) * (u / n) + (c - a) * (v / n);
                    samples.push(Sample { at, body: body[f], segment });
                };
                let (i, j) = (f64::from(i), f64::from(j));
                push(i + 1.0 / 3.0, j + 1.0 / 3.0);
                if i + j + 2.0 <= n {
                    push(i + 2.0 / 3.0, j + 2.0 / 3.0);
                }
            }
        }
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{Shape, balls_in_a_row, mesh, moved, together};
    use super::*;
    use crate::geom::Plane;

    fn segments(shapes: &[Shape]) -> (Mesh, Segmentation) {
        let of_shape = |(k, s): (usize, &Shape)| vec![SegmentId(k as u32); s.1.len()];
        let face_segment = shapes.iter().enumerate().flat_map(of_shape).collect();
        (mesh(&together(shapes)), Segmentation { face_segment, count: shapes.len(), mirror: None })
    }

    fn cube(low: DVec3, side: f64) -> Shape {
        let corner =
            |k: u32| low + DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * side;
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        ((0..8).map(corner).collect(), faces)
    }

    #[test]
    fn a_small_cube_on_a_large_face_touches_where_it_stands() {
        for gap in [0.0, 0.02] {
            let shapes = [cube(DVec3::ZERO, 4.0), cube(DVec3::new(1.0, 1.5, 4.0 + gap), 1.0)];
            let (mesh, segmentation) = segments(&shapes);
            let found = near_contacts(&mesh, &segmentation);
            let points = &found[&(SegmentId(0), SegmentId(1))];
            let (plane, residual) = Plane::fit(points).unwrap();
            assert!(plane.normal().z.abs() > 0.99 && residual < 0.1, "{plane:?}");
            assert!(points.iter().all(|p| (0.8..2.2).contains(&p.x) && (1.3..2.7).contains(&p.y)));
            let centre = points.iter().sum::<DVec3>() / points.len() as f64;
            assert!(centre.distance(DVec3::new(1.5, 2.0, 4.0)) < 0.1, "{centre}");
        }
    }

    #[test]
    fn balls_pushed_into_each_other_touch_along_a_ring() {
        let ball = |z| balls_in_a_row(&[(z, 1.0)], 40, 40);
        let (mesh, segmentation) = segments(&[ball(0.0), ball(1.4)]);
        let found = near_contacts(&mesh, &segmentation);
        let points = &found[&(SegmentId(0), SegmentId(1))];
        let (plane, _) = Plane::fit(points).unwrap();
        assert!(plane.normal().z.abs() > 0.999);
        assert!((plane.offset().abs() - 0.7).abs() < 0.02);
        // The ring has radius √(1 − 0.7²) = 0.714.
        assert!(points.iter().all(|p| (p.truncate().length() - 0.714).abs() < 0.12));
    }

    #[test]
    fn bodies_apart_do_not_touch() {
        let ball = balls_in_a_row(&[(0.0, 1.0)], 20, 20);
        let far = moved(&ball, |p| p + DVec3::X * 2.2);
        let (mesh, segmentation) = segments(&[ball, far]);
        assert!(near_contacts(&mesh, &segmentation).is_empty());
    }
}
