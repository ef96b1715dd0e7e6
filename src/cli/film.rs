//! Options of animations.

use super::error::CliError;
use clap::Args;
use tatamu::export::{FoldOptions, FormatOptions, PoseCount};
use tatamu::show::{FilmOptions, ViewAngle};

/// Options of animations and of poses.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Folding")]
pub struct FilmArgs {
    /// Frames of an animation, folding and deploying together [default: 60]
    ///
    /// For .gif and .apng. More frames move more smoothly and make larger files.
    /// Example: -o teddy.gif --frames 120
    #[arg(long, value_name = "N", value_parser = frames)]
    frames: Option<usize>,

    /// Longer side of an animation in pixels [default: 640]
    ///
    /// Example: -o teddy.gif --size-px 320
    #[arg(long, value_name = "PIXELS", value_parser = size_px)]
    size_px: Option<u32>,

    /// Where an animation is seen from [default: corner]
    ///
    /// corner, front, back, left, right, top, or two angles in degrees: round the model from its
    /// front to its left, and up. Example: --view 30,20
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    view: Option<ViewAngle>,

    /// Poses between deployed and flat in a FOLD file [default: 0]
    ///
    /// Example: -o teddy.fold --fold-frames 20
    #[arg(long, value_name = "N", value_parser = poses)]
    fold_frames: Option<PoseCount>,
}

fn frames(text: &str) -> Result<usize, String> {
    let frames = text.trim().parse().map_err(|_| "this must be a whole number such as 60".to_owned())?;
    FilmOptions::default().with_frames(frames).map(|_| frames)
}

/// Reads a size in pixels.
pub fn size_px(text: &str) -> Result<u32, String> {
    let size_px = text.trim().parse().map_err(|_| "this must be a whole number such as 640".to_owned())?;
    FilmOptions::default().with_size_px(size_px).map(|_| size_px)
}

fn poses(text: &str) -> Result<PoseCount, String> {
    let poses = text.trim().parse().map_err(|_| "this must be a whole number such as 20".to_owned())?;
    PoseCount::new(poses)
}

impl FilmArgs {
    /// Puts the choices into those of the formats.
    pub fn choose(&self, options: FormatOptions) -> Result<FormatOptions, CliError> {
        let mut film = options.film.with_angle(self.view.unwrap_or_default());
        if let Some(frames) = self.frames {
            film = film.with_frames(frames).map_err(CliError::Options)?;
        }
        if let Some(size_px) = self.size_px {
            film = film.with_size_px(size_px).map_err(CliError::Options)?;
        }
        let poses = self.fold_frames.unwrap_or(options.fold.poses);
        let fold = FoldOptions { poses, ..options.fold };
        Ok(FormatOptions { film, fold, ..options })
    }
}
