//! Chains of side panels: whether they are whole, close when flat, and are wide enough.

use super::area::area_vector;
use super::model::Model;
use super::report::FoldReport;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Corners this near to a level are on it, as a share of the panel's size.
const LEVEL: f64 = 1e-7;

/// Fills in what concerns chains.
pub(super) fn measure(model: &Model, report: &mut FoldReport) {
    let master = &model.master;
    let mut chains: BTreeMap<(&str, usize), Vec<(usize, usize)>> = BTreeMap::new();
    for face in 0..master.face_kind.len() {
        if master.face_kind[face] == "side" {
            match (master.chain[face], master.panel[face]) {
                (Some(chain), Some(panel)) => {
                    chains.entry((&master.component[face], chain)).or_default().push((panel, face));
                }
                _ => report.broken_chains.push(format!("{}, face {face}", master.component[face])),
            }
        }
    }
    for ((component, chain), mut panels) in chains {
        panels.sort_unstable();
        let is_row = panels.iter().enumerate().all(|(k, p)| p.0 == k) && panels.len() > 1;
        let sides: Option<Vec<Side>> = panels.iter().map(|p| Side::of(model, p.1)).collect();
        let gap = sides.as_ref().filter(|_| is_row).and_then(|sides| gap_share(model, component, sides));
        match gap {
            Some(gap) => report.gap_share = report.gap_share.max(gap),
            None => report.broken_chains.push(format!("{component}, chain {}", chain + 1)),
        }
        for side in sides.into_iter().flatten() {
            let least = side.least_mm();
            if report.narrowest.is_none_or(|n| least < n.0) {
                report.narrowest = Some((least, side.face));
            }
        }
    }
}

/// A side panel in the crease pattern, turned so that its hinges are horizontal.
struct Side {
    face: usize,
    outline: Vec<DVec2>,
    /// A corner on each of its two hinges, as positions in the outline.
    hinges: [usize; 2],
}

impl Side {
    fn of(model: &Model, face: usize) -> Option<Self> {
        let master = &model.master;
        let corners = &master.faces_vertices[face];
        let is_hinge =
            |e: usize| matches!(master.edge_kind[e].as_str(), "hinge" | "fold-hinge" | "tab" | "mate");
        let hinges = (0..master.edges_vertices.len())
            .filter(|&e| is_hinge(e) && master.edges_vertices[e].iter().all(|v| corners.contains(v)));
        let place = |e: usize| corners.iter().position(|&v| v == master.edges_vertices[e][0]);
        let hinges: Vec<usize> = hinges.collect();
        let [from, to] = master.edges_vertices[*hinges.first()?].map(|v| model.pattern[v].truncate());
        let along = (to - from).try_normalize()?;
        let outline: Vec<DVec2> = corners
            .iter()
            .map(|&v| model.pattern[v].truncate())
            .map(|p| DVec2::new(along.dot(p), along.perp_dot(p)))
            .collect();
        let ends: Vec<usize> = hinges.into_iter().filter_map(place).collect();
        let first = *ends.first()?;
        let rise = |k: usize| (outline[k].y - outline[first].y).abs();
        let second = ends.into_iter().max_by(|&a, &b| rise(a).total_cmp(&rise(b)))?;
        (rise(second) > 0.0).then_some(Self { face, outline, hinges: [first, second] })
    }

    /// Distance between its hinges.
    fn length_mm(&self) -> f64 {
        (self.outline[self.hinges[1]].y - self.outline[self.hinges[0]].y).abs()
    }

    /// Least width at the height of any corner, or height.
    fn least_mm(&self) -> f64 {
        let near = LEVEL * self.length_mm();
        let widths = self.outline.iter().map(|p| self.width_mm(p.y, near));
        widths.fold(self.length_mm(), f64::min)
    }

    fn width_mm(&self, y: f64, near: f64) -> f64 {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, a) in self.outline.iter().enumerate() {
            let b = self.outline[(k + 1) % self.outline.len()];
            let (da, db) = (a.y - y, b.y - y);
            let x = if da.abs() <= near {
                a.x
            } else if da * db < 0.0 && db.abs() > near {
                a.x + (b.x - a.x) * da / (da - db)
            } else {
                continue;
            };
            (low, high) = (low.min(x), high.max(x));
        }
        high - low
    }
}

/// Gap of a chain over its mean segment: lengths from the crease pattern, spread from the first
/// frame, directions from the last.
fn gap_share(model: &Model, component: &str, sides: &[Side]) -> Option<f64> {
    let master = &model.master;
    let (deployed, flat) = (model.frames.first()?, model.frames.last()?);
    let top = (0..master.face_kind.len())
        .find(|&f| master.face_kind[f] == "top" && master.component[f] == component)?;
    let normal = |frame: &[DVec3], face: usize| {
        area_vector(master.faces_vertices[face].iter().map(|&v| frame[v])).try_normalize()
    };
    let (up, flat_up) = (normal(deployed, top)?, normal(flat, top)?);
    let outward = normal(deployed, sides[0].face)?.reject_from(up).try_normalize()?;
    // The highest and the lowest hinge of the chain, by height along the fold axis.
    let hinge = |side: &Side, highest: bool| {
        let points = side.hinges.map(|k| deployed[master.faces_vertices[side.face][k]]);
        let is_first = (up.dot(points[0]) > up.dot(points[1])) == highest;
        points[usize::from(!is_first)]
    };
    let spread = outward.dot(hinge(&sides[sides.len() - 1], false) - hinge(&sides[0], true));
    let mut signed = 0.0;
    for side in sides {
        signed += side.length_mm() * normal(flat, side.face)?.dot(flat_up).signum();
    }
    let mean = sides.iter().map(Side::length_mm).sum::<f64>() / sides.len() as f64;
    Some((spread - signed).abs() / mean)
}
