//! One file for each piece: a single frame with the fold angles of its flat state, for programs
//! that read one connected sheet and the top frame alone (Flat-Folder, Origami Simulator).

use super::{Edges, FoldComponent, FoldModel, Graph, Head};
use glam::DAffine2;
use serde::Serialize;
use tatamu_net::net::Piece;
use tatamu_net::sheet::{PiecePlace, SheetId};

#[derive(Serialize)]
struct Single<'a> {
    #[serde(flatten)]
    head: Head<'a>,
    vertices_coords: Vec<[f64; 3]>,
    #[serde(flatten)]
    edges: Edges,
    faces_vertices: Vec<Vec<usize>>,
}

/// Writes one piece of a component.
///
/// # Errors
/// Only what `serde_json` reports; no input is known that brings it about.
pub(crate) fn write_piece(
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
        head: Head::of_pattern(title, piece.name()),
        vertices_coords: graph.pattern,
        edges,
        faces_vertices: graph.faces.faces_vertices,
    })
}
