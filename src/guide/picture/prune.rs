//! Leaves out what is painted over: pictures become a third of their size.

use crate::drawing::{Mark, Shape};
use crate::geom::polygon;
use glam::DVec2;

/// Pixels along the longer side of the picture that tells what is seen.
const PIXELS: f64 = 700.0;
/// A face of fewer pixels is left out.
const LEAST: usize = 2;

/// The marks of faces that are seen. Each face is a fill, followed by its lines.
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
    marks.into_iter().enumerate().filter_map(keep).collect()
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
        assert_eq!(seen(vec![small.clone(), large.clone()], size_mm), [large.clone()]);
        let both = vec![large, small];
        assert_eq!(seen(both.clone(), size_mm), both);
    }
}
