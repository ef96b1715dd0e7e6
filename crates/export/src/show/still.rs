//! One picture: a scene, framed and lit, with its shadow on the ground.

use super::angle::ViewAngle;
use glam::{DVec2, DVec3};
use tatamu_core::units::MM_PER_INCH;
use tatamu_draw::drawing::{Drawing, Rgb};
use tatamu_draw::render::{Look, Scene, View, ViewError, contact_shadow, picture};

/// Pixels per inch of pictures whose size is in pixels.
const DOTS_PER_INCH: f64 = 96.0;
/// Free border, as a share of the longer side.
const MARGIN: f64 = 0.06;
/// The shorter side is at least this share of the longer one.
const SLIMMEST: f64 = 0.5;

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ShowError {
    /// The view is not possible.
    #[error(transparent)]
    View(#[from] ViewError),
    /// The scene is not possible.
    #[error(transparent)]
    Scene(#[from] tatamu_draw::render::SceneError),
    /// The picture cannot be made of pixels.
    #[error(transparent)]
    Pixels(#[from] tatamu_draw::pixels::PngError),
    /// The pictures of a film are too many for their size.
    #[error(
        "its {pictures} pictures of {width} x {height} pixels have more than {most_millions} million together; use \
         fewer frames, or smaller pictures"
    )]
    Film {
        /// Number of pictures.
        pictures: usize,
        /// Width of each, pixels.
        width: f64,
        /// Height of each, pixels.
        height: f64,
        /// The most that are taken together, million pixels.
        most_millions: f64,
    },
}

/// How a still is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Still {
    /// Longer side in pixels.
    pub size_px: u32,
    /// From where.
    pub angle: ViewAngle,
    /// Colour of the ground; without one the picture is transparent and has no shadow.
    pub ground: Option<Rgb>,
}

impl Still {
    /// Resolution of the drawings, dots per inch.
    pub fn dots_per_inch() -> f64 {
        DOTS_PER_INCH
    }

    /// The size of a picture of four to three, mm.
    pub fn landscape_mm(&self) -> DVec2 {
        DVec2::new(1.0, 0.75) * f64::from(self.size_px) / DOTS_PER_INCH * MM_PER_INCH
    }

    /// The view of some points that fills the picture, which is cut to their shape.
    ///
    /// # Errors
    /// [`ViewError`] where there are no points.
    pub fn view(&self, points: &[DVec3]) -> Result<View, ShowError> {
        let camera = self.angle.camera()?;
        let side_mm = f64::from(self.size_px) / DOTS_PER_INCH * MM_PER_INCH;
        let margin_mm = MARGIN * side_mm;
        let square = View::fit(camera, points.iter().copied(), DVec2::splat(side_mm), margin_mm)?;
        let seen = points.iter().map(|&p| square.project(p));
        let (low, high) = tatamu_core::geom::polygon::bounds(seen).unwrap_or_default();
        let wanted = (high - low + DVec2::splat(2.0 * margin_mm)).max(DVec2::splat(SLIMMEST * side_mm));
        let pixels = (wanted / side_mm * f64::from(self.size_px)).round().max(DVec2::ONE);
        let size_mm = (pixels / DOTS_PER_INCH * MM_PER_INCH).min(DVec2::splat(side_mm));
        Ok(View::fit(camera, points.iter().copied(), size_mm, margin_mm)?)
    }

    /// A scene in a view of all of it.
    ///
    /// # Errors
    /// As [`Still::view`].
    pub fn take(&self, scene: &Scene) -> Result<Drawing, ShowError> {
        let points: Vec<DVec3> = scene.points().collect();
        Ok(framed(scene, &self.view(&points)?, self.ground))
    }
}

/// A scene in a view, with its shadow where there is a ground.
pub fn framed(scene: &Scene, view: &View, ground: Option<Rgb>) -> Drawing {
    let points: Vec<DVec3> = scene.points().collect();
    let shadow = ground.map(|colour| contact_shadow(&points, view, colour)).unwrap_or_default();
    picture(scene, view, &Look::for_size(view.size_mm()), ground, shadow)
}
