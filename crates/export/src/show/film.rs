//! The film of a model that folds, one step after another, rests flat, and is deployed again.

use super::LIFT_MM;
use super::angle::ViewAngle;
use super::scenes::pose_scene;
use super::still::{ShowError, Still, framed};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use tatamu_core::fold::{FoldPlan, ModelMotion, Sequence};
use tatamu_core::model::{Model, PartId};
use tatamu_core::units::MM_PER_INCH;
use tatamu_draw::drawing::{Layer, Mark, Rgb, Text};
use tatamu_draw::pixels::rasterise;
use tatamu_draw::render::{Scene, View};
use tatamu_pipeline::Output;
use tiny_skia::Pixmap;

/// Time that a component takes to fold, and that the first and the last take more, seconds.
const FOLD_S: f64 = 0.9;
const EXTRA_S: f64 = 0.5;
/// Shortest and longest time of a frame, seconds: faster ones are not shown in time, slower ones
/// are no motion.
const FRAME_S: [f64; 2] = [0.04, 0.25];
/// Rest when deployed and when flat, seconds.
const REST_S: f64 = 1.2;
/// Height of capitals of captions, as a share of the picture's width.
const CAPTION: f64 = 0.024;
/// The most pixels of all pictures of a film together, each of which takes 4 bytes, and one more in a GIF: 60 frames
/// of 2200 x 2200 pixels. 2000 frames of 4096 x 4096 would take 67 GB.
const MOST_PIXELS: f64 = 150e6;
const CAPTION_INK: Rgb = Rgb(70, 70, 76);

/// Choices for films.
///
/// # Guarantees
/// The number of frames is even, from 4 to 2000; the size is from 32 to 4096 pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmOptions {
    frames: usize,
    size_px: u32,
    angle: ViewAngle,
}

impl Default for FilmOptions {
    fn default() -> Self {
        Self { frames: 60, size_px: 640, angle: ViewAngle::default() }
    }
}

impl FilmOptions {
    /// Fewest and most frames of a film.
    pub const FRAMES: std::ops::RangeInclusive<usize> = 4..=2000;
    /// Smallest and largest size of pictures in pixels.
    pub const SIZES_PX: std::ops::RangeInclusive<u32> = 32..=4096;

    /// Number of frames, there and back.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Longer side of the pictures in pixels.
    pub fn size_px(&self) -> u32 {
        self.size_px
    }

    /// Chooses the number of frames, there and back.
    ///
    /// # Errors
    /// A message for a number out of range.
    pub fn with_frames(self, frames: usize) -> Result<Self, String> {
        if Self::FRAMES.contains(&frames) {
            return Ok(Self { frames: frames.next_multiple_of(2), ..self });
        }
        Err(format!("the number of frames must be from {} to {}", Self::FRAMES.start(), Self::FRAMES.end()))
    }

    /// Chooses the longer side of the pictures in pixels.
    ///
    /// # Errors
    /// A message for a size out of range.
    pub fn with_size_px(self, size_px: u32) -> Result<Self, String> {
        if Self::SIZES_PX.contains(&size_px) {
            return Ok(Self { size_px, ..self });
        }
        Err(format!(
            "the longer side of a picture must be from {} to {} pixels",
            Self::SIZES_PX.start(),
            Self::SIZES_PX.end()
        ))
    }

    /// Chooses from where it is seen.
    #[must_use]
    pub fn with_angle(self, angle: ViewAngle) -> Self {
        Self { angle, ..self }
    }

    fn still(&self) -> Still {
        Still { size_px: self.size_px, angle: self.angle, ground: Some(Rgb::WHITE) }
    }
}

/// A frame of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shot {
    /// Index of the picture.
    pub picture: usize,
    /// How long it is shown, milliseconds.
    pub duration_ms: u32,
}

/// A film: pictures of one size, and the order in which they are shown.
#[derive(Debug, Clone)]
pub struct Film {
    pictures: Vec<Pixmap>,
    shots: Vec<Shot>,
}

impl Film {
    /// Takes the pictures of a model that folds as planned. All are opaque.
    ///
    /// # Errors
    /// See [`ShowError`]; no model is known that brings one about.
    pub(crate) fn shoot(model: &Model, plan: &FoldPlan, options: &FilmOptions) -> Result<Self, ShowError> {
        let motion = ModelMotion::new(model);
        let sequence = Sequence::of_plan(plan);
        let last = options.frames / 2;
        let scenes: Vec<Scene> = (0..=last)
            .into_par_iter()
            .map(|k| scene_at(&motion, &sequence, k as f64 / last as f64))
            .collect();
        let points: Vec<DVec3> = scenes.iter().flat_map(Scene::points).collect();
        let view = options.still().view(&points)?;
        let pixels = view.size_mm() * (Still::dots_per_inch() / MM_PER_INCH);
        if pixels.element_product() * scenes.len() as f64 > MOST_PIXELS {
            return Err(ShowError::Film {
                pictures: scenes.len(),
                width: pixels.x.round(),
                height: pixels.y.round(),
                most_millions: MOST_PIXELS / 1e6,
            });
        }
        let captions = Captions::new(model, &sequence);
        let pictures: Vec<Result<Pixmap, ShowError>> = scenes
            .par_iter()
            .enumerate()
            .map(|(k, scene)| shot(scene, &view, captions.at(k as f64 / last as f64)))
            .collect();
        let pictures = pictures.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(Self { shots: shots(last, sequence.length()), pictures })
    }

