//! Arrows, labels and dotted lines over pictures.

use super::GLUED;
use glam::DVec2;
use tatamu_core::geom::polygon;
use tatamu_draw::drawing::{Align, Layer, Mark, Rgb, Stroke, Text, text};

/// Of arrows and of labels.
pub const INK: Rgb = Rgb(16, 84, 160);
/// Where something is glued on.
const GLUE: Rgb = Rgb(196, 30, 58);
const ARROW_MM: f64 = 0.9;
const HEAD_MM: f64 = 3.4;
const HALO_MM: f64 = 0.6;
/// Arrows are at least this long, or nothing would be seen of their shafts.
const LEAST_ARROW_MM: f64 = 7.0;
const CAP_MM: f64 = 2.6;
const PAD_MM: f64 = 1.1;
/// Distance of a label's middle from its place.
const LEADER_MM: f64 = 7.0;
const DOT_MM: f64 = 0.8;

/// An arrow along a path of two or more points; the last part of a short one is made longer.
pub fn arrow(path: &[DVec2]) -> Vec<Mark> {
    let [.., before, tip] = *path else { return Vec::new() };
    let along = (tip - before).normalize_or(DVec2::NEG_Y);
    let length: f64 = path.windows(2).map(|w| w[0].distance(w[1])).sum();
    let tip = tip + along * (LEAST_ARROW_MM - length).max(0.0);
    let mut shaft: Vec<DVec2> = path[..path.len() - 1].to_vec();
    shaft.retain(|p| p.distance(tip) > HEAD_MM);
    if shaft.is_empty() {
        shaft.push(path[0]);
    }
    shaft.push(tip - along * (0.8 * HEAD_MM));
    let head = |more: f64| {
        let back = tip - along * (HEAD_MM + more);
        let side = along.perp() * (0.5 * HEAD_MM + more);
        vec![tip + along * (1.5 * more), back + side, back - side]
    };
    vec![
        Mark::polyline(Layer::Picture, shaft.clone(), &Stroke::solid(ARROW_MM + 2.0 * HALO_MM, Rgb::WHITE)),
        Mark::filled(Layer::Picture, head(HALO_MM), Rgb::WHITE),
        Mark::polyline(Layer::Picture, shaft, &Stroke::solid(ARROW_MM, INK)),
        Mark::filled(Layer::Picture, head(0.0), INK),
    ]
}

/// Texts beside their places, each on a plate with a line to its place, within a picture of
/// `size_mm`. The plates keep away from `middle`, from what is taken, and from each other.
pub fn labels(
    items: &[(&str, DVec2)],
    middle: DVec2,
    size_mm: DVec2,
    taken: Option<[DVec2; 2]>,
) -> Vec<Mark> {
    let mut plates: Vec<[DVec2; 2]> = taken.into_iter().collect();
    let mut marks = Vec::new();
    for &(words, at) in items {
        let words = text::shortened(words, CAP_MM, size_mm.x / 2.0);
        let half = DVec2::new(text::width_mm(&words, CAP_MM), CAP_MM) / 2.0 + DVec2::splat(PAD_MM);
        let others = items.iter().filter(|other| other.1 != at);
        let away: DVec2 = others.map(|other| (at - other.1).normalize_or_zero()).sum();
        let outward = ((at - middle).normalize_or_zero() + 1.5 * away).normalize_or(DVec2::Y);
        let centre = free_place(at, outward, half, size_mm, &plates, items);
        plates.push([centre - half, centre + half]);
        marks.push(Mark::line(Layer::Picture, centre, at, &Stroke::solid(0.9, Rgb::WHITE)));
        marks.push(Mark::line(Layer::Picture, centre, at, &Stroke::solid(0.4, INK)));
        marks.push(Mark::filled(Layer::Picture, disc(at, DOT_MM + 0.3), Rgb::WHITE));
        marks.push(Mark::filled(Layer::Picture, disc(at, DOT_MM), INK));
        marks.push(Mark::filled(Layer::Picture, plate(centre, half + DVec2::splat(0.3)), Rgb::WHITE));
        marks.push(Mark::filled(Layer::Picture, plate(centre, half), INK));
        let anchor = centre - DVec2::Y * (CAP_MM / 2.0);
        let words = Text::new(words, anchor, CAP_MM).aligned(Align::Middle).coloured(Rgb::WHITE);
        marks.push(Mark::text(Layer::Picture, words));
    }
    marks
}

