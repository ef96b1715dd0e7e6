//! First guesses that are their own mirror image, in a plane that is straight (see
//! [`super::symmetry`]): directions in pairs, and planes in pairs.

use super::angles::{MAX_TURN_RAD, MIN_BEND_RAD, MIN_TURN_RAD, STEP_RAD, turn};
use super::panel::ChainId;
use super::shape;
use super::solid::{SideFacet, Solid};
use super::symmetry::SAME_RAD;
use super::target::FoldSpot;
use super::worth::{Edge, WORTH_MM, WORTH_SHARE, bulge, meet};
use crate::geom::polygon;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, PI};

/// Directions of the top edges about y = 0: pairs of candidates, thinned out where that adds the
/// least area to the circumscribed polygon, with a direction in the plane itself at neither end,
/// one or both, whichever is best.
pub(super) fn choose_pairs(outline: &[DVec2], locked: &[f64], edges: usize) -> Vec<f64> {
    let mut pairs: Vec<f64> = (1..36).map(|k| f64::from(k) * STEP_RAD).collect();
    let perimeter: f64 = polygon::edges(outline).map(|(a, b)| a.distance(b)).sum();
    let long = polygon::edges(outline).filter(|(a, b)| a.distance(*b) > 0.05 * perimeter);
    pairs.extend(long.map(|(a, b)| (-(b - a).perp()).to_angle().abs()));
    let is_clear = |a: &f64| locked.iter().all(|&l| turn(*a, l).abs() >= MIN_TURN_RAD);
    pairs.retain(|a| is_clear(a) && turn(*a, -a).abs() > 1e-6);
    pairs.extend(locked.iter().filter(|l| **l > 0.0 && **l < PI));
    pairs.sort_by(f64::total_cmp);
    pairs.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    let whole = polygon::area(outline);
    let support = |a: f64| {
        let n = DVec2::from_angle(a);
        outline.iter().map(|p| n.dot(*p)).fold(f64::NEG_INFINITY, f64::max)
    };
    let edge = |angle_rad: f64| Edge {
        angle_rad,
        normal: DVec2::from_angle(angle_rad),
        support: support(angle_rad),
        is_locked: locked.contains(&angle_rad),
    };
    let mut best: Option<(usize, f64, Vec<f64>)> = None;
    for selves in [[false, false], [true, false], [false, true], [true, true]] {
        let own = [0.0, PI].into_iter().zip(selves);
        if own.clone().any(|(a, is_in)| is_in != locked.contains(&a) && !(is_in && is_clear(&a))) {
            continue;
        }
        let own = own.filter(|s| s.1).map(|s| s.0);
        let mut angles: Vec<f64> = pairs.iter().flat_map(|&a| [-a, a]).chain(own).collect();
        angles.sort_by(f64::total_cmp);
        let set = thinned(angles.into_iter().map(edge).collect(), edges, WORTH_SHARE * whole);
        let n = set.len();
        let corners: Vec<DVec2> = (0..n).map(|k| meet(&set[k], &set[(k + 1) % n])).collect();
        let cost = polygon::area(&corners) + WORTH_SHARE * whole * n as f64;
        let key = (n.max(edges), cost);
        if best.as_ref().is_none_or(|b| (b.0, b.1) > key) {
            best = Some((key.0, key.1, set.iter().map(|e| e.angle_rad).collect()));
        }
    }
    best.map_or_else(Vec::new, |b| b.2)
}

/// The edges without pairs that are too many, too close, or not worth `worth_mm2`.
fn thinned(mut set: Vec<Edge>, edges: usize, worth_mm2: f64) -> Vec<Edge> {
    loop {
        let n = set.len();
        let removable = (0..n).filter_map(|k| {
            let own = set[k].angle_rad;
            if own <= 0.0 || own == PI || set[k].is_locked || n < 5 {
                return None;
            }
            let twin = set.iter().position(|e| e.angle_rad == -own)?;
            let beside = |step: usize| {
                let next = (k + step) % n;
                if next == twin { (next + step) % n } else { next }
            };
            let (before, after) = (&set[beside(n - 1)], &set[beside(1)]);
            let gap = (after.angle_rad - before.angle_rad).rem_euclid(2.0 * PI);
            let near = [k + n - 1, k + 1].map(|c| turn(set[c % n].angle_rad, own).abs());
            let area = if (k + 1) % n == twin || (twin + 1) % n == k {
                let (first, second) = if (k + 1) % n == twin { (k, twin) } else { (twin, k) };
                let cut = [
                    meet(before, &set[first]),
                    meet(before, after),
                    meet(&set[second], after),
                    meet(&set[first], &set[second]),
                ];
                polygon::area(&cut).abs()
            } else {
                let corner = [meet(before, &set[k]), meet(before, after), meet(&set[k], after)];
                2.0 * polygon::area(&corner).abs()
            };
            (gap <= MAX_TURN_RAD).then_some((near[0].min(near[1]) >= MIN_TURN_RAD, area, [k, twin]))
        });
        let best = removable.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        match best {
            Some((is_spread, area, pair)) if n > edges || !is_spread || area < 2.0 * worth_mm2 => {
                set.remove(pair[0].max(pair[1]));
                set.remove(pair[0].min(pair[1]));
            }
            _ => return set,
        }
    }
}

