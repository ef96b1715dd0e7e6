//! Pictures of a run: its stages as stills, its folding as a film.
//!
//! Scenes have y up, as pictures do; models have z up.

mod angle;
mod clash;
mod film;
mod scenes;
mod still;

pub use angle::ViewAngle;
pub use clash::{captioned, clash_picture};
pub use film::{Film, FilmOptions, Shot, staged_scene};
pub(crate) use scenes::{Paint, push_panels};
pub use scenes::{components_scene, hulls_scene, mesh_scene, segments_scene, upright};
pub use still::{ShowError, Still, framed};

/// Flat components lie this far off their parents, mm, so that viewers see what lies on what.
pub(crate) const LIFT_MM: f64 = 0.3;
