//! Which planes a part may be cut by.

use crate::geom::{Mirror, Plane, bounds};
use crate::mesh::{Edges, Mesh};
use glam::DVec3;

/// Edges of a smaller angle between the normals are not sharp.
const SHARP_RAD: f64 = 25.0_f64.to_radians();
/// Concave edges, the longest of a part, that planes are laid through.
const MOST_EDGES: usize = 24;
/// Planes of a part that are tried, those first that most of its concave edges lie in.
const MOST_PLANES: usize = 24;
/// Planes with a smaller share of a part's concave edges are not tried. On the skin of an animal most have less.
const LEAST_SHARE: f64 = 0.05;
/// Points within this share of the diagonal from a plane are in it.
const IN_PLANE: f64 = 1e-4;
/// Planes whose normals have a larger cosine are parallel.
const PARALLEL: f64 = 1.0 - 1e-6;

/// Whether two planes are one, whichever way they face.
pub(super) fn is_same(a: &Plane, b: &Plane, mesh: &Mesh) -> bool {
    let cosine = a.normal().dot(b.normal());
    let apart = (a.offset() - b.offset() * cosine.signum()).abs();
    cosine.abs() > PARALLEL && apart <= IN_PLANE * mesh.diagonal_mm()
}

/// Planes to cut a part by, each with the share of its concave edges that lie in it. The mirror plane, and those through the
/// middle of a ring, of a bent part, or of one without sharp edges, come last.
pub(super) fn planes(
    mesh: &Mesh,
    own: &[usize],
    mirror: Option<&Mirror>,
    is_bent: bool,
) -> Vec<(Plane, f64)> {
    let faces: Vec<[u32; 3]> = own.iter().map(|&face| mesh.faces()[face]).collect();
    let edges = Edges::new(&faces);
    let concave = Concave::of_faces(mesh, &faces, &edges);
    let total: f64 = concave.iter().map(|edge| edge.length).sum();
    let near = IN_PLANE * mesh.diagonal_mm();
    let share = |plane: &Plane| {
        let is_in = |edge: &&Concave| edge.ends.iter().all(|&p| plane.distance(p).abs() <= near);
        concave.iter().filter(is_in).map(|edge| edge.length).sum::<f64>() / total.max(f64::MIN_POSITIVE)
    };
    let longest = &concave[..concave.len().min(MOST_EDGES)];
    let of_edge = |(k, edge): (usize, &Concave)| {
        let through = longest[k + 1..].iter().filter_map(|other| edge.plane_with(other, near));
        through.chain(edge.own_planes()).collect::<Vec<_>>()
    };
    let add = |mut planes: Vec<(Plane, f64)>, plane: Plane| {
        if !planes.iter().any(|(known, _)| is_same(known, &plane, mesh)) {
            planes.push((plane, share(&plane)));
        }
        planes
    };
    let mut planes = longest.iter().enumerate().flat_map(of_edge).fold(Vec::new(), add);
    planes.retain(|(_, share)| *share >= LEAST_SHARE);
    planes.sort_by(|a, b| b.1.total_cmp(&a.1));
    planes.truncate(MOST_PLANES);
    let mut middle: Vec<Plane> = mirror.map(|mirror| *mirror.plane()).into_iter().collect();
    if planes.is_empty() || is_bent || is_ring(&faces, &edges) {
        let (low, high) = bounds(own.iter().flat_map(|&face| mesh.corners(face)));
        middle.extend(DVec3::AXES.into_iter().filter_map(|axis| Plane::through((low + high) / 2.0, axis)));
    }
    middle.into_iter().fold(planes, add)
}

/// Whether a surface is closed and has a hole through it, by Euler's formula.
fn is_ring(faces: &[[u32; 3]], edges: &Edges) -> bool {
    let mut vertices: Vec<u32> = faces.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let is_closed = (0..edges.count()).all(|edge| edges.sides(edge).len() == 2);
    is_closed && vertices.len() + faces.len() <= edges.count()
}

/// A sharp concave edge.
struct Concave {
    ends: [DVec3; 2],
    /// Normals of the faces on either side.
    normals: [DVec3; 2],
    length: f64,
}

impl Concave {
    /// Those of some faces of a mesh, the longest first.
    fn of_faces(mesh: &Mesh, faces: &[[u32; 3]], edges: &Edges) -> Vec<Self> {
        let corners = |face: usize| faces[face].map(|v| mesh.positions()[v as usize]);
        let normal = |face: usize| {
            let [a, b, c] = corners(face);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let concave = |edge: usize| {
            let &[a, b] = edges.sides(edge) else { return None };
            let [a, b] = [a, b].map(|side| side as usize / 3);
            let ends = edges.vertices(edge).map(|v| mesh.positions()[v as usize]);
            let (normals, length) = ([a, b].map(normal), ends[0].distance(ends[1]));
            let rises = corners(b).iter().map(|&p| normals[0].dot(p - ends[0])).fold(0.0, f64::max);
            let is_sharp = normals[0].dot(normals[1]) < libm::cos(SHARP_RAD);
            (is_sharp && rises > 1e-9 * length && length > 0.0).then_some(Self { ends, normals, length })
        };
        let mut concave: Vec<Self> = (0..edges.count()).filter_map(concave).collect();
        concave.sort_by(|a, b| b.length.total_cmp(&a.length));
        concave
    }

    fn along(&self) -> DVec3 {
        (self.ends[1] - self.ends[0]) / self.length
    }

    /// The planes of its faces, and the one between them.
    fn own_planes(&self) -> impl Iterator<Item = Plane> {
        let [n, m] = self.normals;
        let between = (n + m).cross(self.along());
        [n, m, between].into_iter().filter_map(|normal| Plane::through(self.ends[0], normal))
    }

    /// The plane through this edge and another, where there is one.
    fn plane_with(&self, other: &Self, near: f64) -> Option<Plane> {
        let [a, b] = other.ends.map(|p| (p - self.ends[0]).cross(self.along()));
        let normal = if a.length() > b.length() { a } else { b };
        // Of edges in one line there are many.
        let plane = (normal.length() > 10.0 * near).then(|| Plane::through(self.ends[0], normal))??;
        other.ends.iter().all(|&p| plane.distance(p).abs() <= near).then_some(plane)
    }
}
