//! Leaves out what is painted over or beyond the picture's border.

use crate::drawing::{Mark, Shape, rectangle};
use glam::DVec2;
use tatamu_core::geom::polygon;

/// Pixels along the longer side of the picture that tells what is seen.
const PIXELS: f64 = 700.0;
/// A face of fewer pixels is left out.
const LEAST: usize = 2;

/// The marks of faces that are seen, cut at the picture's border. Each face is a fill, followed by
/// its lines.
pub fn seen(marks: Vec<Mark>, size_mm: DVec2) -> Vec<Mark> {
    let pixel_mm = size_mm.max_element() / PIXELS;
    let [width, height] = (size_mm / pixel_mm).ceil().to_array().map(|n| n as usize);
    let mut owner = vec![usize::MAX; width * height];
    for (index, mark) in marks.iter().enumerate() {
        if let Shape::Path { contours, fill: Some(_), .. } = &mark.shape {
            for contour in contours {
                let points: Vec<DVec2> = contour.points.iter().map(|p| *p / pixel_mm).collect();
                fill(&points, [width, height], |pixel| owner[pixel] = index);
            }
        }
    }
    let mut count = vec![0; marks.len()];
    owner.into_iter().filter(|&index| index != usize::MAX).for_each(|index| count[index] += 1);
    let mut is_kept = true;
    let keep = |(index, mark): (usize, Mark)| {
        if matches!(mark.shape, Shape::Path { fill: Some(_), .. }) {
            is_kept = count[index] >= LEAST;
        }
        is_kept.then_some(mark)
    };
    marks.into_iter().enumerate().filter_map(keep).map(|mark| cut(mark, size_mm)).collect()
}

/// A mark as far as it is in the picture.
fn cut(mut mark: Mark, size_mm: DVec2) -> Mark {
    let frame = rectangle(DVec2::ZERO, size_mm);
    let is_in = |p: &DVec2| p.cmpge(DVec2::ZERO).all() && p.cmple(size_mm).all();
    if let Shape::Path { contours, fill, .. } = &mut mark.shape {
        if contours.iter().flat_map(|c| &c.points).all(is_in) {
            return mark;
        }
        let is_filled = fill.is_some();
        for contour in contours.iter_mut() {
            contour.points = match contour.points[..] {
                _ if is_filled => polygon::intersect_convex(&contour.points, &frame),
                [from, to] => within(from, to, size_mm),
                _ => std::mem::take(&mut contour.points),
            };
        }
        contours.retain(|contour| !contour.points.is_empty());
    }
    mark
}

/// The part of a segment in the picture (Liang and Barsky 1984); empty where there is none.
fn within(from: DVec2, to: DVec2, size_mm: DVec2) -> Vec<DVec2> {
    let (mut start, mut end) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let step = to[axis] - from[axis];
        for (way, room) in [(-step, from[axis]), (step, size_mm[axis] - from[axis])] {
            match way {
                _ if way == 0.0 && room < 0.0 => return Vec::new(),
                _ if way < 0.0 => start = start.max(room / way),
                _ if way > 0.0 => end = end.min(room / way),
                _ => {}
            }
        }
    }
    if start < end { vec![from.lerp(to, start), from.lerp(to, end)] } else { Vec::new() }
}

/// Calls for each pixel whose middle a convex polygon covers.
fn fill(points: &[DVec2], [width, height]: [usize; 2], mut paint: impl FnMut(usize)) {
    let Some((low, high)) = polygon::bounds(points.iter().copied()) else { return };
    let rows = low.y.floor().max(0.0) as usize..(high.y.ceil().max(0.0) as usize).min(height);
    for row in rows {
        let y = row as f64 + 0.5;
        let crossings = polygon::edges(points).filter(|(a, b)| (a.y > y) != (b.y > y));
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        for (a, b) in crossings {
            let x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
            (left, right) = (left.min(x), right.max(x));
        }
        if left < right {
            let column = |x: f64| ((x - 0.5).ceil().max(0.0) as usize).min(width);
            (column(left)..column(right)).for_each(|x| paint(row * width + x));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Layer, Rgb};

    fn square(side: f64) -> Mark {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|c| DVec2::splat(10.0) + c * side);
        Mark::filled(Layer::Picture, corners.to_vec(), Rgb::BLACK)
    }

    #[test]
    fn what_is_painted_over_is_left_out_and_nothing_else() {
        let [small, large] = [square(10.0), square(40.0)];
        let size_mm = DVec2::splat(100.0);
        assert_eq!(seen(vec![small.clone(), large.clone()], size_mm), std::slice::from_ref(&large));
        let both = vec![large, small];
        assert_eq!(seen(both.clone(), size_mm), both);
    }

    #[test]
    fn lines_end_at_the_border() {
        let size_mm = DVec2::new(10.0, 4.0);
        let p = DVec2::new;
        assert_eq!(within(p(-5.0, 2.0), p(5.0, 2.0), size_mm), [p(0.0, 2.0), p(5.0, 2.0)]);
        assert_eq!(within(p(2.0, -2.0), p(2.0, 6.0), size_mm), [p(2.0, 0.0), p(2.0, 4.0)]);
        assert_eq!(within(p(1.0, 1.0), p(9.0, 3.0), size_mm), [p(1.0, 1.0), p(9.0, 3.0)]);
        assert!(within(p(-5.0, 3.0), p(3.0, 11.0), size_mm).is_empty());
    }
}
