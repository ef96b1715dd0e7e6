//! Cutting polygons into triangles.

use super::{Repairs, Triangle, large};
use crate::geom::{Plane, polygon};
use crate::mesh::Soup;
use earcut::Earcut;
use glam::{DVec2, DVec3};
use std::collections::HashSet;

/// Cuts every polygon into triangles of joined vertices. Counts polygons that give none, for lack
/// of three different corners or of area, and larger ones that repeat the corners of another one,
/// which could otherwise be cut along another diagonal and be taken for something new.
pub(super) fn triangulate(
    soup: &Soup,
    positions: &[DVec3],
    of_input: &[u32],
    repairs: &mut Repairs,
) -> Vec<Triangle> {
    let mut triangles = Vec::with_capacity(soup.polygon_count());
    let mut outline: Vec<u32> = Vec::new();
    let mut seen: HashSet<Vec<u32>> = HashSet::new();
    for (polygon, corners) in soup.polygons().enumerate() {
        outline.clear();
        outline.extend(corners.iter().map(|&v| of_input[v as usize]));
        outline.dedup();
        while outline.len() > 1 && outline.first() == outline.last() {
            outline.pop();
        }
        let before = triangles.len();
        let polygon = polygon as u32;
        let mut add = |corners: [u32; 3]| triangles.push(Triangle { corners, polygon });
        match outline[..] {
            [] | [_] | [_, _] => {}
            [a, b, c] => add([a, b, c]),
            _ if !seen.insert(sorted(&outline)) => {
                repairs.duplicate_faces += 1;
                continue;
            }
            _ => cut(positions, &outline).into_iter().for_each(add),
        }
        repairs.degenerate_faces += usize::from(triangles.len() == before);
    }
    triangles
}

fn sorted(outline: &[u32]) -> Vec<u32> {
    let mut corners = outline.to_vec();
    corners.sort_unstable();
    corners
}

/// Ears are cut off polygons of no more corners: a comb of 2,000 takes 6 ms, one of 10^5 takes 7 s.
const MOST_EARS: usize = 2000;

/// Triangles of a polygon of four or more corners, which may be concave, in the plane that fits it
/// best; empty where it has no area.
fn cut(positions: &[DVec3], outline: &[u32]) -> Vec<[u32; 3]> {
    let corners: Vec<DVec3> = outline.iter().map(|&v| positions[v as usize]).collect();
    let Some(plane) = Plane::through(corners[0], newell(&corners)) else {
        return Vec::new();
    };
    let (a, b) = plane.basis();
    let flat: Vec<DVec2> =
        corners.iter().map(|&p| DVec2::new(a.dot(p - corners[0]), b.dot(p - corners[0]))).collect();
    let triangles = if flat.len() > MOST_EARS { large::cut(&flat) } else { ears(&flat) };
    let different = |&[i, j, k]: &[u32; 3]| i != j && j != k && k != i;
    triangles
        .iter()
        .map(|&[i, j, k]| {
            let is_turned = polygon::cross3(flat[i], flat[j], flat[k]) < 0.0;
            let (j, k) = if is_turned { (k, j) } else { (j, k) };
            [i, j, k].map(|corner| outline[corner])
        })
        .filter(different)
        .collect()
}

fn ears(outline: &[DVec2]) -> Vec<[usize; 3]> {
    let mut ears: Vec<usize> = Vec::new();
    Earcut::new().earcut(outline.iter().map(|p| [p.x, p.y]), &[], &mut ears);
    ears.as_chunks::<3>().0.to_vec()
}

/// Twice the vector area: the normal of the plane that fits best in the sense of area (Newell),
/// divided by the square of the polygon's size so that it keeps clear of underflow.
fn newell(corners: &[DVec3]) -> DVec3 {
    let start = corners[0];
    let size = corners.iter().map(|p| p.distance(start)).fold(0.0, f64::max);
    let unit = |p: DVec3| (p - start) / size;
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&p, &q)| unit(p).cross(unit(q))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area_vector(positions: &[DVec3], triangles: &[Triangle]) -> (DVec3, f64) {
        let cross = |t: &Triangle| {
            let [a, b, c] = t.corners.map(|v| positions[v as usize]);
            (b - a).cross(c - a) / 2.0
        };
        let sum = triangles.iter().map(cross).sum();
        let absolute = triangles.iter().map(|t| cross(t).length()).sum();
        (sum, absolute)
    }

    fn run(positions: &[DVec3], outline: &[u32]) -> (Vec<Triangle>, Repairs) {
        let soup = Soup::new(positions.to_vec(), [outline]).unwrap();
        let same: Vec<u32> = (0..positions.len() as u32).collect();
        let mut repairs = Repairs::default();
        (triangulate(&soup, positions, &same, &mut repairs), repairs)
    }

    #[test]
    fn a_concave_polygon_keeps_its_area_and_direction() {
        let arrow = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)];
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.5, 2.0, -1.0);
        let place = |(x, y): (f64, f64)| turn * DVec3::new(x, y, 3.0);
        let positions = arrow.map(place);
        for outline in [[0, 1, 2, 3, 4], [3, 4, 0, 1, 2], [4, 3, 2, 1, 0]] {
            let (triangles, _) = run(&positions, &outline);
            assert_eq!(triangles.len(), 3);
            let (sum, absolute) = area_vector(&positions, &triangles);
            let expected = turn * DVec3::Z * if outline[0] == 4 { -10.0 } else { 10.0 };
            assert!((sum - expected).length() < 1e-12, "{outline:?}: {sum}");
            assert!((absolute - 10.0).abs() < 1e-12, "{outline:?} overlaps itself");
        }
    }

    #[test]
    fn corners_on_an_edge_stay() {
        let positions = [0.0, 1.0, 2.0, 3.0].map(|x| DVec3::new(x, 0.0, 0.0));
        let positions = [&positions[..], &[DVec3::new(1.0, 2.0, 0.0)]].concat();
        for shift in 0..5 {
            let outline: Vec<u32> = (0..5).map(|k| (k + shift) % 5).collect();
            let (triangles, _) = run(&positions, &outline);
            assert_eq!(triangles.len(), 3, "shift {shift}");
        }
    }

    #[test]
    fn what_has_no_area_is_counted() {
        let positions = [0.0, 1.0, 2.0, 3.0].map(|x| DVec3::new(x, x, 0.0));
        for outline in [&[0, 1, 2, 3][..], &[0, 1], &[2], &[], &[0, 1, 1, 0, 0], &[1, 1, 1]] {
            let (triangles, repairs) = run(&positions, outline);
            assert_eq!((triangles.len(), repairs.degenerate_faces), (0, 1), "{outline:?}");
        }
    }
}
