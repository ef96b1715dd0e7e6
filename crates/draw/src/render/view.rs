//! From where a scene is seen, and how it is laid on the picture.

use glam::{DMat3, DVec2, DVec3};

/// Models are not magnified beyond this size filling the picture.
const SMALLEST_MM: f64 = 1e-6;

/// What is wrong with a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum ViewError {
    /// An angle is out of range.
    #[error("the camera's {0} is out of range")]
    Angle(&'static str),
    /// The picture, less its margins, has no area.
    #[error("the picture has no room inside its margins; make it larger")]
    NoRoom,
    /// There is nothing to look at, or a point of it is not finite.
    #[error("there is no finite point to look at")]
    NoPoints,
}

/// Direction and kind of a camera; the model's y axis is up.
///
/// # Guarantees
/// Finite angles; the elevation is within ±90°, the field of view within 0 to 90°.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    to_eye: DMat3,
    field_of_view_rad: f64,
}

impl Camera {
    /// A camera that looks at the model from `azimuth_rad` (0 is the front, +z; a quarter turn is
    /// the model's left, +x) and from `elevation_rad` above the horizon. A field of view of 0 is an
    /// orthographic camera; 0.3 is mild perspective.
    ///
    /// # Errors
    /// [`ViewError::Angle`] where a guarantee would not hold.
    pub fn new(azimuth_rad: f64, elevation_rad: f64, field_of_view_rad: f64) -> Result<Self, ViewError> {
        const QUARTER: f64 = std::f64::consts::FRAC_PI_2;
        if !azimuth_rad.is_finite() {
            return Err(ViewError::Angle("azimuth"));
        }
        if !(-QUARTER..=QUARTER).contains(&elevation_rad) {
            return Err(ViewError::Angle("elevation"));
        }
        if !(0.0..=QUARTER).contains(&field_of_view_rad) {
            return Err(ViewError::Angle("field of view"));
        }
        Ok(Self {
            to_eye: DMat3::from_rotation_x(elevation_rad) * DMat3::from_rotation_y(-azimuth_rad),
            field_of_view_rad,
        })
    }

    /// A direction of the model in the camera's axes: x right, y up, z towards the viewer.
    pub fn direction(&self, model: DVec3) -> DVec3 {
        self.to_eye * model
    }
}

/// A camera fitted to a picture.
///
/// # Guarantees
/// All points that it was fitted to lie inside the picture's margins. The eye is outside of their
/// bounding ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    camera: Camera,
    centre: DVec3,
    /// Distance of the eye from the centre; none for an orthographic camera.
    distance: Option<f64>,
    scale: f64,
    shift_mm: DVec2,
    size_mm: DVec2,
}

