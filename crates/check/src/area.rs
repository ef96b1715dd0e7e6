//! Areas of polygons, and what they have in common.

use glam::{DVec2, DVec3};

/// Polygons that share less than this area touch and do not overlap.
const OVERLAP_MM2: f64 = 1e-5;

/// The most pairs that are listed: a megabyte of equal faces has 200 million.
const MOST_PAIRS: usize = 1000;

/// Pairs of convex polygons that share more than a touch; the first of very many.
pub(super) fn overlapping(polygons: &[Vec<DVec2>]) -> Vec<(usize, usize)> {
    let boxes: Vec<(DVec2, DVec2)> = polygons
        .iter()
        .map(|p| p.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |b, q| (b.0.min(*q), b.1.max(*q))))
        .collect();
    let mut out = Vec::new();
    for a in 0..polygons.len() {
        for b in 0..a {
            let apart = boxes[a].0.cmpgt(boxes[b].1).any() || boxes[b].0.cmpgt(boxes[a].1).any();
            if !apart && area(&common(&polygons[a], &polygons[b])).abs() > OVERLAP_MM2 {
                out.push((b, a));
                if out.len() == MOST_PAIRS {
                    return out;
                }
            }
        }
    }
    out
}

/// Signed area, positive when counter-clockwise.
pub(super) fn area(polygon: &[DVec2]) -> f64 {
    (0..polygon.len()).map(|k| polygon[k].perp_dot(polygon[(k + 1) % polygon.len()])).sum::<f64>() / 2.0
}

/// The convex hull of points in a plane, counter-clockwise (Andrew 1979).
pub(super) fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(p - a) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let lower = chain(&mut points.iter().copied());
    let upper = chain(&mut points.iter().rev().copied());
    [lower, upper].concat()
}

/// Normal with the length of the area (Newell).
pub(super) fn area_vector(points: impl Iterator<Item = DVec3>) -> DVec3 {
    let points: Vec<DVec3> = points.collect();
    let Some(&origin) = points.first() else {
        return DVec3::ZERO;
    };
    points.windows(2).map(|w| (w[0] - origin).cross(w[1] - origin)).sum::<DVec3>() / 2.0
}

/// The common part of two convex polygons (Sutherland and Hodgman 1974).
fn common(a: &[DVec2], b: &[DVec2]) -> Vec<DVec2> {
    let mut part = a.to_vec();
    for k in 0..b.len() {
        let (from, to) = (b[k], b[(k + 1) % b.len()]);
        let left = |p: DVec2| (to - from).perp_dot(p - from);
        let mut kept = Vec::new();
        for i in 0..part.len() {
            let (p, q) = (part[i], part[(i + 1) % part.len()]);
            let (s, t) = (left(p), left(q));
            if s >= 0.0 {
                kept.push(p);
            }
            if s * t < 0.0 {
                kept.push(p + (q - p) * (s / (s - t)));
            }
        }
        part = kept;
    }
    part
}
