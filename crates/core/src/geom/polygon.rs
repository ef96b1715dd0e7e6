//! Polygons in the plane, as slices of corners, counter-clockwise unless stated.

use glam::DVec2;

/// Twice the signed area of the triangle `a b c`: positive when counter-clockwise.
pub fn cross3(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// Signed area, positive when counter-clockwise.
pub fn area(polygon: &[DVec2]) -> f64 {
    edges(polygon).map(|(a, b)| a.perp_dot(b)).sum::<f64>() / 2.0
}

/// Edges as pairs of corners, the closing edge last.
pub fn edges(polygon: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    let n = polygon.len();
    (0..n).map(move |i| (polygon[i], polygon[(i + 1) % n]))
}

/// Centroid of the area; the mean of the corners where the area vanishes.
pub fn centroid(polygon: &[DVec2]) -> DVec2 {
    let mean = polygon.iter().sum::<DVec2>() / polygon.len().max(1) as f64;
    let (mut sum, mut weight) = (DVec2::ZERO, 0.0);
    for (a, b) in edges(polygon) {
        let w = cross3(mean, a, b);
        sum += (mean + a + b) * (w / 3.0);
        weight += w;
    }
    if weight.abs() > f64::MIN_POSITIVE { sum / weight } else { mean }
}

/// Distance of a point from the segment between two others.
pub fn distance_to_segment(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let way = b - a;
    let share = ((point - a).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    point.distance(a + share * way)
}

/// Whether a point lies inside of a ring (even–odd).
pub fn contains(ring: &[DVec2], p: DVec2) -> bool {
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossings = edges
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y));
    crossings.count() % 2 == 1
}

/// Distance of a point from a ring and what it surrounds; 0 within it. Unlike [`depth_outside`] it does not ask
/// for the direction of an edge, which one of 1e-8 mm does not have.
pub fn distance(ring: &[DVec2], point: DVec2) -> f64 {
    if contains(ring, point) { 0.0 } else { distance_to_edges(ring, point) }
}

/// Distance of a point from the edges of a ring, within it as well; infinite for a ring without corners.
pub fn distance_to_edges(ring: &[DVec2], point: DVec2) -> f64 {
    edges(ring).map(|(a, b)| distance_to_segment(point, a, b)).fold(f64::INFINITY, f64::min)
}

/// Smallest and largest coordinates; `None` for no points.
pub fn bounds(points: impl IntoIterator<Item = DVec2>) -> Option<(DVec2, DVec2)> {
    points.into_iter().fold(None, |acc, p| match acc {
        None => Some((p, p)),
        Some((lo, hi)) => Some((lo.min(p), hi.max(p))),
    })
}

/// Convex hull, counter-clockwise, without collinear points (Andrew's monotone chain).
pub fn convex_hull(points: &[DVec2]) -> Vec<DVec2> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in points {
            while chain.len() >= 2 && cross3(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter().copied());
    hull.extend(half(&mut sorted.iter().rev().copied()));
    hull
}

/// The part of a convex polygon where `normal · x <= offset` (Sutherland–Hodgman, one edge).
/// Empty where nothing is left.
pub fn clip(polygon: &[DVec2], normal: DVec2, offset: f64) -> Vec<DVec2> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (a, b) in edges(polygon) {
        let (da, db) = (normal.dot(a) - offset, normal.dot(b) - offset);
        if da <= 0.0 {
            out.push(a);
        }
        if (da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0) {
            out.push(a + (b - a) * (da / (da - db)));
        }
    }
    if out.len() < 3 { Vec::new() } else { out }
}

/// Intersection of two convex polygons; empty where they do not overlap.
pub fn intersect_convex(a: &[DVec2], b: &[DVec2]) -> Vec<DVec2> {
    edges(b).fold(a.to_vec(), |part, (p, q)| {
        let outward = -(q - p).perp().normalize_or_zero();
        if part.is_empty() || outward == DVec2::ZERO { part } else { clip(&part, outward, outward.dot(p)) }
    })
}

/// Whether two convex polygons overlap by more than `tolerance_mm` in every direction of their
/// edge normals (separating axes); touching polygons do not.
pub fn convex_overlap(a: &[DVec2], b: &[DVec2], tolerance_mm: f64) -> bool {
    let separated = |p: &[DVec2], q: &[DVec2]| {
        edges(p).any(|(s, e)| {
            let outward = -(e - s).perp().normalize_or_zero();
            outward != DVec2::ZERO && q.iter().all(|&x| outward.dot(x - s) >= -tolerance_mm)
        })
    };
    !a.is_empty() && !b.is_empty() && !separated(a, b) && !separated(b, a)
}

