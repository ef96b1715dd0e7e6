//! What parts are called: by where they are, as seen from the front.

use super::Segmentation;
use crate::geom::bounds;
use crate::mesh::Mesh;
use glam::DVec3;
use std::collections::BTreeSet;

/// The names along each axis, of the lower side and of the upper one: the viewer looks along +y,
/// with x to the right and z up.
const PLACES: [[&str; 2]; 3] = [["left", "right"], ["front", "back"], ["bottom", "top"]];

/// Names for all parts, in their order. The first is the body. Each of a pair is called after its
/// side of the mirror plane with the number of the pair, biggest first: `left-1` and `right-1`. Each
/// other is called after the side of the body's box out of which it is farthest, and numbered from
/// the second on: `top`, `top-2`.
pub(super) fn names(mesh: &Mesh, segmentation: &Segmentation, areas: &[f64]) -> Vec<String> {
    let (low, high) = body_box(mesh, segmentation);
    let (middle, half) = (low.midpoint(high), (high - low) / 2.0);
    let centres = centres(mesh, segmentation);
    let twins = segmentation.twins(mesh);
    let twin = |k: usize| twins.as_ref().map_or(k, |twins| twins[k].0 as usize);
    let normal = segmentation.mirror().map(|plane| plane.mirror.plane().normal());
    let across = normal.map_or(0, |normal| normal.abs().max_position());
    let mut names = vec![String::new(); areas.len()];
    let mut taken = BTreeSet::new();
    let mut pairs: Vec<usize> = (0..areas.len()).filter(|&k| k < twin(k)).collect();
    let size = |k: usize| areas[k] + areas[twin(k)];
    pairs.sort_by(|&a, &b| size(b).total_cmp(&size(a)).then(a.cmp(&b)));
    for (number, one) in (1..).zip(pairs) {
        let other = twin(one);
        let is_lower = centres[one][across] < centres[other][across];
        let [lower, upper] = if is_lower { [one, other] } else { [other, one] };
        for (part, place) in [lower, upper].into_iter().zip(PLACES[across]) {
            names[part] = format!("{place}-{number}");
            taken.insert(names[part].clone());
        }
    }
    for k in 0..areas.len() {
        if names[k].is_empty() {
            let place = if k == 0 { "body" } else { place(centres[k] - middle, half) };
            let numbered = (2..).map(|number| format!("{place}-{number}"));
            let mut free = std::iter::once(place.to_owned()).chain(numbered).filter(|n| !taken.contains(n));
            names[k] = free.next().unwrap_or_default();
            taken.insert(names[k].clone());
        }
    }
    names
}

/// Where a point is from the middle of a box with these half sides.
fn place(from_middle: DVec3, half: DVec3) -> &'static str {
    let axis = (from_middle.abs() - half).max_position();
    PLACES[axis][usize::from(from_middle[axis] > 0.0)]
}

fn body_box(mesh: &Mesh, segmentation: &Segmentation) -> (DVec3, DVec3) {
    let of_body = segmentation.face_segments().iter().enumerate().filter(|(_, id)| id.0 == 0);
    bounds(of_body.flat_map(|(f, _)| mesh.corners(f)))
}

/// Centre of each part's surface.
fn centres(mesh: &Mesh, segmentation: &Segmentation) -> Vec<DVec3> {
    let mut sums = vec![(DVec3::ZERO, 0.0); segmentation.count()];
    for (f, id) in segmentation.face_segments().iter().enumerate() {
        let [a, b, c] = mesh.corners(f);
        let (area, sum) = ((b - a).cross(c - a).length(), &mut sums[id.0 as usize]);
        *sum = (sum.0 + (a + b + c) / 3.0 * area, sum.1 + area);
    }
    sums.into_iter().map(|(moment, area)| moment / f64::max(area, f64::MIN_POSITIVE)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::SegmentId;
    use super::super::shapes::{balls_in_a_row, mesh, moved, together};
    use super::*;
    use crate::geom::{Mirror, Plane};
    use crate::mesh::MirrorPlane;

    /// A body with balls at the given places.
    fn named(places: &[DVec3], normal: Option<DVec3>) -> Vec<String> {
        let ball = |at: DVec3, size: f64| moved(&balls_in_a_row(&[(0.0, size)], 12, 12), |p| p + at);
        let mut shapes = vec![ball(DVec3::ZERO, 3.0)];
        shapes.extend(places.iter().map(|&at| ball(at, 1.0)));
        let of_shape = |(k, s): (usize, &(Vec<DVec3>, Vec<[u32; 3]>))| vec![SegmentId(k as u32); s.1.len()];
        let face_segment = shapes.iter().enumerate().flat_map(of_shape).collect();
        let mirror = normal.map(|normal| {
            let mirror = Mirror::new(Plane::through(DVec3::ZERO, normal).unwrap());
            MirrorPlane { mirror, error_percent: 0.0, crossing: None }
        });
        let segmentation = Segmentation { face_segment, count: shapes.len(), mirror };
        names(&mesh(&together(&shapes)), &segmentation, &vec![1.0; shapes.len()])
    }

    #[test]
    fn parts_are_called_after_their_place() {
        let places = [DVec3::Z, DVec3::new(0.5, 0.0, 1.2), DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z, DVec3::Y];
        let expected = ["body", "top", "top-2", "front", "right", "bottom", "back"];
        assert_eq!(named(&places.map(|p| p * 4.0), None), expected);
    }

    #[test]
    fn pairs_share_a_number() {
        let legs = [DVec3::new(1.0, -2.0, -4.0), DVec3::new(-1.0, -2.0, -4.0), DVec3::Z * 4.0];
        assert_eq!(named(&legs, Some(DVec3::X)), ["body", "right-1", "left-1", "top"]);
        let legs = legs.map(|p| DVec3::new(p.y, p.x, p.z));
        assert_eq!(named(&legs, Some(DVec3::Y)), ["body", "back-1", "front-1", "top"]);
    }
}
