//! A FOLD master as tatamu writes it, read from its bytes.

use glam::{DVec2, DVec3};
use serde::Deserialize;

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
    /// A face that no panel is.
    #[error("face {face} has {count} corners; a panel has at most {most}")]
    Corners {
        /// Index of the face.
        face: usize,
        /// Its corners.
        count: usize,
        /// The most that are measured.
        most: usize,
    },
}

/// The most corners of a face, whose distances from each other are all measured. A top panel has at most 64 edges, each of
/// which may be in a few parts.
const MOST_CORNERS: usize = 1000;

#[derive(Deserialize)]
pub(super) struct Master {
    pub(super) vertices_coords: Vec<Vec<f64>>,
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
    pub(super) edge_label: Vec<Option<String>>,
    #[serde(rename = "edges_tatamu:lift_mm", default)]
    pub(super) edge_lift_mm: Vec<f64>,
    pub(super) file_frames: Vec<FoldFrame>,
}

#[derive(Deserialize)]
pub(super) struct FoldFrame {
    #[serde(default)]
    pub(super) frame_title: String,
    pub(super) vertices_coords: Vec<Vec<f64>>,
    #[serde(rename = "edges_foldAngle")]
    pub(super) fold_angle_deg: Vec<f64>,
}

/// A master whose lists fit together, with all coordinates in space.
pub(super) struct Model {
    pub(super) master: Master,
    pub(super) pattern: Vec<DVec3>,
    pub(super) frames: Vec<Vec<DVec3>>,
}

impl Model {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, FoldCheckError> {
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
        let mut corners = master.faces_vertices.iter().map(Vec::len).enumerate();
        if let Some((face, count)) = corners.find(|&(_, count)| count > MOST_CORNERS) {
            return Err(FoldCheckError::Corners { face, count, most: MOST_CORNERS });
        }
        let pattern = points(&master.vertices_coords)?;
        let frames =
            master.file_frames.iter().map(|f| points(&f.vertices_coords)).collect::<Result<_, _>>()?;
        Ok(Self { master, pattern, frames })
    }

    /// Corners of a face in the crease pattern.
    pub(super) fn polygon(&self, face: usize) -> Vec<DVec2> {
        self.master.faces_vertices[face].iter().map(|&v| self.pattern[v].truncate()).collect()
    }
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
