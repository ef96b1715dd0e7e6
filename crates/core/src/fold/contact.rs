//! How far apart two convex polygons in space are, or how deep they are in each other.
//!
//! The bodies are sheets without thickness. Their difference (Minkowski) is a convex body whose
//! facets are copies of the two polygons and parallelograms of an edge of each, so the normals of
//! these, the directions of the separating axis theorem, find the least way that parts two sheets
//! that cut through each other exactly.

use crate::component::Panel;
use glam::{DAffine3, DVec3};

/// Two edges are parallel where the sine of their angle is below this; their product has no
/// direction then, and the other axes suffice.
const PARALLEL: f64 = 1e-7;

/// A convex polygon with its unit normal.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    /// Corners in order.
    pub corners: Vec<DVec3>,
    /// Unit normal.
    pub normal: DVec3,
}

impl Sheet {
    /// A panel at its place in a pose.
    pub fn of_panel(panel: &Panel, place: DAffine3) -> Self {
        Self {
            corners: panel.outline.iter().map(|p| place.transform_point3(p.extend(0.0))).collect(),
            normal: place.matrix3.z_axis,
        }
    }
}

/// A signed gap between two polygons, and the direction in which it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Where positive, the least distance between the polygons; where negative, the polygons cut through
    /// each other, and a shift by this length parts them. Sheets that touch have 0.
    pub mm: f64,
    /// Which of the directions it was: the next search for the same two starts with it.
    pub axis: usize,
}

/// The signed gap. The search begins with direction `first` and ends as soon as the gap is known
/// to be above `enough_mm`.
pub fn gap(a: &Sheet, b: &Sheet, enough_mm: f64, first: usize) -> Gap {
    let (m, n) = (a.corners.len(), b.corners.len());
    let simple = 3 + m + n;
    let first = first.min(simple + m * n - 1);
    let begin = std::iter::once(first).chain(0..simple).map(|axis| (axis, gap_in(a, b, axis)));
    let edges = (0..m).flat_map(|k| (0..n).map(move |l| gap_between_edges(a, k, b, l)));
    let mut best = Gap { mm: f64::NEG_INFINITY, axis: 0 };
    for (axis, found) in begin.chain((simple..).zip(edges)) {
        if let Some(mm) = found.filter(|mm| *mm > best.mm) {
            best = Gap { mm, axis };
            if mm > enough_mm {
                break;
            }
        }
    }
    best
}

/// The gap in one direction: from middle to middle, across each sheet, in its plane outwards of
/// each of its edges, and across each pair of edges. None where that is no direction, or where the
/// two edges are not what the sheets have nearest to each other in it.
fn gap_in(a: &Sheet, b: &Sheet, index: usize) -> Option<f64> {
    let (m, n) = (a.corners.len(), b.corners.len());
    match index {
        0 => (centre(b) - centre(a)).try_normalize().map(|axis| gap_along(a, b, axis)),
        1 => Some(gap_across(a, b)),
        2 => Some(gap_across(b, a)),
        k if k < 3 + m => gap_beside(a, k - 3, b),
        k if k < 3 + m + n => gap_beside(b, k - 3 - m, a),
        k => {
            let k = k - 3 - m - n;
            gap_between_edges(a, k / n, b, k % n)
        }
    }
}

/// The gap across the plane of `a`.
fn gap_across(a: &Sheet, b: &Sheet) -> f64 {
    let (from, to) = spread(b, a.normal);
    let level = a.normal.dot(a.corners[0]);
    (from - level).max(level - to)
}

/// The gap in the plane of `a` beyond one of its edges.
fn gap_beside(a: &Sheet, k: usize, b: &Sheet) -> Option<f64> {
    let outward = edge(a, k).cross(a.normal).try_normalize()?;
    let nearest = b.corners.iter().map(|c| outward.dot(*c)).fold(f64::INFINITY, f64::min);
    Some(nearest - outward.dot(a.corners[k]))
}

/// The gap across two edges. A convex sheet lies on one side of each of its edges, so that the
/// edges are ends of the two in this direction, and face each other or not: that depends on whether
/// each edge goes up or down as seen from the other sheet.
fn gap_between_edges(a: &Sheet, k: usize, b: &Sheet, l: usize) -> Option<f64> {
    let (e, f) = (edge(a, k), edge(b, l));
    let (e_up, f_up) = (e.dot(b.normal), f.dot(a.normal));
    let signed: fn(f64) -> f64 = match (e_up >= 0.0 && f_up >= 0.0, e_up <= 0.0 && f_up <= 0.0) {
        (true, true) => f64::abs,
        (true, false) => |way| way,
        (false, true) => |way| -way,
        (false, false) => return None,
    };
    let across = e.cross(f);
    let length_squared = across.length_squared();
    if length_squared <= PARALLEL * PARALLEL * (e.length_squared() * f.length_squared()) {
        return None;
    }
    Some(signed(across.dot(b.corners[l] - a.corners[k]) / length_squared.sqrt()))
}

fn edge(sheet: &Sheet, k: usize) -> DVec3 {
    let next = if k + 1 == sheet.corners.len() { 0 } else { k + 1 };
    sheet.corners[next] - sheet.corners[k]
}

fn edges(sheet: &Sheet) -> impl Iterator<Item = DVec3> + '_ {
    (0..sheet.corners.len()).map(|k| edge(sheet, k))
}

fn centre(sheet: &Sheet) -> DVec3 {
    sheet.corners.iter().sum::<DVec3>() / sheet.corners.len() as f64
}

