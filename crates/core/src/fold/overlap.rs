//! Components that overlap before anything folds.

use super::cache::{Key, SweepCache};
use super::contact::{Sheet, gap};
use super::pose::{ModelMotion, ancestors, root_of};
use super::way::{push_way, ways};
use crate::component::Panel;
use crate::geom::{Hull, bounds};
use crate::model::{Alike, PartId};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;

/// A corner above another panel's plane by less is rounding.
const CONVEX_MM: f64 = 1e-6;

/// Two components that overlap when all are unfolded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// The two, the smaller id first.
    pub parts: [PartId; 2],
    /// How deep two of their panels are in each other, at most, mm; the shift that parts the two where panels
    /// only touch.
    pub depth_mm: f64,
}

/// A component's panels in the model, each with a ball round it.
struct PosedComponent {
    sheets: Vec<(Sheet, DVec3, f64)>,
    low: DVec3,
    high: DVec3,
}

impl PosedComponent {
    fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.sheets.iter().flat_map(|s| s.0.corners.iter().copied())
    }

    fn is_convex(&self) -> bool {
        let is_below = |sheet: &Sheet, corner| sheet.normal.dot(corner - sheet.corners[0]) < CONVEX_MM;
        self.sheets.iter().all(|s| self.corners().all(|corner| is_below(&s.0, corner)))
    }
}

/// Pairs of components that overlap by more than `tolerance_mm` when unfolded.
pub(super) fn overlaps(
    motion: &ModelMotion<'_>,
    tolerance_mm: f64,
    alike: &Alike,
    cache: &SweepCache,
) -> Vec<Overlap> {
    let model = motion.model();
    let parts = model.parts();
    let solids: Vec<PosedComponent> =
        parts.iter().map(|part| solid(part.component.panels().panels(), part.deployed())).collect();
    let above: Vec<Vec<PartId>> = model.ids().map(|p| ancestors(model, p)).collect();
    let (ways, deployed) = (ways(&above), vec![0; parts.len()]);
    let pairs: Vec<[PartId; 2]> = model
        .ids()
        .flat_map(|a| model.ids().skip(a.0 + 1).map(move |b| [a, b]))
        .filter(|&[a, b]| root_of(model, a) == root_of(model, b))
        .collect();
    let depth_mm = |&pair: &[PartId; 2]| {
        // Of a pair and its image one is looked at.
        let [a, b] = pair.min(alike.image(pair));
        let (p, q) = (&solids[a.0], &solids[b.0]);
        if (p.low.cmpgt(q.high) | q.low.cmpgt(p.high)).any() {
            return 0.0;
        }
        let mut key = vec![tolerance_mm.to_bits(), alike.ids[a.0]];
        push_way(&mut key, &ways[a.0][b.0], &above[a.0], &alike.ids, &deployed);
        let key: Key = key.into_boxed_slice();
        cache.overlaps().get_or(key, || depth_mm(p, q, tolerance_mm))
    };
    let depths: Vec<f64> = pairs.par_iter().map(depth_mm).collect();
    let found = pairs.into_iter().zip(depths).filter(|(_, depth_mm)| *depth_mm > tolerance_mm);
    found.map(|(parts, depth_mm)| Overlap { parts, depth_mm }).collect()
}

fn solid(panels: &[Panel], deployed: DAffine3) -> PosedComponent {
    let sheet = |panel: &Panel| {
        let placement = deployed * panel.deployed;
        let corner = |p: &glam::DVec2| placement.transform_point3(p.extend(0.0));
        let corners: Vec<DVec3> = panel.outline.iter().map(corner).collect();
        let centre = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let radius_mm = corners.iter().map(|c| c.distance(centre)).fold(0.0, f64::max);
        (Sheet { corners, normal: placement.matrix3.z_axis }, centre, radius_mm)
    };
    let sheets: Vec<(Sheet, DVec3, f64)> = panels.iter().map(sheet).collect();
    let (low, high) = bounds(sheets.iter().flat_map(|s| &s.0.corners).copied());
    PosedComponent { sheets, low, high }
}

/// How deep two components are in each other, as far as above the tolerance.
fn depth_mm(a: &PosedComponent, b: &PosedComponent, tolerance_mm: f64) -> f64 {
    let panels_mm = panels_depth_mm(a, b, tolerance_mm);
    if panels_mm > tolerance_mm || !a.is_convex() || !b.is_convex() {
        return panels_mm;
    }
    // No panel cuts through another where sides lie in the same planes, or one body is inside of the other.
    let hulls = [a, b].map(|solid| Hull::of_points(&solid.corners().collect::<Vec<_>>()));
    let [Ok(p), Ok(q)] = &hulls else { return panels_mm };
    solids_depth_mm(p, q, tolerance_mm)
}

/// How deep two convex bodies are in each other, as far as above the tolerance, by the separating axis theorem.
fn solids_depth_mm(a: &Hull, b: &Hull, tolerance_mm: f64) -> f64 {
    let normals =
        [a, b].into_iter().flat_map(|hull| hull.facets().iter().map(|facet| facet.plane().normal()));
    let [e, f] = [a, b].map(edges);
    let across = e.iter().flat_map(|e| f.iter().map(|f| e.cross(*f))).filter_map(DVec3::try_normalize);
    let mut depth_mm = f64::INFINITY;
    for axis in normals.chain(across) {
        let ways = [axis, -axis].map(|axis| a.support(axis) + b.support(-axis));
        depth_mm = depth_mm.min(ways[0]).min(ways[1]);
        if depth_mm <= tolerance_mm {
            return 0.0;
        }
    }
    depth_mm
}

/// The edges of a hull, each once.
fn edges(hull: &Hull) -> Vec<DVec3> {
    let edges = hull.facets().iter().flat_map(|facet| {
        let next = facet.outline().iter().cycle().skip(1);
        facet.outline().iter().zip(next).filter(|(from, to)| from < to)
    });
    edges.map(|(from, to)| hull.vertices()[*to as usize] - hull.vertices()[*from as usize]).collect()
}

/// How deep two panels of two components are in each other at most, as far as above the tolerance.
fn panels_depth_mm(a: &PosedComponent, b: &PosedComponent, tolerance_mm: f64) -> f64 {
    let mut deepest_mm = 0.0_f64;
    for (p, p_centre, p_radius) in &a.sheets {
        for (q, q_centre, q_radius) in &b.sheets {
            if p_centre.distance(*q_centre) < p_radius + q_radius {
                deepest_mm = deepest_mm.max(-gap(p, q, -tolerance_mm, 0).mm);
            }
        }
    }
    deepest_mm
}
