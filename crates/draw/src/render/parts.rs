//! A picture of the parts of a mesh in colour, from two sides, with their names.

use super::callouts::callouts;
use super::leaders::Callout;
use super::palette;
use super::part_map::PartMap;
use super::picture::{Look, picture};
use super::proxy::proxy;
use super::scene::{Scene, SceneError};
use super::view::{Camera, View, ViewError};
use crate::drawing::{Drawing, Rgb};
use glam::{DAffine2, DVec2, DVec3};
use tatamu_core::mesh::Mesh;
use tatamu_core::model::PartId;

/// One of the two sides with its names, mm; the width of the columns of names; free border.
const SIDE_MM: DVec2 = DVec2::new(150.0, 110.0);
const COLUMN_MM: f64 = 28.0;
const MARGIN_MM: f64 = 4.0;
const CAP_MM: f64 = 2.4;

/// From half above the left front, and from the opposite side.
const AZIMUTHS_RAD: [f64; 2] = [0.5, 0.5 + std::f64::consts::PI];
const ELEVATION_RAD: f64 = 0.3;
const FIELD_OF_VIEW_RAD: f64 = 0.3;

/// Meshes of more faces are drawn by fewer.
const MOST_FACES: usize = 9_000;

/// Why there is no picture.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PartsPictureError {
    /// The mesh cannot be a scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// It cannot be seen.
    #[error(transparent)]
    View(#[from] ViewError),
}

/// Draws a mesh whose z axis is up. `part_of_face` has one entry, an index into `names`, for each
/// face of the mesh.
///
/// # Errors
/// [`PartsPictureError`] for meshes that are not finite or have no extent.
pub fn parts_picture(
    mesh: &Mesh,
    part_of_face: &[u32],
    names: &[String],
) -> Result<Drawing, PartsPictureError> {
    // Pictures have y up.
    let upright: Vec<DVec3> = mesh.positions().iter().map(|p| DVec3::new(p.x, p.z, -p.y)).collect();
    let few = proxy(&upright, mesh.faces(), MOST_FACES);
    let part = |triangle: usize| PartId(part_of_face[few.origin[triangle] as usize] as usize);
    let mut scene = Scene::new();
    let colour_of = |face: usize| palette::colour(part_of_face[face] as usize);
    scene.push_proxy(&few, colour_of, Some(Rgb(235, 235, 235)))?;
    let mut drawing = Drawing::new("", SIDE_MM * DVec2::new(2.0, 1.0));
    drawing.ground = Some(Rgb::WHITE);
    let room = SIDE_MM - DVec2::X * (2.0 * COLUMN_MM);
    for (side, azimuth) in AZIMUTHS_RAD.into_iter().enumerate() {
        let camera = Camera::new(azimuth, ELEVATION_RAD, FIELD_OF_VIEW_RAD)?;
        let view = View::fit(camera, few.vertices.iter().copied(), room, MARGIN_MM)?;
        let corner = DVec2::X * (SIDE_MM.x * side as f64);
        let marks = picture(&scene, &view, &Look::for_size(SIDE_MM), None, Vec::new()).marks;
        drawing.place(marks, DAffine2::from_translation(corner + DVec2::X * COLUMN_MM));
        let mut map = PartMap::new(&view);
        for (t, triangle) in few.triangles.iter().enumerate() {
            map.push(&triangle.map(|v| few.vertices[v as usize]), part(t));
        }
        let items = (0..).map(PartId).zip(names);
        let items: Vec<Callout> =
            items.map(|(part, name)| Callout { name, part, places: map.places(part) }).collect();
        let marks = callouts(&items, &map, COLUMN_MM - MARGIN_MM, CAP_MM);
        drawing.place(marks, DAffine2::from_translation(corner + DVec2::X * MARGIN_MM));
    }
    Ok(drawing)
}
