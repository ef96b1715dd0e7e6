//! The two layers of each flat component.

use super::fold::{Model, area_vector, overlapping};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Pairs of panels of one component that face the same way in the last frame and overlap there.
/// Tabs are left out: they lie behind their mates.
pub(super) fn overlaps(model: &Model) -> Vec<(usize, usize)> {
    let Some(flat) = model.frames.last() else { return Vec::new() };
    let mut by_component: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (face, name) in model.master.component.iter().enumerate() {
        if model.master.face_kind[face] != "tab" {
            by_component.entry(name).or_default().push(face);
        }
    }
    let mut out = Vec::new();
    for faces in by_component.values() {
        let corners = |f: usize| model.master.faces_vertices[f].iter().map(|&v| flat[v]);
        let normals: Vec<DVec3> = faces.iter().map(|&f| area_vector(corners(f))).collect();
        let Some(largest) = normals.iter().max_by(|a, b| a.length().total_cmp(&b.length())) else { continue };
        let (x, y) = largest.normalize_or(DVec3::Z).any_orthonormal_pair();
        for faces_up in [true, false] {
            let layer: Vec<usize> =
                (0..faces.len()).filter(|&k| (normals[k].dot(*largest) > 0.0) == faces_up).collect();
            let polygons: Vec<Vec<DVec2>> = layer
                .iter()
                .map(|&k| {
                    let mut polygon: Vec<DVec2> =
                        corners(faces[k]).map(|p| DVec2::new(x.dot(p), y.dot(p))).collect();
                    if super::fold::area(&polygon) < 0.0 {
                        polygon.reverse();
                    }
                    polygon
                })
                .collect();
            out.extend(overlapping(&polygons).into_iter().map(|(a, b)| (faces[layer[a]], faces[layer[b]])));
        }
    }
    out
}
