//! Names beside a picture, with thin lines to what they name.

use crate::drawing::{Align, Layer, Mark, Rgb, Stroke, Text, text};
use glam::DVec2;

/// A name and the place that it belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Callout<'a> {
    /// What is written.
    pub name: &'a str,
    /// The place in the picture, mm.
    pub at_mm: DVec2,
}

/// Height of capitals against the distance of lines of text.
const CAP_SHARE: f64 = 0.5;
/// Radius of the dot at a place, and width of lines, against the height of capitals.
const DOT_SHARE: f64 = 0.3;
const LINE_SHARE: f64 = 0.09;
/// Distance of a line from its text, against the height of capitals.
const GAP_SHARE: f64 = 0.6;

/// Names in two columns at the left and right edge of a picture of `size_mm`, each level with its
/// place as far as the others leave room, with letters as high as `cap_mm` at most. The columns
/// are at most `column_mm` wide: longer names are shortened.
pub fn callouts(items: &[Callout], size_mm: DVec2, column_mm: f64, cap_mm: f64) -> Vec<Mark> {
    let mut by_x: Vec<&Callout> = items.iter().collect();
    by_x.sort_by(|a, b| a.at_mm.x.total_cmp(&b.at_mm.x).then(a.name.cmp(b.name)));
    let in_left_half = by_x.iter().filter(|c| c.at_mm.x < size_mm.x / 2.0).count();
    // Columns of nearly the same length.
    let half = by_x.len() / 2;
    let right = by_x.split_off(in_left_half.clamp(half.saturating_sub(2), half + 2).min(by_x.len()));
    let left = by_x;
    let most = left.len().max(right.len()).max(1);
    let step = (cap_mm / CAP_SHARE).min(size_mm.y / most as f64);
    let cap_mm = step * CAP_SHARE;
    let mut marks = Vec::new();
    for (column, is_left) in [(left, true), (right, false)] {
        for (callout, height) in placed(column, size_mm.y, step) {
            let name = text::shortened(callout.name, cap_mm, column_mm);
            let width = text::width_mm(&name, cap_mm) + GAP_SHARE * cap_mm;
            let (start, end, align) = if is_left {
                (DVec2::new(0.0, height), DVec2::new(width, height), Align::Start)
            } else {
                (DVec2::new(size_mm.x, height), DVec2::new(size_mm.x - width, height), Align::End)
            };
            draw(&mut marks, callout, end, cap_mm);
            let base = start - DVec2::Y * (cap_mm / 2.0);
            marks.push(Mark::text(Layer::Picture, Text::new(name, base, cap_mm).aligned(align)));
        }
    }
    marks
}

/// The heights of names, highest first: as near to their places as a distance of `step` allows.
fn placed<'a>(mut column: Vec<&'a Callout<'a>>, height: f64, step: f64) -> Vec<(&'a Callout<'a>, f64)> {
    column.sort_by(|a, b| b.at_mm.y.total_cmp(&a.at_mm.y).then(a.name.cmp(b.name)));
    let mut heights: Vec<f64> = Vec::with_capacity(column.len());
    for callout in &column {
        let top = heights.last().map_or(height - step / 2.0, |above| above - step);
        heights.push(callout.at_mm.y.min(top));
    }
    let mut bottom = step / 2.0;
    for h in heights.iter_mut().rev() {
        *h = h.max(bottom);
        bottom = *h + step;
    }
    column.into_iter().zip(heights).collect()
}

fn draw(marks: &mut Vec<Mark>, callout: &Callout, from: DVec2, cap_mm: f64) {
    let stroke = |width: f64, colour| Stroke::solid(width * cap_mm, colour);
    // White below makes lines and dots stand out on dark parts.
    for (more, colour) in [(2.0 * LINE_SHARE, Rgb::WHITE), (0.0, Rgb::BLACK)] {
        let line = stroke(LINE_SHARE + more, colour);
        marks.push(Mark::line(Layer::Picture, from, callout.at_mm, &line));
        let corners = (0..16).map(|k| {
            let direction = DVec2::from_angle(std::f64::consts::TAU * f64::from(k) / 16.0);
            callout.at_mm + direction * ((DOT_SHARE + more / 2.0) * cap_mm)
        });
        marks.push(Mark::filled(Layer::Picture, corners.collect(), colour));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;

    #[test]
    fn names_stay_in_the_picture_and_apart() {
        let names: Vec<String> = (0..30).map(|k| format!("part-{k}")).collect();
        let items: Vec<Callout> = names
            .iter()
            .enumerate()
            .map(|(k, name)| Callout { name, at_mm: DVec2::new(20.0 + k as f64, 40.0 + (k % 3) as f64) })
            .collect();
        let size = DVec2::new(100.0, 80.0);
        let marks = callouts(&items, size, 25.0, 3.0);
        let mut lines: Vec<(Align, f64, f64)> = marks
            .iter()
            .filter_map(|m| match &m.shape {
                Shape::Text(text) => Some((text.align, text.anchor.y, text.cap_height_mm)),
                Shape::Path { .. } | Shape::Image(_) => None,
            })
            .collect();
        assert_eq!(lines.len(), 30);
        assert!(lines.iter().all(|l| l.1 >= 0.0 && l.1 + l.2 <= size.y));
        lines.sort_by(|a, b| (a.0 == Align::End).cmp(&(b.0 == Align::End)).then(a.1.total_cmp(&b.1)));
        for pair in lines.windows(2).filter(|p| p[0].0 == p[1].0) {
            assert!(pair[1].1 - pair[0].1 > 1.5 * pair[0].2, "{pair:?}");
        }
    }
}
