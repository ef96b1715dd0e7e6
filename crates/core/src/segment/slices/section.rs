//! Sections of parts by planes.

use crate::geom::Plane;
use crate::mesh::{Edges, Mesh};
use crate::segment::forest::Forest;
use glam::DVec2;
use std::collections::BTreeMap;

/// Vertices within this share of the diagonal from a plane are in it.
const IN_PLANE: f64 = 1e-5;

/// A section by which a part was cut before: there its surface is open, and the solid is closed.
#[derive(Debug, Clone)]
pub(super) struct Cap {
    pub plane: Plane,
    /// Vertices on its outlines.
    pub vertices: Vec<u32>,
}

/// A line of a section, by its vertices.
type Line = [u32; 2];

/// The vertices of each connected section of a part by a plane, on its outline and round its holes; `None` where the part is
/// open there. `front` tells for each face of the part whether it is in front of the plane.
pub(super) fn sections(
    mesh: &Mesh,
    own: &[usize],
    front: &[bool],
    plane: &Plane,
    caps: &[Cap],
) -> Option<Vec<Vec<u32>>> {
    let lines = closed_lines(mesh, lines(mesh, own, front), plane, caps)?;
    let mut vertices: Vec<u32> = lines.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let index = |v: u32| vertices.partition_point(|&other| other < v) as u32;
    let mut forest = Forest::new(vertices.len());
    for &line in &lines {
        forest.join(line.map(index));
    }
    let mut loops: BTreeMap<u32, Vec<[DVec2; 2]>> = BTreeMap::new();
    for &line in &lines {
        let ends = line.map(|v| plane.flat(mesh.positions()[v as usize]));
        loops.entry(forest.find(index(line[0]))).or_default().push(ends);
    }
    for pair in holes(&loops) {
        forest.join(pair);
    }
    let mut sections: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (k, &v) in vertices.iter().enumerate() {
        sections.entry(forest.find(k as u32)).or_default().push(v);
    }
    Some(sections.into_values().collect())
}

/// Edges of a part between a face in front of a plane and one behind it.
fn lines(mesh: &Mesh, own: &[usize], front: &[bool]) -> Vec<Line> {
    let faces: Vec<[u32; 3]> = own.iter().map(|&face| mesh.faces()[face]).collect();
    let edges = Edges::new(&faces);
    let is_between = |edge: &usize| {
        let sides = edges.sides(*edge);
        let in_front = sides.iter().filter(|&&side| front[side as usize / 3]).count();
        in_front > 0 && in_front < sides.len()
    };
    (0..edges.count()).filter(is_between).map(|edge| edges.vertices(edge)).collect()
}

/// The same, closed where a plane crosses caps; `None` where they are open elsewhere.
fn closed_lines(mesh: &Mesh, mut lines: Vec<Line>, plane: &Plane, caps: &[Cap]) -> Option<Vec<Line>> {
    let at = |v: u32| mesh.positions()[v as usize];
    let mut lines_at: BTreeMap<u32, usize> = BTreeMap::new();
    lines.iter().flatten().for_each(|&v| *lines_at.entry(v).or_default() += 1);
    let mut open: Vec<u32> =
        lines_at.into_iter().filter(|(_, count)| count % 2 == 1).map(|(v, _)| v).collect();
    for cap in caps {
        let is_in = |v: &u32| cap.plane.distance(at(*v)).abs() <= IN_PLANE * mesh.diagonal_mm();
        let along = cap.plane.normal().cross(plane.normal());
        let mut ends: Vec<u32> = open.iter().copied().filter(is_in).collect();
        ends.sort_by(|&a, &b| along.dot(at(a)).total_cmp(&along.dot(at(b))));
        let (pairs, _) = ends.as_chunks::<2>();
        open.retain(|v| !pairs.iter().flatten().any(|end| end == v));
        lines.extend(pairs);
    }
    (open.is_empty() && !lines.is_empty()).then_some(lines)
}

/// Loops that are holes, each with the one that they are in.
fn holes(loops: &BTreeMap<u32, Vec<[DVec2; 2]>>) -> Vec<[u32; 2]> {
    let is_in = |p: DVec2, outline: &[[DVec2; 2]]| {
        let is_right = |[a, b]: &&[DVec2; 2]| {
            (a.y > p.y) != (b.y > p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x
        };
        outline.iter().filter(is_right).count() % 2 == 1
    };
    let around = |(&own, lines): (&u32, &Vec<[DVec2; 2]>)| {
        let p = (lines[0][0] + lines[0][1]) / 2.0;
        let others = loops.iter().filter(|(other, outline)| **other != own && is_in(p, outline));
        (own, others.map(|(&other, _)| other).collect())
    };
    let around: BTreeMap<u32, Vec<u32>> = loops.iter().map(around).collect();
    let hole = |(&own, outer): (&u32, &Vec<u32>)| {
        let is_next = |other: &&u32| around[*other].len() + 1 == outer.len();
        (outer.len() % 2 == 1).then(|| Some([own, *outer.iter().find(is_next)?]))?
    };
    around.iter().filter_map(hole).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> Vec<[DVec2; 2]> {
        let corners = [[low, low], [high, low], [high, high], [low, high]].map(DVec2::from);
        (0..4).map(|k| [corners[k], corners[(k + 1) % 4]]).collect()
    }

    #[test]
    fn what_is_in_a_hole_is_no_hole() {
        let nested =
            [(0, square(0.0, 9.0)), (1, square(1.0, 8.0)), (2, square(2.0, 7.0)), (3, square(20.0, 21.0))];
        assert_eq!(holes(&BTreeMap::from(nested)), [[1, 0]]);
    }
}
