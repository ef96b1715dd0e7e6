//! The report on the parts of a mesh, as JSON.

use crate::json;
use serde::Serialize;
use tatamu_core::geom::Hull;
use tatamu_core::segment::{Overlap, Parts, SegmentId};

/// Version of the report's structure.
const SCHEMA: u32 = 1;

/// What is known of the parts beside themselves.
#[derive(Debug, Clone, Copy)]
pub struct PartsRun<'a> {
    /// Path of the mesh, as the user gave it.
    pub path: &'a str,
    /// The convex hull of each part that has one.
    pub hulls: &'a [Option<Hull>],
    /// Their union against the solid, where there is a solid.
    pub overlap: Option<Overlap>,
    /// Name and duration of each step, seconds.
    pub stages: &'a [(&'static str, f64)],
}

#[derive(Serialize)]
struct Report<'a> {
    schema: u32,
    input: Input<'a>,
    stages: Vec<Stage>,
    overlap: Option<OverlapNumbers>,
    parts: Vec<Part<'a>>,
    borders: Vec<Border<'a>>,
}

#[derive(Serialize)]
struct Input<'a> {
    path: &'a str,
    faces: usize,
    diagonal_mm: f64,
}

#[derive(Serialize)]
struct Stage {
    name: &'static str,
    seconds: f64,
}

#[derive(Serialize)]
struct OverlapNumbers {
    iou: f64,
    missing: f64,
    outside: f64,
}

#[derive(Serialize)]
struct Part<'a> {
    name: &'a str,
    faces: usize,
    area_share: f64,
    hull_volume_mm3: Option<f64>,
}

#[derive(Serialize)]
struct Border<'a> {
    parts: [&'a str; 2],
    length_mm: f64,
    pieces: usize,
    plane: Option<PlaneNumbers>,
}

#[derive(Serialize)]
struct PlaneNumbers {
    normal: [f64; 3],
    offset_mm: f64,
    residual_mm: f64,
}

/// The report on parts: their sizes, the borders between them with their planes, and how well
/// their hulls stand for the solid.
///
/// # Errors
/// Only what `serde_json` reports; no run is known that brings it about.
pub fn to_json(parts: &Parts, run: &PartsRun<'_>) -> Result<Vec<u8>, serde_json::Error> {
    let mesh = parts.mesh();
    let sizes = parts.face_counts().into_iter().zip(parts.area_shares()).zip(run.hulls);
    let name = |id: SegmentId| parts.names()[id.0 as usize].as_str();
    let borders = parts.segmentation().borders(mesh).into_iter().map(|((a, b), border)| Border {
        parts: [name(a), name(b)],
        length_mm: border.length(),
        pieces: border.pieces(),
        plane: border.plane(mesh).map(|(plane, residual_mm)| PlaneNumbers {
            normal: plane.normal().to_array(),
            offset_mm: plane.offset(),
            residual_mm,
        }),
    });
    let report = Report {
        schema: SCHEMA,
        input: Input { path: run.path, faces: mesh.faces().len(), diagonal_mm: mesh.diagonal_mm() },
        stages: run.stages.iter().map(|&(name, seconds)| Stage { name, seconds }).collect(),
        overlap: run.overlap.map(|o| OverlapNumbers { iou: o.iou, missing: o.missing, outside: o.outside }),
        parts: parts
            .names()
            .iter()
            .zip(sizes)
            .map(|(name, ((faces, area_share), hull))| Part {
                name,
                faces,
                area_share,
                hull_volume_mm3: hull.as_ref().map(Hull::volume),
            })
            .collect(),
        borders: borders.collect(),
    };
    json::pretty(&report)
}