/// The place for a plate nearest to the wanted direction that is within the picture and covers no
/// other plate and no labelled place.
fn free_place(
    at: DVec2,
    outward: DVec2,
    half: DVec2,
    size_mm: DVec2,
    plates: &[[DVec2; 2]],
    items: &[(&str, DVec2)],
) -> DVec2 {
    let inside = |p: DVec2| p.clamp(half, (size_mm - half).max(half));
    let places = [1.0, 1.5, 2.2].into_iter().flat_map(|reach| {
        (0..12_u32).map(move |k| {
            let turn = f64::from(k.div_ceil(2)) * if k % 2 == 0 { 1.0 } else { -1.0 };
            let turn = DVec2::from_angle(turn * std::f64::consts::TAU / 12.0);
            at + turn.rotate(outward) * (LEADER_MM * reach + half.x - half.y)
        })
    });
    let is_free = |p: DVec2| {
        let gap = DVec2::ONE;
        let is_off = |place: &[DVec2; 2]| {
            (p + half + gap).cmplt(place[0]).any() || (p - half - gap).cmpgt(place[1]).any()
        };
        let is_clear = |dot: DVec2| ((dot - p).abs() - half).max_element() > DOT_MM + 0.5;
        plates.iter().all(is_off) && items.iter().all(|item| is_clear(item.1))
    };
    let mut places = places.map(inside);
    let first = inside(at + outward * (LEADER_MM + half.x - half.y));
    places.find(|&p| is_free(p)).unwrap_or(first)
}

fn plate(centre: DVec2, half: DVec2) -> Vec<DVec2> {
    let round = half.min_element() * 0.6;
    let corners =
        [DVec2::new(1.0, 1.0), DVec2::new(-1.0, 1.0), DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0)];
    let arc = |(k, corner): (usize, DVec2)| {
        let middle = centre + corner * (half - DVec2::splat(round));
        (0..=4).map(move |step| {
            let turn = (k as f64 + f64::from(step) / 4.0) * std::f64::consts::FRAC_PI_2;
            middle + round * DVec2::from_angle(turn)
        })
    };
    corners.into_iter().enumerate().flat_map(arc).collect()
}

fn disc(centre: DVec2, radius: f64) -> Vec<DVec2> {
    let corner = |k: u32| centre + radius * DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / 16.0);
    (0..16).map(corner).collect()
}

/// The area of what is glued on, with its outline and its mark of orientation.
pub fn joint(outline: Vec<DVec2>, key: Vec<DVec2>) -> Vec<Mark> {
    let dashed = Stroke { width_mm: 0.6, colour: GLUE, dash_mm: vec![1.6, 1.0] };
    vec![
        Mark::filled(Layer::Picture, outline.clone(), GLUED),
        Mark::polygon(Layer::Picture, outline.clone(), &Stroke::solid(1.1, Rgb::WHITE)),
        Mark::polygon(Layer::Picture, outline, &dashed),
        Mark::filled(Layer::Picture, key, GLUE),
    ]
}

/// The slits that a tab is pushed through, with their mark of orientation.
pub fn slits(lines: &[[DVec2; 2]], key: Vec<DVec2>) -> Vec<Mark> {
    let line = |stroke: Stroke| {
        lines.iter().map(move |[a, b]| Mark::line(Layer::Picture, *a, *b, &stroke)).collect::<Vec<_>>()
    };
    let mut marks = line(Stroke::solid(1.4, Rgb::WHITE));
    marks.extend(line(Stroke::solid(0.6, GLUE)));
    marks.push(Mark::filled(Layer::Picture, key, GLUE));
    marks
}

/// Thin lines between places that meet.
pub fn meetings(lines: &[[DVec2; 2]]) -> Vec<Mark> {
    let dotted = Stroke { width_mm: 0.35, colour: GLUE, dash_mm: vec![0.8, 1.2] };
    lines.iter().map(|[a, b]| Mark::line(Layer::Picture, *a, *b, &dotted)).collect()
}

/// Middle of what is drawn.
pub fn middle(marks: &[Mark]) -> DVec2 {
    let bounds = marks.iter().filter_map(Mark::bounds).flat_map(|(low, high)| [low, high]);
    polygon::bounds(bounds).map_or(DVec2::ZERO, |(low, high)| low.midpoint(high))
}
