//! Small bodies that stick out of large ones: hulls leave them out.

use super::surface::Surface;
use crate::geom::{Hull, HullError, Plane};
use crate::mesh::Mesh;
use glam::DVec3;

/// A body makes the hull of another too large by more than this many times its volume: the two then share less with the
/// solid than without it.
pub(super) const WORTH: f64 = 2.0;
/// Hulls are cut along planes that have at least this share of a segment's area. Not bounded by a case.
const LEAST_SIDE: f64 = 0.04;
/// Where such planes have at least this share in all: the hulls of a fish and a cow share less with what is seen when they are
/// cut.
const LEAST_SIDES: f64 = 0.5;
/// A face with a smaller share than this says nothing about planes: only meshes of few faces have others. Not bounded by a case.
const LEAST_FACE: f64 = 0.004;
/// Faces are in one plane within this angle,
const ALONG_RAD: f64 = 2.0_f64.to_radians();
/// and this share of the mesh's diagonal. Neither is bounded by a case.
pub(super) const IN_PLANE: f64 = 0.005;

/// Faces of one body.
#[derive(Default)]
pub(super) struct Piece {
    pub faces: Vec<usize>,
    pub area: f64,
}

impl Piece {
    /// The largest first.
    pub fn sort(pieces: &mut [Self]) {
        pieces.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.faces.cmp(&b.faces)));
    }
}

/// Bodies with those that stick out set aside.
pub(super) struct Weeded {
    pub kept: Vec<Piece>,
    pub left_out: Vec<Piece>,
    /// The planes of the large flat sides of what is kept.
    pub sides: Vec<Plane>,
}

impl Weeded {
    /// Where large bodies consist of flat sides, without those small ones that make the hull too large. Both come in
    /// order; `hull` is that of bodies.
    pub fn new(
        (mesh, surface): (&Mesh, &Surface),
        large: Vec<Piece>,
        small: Vec<Piece>,
        hull: impl Fn(&[Piece]) -> Result<Hull, HullError>,
    ) -> Self {
        let sides = sides(mesh, surface, &large);
        let (mut kept, mut left_out) = (large, Vec::new());
        if sides.is_empty() {
            kept.extend(small);
        } else if let Ok(mut hull) = hull(&kept) {
            for piece in small {
                let own = points(mesh, std::slice::from_ref(&piece));
                let all: Vec<DVec3> = hull.vertices().iter().chain(&own).copied().collect();
                match Hull::of_points(&all) {
                    Ok(grown) if grown.volume() - hull.volume() <= WORTH * volume(&own) => {
                        hull = grown;
                        kept.push(piece);
                    }
                    _ => left_out.push(piece),
                }
            }
        }
        Self { kept, left_out, sides }
    }
}

/// The positions of vertices, each once.
pub(super) fn points_at(mesh: &Mesh, mut vertices: Vec<u32>) -> Vec<DVec3> {
    vertices.sort_unstable();
    vertices.dedup();
    vertices.into_iter().map(|v| mesh.positions()[v as usize]).collect()
}

/// The volume of the hull of points; 0 where it has none.
pub(super) fn volume(points: &[DVec3]) -> f64 {
    Hull::of_points(points).map_or(0.0, |hull| hull.volume())
}

/// The corners of faces.
pub(super) fn points(mesh: &Mesh, pieces: &[Piece]) -> Vec<DVec3> {
    let faces = pieces.iter().flat_map(|piece| &piece.faces);
    points_at(mesh, faces.flat_map(|&face| mesh.faces()[face]).collect())
}

/// The planes of the large flat sides of what consists of them, as a box does, in a mesh of few faces.
fn sides(mesh: &Mesh, surface: &Surface, pieces: &[Piece]) -> Vec<Plane> {
    let area: f64 = pieces.iter().map(|piece| piece.area).sum();
    let faces = || pieces.iter().flat_map(|piece| &piece.faces).copied();
    let mut large: Vec<usize> = faces().filter(|&face| surface.areas()[face] >= LEAST_FACE * area).collect();
    large.sort_by(|&a, &b| surface.areas()[b].total_cmp(&surface.areas()[a]).then(a.cmp(&b)));
    let near = IN_PLANE * mesh.diagonal_mm();
    let mut sides: Vec<Plane> = Vec::new();
    let mut covered = 0.0;
    let is_in = |plane: &Plane, face: usize| {
        plane.normal().dot(surface.normals()[face]) > libm::cos(ALONG_RAD)
            && plane.distance(surface.centres()[face]).abs() <= near
    };
    for face in large {
        let Some(plane) = Plane::through(surface.centres()[face], surface.normals()[face]) else { continue };
        if sides.iter().any(|side| is_in(side, face)) {
            continue;
        }
        let of_plane: f64 =
            faces().filter(|&other| is_in(&plane, other)).map(|other| surface.areas()[other]).sum();
        if of_plane >= LEAST_SIDE * area {
            sides.push(plane);
            covered += of_plane;
        }
    }
    if covered < LEAST_SIDES * area { Vec::new() } else { sides }
}
