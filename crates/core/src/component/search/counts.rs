//! How many top edges and profile vertices fits start with, and may have.

use super::super::symmetry::Symmetry;
use super::super::target::Target;
use super::price::height_mm;
use crate::geom::{Hull, polygon};

/// Fits start with no more top edges and profile vertices than this, and add the others where they are
/// worth most: the search is more reliable with few. If the user asks for the most that is possible, the
/// search also starts with all, so that more edges and vertices never make the error larger.
const SURE: usize = 6;
/// How many top edges a second start has less, and its share of the profile vertices.
const FEWER_EDGES: [usize; 2] = [1, 2];
const FEWER_VERTICES: f64 = 0.6;

/// The target for a simplified hull, with no more panels than can be handled comfortably at the
/// hull's size.
pub(super) fn goal<'h>(target: &Target<'h>, hull: &'h Hull) -> Target<'h> {
    let (girth, height) = girth_and_height(hull);
    let at_most = |length: f64| (length / target.comfortable_mm.max(1e-9)) as usize;
    let least_edges = target.symmetry.map_or(3, Symmetry::least_edges);
    Target {
        hull,
        filling: target.filling,
        joints: target.joints.clone(),
        borders: target.borders.clone(),
        symmetry: target.symmetry,
        top_edges: target
            .top_edges
            .min(at_most(0.5 * girth))
            .max(target.locked_angles().len().max(least_edges)),
        profile_vertices: target.profile_vertices.min(1 + at_most(0.7 * height)).max(3),
        min_panel_mm: target.comfortable_mm,
        panel_worth: target.panel_worth,
        comfortable_mm: target.comfortable_mm,
    }
}

/// Length round the hull, seen along the fold axis, and the height along it.
fn girth_and_height(hull: &Hull) -> (f64, f64) {
    let flat: Vec<glam::DVec2> = hull.vertices().iter().map(|v| v.truncate()).collect();
    let outline = polygon::convex_hull(&flat);
    let girth = polygon::edges(&outline).map(|(a, b)| a.distance(b)).sum();
    (girth, height_mm(hull))
}

/// Top edges and profile vertices to start with: all, where none is to be left out.
pub(super) fn first_counts(goal: &Target) -> (usize, usize) {
    let most = if goal.panel_worth == 0.0 { usize::MAX } else { SURE };
    (goal.top_edges.min(most), goal.profile_vertices.min(most))
}

/// The same, but fewer.
pub(super) fn fewer(goal: &Target) -> Vec<(usize, usize)> {
    let (edges, vertices) = first_counts(goal);
    let least = goal.locked_angles().len().max(3);
    let fewer_edges = FEWER_EDGES.into_iter().filter(|less| edges >= least + less);
    let fewer_vertices = (vertices as f64 * FEWER_VERTICES).ceil() as usize;
    let other = (3..vertices).contains(&fewer_vertices).then_some((edges, fewer_vertices));
    fewer_edges.map(|less| (edges - less, vertices)).chain(other).collect()
}

/// The targets with at most [`SURE`] top edges and profile vertices; `None` where the search starts
/// with no more than that anyway.
pub(super) fn with_sure_counts<'h>(targets: &[(Target<'h>, f64)]) -> Option<Vec<(Target<'h>, f64)>> {
    let sure = |(target, cost_mm): &(Target<'h>, f64)| {
        let top_edges = target.top_edges.min(SURE);
        let profile_vertices = target.profile_vertices.min(SURE);
        (Target { top_edges, profile_vertices, ..target.clone() }, *cost_mm)
    };
    let starts_with_more = |target: &Target| {
        let (edges, vertices) = first_counts(target);
        edges.max(vertices) > SURE
    };
    targets.iter().any(|t| starts_with_more(&t.0)).then(|| targets.iter().map(sure).collect())
}
