//! Options of animations and of poses.

use super::settings::put;
use super::{Count, Dial, Entry, Flag, Kind, Scope, Text};
use crate::export::PoseCount;
use crate::show::FilmOptions;

pub(super) const ALL: &[&Entry] = &[&FRAMES, &SIZE_PX, &VIEW, &FOLD_FRAMES];

const HEADING: &str = "Folding";

/// Frames of an animation.
static FRAMES: Entry = Entry {
    flag: Flag::under(HEADING, "frames", "N"),
    scope: Scope::Files,
    kind: Kind::Count(Count {
        least: *FilmOptions::FRAMES.start(),
        most: *FilmOptions::FRAMES.end(),
        fault: "the number of frames must be from {least} to {most}",
        such_as: 60,
        get: |s| Some(s.files.formats.film.frames()),
        set: |s, n| {
            let film = s.files.formats.film.with_frames(n)?;
            put(&mut s.files.formats.film, film)
        },
    }),
    short: "Frames of an animation, folding and unfolding together",
    long: "For .gif and .apng. More frames give smoother motion and larger files. All pictures together, half as many as \
           frames, have at most 150 million pixels.",
    example: "-o teddy.gif --frames 120",
    meaning: "frames of an animation",
    ..Entry::BLANK
};

/// Size of an animation.
static SIZE_PX: Entry = Entry {
    flag: Flag::under(HEADING, "size-px", "PIXELS"),
    scope: Scope::Files,
    kind: Kind::Count(Count {
        least: *FilmOptions::SIZES_PX.start() as usize,
        most: *FilmOptions::SIZES_PX.end() as usize,
        fault: "the longer side of a picture must be from {least} to {most} pixels",
        such_as: 640,
        get: |s| Some(s.files.formats.film.size_px() as usize),
        set: |s, n| {
            let film = s.files.formats.film.with_size_px(n as u32)?;
            put(&mut s.files.formats.film, film)
        },
    }),
    short: "Longer side of an animation in pixels",
    example: "-o teddy.gif --size-px 320",
    meaning: "longer side of an animation in pixels",
    dial: Dial::new("Size in pixels"),
    ..Entry::BLANK
};

/// Where an animation is seen from.
static VIEW: Entry = Entry {
    flag: Some(Flag { may_begin_with_dash: true, ..Flag::named("view", "ANGLE", Some(HEADING)) }),
    scope: Scope::Files,
    kind: Kind::Text(Text {
        names: Vec::new,
        other: "text",
        such_as: "30,20",
        get: |_| None,
        set: |s, text| {
            let film = s.files.formats.film.with_angle(text.parse()?);
            put(&mut s.files.formats.film, film)
        },
    }),
    short: "Camera of an animation: a side or two angles",
    long: "corner, front, back, left, right, top, or two angles in degrees: around the model from its front to its left, \
           then up.",
    example: "--view 30,20",
    automatic: "corner",
    meaning: "`corner`, `front`, `back`, `left`, `right`, `top`, or two angles such as `30,20`",
    ..Entry::BLANK
};

/// Poses in a FOLD file.
static FOLD_FRAMES: Entry = Entry {
    flag: Flag::under(HEADING, "fold-frames", "N"),
    scope: Scope::Files,
    kind: Kind::Count(Count {
        least: 0,
        most: PoseCount::MOST,
        fault: "the number of poses must be at most {most}",
        such_as: 20,
        get: |s| Some(s.files.formats.fold.poses.get()),
        set: |s, n| put(&mut s.files.formats.fold.poses, PoseCount::new(n)?),
    }),
    short: "Poses between unfolded and flat in a FOLD file",
    example: "-o teddy.fold --fold-frames 20",
    meaning: "poses between unfolded and flat in a FOLD file",
    dial: Dial::new("FOLD poses"),
    ..Entry::BLANK
};