impl View {
    /// Fits a camera to points: they fill a picture of `size_mm` except for `margin_mm` all round.
    /// Frames of an animation share one view, fitted to the points of all frames.
    ///
    /// # Errors
    /// [`ViewError::NoRoom`], [`ViewError::NoPoints`].
    pub fn fit(
        camera: Camera,
        points: impl IntoIterator<Item = DVec3>,
        size_mm: DVec2,
        margin_mm: f64,
    ) -> Result<Self, ViewError> {
        let room = size_mm - DVec2::splat(2.0 * margin_mm);
        if !(room.min_element() > 0.0 && room.is_finite() && margin_mm >= 0.0) {
            return Err(ViewError::NoRoom);
        }
        let points: Vec<DVec3> = points.into_iter().collect();
        let low = points.iter().copied().reduce(DVec3::min);
        let high = points.iter().copied().reduce(DVec3::max);
        let (Some(low), Some(high)) = (low, high) else {
            return Err(ViewError::NoPoints);
        };
        if !points.iter().all(|p| p.is_finite()) {
            return Err(ViewError::NoPoints);
        }
        let radius = (0.5 * low.distance(high)).max(SMALLEST_MM);
        let half_angle = 0.5 * camera.field_of_view_rad;
        let mut view = Self {
            camera,
            centre: 0.5 * (low + high),
            distance: (half_angle > 0.0).then(|| radius / libm::sin(half_angle) * (1.0 + 1e-9)),
            scale: 1.0,
            shift_mm: DVec2::ZERO,
            size_mm,
        };
        let flat = points.iter().map(|&p| view.project(p));
        let (low, high) = flat.fold((DVec2::MAX, DVec2::MIN), |(low, high), p| (low.min(p), high.max(p)));
        let extent = (high - low).max(DVec2::splat(SMALLEST_MM));
        view.scale = (room / extent).min_element();
        view.shift_mm = 0.5 * size_mm - 0.5 * view.scale * (low + high);
        Ok(view)
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Size of the picture, mm.
    pub fn size_mm(&self) -> DVec2 {
        self.size_mm
    }

    /// Where a point appears in the picture, mm. It must lie before the eye.
    pub fn project(&self, point: DVec3) -> DVec2 {
        let local = self.camera.direction(point - self.centre);
        let nearness = self.distance.map_or(1.0, |distance| distance / (distance - local.z));
        self.scale * nearness * local.truncate() + self.shift_mm
    }

    /// Direction from a point of the model to the viewer, in the model's axes, not of unit length.
    pub fn towards_eye(&self, point: DVec3) -> DVec3 {
        let backwards = self.camera.to_eye.transpose() * DVec3::Z;
        match self.distance {
            None => backwards,
            Some(distance) => self.centre + distance * backwards - point,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    fn corners() -> impl Iterator<Item = DVec3> {
        (0..8).map(|k| {
            DVec3::new(f64::from(k & 1) * 30.0, f64::from(k >> 1 & 1) * 20.0, f64::from(k >> 2) * 50.0)
        })
    }

    #[test]
    fn views_fill_the_picture() {
        for field_of_view in [0.0, 0.4] {
            for (azimuth, elevation) in [(0.0, 0.0), (0.7, 0.4), (3.0, -FRAC_PI_2)] {
                let camera = Camera::new(azimuth, elevation, field_of_view).unwrap();
                let size = DVec2::new(100.0, 80.0);
                let view = View::fit(camera, corners(), size, 5.0).unwrap();
                let flat: Vec<DVec2> = corners().map(|c| view.project(c)).collect();
                let low = flat.iter().copied().reduce(DVec2::min).unwrap();
                let high = flat.iter().copied().reduce(DVec2::max).unwrap();
                assert!(low.min_element() > 5.0 - 1e-9);
                assert!((size - high).min_element() > 5.0 - 1e-9);
                assert!((low + high - size).length() < 1e-9, "centred");
                let room = (high - low) / DVec2::new(90.0, 70.0);
                assert!((room.max_element() - 1.0).abs() < 1e-9, "fills one direction");
            }
        }
    }

    #[test]
    fn axes_are_right_way_round() {
        let size = DVec2::splat(100.0);
        let see = |azimuth, elevation| {
            let camera = Camera::new(azimuth, elevation, 0.0).unwrap();
            View::fit(camera, corners(), size, 5.0).unwrap()
        };
        let front = see(0.0, 0.0);
        let origin = front.project(DVec3::ZERO);
        assert!(front.project(DVec3::X).x > origin.x);
        assert!(front.project(DVec3::Y).y > origin.y);
        assert!(front.towards_eye(DVec3::ZERO).dot(DVec3::Z) > 0.99);
        assert!(see(FRAC_PI_2, 0.0).towards_eye(DVec3::ZERO).dot(DVec3::X) > 0.99);
        assert!(see(0.3, FRAC_PI_2).towards_eye(DVec3::ZERO).dot(DVec3::Y) > 0.99);
        let above = see(0.0, FRAC_PI_4);
        assert!(above.project(DVec3::Z).y < above.project(DVec3::ZERO).y);
    }

    #[test]
    fn unusable_views_are_refused() {
        assert!(Camera::new(f64::NAN, 0.0, 0.0).is_err());
        assert!(Camera::new(0.0, 1.6, 0.0).is_err());
        assert!(Camera::new(0.0, 0.0, -0.1).is_err());
        let camera = Camera::new(0.0, 0.0, 0.0).unwrap();
        let size = DVec2::splat(10.0);
        let fit = |points: Vec<DVec3>, margin| View::fit(camera, points, size, margin);
        assert_eq!(fit(vec![], 1.0), Err(ViewError::NoPoints));
        assert_eq!(fit(vec![DVec3::NAN], 1.0), Err(ViewError::NoPoints));
        assert_eq!(fit(vec![DVec3::ZERO], 5.0), Err(ViewError::NoRoom));
        let lone = fit(vec![DVec3::ONE], 1.0).unwrap().project(DVec3::ONE);
        assert!((lone - DVec2::splat(5.0)).length() < 1e-9);
    }
}
