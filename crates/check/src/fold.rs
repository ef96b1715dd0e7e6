//! Refolding a FOLD master by its numbers.

use super::area::{area, area_vector, overlapping};
use super::model::{FoldCheckError, Model};
use super::report::FoldReport;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Refolds a FOLD master: measures every folded frame against the crease pattern.
///
/// # Errors
/// Files that are no such master, or whose lists do not fit together.
pub fn fold(bytes: &[u8]) -> Result<FoldReport, FoldCheckError> {
    let model = Model::read(bytes)?;
    let (label_gap_mm, unpaired_labels) = model.labels();
    let mut report = FoldReport {
        faces: model.master.faces_vertices.len(),
        frames: model.master.file_frames.iter().map(|f| f.frame_title.clone()).collect(),
        stretch_mm: model.stretch(),
        label_gap_mm,
        unpaired_labels,
        overlaps: overlapping(
            &(0..model.master.faces_vertices.len()).map(|f| model.polygon(f)).collect::<Vec<_>>(),
        ),
        thickness_mm: model.frames.last().map_or(0.0, |flat| model.thickness(flat)),
        ..FoldReport::default()
    };
    let faces = 0..report.faces;
    report.clockwise_faces = faces.filter(|&f| area(&model.polygon(f)) <= 0.0).collect();
    model.edges(&mut report);
    super::chains::measure(&model, &mut report);
    report.layer_overlaps = super::layers::overlaps(&model);
    Ok(report)
}

impl Model {
    fn stretch(&self) -> f64 {
        let mut worst: f64 = 0.0;
        for frame in &self.frames {
            for face in &self.master.faces_vertices {
                for (k, &a) in face.iter().enumerate() {
                    for &b in &face[..k] {
                        let here = self.pattern[a].distance(self.pattern[b]);
                        worst = worst.max((frame[a].distance(frame[b]) - here).abs());
                    }
                }
            }
        }
        worst
    }

    fn labels(&self) -> (f64, Vec<String>) {
        let mut edges: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (edge, label) in self.master.edge_label.iter().enumerate() {
            if let Some(label) = label {
                edges.entry(label).or_default().push(edge);
            }
        }
        let (mut worst, mut unpaired) = (0.0_f64, Vec::new());
        for (label, pair) in edges {
            let kinds: BTreeSet<&str> = pair.iter().map(|&e| self.master.edge_kind[e].as_str()).collect();
            let is_glued = kinds == BTreeSet::from(["mate", "tab"]);
            let is_taped = kinds == BTreeSet::from(["mate"]);
            if pair.len() != 2 || !(is_glued || is_taped) {
                unpaired.push(label.to_owned());
                continue;
            }
            for frame in &self.frames {
                let [a, b] = [pair[0], pair[1]].map(|edge| self.axis(edge, frame));
                let apart = |i: usize, k: usize| a[i].distance(b[k]);
                let along = apart(0, 0).max(apart(1, 1));
                worst = worst.max(apart(0, 1).max(apart(1, 0)).min(along));
            }
        }
        (worst, unpaired)
    }

    /// The axis of an edge in a frame: over the edge, where the panels are boards.
    fn axis(&self, edge: usize, frame: &[DVec3]) -> [DVec3; 2] {
        let ends = self.master.edges_vertices[edge];
        let lift_mm = self.master.edge_lift_mm.get(edge).copied().unwrap_or(0.0);
        let faces = || self.master.faces_vertices.iter();
        let own = || faces().find(|face| ends.iter().all(|end| face.contains(end)));
        let lift = match own().filter(|_| lift_mm != 0.0) {
            Some(face) => area_vector(face.iter().map(|&v| frame[v])).normalize_or_zero() * lift_mm,
            None => DVec3::ZERO,
        };
        ends.map(|end| frame[end] + lift)
    }

    /// Thickness of the boards, if there are some: as far as valleys have their axes outside.
    fn board_mm(&self) -> Option<f64> {
        let most = self.master.edge_lift_mm.iter().copied().fold(0.0, f64::max);
        (most > 0.0).then_some(most)
    }

    /// How far any corner is out of its layer, paper having one.
    fn thickness(&self, flat: &[DVec3]) -> f64 {
        let mut plane: BTreeMap<&str, (DVec3, DVec3)> = BTreeMap::new();
        let faces = || self.master.component.iter().zip(&self.master.faces_vertices);
        let mut largest: BTreeMap<&str, f64> = BTreeMap::new();
        for (name, face) in faces() {
            let normal = area_vector(face.iter().map(|&v| flat[v]));
            let best = largest.entry(name).or_insert(0.0);
            if normal.length() > *best {
                *best = normal.length();
                plane.insert(name, (flat[face[0]], normal.normalize()));
            }
        }
        let height = |name: &String, v: usize| {
            let height_mm = plane.get(name.as_str()).map_or(0.0, |(at, n)| n.dot(flat[v] - *at).abs());
            self.board_mm().map_or(height_mm, |board| (height_mm - (height_mm / board).round() * board).abs())
        };
        faces().flat_map(|(name, f)| f.iter().map(move |&v| height(name, v))).fold(0.0, f64::max)
    }

    /// Fold angles by geometry (mountain negative), and whether kinds match what is joined.
    fn edges(&self, report: &mut FoldReport) {
        let mut sides: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (f, face) in self.master.faces_vertices.iter().enumerate() {
            for k in 0..face.len() {
                let (a, b) = (face[k], face[(k + 1) % face.len()]);
                sides.entry([a.min(b), a.max(b)]).or_default().push(f);
            }
        }
        for (e, &[a, b]) in self.master.edges_vertices.iter().enumerate() {
            let at = sides.get(&[a.min(b), a.max(b)]).map_or(&[][..], Vec::as_slice);
            let is_joined = matches!(self.master.edge_kind[e].as_str(), "hinge" | "fold-hinge" | "tab");
            if at.len() != if is_joined { 2 } else { 1 } {
                report.misnamed_edges.push(e);
            } else if let &[p, q] = at {
                for (frame, stated) in self.frames.iter().zip(&self.master.file_frames) {
                    let measured = self.angle(frame, [a, b], p, q);
                    let stated = stated.fold_angle_deg[e].to_radians();
                    // 180° and -180° are the same position.
                    let turn = std::f64::consts::TAU;
                    let off = (measured - stated).rem_euclid(turn);
                    report.angle_error_rad = report.angle_error_rad.max(off.min(turn - off));
                }
            }
        }
    }

    /// Signed angle by which face q is folded against face p at their edge; negative for mountain.
    fn angle(&self, frame: &[DVec3], ends: [usize; 2], p: usize, q: usize) -> f64 {
        let normal = |f: usize| {
            area_vector(self.master.faces_vertices[f].iter().map(|&v| frame[v])).normalize_or_zero()
        };
        let face = &self.master.faces_vertices[p];
        let is_along = (0..face.len()).any(|k| face[k] == ends[0] && face[(k + 1) % face.len()] == ends[1]);
        let along = (frame[ends[1]] - frame[ends[0]]).normalize_or_zero() * if is_along { 1.0 } else { -1.0 };
        let (n, m) = (normal(p), normal(q));
        -libm::atan2(along.dot(n.cross(m)), n.dot(m))
    }
}
