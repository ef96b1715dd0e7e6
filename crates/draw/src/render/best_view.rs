//! From where a scene is seen: so that the places that matter are.

use super::scene::{Face, Scene};
use super::view::{Camera, View, ViewError};
use glam::{DVec2, DVec3};

/// Mild perspective.
const FIELD_OF_VIEW_RAD: f64 = 0.2;
/// Directions that are tried, the usual one first: degrees round the model, and up.
const AZIMUTHS_DEG: [f64; 12] =
    [30.0, 0.0, 60.0, -30.0, 90.0, -60.0, 120.0, -90.0, 150.0, -120.0, 180.0, -150.0];
const ELEVATIONS_DEG: [f64; 4] = [24.0, 45.0, 5.0, -25.0];
/// What one step away from the usual direction costs, where a place that is well seen is worth 1.
const STEP_COST: f64 = 0.04;
const ELEVATION_COST: [f64; 4] = [0.0, 0.05, 0.08, 0.2];
/// A place counts as seen this far before its face, mm.
const OFF_MM: f64 = 0.3;

/// A place on a face that should be seen.
#[derive(Debug, Clone, Copy)]
pub struct Spot {
    /// Where.
    pub at: DVec3,
    /// Towards the side from which it can be seen.
    pub normal: DVec3,
    /// How much it matters, against others.
    pub weight: f64,
}

/// The view of some points, in a picture of this size with a free border, that shows the spots best.
///
/// # Errors
/// [`ViewError`] where there are no points.
pub fn best_view(
    scene: &Scene,
    points: &[DVec3],
    spots: &[Spot],
    (size_mm, margin_mm): (DVec2, f64),
) -> Result<View, ViewError> {
    let mut best: Option<(f64, View)> = None;
    for (a, azimuth) in AZIMUTHS_DEG.into_iter().enumerate() {
        for (e, elevation) in ELEVATIONS_DEG.into_iter().enumerate() {
            let camera = Camera::new(azimuth.to_radians(), elevation.to_radians(), FIELD_OF_VIEW_RAD)?;
            let view = View::fit(camera, points.iter().copied(), size_mm, margin_mm)?;
            let seen: f64 = spots.iter().map(|spot| spot.weight * clearness(scene, &view, spot)).sum();
            let value = seen - STEP_COST * a.div_ceil(2) as f64 - ELEVATION_COST[e];
            if best.as_ref().is_none_or(|(most, _)| value > *most) {
                best = Some((value, view));
            }
        }
    }
    best.map(|(_, view)| view).ok_or(ViewError::NoPoints)
}

/// How well a spot is seen: from 0, hidden, to 1, at a right angle.
pub fn clearness(scene: &Scene, view: &View, spot: &Spot) -> f64 {
    let to_eye = view.towards_eye(spot.at).normalize_or_zero();
    let facing = to_eye.dot(spot.normal.normalize_or_zero());
    // Seen at a flat angle, it hardly differs from its neighbours.
    if facing < 0.1 || is_hidden(scene, spot, to_eye) { 0.0 } else { 0.6 + 0.4 * facing }
}

fn is_hidden(scene: &Scene, spot: &Spot, to_eye: DVec3) -> bool {
    let from = spot.at + OFF_MM * spot.normal.normalize_or_zero();
    scene.faces().iter().any(|face| is_met(face, from, to_eye))
}

/// Whether a ray meets a face.
fn is_met(face: &Face, from: DVec3, direction: DVec3) -> bool {
    let normal = face.normal();
    let speed = normal.dot(direction);
    let way = normal.dot(face.corners()[0] - from) / speed;
    if speed == 0.0 || way <= 0.0 {
        return false;
    }
    let at = from + way * direction;
    let corners = face.corners();
    (0..corners.len()).all(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
        (b - a).cross(at - a).dot(normal) >= 0.0
    })
}
