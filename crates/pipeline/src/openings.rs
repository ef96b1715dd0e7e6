//! Openings of an unfolded component: where its panels leave a hole, because a slit was widened so that the flat
//! layers do not overlap.

use glam::DVec3;
use std::collections::BTreeMap;
use tatamu_core::component::PanelSet;

/// Corners that are nearer are one point: chains close to 1e-9 of a segment.
const POINT_MM: f64 = 1e-3;
/// A smaller opening is a slit that stands open by a hair.
const LEAST_MM2: f64 = 0.5;

/// Areas of the openings of an unfolded component, mm², the largest first. They are found from its panels alone:
/// what is left when the edges that two panels share cancel out are the borders of the openings.
pub fn openings_mm2(panels: &PanelSet) -> Vec<f64> {
    let mut points = Vec::new();
    let outlines: Vec<Vec<usize>> = panels
        .panels()
        .iter()
        .map(|panel| panel.deployed_outline().into_iter().map(|p| index(&mut points, p)).collect())
        .collect();
    // How often each piece of an edge is passed from its lesser to its greater point, less the other way.
    let mut passes: BTreeMap<[usize; 2], i32> = BTreeMap::new();
    for outline in &outlines {
        let next = outline.iter().cycle().skip(1);
        for (&from, &to) in outline.iter().zip(next).filter(|(from, to)| from != to) {
            for pair in along(&points, from, to).windows(2) {
                let (key, step) =
                    if pair[0] < pair[1] { ([pair[0], pair[1]], 1) } else { ([pair[1], pair[0]], -1) };
                *passes.entry(key).or_default() += step;
            }
        }
    }
    passes.retain(|_, count| *count != 0);
    let mut areas: Vec<f64> =
        groups(&passes, points.len()).iter().map(|edges| area_mm2(&points, edges)).collect();
    areas.retain(|area| *area >= LEAST_MM2);
    areas.sort_by(|a, b| b.total_cmp(a));
    areas
}

/// The point at a place.
fn index(points: &mut Vec<DVec3>, place: DVec3) -> usize {
    points.iter().position(|point| point.distance(place) < POINT_MM).unwrap_or_else(|| {
        points.push(place);
        points.len() - 1
    })
}

/// The points on an edge, from one end to the other.
fn along(points: &[DVec3], from: usize, to: usize) -> Vec<usize> {
    let (start, way) = (points[from], points[to] - points[from]);
    let share = |k: usize| (points[k] - start).dot(way) / way.length_squared();
    let is_between = |&k: &usize| {
        let share = share(k);
        let is_near = (start + way * share).distance(points[k]) < POINT_MM;
        k != from && k != to && is_near && share > 0.0 && share < 1.0
    };
    let mut between: Vec<usize> = (0..points.len()).filter(is_between).collect();
    between.sort_by(|&a, &b| share(a).total_cmp(&share(b)));
    [&[from], &between[..], &[to]].concat()
}

/// Edges with how often they are passed, connected ones together.
fn groups(passes: &BTreeMap<[usize; 2], i32>, points: usize) -> Vec<Vec<([usize; 2], i32)>> {
    let mut group: Vec<usize> = (0..points).collect();
    // Few edges are left, so that repeating until nothing changes is quick.
    let mut is_settled = false;
    while !is_settled {
        is_settled = true;
        for &[a, b] in passes.keys() {
            let least = group[a].min(group[b]);
            is_settled &= group[a] == group[b];
            (group[a], group[b]) = (least, least);
        }
    }
    let mut all: BTreeMap<usize, Vec<([usize; 2], i32)>> = BTreeMap::new();
    for (&edge, &count) in passes {
        all.entry(group[edge[0]]).or_default().push((edge, count));
    }
    all.into_values().collect()
}

/// The area within closed borders, seen from where it looks largest.
fn area_mm2(points: &[DVec3], edges: &[([usize; 2], i32)]) -> f64 {
    let start = edges.first().map_or(DVec3::ZERO, |(edge, _)| points[edge[0]]);
    let across = |&([a, b], count): &([usize; 2], i32)| {
        (points[a] - start).cross(points[b] - start) * f64::from(count) / 2.0
    };
    edges.iter().map(across).sum::<DVec3>().length()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DAffine3, DMat3, DVec2};
    use tatamu_core::component::{ChainId, Panel, PanelKind};

    /// A box of 20 × 30 × 40 mm, in which one side panel is cut back by `cut_mm` at one corner.
    fn cut_box(cut_mm: f64) -> PanelSet {
        let size = DVec3::new(20.0, 30.0, 40.0);
        let sides = [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z), (DVec3::Z, DVec3::X)];
        let panels = sides.iter().enumerate().flat_map(|(k, &(u, v))| {
            [true, false].map(|is_far| {
                let (u, v) = if is_far { (u, v) } else { (v, u) };
                let [width, height] = [u, v].map(|axis| size.dot(axis));
                let w = u.cross(v);
                let start = if is_far { w * size.dot(w) } else { DVec3::ZERO };
                let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
                let mut outline: Vec<DVec2> = corners.map(|(x, y)| DVec2::new(x, y)).to_vec();
                if k == 0 && is_far && cut_mm > 0.0 {
                    let top = [(width, height - cut_mm), (width - cut_mm, height)];
                    outline.splice(2..3, top.map(|(x, y)| DVec2::new(x, y)));
                }
                let deployed = DAffine3::from_mat3_translation(DMat3::from_cols(u, v, w), start);
                Panel {
                    kind: PanelKind::Side { chain: ChainId(k), index: 0 },
                    outline,
                    deployed,
                    flat: deployed,
                }
            })
        });
        PanelSet::new(panels.collect(), Vec::new())
    }

    #[test]
    fn a_closed_box_has_none_and_a_corner_that_is_cut_off_has_its_area() {
        assert_eq!(openings_mm2(&cut_box(0.0)), []);
        let found = openings_mm2(&cut_box(10.0));
        assert!(found.len() == 1 && (found[0] - 50.0).abs() < 1e-9, "{found:?}");
    }
}