/// Signed distance of a point from a convex polygon's boundary lines: the largest over its edges,
/// negative inside.
pub fn depth_outside(polygon: &[DVec2], point: DVec2) -> f64 {
    edges(polygon)
        .map(|(s, e)| (-(e - s).perp().normalize_or_zero()).dot(point - s))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// A rectangle is less than another if it is so by this share: rounding is not a reason.
const ROUNDING: f64 = 1e-10;

/// The bounding rectangle of least area: the angle that brings it parallel to the axes, with its
/// long side along x, and its size there. One side lies on an edge of the hull (Freeman and
/// Shapira 1975).
pub fn least_rectangle(outline: &[DVec2]) -> (f64, DVec2) {
    let hull = convex_hull(outline);
    let mut best = (0.0, extent(&hull, 0.0));
    for (a, b) in edges(&hull) {
        let angle = -(b - a).to_angle();
        let size = extent(&hull, angle);
        if size.element_product() < best.1.element_product() * (1.0 - ROUNDING) {
            best = (angle, size);
        }
    }
    let (angle, size) = best;
    if size.y > size.x { (angle + std::f64::consts::FRAC_PI_2, DVec2::new(size.y, size.x)) } else { best }
}

/// Width and height of the bounding box of points turned by an angle, radians.
pub fn extent(points: &[DVec2], angle_rad: f64) -> DVec2 {
    let turn = DVec2::from_angle(angle_rad);
    let turned = points.iter().map(|&p| turn.rotate(p));
    bounds(turned).map_or(DVec2::ZERO, |(lo, hi)| hi - lo)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<DVec2> {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .iter()
            .map(|&(u, v)| DVec2::new(x + u * side, y + v * side))
            .collect()
    }

    #[test]
    fn area_and_centroid_of_a_square() {
        let s = square(1.0, 2.0, 4.0);
        assert_eq!(area(&s), 16.0);
        assert!((centroid(&s) - DVec2::new(3.0, 4.0)).length() < 1e-12);
    }

    /// The edge of 1e-9 mm at the corner points anywhere; the point beside it is 1 mm away.
    #[test]
    fn distances_do_not_ask_for_the_direction_of_an_edge() {
        let mut ring = square(0.0, 0.0, 2.0);
        ring.insert(2, DVec2::new(2.0, 2.0 - 1e-9));
        assert!((distance(&ring, DVec2::new(3.0, 1.0)) - 1.0).abs() < 1e-12);
        assert_eq!(distance(&ring, DVec2::new(1.5, 1.0)), 0.0);
        assert!((distance_to_edges(&ring, DVec2::new(1.5, 1.0)) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn touching_is_not_overlap() {
        assert!(!convex_overlap(&square(0.0, 0.0, 1.0), &square(1.0, 0.0, 1.0), 1e-9));
        assert!(convex_overlap(&square(0.0, 0.0, 1.0), &square(0.9, 0.0, 1.0), 1e-9));
    }

    #[test]
    fn intersection_of_shifted_squares() {
        let part = intersect_convex(&square(0.0, 0.0, 2.0), &square(1.0, 1.5, 2.0));
        assert!((area(&part) - 0.5).abs() < 1e-12);
        assert!(intersect_convex(&square(0.0, 0.0, 1.0), &square(3.0, 0.0, 1.0)).is_empty());
    }

    #[test]
    fn hull_drops_inner_and_collinear_points() {
        let mut points = square(0.0, 0.0, 2.0);
        points.extend([DVec2::new(1.0, 0.0), DVec2::new(1.0, 1.0)]);
        assert_eq!(convex_hull(&points).len(), 4);
    }

    #[test]
    fn the_least_rectangle_of_a_turned_bar_is_the_bar() {
        let turn = DVec2::from_angle(0.7);
        let corners = [(0.0, 0.0), (30.0, 0.0), (30.0, 80.0), (0.0, 80.0)].map(DVec2::from);
        let bar = corners.map(|p| turn.rotate(p));
        let (angle, size) = least_rectangle(&bar);
        assert!((size - DVec2::new(80.0, 30.0)).abs().max_element() < 1e-9);
        assert!((extent(&bar, angle) - size).abs().max_element() < 1e-9);
    }
}
