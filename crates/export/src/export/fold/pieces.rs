//! One file for each piece: a single frame with the fold angles of its flat state, for programs
//! that read one connected sheet and the top frame alone (Flat-Folder, Origami Simulator).

use super::{CREATOR, Edges, FoldComponent, FoldModel, Graph, SPEC};
use glam::DAffine2;
use serde::Serialize;
use tatamu_net::net::Piece;
use tatamu_net::sheet::{PiecePlace, SheetId};

#[derive(Serialize)]
struct Single<'a> {
    file_spec: f64,
    file_creator: &'static str,
    file_title: &'a str,
    file_classes: [&'static str; 1],
    frame_title: &'a str,
    frame_classes: [&'static str; 1],
    frame_attributes: [&'static str; 1],
    frame_unit: &'static str,
    vertices_coords: Vec<[f64; 3]>,
    #[serde(flatten)]
    edges: Edges,
    faces_vertices: Vec<Vec<usize>>,
}

/// Writes one piece of a component.
///
/// # Errors
/// Only what `serde_json` reports; no input is known that brings it about.
pub fn write_piece(
    title: &str,
    component: &FoldComponent<'_>,
    piece: &Piece,
) -> Result<Vec<u8>, serde_json::Error> {
    let mut graph = Graph::with_poses(0);
    let model = FoldModel { title, components: &[], sheet_offsets: &[] };
    graph.add_piece(&model, component, piece, PiecePlace { sheet: SheetId(0), place: DAffine2::IDENTITY });
    let mut edges = graph.edges;
    edges.fold_angle_deg = graph.states.pop().unwrap_or_default().angles_deg;
    for (assignment, &angle_deg) in edges.edges_assignment.iter_mut().zip(&edges.fold_angle_deg) {
        if *assignment != "B" {
            *assignment = if angle_deg < 0.0 { "M" } else { "F" };
        }
    }
    serde_json::to_vec(&Single {
        file_spec: SPEC,
        file_creator: CREATOR,
        file_title: title,
        file_classes: ["singleModel"],
        frame_title: piece.name(),
        frame_classes: ["creasePattern"],
        frame_attributes: ["2D"],
        frame_unit: "mm",
        vertices_coords: graph.pattern,
        edges,
        faces_vertices: graph.faces.faces_vertices,
    })
}