/// Rounds in which each direction of [`choose_fours`] is exchanged for a better one; two are enough for most.
const EXCHANGES: usize = 4;

/// Directions of the top edges about y = 0 and x = 0: directions in neither plane, in one or both, and others in
/// fours, spread evenly and exchanged for candidates as long as the circumscribed polygon becomes smaller.
pub(super) fn choose_fours(outline: &[DVec2], locked: &[f64], edges: usize) -> Vec<f64> {
    let quarter = |a: f64| a.abs().min(PI - a.abs());
    let is_in = |set: &[f64], a: f64| set.iter().any(|b| (a - b).abs() < SAME_RAD);
    let in_quarter: Vec<f64> = locked.iter().map(|&a| quarter(a)).collect();
    let perimeter: f64 = polygon::edges(outline).map(|(a, b)| a.distance(b)).sum();
    let long = polygon::edges(outline).filter(|(a, b)| a.distance(*b) > 0.05 * perimeter);
    let long = long.map(|(a, b)| quarter((-(b - a).perp()).to_angle()));
    let candidates: Vec<f64> = (1..18).map(|k| f64::from(k) * STEP_RAD).chain(long).collect();
    let mut fixed = in_quarter.clone();
    fixed.retain(|a| !is_in(&[0.0, FRAC_PI_2], *a));
    fixed.sort_by(f64::total_cmp);
    fixed.dedup_by(|a, b| (*a - *b).abs() < SAME_RAD);
    let whole = polygon::area(outline);
    let mut best: Option<(usize, f64, Vec<f64>)> = None;
    for selves in [[false, false], [true, false], [false, true], [true, true]] {
        let own: Vec<f64> = [0.0, FRAC_PI_2].into_iter().zip(selves).filter(|s| s.1).map(|s| s.0).collect();
        if in_quarter.iter().any(|&l| !is_in(&fixed, l) && !is_in(&own, l)) {
            continue;
        }
        let cost = |free: &[f64]| {
            let fours: Vec<f64> = fixed.iter().chain(free).copied().collect();
            let all = all_around(&own, &fours);
            let apart = |k: usize| (all[(k + 1) % all.len()] - all[k]).rem_euclid(2.0 * PI);
            // Those that are fixed may be nearer to one another.
            let is_fixed = |k: usize| is_in(&in_quarter, quarter(all[k % all.len()]));
            let is_spread =
                (0..all.len()).all(|k| apart(k) > MIN_TURN_RAD - 1e-9 || (is_fixed(k) && is_fixed(k + 1)));
            let area = area_within(outline, &all).filter(|_| is_spread)?;
            Some(area + WORTH_SHARE * whole * all.len() as f64)
        };
        let room = edges.saturating_sub(2 * own.len() + 4 * fixed.len()) / 4;
        for count in 0..=room {
            let first = if selves[0] { 1.0 } else { 0.5 };
            let place = |k: usize| FRAC_PI_2 * (k as f64 + first) / (count as f64 + 0.5 * own.len() as f64);
            let mut free: Vec<f64> = (0..count).map(place).collect();
            let mut least = cost(&free).unwrap_or(f64::INFINITY);
            for k in (0..EXCHANGES).flat_map(|_| 0..count) {
                for &angle_rad in &candidates {
                    let before = std::mem::replace(&mut free[k], angle_rad);
                    match cost(&free) {
                        Some(cost) if cost < least => least = cost,
                        _ => free[k] = before,
                    }
                }
            }
            let fours: Vec<f64> = fixed.iter().chain(&free).copied().collect();
            let all = all_around(&own, &fours);
            let key = (all.len().max(edges), least);
            if least < f64::INFINITY && best.as_ref().is_none_or(|b| (b.0, b.1) > key) {
                best = Some((key.0, key.1, all));
            }
        }
    }
    let mut all = best.map_or_else(Vec::new, |b| b.2);
    for angle_rad in &mut all {
        if let Some(&own) = locked.iter().find(|l| turn(**l, *angle_rad).abs() < SAME_RAD) {
            *angle_rad = own;
        }
    }
    all
}

/// Directions of the edges of a regular polygon with an even number of them, of which one faces along x, and the last
/// exactly against it.
pub(super) fn regular(edges: usize) -> Vec<f64> {
    let half = edges as i32 / 2;
    (1 - half..=half).map(|k| PI * (f64::from(k) / f64::from(half))).collect()
}