fn gap_along(a: &Sheet, b: &Sheet, axis: DVec3) -> f64 {
    let (low, high) = spread(a, axis);
    let (from, to) = spread(b, axis);
    (from - high).max(low - to)
}

fn spread(sheet: &Sheet, axis: DVec3) -> (f64, f64) {
    sheet.corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), corner| {
        let at = axis.dot(*corner);
        (low.min(at), high.max(at))
    })
}

/// Height of b's middle over a's plane where the two face each other: b lies on one side of a's
/// plane, and the two overlap as seen along a's normal, all by `least_mm` or more.
pub fn facing_mm(a: &Sheet, b: &Sheet, least_mm: f64) -> Option<f64> {
    let (from, to) = spread(b, a.normal);
    let level = a.normal.dot(a.corners[0]);
    let is_across = from - level < -least_mm && to - level > least_mm;
    let is_beside = |edge: DVec3| gap_along(a, b, a.normal.cross(edge).normalize_or_zero()) > -least_mm;
    let is_apart = edges(a).any(is_beside) || edges(b).any(is_beside);
    (!is_across && !is_apart).then_some(0.5 * (from + to) - level)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec2};
    use proptest::prelude::*;

    fn gap_mm(a: &Sheet, b: &Sheet) -> f64 {
        gap(a, b, f64::INFINITY, 7).mm
    }

    fn sheet(corners: Vec<DVec3>) -> Sheet {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        Sheet { corners, normal }
    }

    fn square(place: DVec3, turn: DMat3) -> Sheet {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        sheet(corners.map(|(x, y)| place + turn * DVec3::new(x, y, 0.0)).to_vec())
    }

    fn triangle() -> impl Strategy<Value = [DVec3; 3]> {
        let point = || (-3.0f64..3.0, -3.0f64..3.0, -3.0f64..3.0).prop_map(DVec3::from);
        (point(), point(), point())
            .prop_map(|(a, b, c)| [a, b, c])
            .prop_filter("thin", |[a, b, c]| (*b - *a).cross(*c - *a).length() > 0.3)
    }

    /// Whether a segment goes through a triangle (Möller and Trumbore 1997).
    fn pierces([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
        let along = q - p;
        let across = along.cross(c - a);
        let det = (b - a).dot(across);
        let u = (p - a).dot(across) / det;
        let up = (p - a).cross(b - a);
        let v = along.dot(up) / det;
        let t = (c - a).dot(up) / det;
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t)
    }

    fn intersect(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
        let sides = |t: [DVec3; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        sides(a).into_iter().any(|s| pierces(s, b)) || sides(b).into_iter().any(|s| pierces(s, a))
    }

    proptest! {
        #[test]
        fn gaps_are_negative_where_triangles_intersect(a in triangle(), b in triangle()) {
            let gap = gap_mm(&sheet(a.to_vec()), &sheet(b.to_vec()));
            prop_assert_eq!(gap < 0.0, intersect(a, b), "gap {}", gap);
        }

        #[test]
        fn a_shift_by_the_depth_parts_and_a_shorter_one_does_not(a in triangle(), b in triangle(), to in (-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0)) {
            let (p, q) = (sheet(a.to_vec()), sheet(b.to_vec()));
            let depth = -gap_mm(&p, &q);
            prop_assume!(depth > 1e-3);
            let shift = DVec3::from(to).normalize_or(DVec3::X) * depth * 0.999;
            prop_assert!(intersect(a.map(|c| c + shift), b), "parted by less than {}", depth);
        }

        #[test]
        fn gaps_never_exceed_the_distance(a in triangle(), b in triangle(), u in (0.0f64..1.0, 0.0f64..1.0), v in (0.0f64..1.0, 0.0f64..1.0)) {
            let at = |t: [DVec3; 3], w: (f64, f64)| {
                let w = if w.0 + w.1 > 1.0 { DVec2::ONE - DVec2::from(w) } else { DVec2::from(w) };
                t[0] + w.x * (t[1] - t[0]) + w.y * (t[2] - t[0])
            };
            let gap = gap_mm(&sheet(a.to_vec()), &sheet(b.to_vec()));
            prop_assert!(gap <= at(a, u).distance(at(b, v)) + 1e-12);
        }
    }

    #[test]
    fn touching_sheets_have_no_depth() {
        let flat = square(DVec3::ZERO, DMat3::IDENTITY);
        let beside = square(DVec3::X * 2.0, DMat3::IDENTITY);
        let over = square(DVec3::X, DMat3::IDENTITY);
        let upright = square(DVec3::new(0.0, 0.0, 1.0), DMat3::from_rotation_x(std::f64::consts::FRAC_PI_2));
        for other in [beside, over, upright] {
            assert!(gap_mm(&flat, &other).abs() < 1e-12);
        }
    }

    #[test]
    fn heights_are_told_of_sheets_that_face_each_other() {
        let flat = square(DVec3::ZERO, DMat3::IDENTITY);
        let at = |x: f64, z: f64| square(DVec3::new(x, 0.0, z), DMat3::IDENTITY);
        let near = |found: Option<f64>, expected: f64| (found.unwrap() - expected).abs() < 1e-12;
        assert!(near(facing_mm(&flat, &at(0.5, 0.05), 0.1), 0.05));
        assert!(near(facing_mm(&flat, &at(0.5, -0.05), 0.1), -0.05));
        assert_eq!(facing_mm(&flat, &at(2.5, 0.05), 0.1), None);
        let across = square(DVec3::ZERO, DMat3::from_rotation_x(1.0));
        assert_eq!(facing_mm(&flat, &across, 0.1), None);
    }
}
