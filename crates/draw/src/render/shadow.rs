//! A soft shadow on the ground below a model.

use glam::{DVec2, DVec3};

use super::light::mixed;
use super::view::View;
use crate::drawing::{Layer, Mark, Rgb};
use tatamu_core::geom::polygon::convex_hull;

/// Steps from the ground's colour to the darkest.
const STEPS: u32 = 12;
/// Size of the outermost and of the innermost step, relative to the model's outline seen from
/// above.
const OUTER: f64 = 1.12;
const INNER: f64 = 0.55;
/// How dark the middle is.
const DARKEST: Rgb = Rgb(120, 122, 130);
const DARKEST_SHARE: f64 = 0.45;
/// A point at this height, relative to the model's width, casts a shadow of half its distance from
/// the middle: what is far above the ground shades it little.
const FADING_HEIGHT: f64 = 0.5;

/// Marks for a contact shadow of the points on the plane y = the lowest of them, to be drawn under
/// the model on a ground of the given colour. None if the view is from below the horizon, where
/// the ground would hide the model, or if there are no points.
pub fn contact_shadow(points: &[DVec3], view: &View, ground: Rgb) -> Vec<Mark> {
    let low = points.iter().copied().fold(DVec3::MAX, DVec3::min);
    let high = points.iter().copied().fold(DVec3::MIN, DVec3::max);
    let middle = 0.5 * (low + high);
    let is_seen_from_above = view.towards_eye(middle.with_y(low.y)).y > 0.0;
    let width = (high - low).with_y(0.0).length();
    if points.is_empty() || !is_seen_from_above || width == 0.0 {
        return Vec::new();
    }
    let feet = points.iter().map(|p| {
        let nearness = FADING_HEIGHT / (FADING_HEIGHT + (p.y - low.y) / width);
        DVec2::new(p.x - middle.x, p.z - middle.z) * nearness
    });
    let outline = convex_hull(&feet.collect::<Vec<_>>());
    let step = |k: u32| {
        let share = f64::from(k) / f64::from(STEPS - 1);
        let size = OUTER + (INNER - OUTER) * share;
        let corner = |p: &DVec2| DVec3::new(middle.x + size * p.x, low.y, middle.z + size * p.y);
        let dark = f64::from(k + 1) / f64::from(STEPS);
        Mark::filled(
            Layer::Picture,
            outline.iter().map(|p| view.project(corner(p))).collect(),
            mixed(ground, DARKEST, DARKEST_SHARE * dark * dark),
        )
    };
    (0..STEPS).map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;
    use crate::render::Camera;

    #[test]
    fn shadows_darken_inwards_and_need_a_view_from_above() {
        let points: Vec<DVec3> =
            (0..8).map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2))).collect();
        let see = |elevation| {
            let camera = Camera::new(0.5, elevation, 0.0).unwrap();
            let view = View::fit(camera, points.clone(), DVec2::splat(80.0), 8.0).unwrap();
            contact_shadow(&points, &view, Rgb(255, 255, 255))
        };
        assert!(see(-0.3).is_empty());
        let marks = see(0.3);
        let fills: Vec<u8> = marks
            .iter()
            .filter_map(|m| match &m.shape {
                Shape::Path { fill, .. } => fill.map(|f| f.1),
                Shape::Text(_) | Shape::Image(_) => None,
            })
            .collect();
        assert_eq!(fills.len(), STEPS as usize);
        assert!(fills.is_sorted_by(|a, b| a >= b) && fills[0] > fills[11] + 30);
        let nothing = View::fit(Camera::new(0.0, 0.3, 0.0).unwrap(), [DVec3::ZERO], DVec2::splat(80.0), 8.0);
        assert!(contact_shadow(&[], &nothing.unwrap(), Rgb(255, 255, 255)).is_empty());
    }
}