/// Directions in the planes and others in fours, with their images, in order.
fn all_around(own: &[f64], fours: &[f64]) -> Vec<f64> {
    let fours = fours.iter().flat_map(|&a| [-a, a, PI - a, a - PI]);
    let own = own.iter().flat_map(|&a| [a, if a == 0.0 { PI } else { -a }]);
    let mut all: Vec<f64> = fours.chain(own).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Area of the polygon round an outline with edges in these directions; `None` where it is open.
fn area_within(outline: &[DVec2], angles: &[f64]) -> Option<f64> {
    let edge = |&angle_rad: &f64| {
        let normal = DVec2::from_angle(angle_rad);
        let support = outline.iter().map(|p| normal.dot(*p)).fold(f64::NEG_INFINITY, f64::max);
        Edge { angle_rad, normal, support, is_locked: false }
    };
    let edges: Vec<Edge> = angles.iter().map(edge).collect();
    let next = |k: usize| &edges[(k + 1) % edges.len()];
    let gap = |k: usize| (next(k).angle_rad - edges[k].angle_rad).rem_euclid(2.0 * PI);
    let is_closed = edges.len() > 2 && (0..edges.len()).all(|k| gap(k) <= MAX_TURN_RAD);
    let corners = || (0..edges.len()).map(|k| meet(&edges[k], next(k))).collect::<Vec<DVec2>>();
    is_closed.then(|| polygon::area(&corners()))
}

/// Number of vertices of a level profile of `planes` planes: an odd number folds inside the middle one.
pub(super) fn vertices(planes: usize) -> usize {
    planes + 1 + planes % 2
}

/// Where a level chain of `planes` planes folds: in its middle.
pub(super) fn middle(planes: usize) -> FoldSpot {
    if planes.is_multiple_of(2) { FoldSpot::Bend(planes / 2 - 1) } else { FoldSpot::Inside(planes / 2) }
}

/// The planes above z = 0 with their images, and the upright one, if any.
pub(super) fn levelled(facets: Vec<SideFacet>) -> Vec<SideFacet> {
    let is_upper =
        |f: &SideFacet| f.slope_rad > 0.0 && (f.is_joint || 2.0 * f.slope_rad >= 1.2 * MIN_BEND_RAD);
    let upper: Vec<SideFacet> = facets.iter().copied().filter(is_upper).collect();
    let images = upper.iter().rev().map(|f| SideFacet { slope_rad: -f.slope_rad, ..*f });
    let upright = facets.iter().copied().filter(|f| f.slope_rad == 0.0);
    upper.iter().copied().chain(upright).chain(images).collect()
}

/// Drops planes of level chain j in pairs until its profile has at most `most` vertices and all are
/// worth having (as [`super::start::thin_out`]).
pub(super) fn thin_out_level(solid: &mut Solid, j: ChainId, most: usize) {
    let ends = (solid.top_mm, solid.bottom_mm);
    let facets = &mut solid.chains[j.0].facets;
    loop {
        let lines = shape::lines_of(facets);
        let count = facets.len();
        let pair = |k: usize| if 2 * k + 1 == count { 1 } else { 2 };
        let best = (0..count.div_ceil(2))
            .filter(|&k| !facets[k].is_joint && count > pair(k))
            .map(|k| (pair_bulge(&lines, k, ends), k))
            .min_by(|a, b| a.0.0.total_cmp(&b.0.0).then(a.1.cmp(&b.1)));
        match best {
            Some(((_, mean_mm), k)) if vertices(count) > most || mean_mm < WORTH_MM => {
                drop_pair(facets, k);
            }
            _ => return,
        }
    }
}

/// Drops plane k of a level chain and its image.
pub(super) fn drop_pair(facets: &mut Vec<SideFacet>, k: usize) {
    let image = facets.len() - 1 - k;
    facets.remove(k.max(image));
    if image != k {
        facets.remove(k.min(image));
    }
}

/// Area by which a level profile would grow without plane k, of the upper half, and its image, mm²,
/// and its mean width, mm.
pub(super) fn pair_bulge(lines: &[shape::ProfileLine], k: usize, ends: (f64, f64)) -> (f64, f64) {
    let count = lines.len();
    let (area, mean_mm) = match 2 * k + 2 {
        // The two meet: what bounds the one is not the other.
        twice if twice == count => bulge(&lines[..=k], k, (ends.0, 0.0)),
        _ => bulge(lines, k, ends),
    };
    (if 2 * k + 1 == count { area } else { 2.0 * area }, mean_mm)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_4;

    /// The four joints of a body in two planes are mirrored on different ways, so that they are images but for rounding.
    #[test]
    fn locked_directions_are_taken_once_and_as_they_are() {
        let outline: Vec<DVec2> =
            (0..24).map(|k| 10.0 * DVec2::from_angle(f64::from(k) * PI / 12.0)).collect();
        let locked = [FRAC_PI_4, -FRAC_PI_4 + 1e-15, 3.0 * FRAC_PI_4, PI - FRAC_PI_4 - PI * 1.5];
        for edges in 4..11 {
            let all = choose_fours(&outline, &locked, edges);
            assert!(locked.iter().all(|l| all.contains(l)), "{all:?}");
            let apart = |k: usize| turn(all[(k + 1) % all.len()], all[k]);
            assert!((0..all.len()).all(|k| apart(k) > MIN_TURN_RAD / 2.0), "{all:?}");
        }
    }
}
