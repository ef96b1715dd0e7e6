//! A magnified part of a picture in one of its corners: tabs of a few millimetres are specks in the picture of a
//! whole component, and others are seen at a flat angle, or behind panels.

use super::{PictureError, overlay, taken};
use glam::{DAffine2, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};
use tatamu_core::geom::polygon;
use tatamu_draw::drawing::{Layer, Mark, Rgb, Stroke, rectangle};
use tatamu_draw::render::{Camera, Scene, Spot, View, clearness};

/// What is seen of an area is magnified below this, mm². On a phone, whose screen is 65 mm wide, it is 5 by 4 mm.
const LEAST_MM2: f64 = 32.0;
/// A lens is drawn only where it shows the area at least this many times as large.
const LEAST_FACTOR: f64 = 3.0;
/// Side of the part, its free border, and its distance from the picture's border and from what it may not cover, mm.
const SIDE_MM: f64 = 25.0;
const MARGIN_MM: f64 = 4.0;
const INSET_MM: f64 = 0.5;
const GAP_MM: f64 = 2.0;
const FRAME_MM: f64 = 0.4;
/// A lens looks from the side of the picture, or turned by one of these angles. A turn has a cost, so that readers
/// recognise the place.
const TURNS_DEG: [f64; 5] = [0.0, 30.0, -30.0, 60.0, -60.0];
const TURN_COST: f64 = 0.06;
/// Places along and across an area of four corners that are looked at.
const PLACES: [f64; 4] = [0.1, 0.37, 0.63, 0.9];

/// A magnified part.
pub struct Lens {
    /// What is drawn over the picture.
    pub marks: Vec<Mark>,
    /// Lower left and upper right corner of it.
    pub corners: [DVec2; 2],
}

/// A flat area of four corners, larger than in the picture, where it is a speck there and a corner has room: none
/// of `clear` is covered, and as little of the scene as can be.
pub fn lens(
    scene: &Scene,
    view: &View,
    (area, normal): ([DVec3; 4], DVec3),
    clear: &[DVec2],
) -> Result<Option<Lens>, PictureError> {
    let side = DVec2::splat(SIDE_MM);
    let to_eye = view.towards_eye(area[0]).normalize_or(DVec3::Z);
    let (azimuth, elevation) = (libm::atan2(to_eye.x, to_eye.z), libm::asin(to_eye.y.clamp(-1.0, 1.0)));
    let mut best: Option<(f64, View)> = None;
    for (a, turn) in TURNS_DEG.into_iter().enumerate() {
        for (e, rise) in TURNS_DEG.into_iter().enumerate() {
            let elevation = (elevation + rise.to_radians()).clamp(-FRAC_PI_2, FRAC_PI_2);
            let camera = Camera::new(azimuth + turn.to_radians(), elevation, 0.0)?;
            let near = View::fit(camera, area, side, MARGIN_MM)?;
            let cost = TURN_COST * (a.div_ceil(2) + e.div_ceil(2)) as f64;
            let value = share_seen(scene, &near, &area, normal, true) - cost;
            if best.as_ref().is_none_or(|(most, _)| value > *most) {
                best = Some((value, near));
            }
        }
    }
    let Some((_, near)) = best else { return Ok(None) };
    let seen_mm2 = |view: &View| {
        let flat: Vec<DVec2> = area.iter().map(|&p| view.project(p)).collect();
        polygon::area(&polygon::convex_hull(&flat)) * share_seen(scene, view, &area, normal, false)
    };
    let now_mm2 = seen_mm2(view);
    if now_mm2 >= LEAST_MM2 || seen_mm2(&near) < (LEAST_FACTOR * now_mm2).max(LEAST_MM2) {
        return Ok(None);
    }
    let Some(low) = corner(scene, view, clear) else { return Ok(None) };
    let corners = [low, low + side];
    let square = |gap_mm: f64| rectangle(low - gap_mm, low + side + gap_mm).to_vec();
    let frame = Stroke::solid(FRAME_MM, overlay::INK);
    let flat = area.map(|p| view.project(p));
    let place = polygon::centroid(&polygon::convex_hull(&flat));
    let reach_mm = flat.iter().map(|p| p.distance(place)).fold(0.0, f64::max) + 1.0;
    let ring = (0..24).map(|k| place + reach_mm * DVec2::from_angle(f64::from(k) * TAU / 24.0)).collect();
    let from = place.clamp(corners[0], corners[1]);
    let to = place + (from - place).normalize_or_zero() * reach_mm;
    let mut marks = vec![
        Mark::line(Layer::Picture, from, to, &frame),
        Mark::polygon(Layer::Picture, ring, &frame),
        Mark::filled(Layer::Picture, square(INSET_MM), Rgb::WHITE),
    ];
    let shift = DAffine2::from_translation(low);
    marks.extend(taken(scene, &near, Vec::new()).marks.into_iter().map(|mark| mark.placed(shift)));
    marks.push(Mark::polygon(Layer::Picture, square(0.0), &frame));
    Ok(Some(Lens { marks, corners }))
}

/// How much of an area is seen, from 0 to 1; `is_weighted` makes what is seen at a flat angle count less.
fn share_seen(scene: &Scene, view: &View, area: &[DVec3; 4], normal: DVec3, is_weighted: bool) -> f64 {
    let [start, end, far, near] = *area;
    let places = PLACES.iter().flat_map(|&s| PLACES.map(|t| start.lerp(end, s).lerp(near.lerp(far, s), t)));
    let clear = places.map(|at| clearness(scene, view, &Spot { at, normal, weight: 1.0 }));
    let count = (PLACES.len() * PLACES.len()) as f64;
    clear.map(|clear| if is_weighted { clear } else { f64::from(clear > 0.0) }).sum::<f64>() / count
}

/// The lower left corner of a free place in one of the picture's corners.
fn corner(scene: &Scene, view: &View, clear: &[DVec2]) -> Option<DVec2> {
    let far = view.size_mm() - DVec2::splat(SIDE_MM + INSET_MM);
    let near = DVec2::splat(INSET_MM);
    let places = [DVec2::new(far.x, near.y), near, far, DVec2::new(near.x, far.y)];
    let points: Vec<DVec2> = scene.points().map(|p| view.project(p)).collect();
    let holds = |low: DVec2, gap_mm: f64, p: &DVec2| {
        let high = low + SIDE_MM + gap_mm;
        p.cmpgt(low - gap_mm).all() && p.cmplt(high).all()
    };
    let free = places.into_iter().filter(|&low| !clear.iter().any(|p| holds(low, GAP_MM, p)));
    free.min_by_key(|&low| points.iter().filter(|p| holds(low, 0.0, p)).count())
}
