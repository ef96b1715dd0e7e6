//! Chains of side panels: whether they are whole, close when flat, and are wide enough.

use super::area::{area, area_vector, hull};
use super::model::Model;
use super::report::FoldReport;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Corners this near to a level are on it, as a share of the panel's size.
const LEVEL: f64 = 1e-7;
/// Parts of a panel leave no more of its outline than this share of its area: rounding.
const PARTS_AREA: f64 = 1e-6;

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
        // A panel that is larger than the sheet is glued from several faces.
        let rows: Vec<&[(usize, usize)]> = panels.chunk_by(|a, b| a.0 == b.0).collect();
        let is_row = rows.iter().enumerate().all(|(k, row)| row[0].0 == k) && rows.len() > 1;
        let first = panels[0].1;
        let sides: Option<Vec<Side>> = rows
            .iter()
            .map(|row| match row {
                [(_, face)] => Side::of(model, *face),
                parts => Side::of_parts(model, component, first, parts.iter().map(|p| p.1)),
            })
            .collect();
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
    /// The same corners in the first frame.
    ends: [DVec3; 2],
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
        let places: Vec<usize> = hinges.into_iter().filter_map(place).collect();
        let first = *places.first()?;
        let rise = |k: usize| (outline[k].y - outline[first].y).abs();
        let second = places.into_iter().max_by(|&a, &b| rise(a).total_cmp(&rise(b)))?;
        let deployed = model.frames.first()?;
        let ends = [first, second].map(|k| deployed[corners[k]]);
        (rise(second) > 0.0).then_some(Self { face, outline, hinges: [first, second], ends })
    }

    /// A panel of several faces, which lie apart in the crease pattern: it is measured in the first frame,
    /// where they are together. `first` is a face of the chain's first panel.
    fn of_parts(
        model: &Model,
        component: &str,
        first: usize,
        faces: impl Iterator<Item = usize>,
    ) -> Option<Self> {
        let (master, deployed) = (&model.master, model.frames.first()?);
        let up = normal(model, deployed, top(model, component)?)?;
        let along = up.cross(outward(model, deployed, first, up)?);
        let faces: Vec<usize> = faces.collect();
        let face = *faces.first()?;
        let across = normal(model, deployed, face)?.cross(along);
        let flat = |v: usize| DVec2::new(along.dot(deployed[v]), across.dot(deployed[v]));
        let vertices = || faces.iter().flat_map(|&f| &master.faces_vertices[f]).copied();
        let outline = hull(vertices().map(flat).collect());
        let parts = faces
            .iter()
            .map(|&f| area(&master.faces_vertices[f].iter().map(|&v| flat(v)).collect::<Vec<_>>()));
        let is_whole = (parts.sum::<f64>() - area(&outline)).abs() <= PARTS_AREA * area(&outline);
        let by_height = |a: &usize, b: &usize| outline[*a].y.total_cmp(&outline[*b].y);
        let hinges = [(0..outline.len()).min_by(by_height)?, (0..outline.len()).max_by(by_height)?];
        let end = |k: usize| vertices().find(|&v| flat(v) == outline[k]).map(|v| deployed[v]);
        let ends = [end(hinges[0])?, end(hinges[1])?];
        is_whole.then_some(Self { face, outline, hinges, ends })
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
    let (deployed, flat) = (model.frames.first()?, model.frames.last()?);
    let top = top(model, component)?;
    let (up, flat_up) = (normal(model, deployed, top)?, normal(model, flat, top)?);
    let outward = outward(model, deployed, sides[0].face, up)?;
    // The highest and the lowest hinge of the chain, by height along the fold axis.
    let hinge = |side: &Side, highest: bool| {
        let is_first = (up.dot(side.ends[0]) > up.dot(side.ends[1])) == highest;
        side.ends[usize::from(!is_first)]
    };
    let spread = outward.dot(hinge(&sides[sides.len() - 1], false) - hinge(&sides[0], true));
    let mut signed = 0.0;
    for side in sides {
        signed += side.length_mm() * normal(model, flat, side.face)?.dot(flat_up).signum();
    }
    let mean = sides.iter().map(Side::length_mm).sum::<f64>() / sides.len() as f64;
    Some((spread - signed).abs() / mean)
}

/// A face of a component's top panel.
fn top(model: &Model, component: &str) -> Option<usize> {
    let master = &model.master;
    (0..master.face_kind.len()).find(|&f| master.face_kind[f] == "top" && master.component[f] == component)
}

fn normal(model: &Model, frame: &[DVec3], face: usize) -> Option<DVec3> {
    area_vector(model.master.faces_vertices[face].iter().map(|&v| frame[v])).try_normalize()
}

/// The horizontal direction in which a side panel looks.
fn outward(model: &Model, frame: &[DVec3], face: usize, up: DVec3) -> Option<DVec3> {
    normal(model, frame, face)?.reject_from(up).try_normalize()
}
