//! The layers of each flat component.
//!
//! Each time a chain turns back, it is one layer further down. Its panels in the first layer
//! lie beside the top panel, those in the last one beside the bottom panel, whichever chain they
//! belong to; what lies between can take any order against other chains.

use super::area::{area, area_vector, overlapping};
use super::model::Model;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Pairs of panels of one component that lie in one layer in the last frame and overlap there.
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
        let normal = |f: usize| area_vector(corners(f));
        let normals: Vec<DVec3> = faces.iter().map(|&f| normal(f)).collect();
        let Some(largest) = normals.iter().max_by(|a, b| a.length().total_cmp(&b.length())) else { continue };
        let (x, y) = largest.normalize_or(DVec3::Z).any_orthonormal_pair();
        let layer_of = layers(model, faces, |f| normal(f).dot(*largest) > 0.0);
        for wanted in [Layer::Top, Layer::Bottom] {
            let layer: Vec<usize> = faces.iter().copied().filter(|f| layer_of[f] == wanted).collect();
            let polygons: Vec<Vec<DVec2>> = layer
                .iter()
                .map(|&f| {
                    let mut polygon: Vec<DVec2> =
                        corners(f).map(|p| DVec2::new(x.dot(p), y.dot(p))).collect();
                    if area(&polygon) < 0.0 {
                        polygon.reverse();
                    }
                    polygon
                })
                .collect();
            out.extend(overlapping(&polygons).into_iter().map(|(a, b)| (layer[a], layer[b])));
        }
    }
    out
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Layer {
    Top,
    Between,
    Bottom,
}

/// The layer of each face of a component: chains are followed from the top panel down.
fn layers(model: &Model, faces: &[usize], faces_up: impl Fn(usize) -> bool) -> BTreeMap<usize, Layer> {
    let master = &model.master;
    let kind = |f: usize| master.face_kind[f].as_str();
    let end = |f: &usize| if kind(*f) == "top" { Layer::Top } else { Layer::Bottom };
    let mut layers: BTreeMap<usize, Layer> = faces.iter().map(|f| (*f, end(f))).collect();
    let mut chains: BTreeMap<Option<usize>, Vec<usize>> = BTreeMap::new();
    for &face in faces.iter().filter(|f| kind(**f) == "side") {
        chains.entry(master.chain[face]).or_default().push(face);
    }
    for mut chain in chains.into_values() {
        chain.sort_by_key(|&f| master.panel[f]);
        let turns = |part: &[usize]| part.windows(2).filter(|w| faces_up(w[0]) != faces_up(w[1])).count();
        for (k, &face) in chain.iter().enumerate() {
            let layer = match (turns(&chain[..=k]), turns(&chain[k..])) {
                (0, _) => Layer::Top,
                (_, 0) => Layer::Bottom,
                _ => Layer::Between,
            };
            layers.insert(face, layer);
        }
    }
    layers
}
