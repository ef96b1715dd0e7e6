//! From where a scene is seen in a window, and how the mouse changes that.

use super::view::{Camera, ViewError};
use glam::{DVec2, DVec3};

/// Field of view; mild perspective.
const FIELD_OF_VIEW_RAD: f64 = 0.45;
/// What is nearer to the eye than this share of its distance is not drawn.
const NEAREST: f64 = 0.05;

/// From where a scene is seen in a window, and what the mouse changes about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orbit {
    /// Turn about the vertical, radians; 0 is the front.
    pub azimuth_rad: f64,
    /// Height over the horizon, radians, within a quarter turn.
    pub elevation_rad: f64,
    /// Magnification; at 1 the ball about the scene fills the window.
    pub zoom: f64,
    /// Shift of the picture, as a share of the window's shorter side, y up.
    pub shift: DVec2,
    /// Middle of the scene.
    pub centre: DVec3,
    /// Radius of the ball about the scene.
    pub radius: f64,
}

impl Orbit {
    /// A view of a ball, from the front, a little from the right and above.
    pub fn of_ball((centre, radius): (DVec3, f64)) -> Self {
        Self { azimuth_rad: 0.55, elevation_rad: 0.35, zoom: 1.0, shift: DVec2::ZERO, centre, radius }
    }

    /// Turns the scene.
    pub fn turn(&mut self, azimuth_rad: f64, elevation_rad: f64) {
        const QUARTER: f64 = std::f64::consts::FRAC_PI_2;
        self.azimuth_rad = (self.azimuth_rad + azimuth_rad) % std::f64::consts::TAU;
        self.elevation_rad = (self.elevation_rad + elevation_rad).clamp(-QUARTER, QUARTER);
    }

    /// Magnifies about a point of the window, given like the shift.
    pub fn zoom_at(&mut self, factor: f64, at: DVec2) {
        let zoom = (self.zoom * factor).clamp(0.1, 40.0);
        self.shift = at + (self.shift - at) * (zoom / self.zoom);
        self.zoom = zoom;
    }

    /// The eye for a picture of this size.
    ///
    /// # Errors
    /// [`ViewError`] for angles that are out of range and pictures without pixels.
    pub fn eye(&self, size_px: [usize; 2]) -> Result<Eye, ViewError> {
        let camera = Camera::new(self.azimuth_rad, self.elevation_rad, FIELD_OF_VIEW_RAD)?;
        let size = DVec2::new(size_px[0] as f64, size_px[1] as f64);
        if size.min_element() < 1.0 || size.max_element() > 16384.0 {
            return Err(ViewError::NoRoom);
        }
        if !(self.centre.is_finite() && self.shift.is_finite() && self.radius > 0.0 && self.zoom > 0.0) {
            return Err(ViewError::NoPoints);
        }
        let distance = self.radius / libm::sin(0.5 * FIELD_OF_VIEW_RAD);
        Ok(Eye {
            camera,
            centre: self.centre,
            distance,
            scale: 0.48 * size.min_element() * self.zoom / self.radius,
            middle: 0.5 * size + self.shift * size.min_element(),
            size_px,
        })
    }
}

/// A camera before a picture of pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eye {
    camera: Camera,
    centre: DVec3,
    distance: f64,
    scale: f64,
    middle: DVec2,
    size_px: [usize; 2],
}

impl Eye {
    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Width and height of the picture.
    pub fn size_px(&self) -> [usize; 2] {
        self.size_px
    }

    /// Where a point is in the picture, y down, and its nearness, which is more for what is nearer.
    /// None for what is behind the eye, or almost.
    pub fn project(&self, point: DVec3) -> Option<(DVec2, f64)> {
        let local = self.camera.direction(point - self.centre);
        let away = self.distance - local.z;
        let nearness = self.distance / away;
        let at = self.middle + self.scale * nearness * local.truncate();
        let is_before = away > NEAREST * self.distance;
        is_before.then(|| (DVec2::new(at.x, self.size_px[1] as f64 - at.y), nearness))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooming_keeps_the_point_under_the_mouse() {
        let mut orbit = Orbit::of_ball((DVec3::ZERO, 10.0));
        let point = DVec3::new(1.0, 2.0, 3.0);
        let size = [200, 100];
        let (before, _) = orbit.eye(size).unwrap().project(point).unwrap();
        let at = DVec2::new(before.x - 100.0, 50.0 - before.y) / 100.0;
        orbit.zoom_at(3.0, at);
        let (after, _) = orbit.eye(size).unwrap().project(point).unwrap();
        assert!(before.distance(after) < 1e-9, "{before} {after}");
    }

    #[test]
    fn impossible_views_are_refused() {
        let orbit = Orbit::of_ball((DVec3::ZERO, 10.0));
        assert!(orbit.eye([0, 10]).is_err());
        assert!(Orbit { elevation_rad: 2.0, ..orbit }.eye([9, 9]).is_err());
        assert!(Orbit { centre: DVec3::NAN, ..orbit }.eye([9, 9]).is_err());
    }
}
