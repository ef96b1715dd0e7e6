//! Refolding a FOLD master by its numbers.

use glam::{DVec2, DVec3};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

/// Polygons that share less than this area touch and do not overlap.
const OVERLAP_MM2: f64 = 1e-5;

/// A file that cannot be checked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FoldCheckError {
    /// Not a FOLD master as tatamu writes it.
    #[error("the file is not a FOLD master: {0}")]
    Format(String),
    /// A list is too short or too long for the others.
    #[error("{list} has {found} entries where {expected} are needed")]
    Length {
        /// Name of the list.
        list: String,
        /// Its length.
        found: usize,
        /// What it should be.
        expected: usize,
    },
    /// A number that points to no vertex.
    #[error("{list} names vertex {index}, but there are only {count}")]
    Index {
        /// Name of the list.
        list: &'static str,
        /// The number.
        index: usize,
        /// How many vertices there are.
        count: usize,
    },
}

/// What refolding found. Every measure is 0 and every list empty for a perfect file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FoldReport {
    /// Faces in the file.
    pub faces: usize,
    /// Titles of the folded frames.
    pub frames: Vec<String>,
    /// Largest change of a distance within a face, in any frame, mm.
    pub stretch_mm: f64,
    /// Largest distance between two edges of the same label, in any folded frame, mm.
    pub label_gap_mm: f64,
    /// Labels that are not on exactly one tab edge and one mate edge, or on two mate edges, which
    /// tape joins.
    pub unpaired_labels: Vec<String>,
    /// Faces that are not counter-clockwise in the crease pattern.
    pub clockwise_faces: Vec<usize>,
    /// Pairs of faces that overlap in the crease pattern.
    pub overlaps: Vec<(usize, usize)>,
    /// Largest distance of a vertex from its component's plane in the last frame, mm.
    pub thickness_mm: f64,
    /// Largest difference between an edge's stated and measured fold angle, radians.
    pub angle_error_rad: f64,
    /// Pairs of panels of one component that overlap in one of its layers in the last frame.
    pub layer_overlaps: Vec<(usize, usize)>,
    /// Largest gap of a chain, Eq. (2), as a share of its mean segment.
    pub gap_share: f64,
    /// Chains whose panels are not one row from the top panel to the bottom panel, as
    /// `component, chain`.
    pub broken_chains: Vec<String>,
    /// Narrowest side panel: least width at any height, or least height, mm, with its face.
    pub narrowest: Option<(f64, usize)>,
    /// Edges shared by two faces that are no hinge, fold hinge or tab, and such edges that are
    /// not shared by two faces.
    pub misnamed_edges: Vec<usize>,
}

#[derive(Deserialize)]
pub(super) struct Master {
    vertices_coords: Vec<Vec<f64>>,
    pub(super) edges_vertices: Vec<[usize; 2]>,
    pub(super) faces_vertices: Vec<Vec<usize>>,
    #[serde(rename = "faces_tatamu:component")]
    pub(super) component: Vec<String>,
    #[serde(rename = "faces_tatamu:kind")]
    pub(super) face_kind: Vec<String>,
    #[serde(rename = "faces_tatamu:chain")]
    pub(super) chain: Vec<Option<usize>>,
    #[serde(rename = "faces_tatamu:panel")]
    pub(super) panel: Vec<Option<usize>>,
    #[serde(rename = "edges_tatamu:kind")]
    pub(super) edge_kind: Vec<String>,
    #[serde(rename = "edges_tatamu:label")]
    edge_label: Vec<Option<String>>,
    #[serde(rename = "edges_tatamu:lift_mm", default)]
    edge_lift_mm: Vec<f64>,
    file_frames: Vec<Frame>,
}

#[derive(Deserialize)]
struct Frame {
    #[serde(default)]
    frame_title: String,
    vertices_coords: Vec<Vec<f64>>,
    #[serde(rename = "edges_foldAngle")]
    fold_angle_deg: Vec<f64>,
}

/// A master whose lists fit together, with all coordinates in space.
pub(super) struct Model {
    pub(super) master: Master,
    pub(super) pattern: Vec<DVec3>,
    pub(super) frames: Vec<Vec<DVec3>>,
}

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
    fn read(bytes: &[u8]) -> Result<Self, FoldCheckError> {
        let master: Master =
            serde_json::from_slice(bytes).map_err(|e| FoldCheckError::Format(e.to_string()))?;
        let count = master.vertices_coords.len();
        let (edges, faces) = (master.edges_vertices.len(), master.faces_vertices.len());
        let length = |list: &str, found: usize, expected: usize| {
            let list = list.to_owned();
            if found == expected { Ok(()) } else { Err(FoldCheckError::Length { list, found, expected }) }
        };
        length("faces_tatamu:component", master.component.len(), faces)?;
        length("faces_tatamu:kind", master.face_kind.len(), faces)?;
        length("faces_tatamu:chain", master.chain.len(), faces)?;
        length("faces_tatamu:panel", master.panel.len(), faces)?;
        length("edges_tatamu:kind", master.edge_kind.len(), edges)?;
        length("edges_tatamu:label", master.edge_label.len(), edges)?;
        if !master.edge_lift_mm.is_empty() {
            length("edges_tatamu:lift_mm", master.edge_lift_mm.len(), edges)?;
        }
        for frame in &master.file_frames {
            let of = |list: &str| format!("{list} of frame {:?}", frame.frame_title);
            length(&of("vertices_coords"), frame.vertices_coords.len(), count)?;
            length(&of("edges_foldAngle"), frame.fold_angle_deg.len(), edges)?;
        }
        let index = |list: &'static str, mut indices: Box<dyn Iterator<Item = usize> + '_>| {
            indices
                .find(|&i| i >= count)
                .map_or(Ok(()), |index| Err(FoldCheckError::Index { list, index, count }))
        };
        index("edges_vertices", Box::new(master.edges_vertices.iter().flatten().copied()))?;
        index("faces_vertices", Box::new(master.faces_vertices.iter().flatten().copied()))?;
        let pattern = points(&master.vertices_coords)?;
        let frames =
            master.file_frames.iter().map(|f| points(&f.vertices_coords)).collect::<Result<_, _>>()?;
        Ok(Self { master, pattern, frames })
    }

    /// Corners of a face in the crease pattern.
    pub(super) fn polygon(&self, face: usize) -> Vec<DVec2> {
        self.master.faces_vertices[face].iter().map(|&v| self.pattern[v].truncate()).collect()
    }

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
        -along.dot(n.cross(m)).atan2(n.dot(m))
    }
}

/// Pairs of convex polygons that share more than a touch.
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
            }
        }
    }
    out
}

fn points(coords: &[Vec<f64>]) -> Result<Vec<DVec3>, FoldCheckError> {
    coords
        .iter()
        .map(|c| match c[..] {
            [x, y] => Ok(DVec3::new(x, y, 0.0)),
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            _ => Err(FoldCheckError::Format(format!("a vertex has {} coordinates", c.len()))),
        })
        .collect()
}

pub(super) fn area(polygon: &[DVec2]) -> f64 {
    (0..polygon.len()).map(|k| polygon[k].perp_dot(polygon[(k + 1) % polygon.len()])).sum::<f64>() / 2.0
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
