//! Segments without volume that show, such as the fins of a fish: they become thin plates.

use super::clean::SHOWN;
use super::interface::fit_plane;
use super::{SegmentId, Segmentation};
use crate::geom::{Hull, HullError};
use crate::mesh::{Mesh, Views};
use glam::DVec3;

/// Thickness of such a plate, as a share of the mesh's diagonal: 1 mm of a model of 200 mm. Components are thicker.
const THICKNESS: f64 = 0.005;

/// The hulls of segments, with plates for those without volume that add to the outlines what a part has to. Where no segment has
/// volume, as where a number of parts cuts a box into its sides, none becomes a plate.
pub(super) fn with_plates(
    mesh: &Mesh,
    segmentation: &Segmentation,
    hulls: Vec<Result<Hull, HullError>>,
) -> Vec<Result<Hull, HullError>> {
    let solid: Vec<&Hull> = hulls.iter().flatten().collect();
    if solid.is_empty() || solid.len() == hulls.len() {
        return hulls;
    }
    let views = Views::of_mesh(mesh);
    let solid: Vec<_> = solid.into_iter().map(|hull| views.cover_of(hull)).collect();
    let ground = views.outlines(&solid.iter().collect::<Vec<_>>());
    let unlike = views.unlike(&ground, &[]);
    let shows = |plate: &Hull| unlike - views.unlike(&ground, &[views.cover_of(plate)]) >= SHOWN;
    let of_segments = 0..hulls.len() as u32;
    let plates: Vec<Option<Hull>> = of_segments
        .zip(&hulls)
        .map(|(id, hull)| hull.is_err().then(|| plate(mesh, segmentation, SegmentId(id))).flatten())
        .collect();
    let show: Vec<bool> = plates.iter().map(|plate| plate.as_ref().is_some_and(shows)).collect();
    let twins = segmentation.twins(mesh);
    let twin_shows = |id: usize| twins.as_ref().is_some_and(|twins| show[twins[id].0 as usize]);
    let kept = plates.into_iter().enumerate().map(|(id, plate)| plate.filter(|_| show[id] || twin_shows(id)));
    hulls.into_iter().zip(kept).map(|(hull, plate)| plate.map_or(hull, Ok)).collect()
}

/// The corners of a segment on either side of the plane nearest to them.
fn plate(mesh: &Mesh, segmentation: &Segmentation, id: SegmentId) -> Option<Hull> {
    let own = segmentation.face_segments().iter().enumerate().filter(|(_, other)| **other == id);
    let corners: Vec<DVec3> = own.flat_map(|(face, _)| mesh.corners(face)).collect();
    let (plane, _) = fit_plane(&corners)?;
    let half = plane.normal() * (THICKNESS * mesh.diagonal_mm() / 2.0);
    let points: Vec<DVec3> = corners.iter().flat_map(|&corner| [corner - half, corner + half]).collect();
    Hull::of_points(&points).ok()
}
