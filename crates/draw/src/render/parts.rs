//! A picture of the parts of a mesh in colour, from two sides, with their names.

use super::callouts::{Callout, callouts};
use super::palette;
use super::picture::{Look, picture};
use super::proxy::{Proxy, proxy};
use super::scene::{Scene, SceneError};
use super::view::{Camera, View, ViewError};
use crate::drawing::{Drawing, Rgb};
use glam::{DAffine2, DVec2, DVec3};
use tatamu_core::mesh::Mesh;

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

/// Pixels along the longer side of the small picture that shows where each part is seen, and the
/// fewest pixels of a part that is named.
const PIXELS: f64 = 240.0;
const LEAST_PIXELS: usize = 10;

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
    let part = |triangle: usize| part_of_face[few.origin[triangle] as usize] as usize;
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
        let seen = Seen::new(&few, &view, &part);
        let items: Vec<Callout> = (0..names.len())
            .filter_map(|p| {
                let at_mm = seen.middle(p)? + DVec2::X * (COLUMN_MM - MARGIN_MM);
                Some(Callout { name: &names[p], at_mm })
            })
            .collect();
        let inner = SIDE_MM - DVec2::X * (2.0 * MARGIN_MM);
        let marks = callouts(&items, inner, COLUMN_MM - MARGIN_MM, CAP_MM);
        drawing.place(marks, DAffine2::from_translation(corner + DVec2::X * MARGIN_MM));
    }
    Ok(drawing)
}

/// Which part is seen at each pixel of a small picture.
struct Seen {
    width: usize,
    height: usize,
    pixel_mm: f64,
    part: Vec<Option<usize>>,
}

impl Seen {
    fn new(mesh: &Proxy, view: &View, part: &dyn Fn(usize) -> usize) -> Self {
        let pixel_mm = view.size_mm().max_element() / PIXELS;
        let [width, height] = (view.size_mm() / pixel_mm).ceil().to_array().map(|n| n as usize);
        let mut nearest = vec![f64::INFINITY; width * height];
        let mut seen = Self { width, height, pixel_mm, part: vec![None; width * height] };
        for (t, triangle) in mesh.triangles.iter().enumerate() {
            let corners = triangle.map(|v| mesh.vertices[v as usize]);
            let flat = corners.map(|c| view.project(c) / pixel_mm);
            let away = corners.map(|c| view.towards_eye(c).length());
            seen.fill(flat, away, part(t), &mut nearest);
        }
        seen
    }

    fn fill(&mut self, flat: [DVec2; 3], away: [f64; 3], part: usize, nearest: &mut [f64]) {
        let doubled = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
        if doubled == 0.0 {
            return;
        }
        let span = |k: usize, most: usize| {
            let values = flat.map(|p| p[k]);
            let low = values.iter().copied().fold(f64::INFINITY, f64::min).floor().max(0.0) as usize;
            let high = values.iter().copied().fold(0.0, f64::max).ceil() as usize;
            low..high.min(most)
        };
        for y in span(1, self.height) {
            for x in span(0, self.width) {
                let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let share = |k: usize| {
                    let (a, b) = (flat[(k + 1) % 3], flat[(k + 2) % 3]);
                    (b - a).perp_dot(p - a) / doubled
                };
                let shares = [share(0), share(1), share(2)];
                let depth: f64 = shares.iter().zip(away).map(|(s, d)| s * d).sum();
                let pixel = y * self.width + x;
                if shares.iter().all(|s| *s >= 0.0) && depth < nearest[pixel] {
                    nearest[pixel] = depth;
                    self.part[pixel] = Some(part);
                }
            }
        }
    }

    /// The place within a part, as it is seen, that is farthest from what is not the part, mm;
    /// `None` where hardly any of it is seen.
    fn middle(&self, part: usize) -> Option<DVec2> {
        let is_part = |x: usize, y: usize| self.part[y * self.width + x] == Some(part);
        // Distance in steps to the next pixel that is not of the part, from two sweeps.
        let mut depth = vec![0u32; self.part.len()];
        let mut count = 0;
        for y in 1..self.height - 1 {
            for x in 1..self.width - 1 {
                if is_part(x, y) {
                    count += 1;
                    let k = y * self.width + x;
                    depth[k] = 1 + depth[k - 1].min(depth[k - self.width]);
                }
            }
        }
        let mut best = (0, 0);
        for y in (1..self.height - 1).rev() {
            for x in (1..self.width - 1).rev() {
                let k = y * self.width + x;
                if is_part(x, y) {
                    depth[k] = depth[k].min(1 + depth[k + 1].min(depth[k + self.width]));
                    best = best.max((depth[k], k));
                }
            }
        }
        let centre = DVec2::new((best.1 % self.width) as f64, (best.1 / self.width) as f64) + 0.5;
        (count >= LEAST_PIXELS).then(|| centre * self.pixel_mm)
    }
}