    /// The pictures, all of one size.
    pub fn pictures(&self) -> &[Pixmap] {
        &self.pictures
    }

    /// The frames in their order; after the last one the film starts again.
    pub(crate) fn shots(&self) -> &[Shot] {
        &self.shots
    }
}

/// A model at some progress of its folding, from 0 (deployed) to 1 (flat), on the ground.
pub fn staged_scene(output: &Output, progress: f64) -> Scene {
    let motion = ModelMotion::new(output.model());
    scene_at(&motion, &Sequence::of_plan(output.fold_plan()), progress)
}

fn scene_at(motion: &ModelMotion<'_>, sequence: &Sequence, progress: f64) -> Scene {
    let pose = motion.pose_on_ground(&sequence.moment(progress), LIFT_MM);
    pose_scene(motion.model(), &pose)
}

/// What moves at each time: "2/8 head".
struct Captions {
    /// Progress at the end of each motion, and its caption.
    ends: Vec<(f64, String)>,
}

impl Captions {
    fn new(model: &Model, sequence: &Sequence) -> Self {
        let count = sequence.motions().len();
        let motions = sequence.motions().iter().zip(sequence.marks().into_iter().skip(1)).enumerate();
        let caption = |k: usize, part: PartId| format!("{}/{count}  {}", k + 1, model.part(part).name);
        Self { ends: motions.map(|(k, (motion, end))| (end, caption(k, motion.part()))).collect() }
    }

    /// The caption at some progress; none where nothing moves, or a single component does.
    fn at(&self, progress: f64) -> Option<&str> {
        let is_moving = progress > 0.0 && progress < 1.0 && self.ends.len() > 1;
        let found = self.ends.iter().find(|(end, _)| progress <= *end).filter(|_| is_moving);
        found.map(|(_, caption)| caption.as_str())
    }
}

fn shot(scene: &Scene, view: &View, caption: Option<&str>) -> Result<Pixmap, ShowError> {
    let mut drawing = framed(scene, view, Some(Rgb::WHITE));
    let cap_mm = CAPTION * view.size_mm().x;
    let text = caption.map(|words| Text::new(words, DVec2::splat(cap_mm), cap_mm).coloured(CAPTION_INK));
    drawing.marks.extend(text.map(|text| Mark::text(Layer::Picture, text)));
    Ok(rasterise(&drawing, Still::dots_per_inch())?)
}

/// There, a rest, back, a rest.
fn shots(last: usize, length: f64) -> Vec<Shot> {
    let way_s = FOLD_S * length + EXTRA_S;
    let frame_s = (way_s / last as f64).clamp(FRAME_S[0], FRAME_S[1]);
    let there_and_back = (0..=last).chain((1..last).rev());
    let duration_s = |picture: usize| if picture == 0 || picture == last { REST_S } else { frame_s };
    there_and_back
        .map(|picture| Shot { picture, duration_ms: (1000.0 * duration_s(picture)).round() as u32 })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_go_there_and_back_and_rest_at_both_ends() {
        let shots = shots(3, 2.0);
        assert_eq!(shots.iter().map(|s| s.picture).collect::<Vec<_>>(), [0, 1, 2, 3, 2, 1]);
        assert!(shots[0].duration_ms > 1000 && shots[3].duration_ms > 1000);
        assert_eq!(shots[1].duration_ms, 250);
        assert_eq!(shots.len(), 6);
    }

    #[test]
    fn captions_name_what_moves() {
        let ends = vec![(0.4, "1/2  head".to_owned()), (1.0, "2/2  body".to_owned())];
        let captions = Captions { ends };
        let told = [0.0, 0.2, 0.4, 0.7, 1.0].map(|progress| captions.at(progress));
        assert_eq!(told, [None, Some("1/2  head"), Some("1/2  head"), Some("2/2  body"), None]);
    }

    #[test]
    fn choices_are_checked() {
        let options = FilmOptions::default();
        assert_eq!(options.with_frames(61).map(|o| o.frames), Ok(62));
        assert!(options.with_frames(0).is_err() && options.with_frames(100_000).is_err());
        assert!(options.with_size_px(0).is_err() && options.with_size_px(50_000).is_err());
    }
}
