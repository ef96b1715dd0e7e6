//! Where separate bodies touch, or nearly do.

use super::apart::Apart;
use super::surface::Surface;
use super::{SegmentId, Segmentation};
use crate::mesh::Mesh;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Bodies nearer to each other than this share of the diagonal touch. Models made for screens push
/// parts into each other or leave such gaps; in paper it is a millimetre or two.
pub(super) const GAP: f64 = 0.01;

/// Faces are sampled at this share of the gap, but each side in at most `FINEST` pieces.
const SPACING: f64 = 0.7;
const FINEST: f64 = 250.0;

/// Places where bodies touch.
pub(super) struct Touch {
    /// Midway between the two surfaces.
    pub at: DVec3,
    /// A face of either body.
    pub faces: [usize; 2],
    /// How far the two are from each other, at most.
    pub gap: f64,
}

/// A point of the surface.
struct Sample {
    at: DVec3,
    face: usize,
}

/// For each pair of segments of different bodies that touch, nearly touch or run into each other,
/// points midway between the two surfaces; the smaller id first, in ascending order.
pub(super) fn near_contacts(
    mesh: &Mesh,
    segmentation: &Segmentation,
) -> BTreeMap<(SegmentId, SegmentId), Vec<DVec3>> {
    let (body, _) = Surface::of_faces(mesh.positions(), mesh.faces()).components(|_| 0);
    near(&touches(mesh, &body), segmentation.face_segments(), |_| false)
}

/// Points where segments touch, for each pair, the smaller id first. Faces that are left out touch only where no others
/// of the two do.
pub(super) fn near(
    touches: &[Touch],
    segments: &[SegmentId],
    is_left_out: impl Fn(usize) -> bool,
) -> BTreeMap<(SegmentId, SegmentId), Vec<DVec3>> {
    let mut near: BTreeMap<(SegmentId, SegmentId), [Vec<DVec3>; 2]> = BTreeMap::new();
    for touch in touches {
        let [own, other] = touch.faces.map(|face| segments[face]);
        if own != other {
            let points = near.entry((own.min(other), own.max(other))).or_default();
            points[usize::from(touch.faces.iter().any(|&face| is_left_out(face)))].push(touch.at);
        }
    }
    let of_pair = |(pair, [points, of_left_out]): (_, [Vec<DVec3>; 2])| {
        (pair, if points.is_empty() { of_left_out } else { points })
    };
    near.into_iter().map(of_pair).collect()
}

/// Where each body has others near it, and which is the nearest there; `body` says which faces are on one.
pub(super) fn touches(mesh: &Mesh, body: &[u32]) -> Vec<Touch> {
    if body.iter().all(|other| *other == body[0]) {
        return Vec::new();
    }
    let gap = GAP * mesh.diagonal_mm();
    let spacing = SPACING * gap;
    let faces = (0..mesh.faces().len()).into_par_iter();
    let samples: Vec<Sample> = faces
        .flat_map_iter(|face| spread(mesh.corners(face), spacing).map(move |at| Sample { at, face }))
        .collect();
    // Two surfaces at a gap have samples up to a spacing farther apart.
    let reach = gap * (1.0 + SPACING);
    let (points, bodies): (Vec<DVec3>, Vec<u32>) = samples.iter().map(|s| (s.at, body[s.face])).unzip();
    let mut tree = Apart::new(&points);
    tree.mark(&bodies);
    let nearest_of = |i: usize| Some((i, tree.nearest_other(i, &bodies, reach * reach)?.1 as usize));
    let near: Vec<(usize, usize)> = (0..samples.len()).into_par_iter().filter_map(nearest_of).collect();
    let touch = |(i, o): (usize, usize)| {
        let [own, other] = [&samples[i], &samples[o]];
        Touch { at: own.at.midpoint(other.at), faces: [own.face, other.face], gap: own.at.distance(other.at) }
    };
    near.into_iter().map(touch).collect()
}

/// Points of a triangle in rows along its longest side, at most `spacing` apart: middles of pieces of nearly the same area.
fn spread(corners: [DVec3; 3], spacing: f64) -> impl Iterator<Item = DVec3> {
    let side = |k: usize| corners[k].distance(corners[(k + 1) % 3]);
    let longest = (1..3).fold(0, |best, k| if side(k) > side(best) { k } else { best });
    let [a, b, c] = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
    let height = (b - a).cross(c - a).length() / side(longest).max(f64::MIN_POSITIVE);
    let pieces = move |length: f64| (length / spacing).ceil().clamp(1.0, FINEST);
    let rows = pieces(height);
    (0..rows as u32).flat_map(move |row| {
        // A row is a trapezium as wide as this at either edge.
        let [below, above] = [0.0, 1.0].map(|edge| 1.0 - (f64::from(row) + edge) / rows);
        let middle = (below + 2.0 * above) / (3.0 * (below + above));
        let up = (f64::from(row) + middle) / rows;
        let [left, right] = [a, b].map(|end| end.lerp(c, up));
        let count = pieces(left.distance(right));
        (0..count as u32).map(move |k| left.lerp(right, (f64::from(k) + 0.5) / count))
    })
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{Shape, balls_in_a_row, cuboid, mesh, moved, together};
    use super::*;
    use crate::geom::Plane;

    fn segments(shapes: &[Shape]) -> (Mesh, Segmentation) {
        let of_shape = |(k, s): (usize, &Shape)| vec![SegmentId(k as u32); s.1.len()];
        let face_segment = shapes.iter().enumerate().flat_map(of_shape).collect();
        (mesh(&together(shapes)), Segmentation { face_segment, count: shapes.len(), mirror: None })
    }

    fn cube(low: DVec3, side: f64) -> Shape {
        cuboid(low, low + side)
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
