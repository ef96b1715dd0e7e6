//! FOLD 1.2: the multi-frame master, from crease pattern to flat model.
//!
//! Frame 0 holds the crease pattern, all pieces at their places on the sheets; `file_frames` hold
//! the deployed and the flat state of the same vertices. Coordinates are written with as many
//! digits as they have, so every face is congruent in all frames within rounding.

mod pieces;

pub use pieces::write_piece;

use super::{ExportError, ExportFile, Format, FormatOptions, Source};
use crate::component::{HingeId, PanelKind, PanelSet};
use crate::net::{Corner, EdgeKind, FaceKind, Net, Piece};
use crate::product::Product;
use crate::sheet::PiecePlace;
use glam::{DAffine3, DVec2, DVec3};
use serde::Serialize;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "fold",
    extensions: &["fold"],
    description: "FOLD 1.2: crease pattern, standing and flat model; each piece by --fold-pieces",
    source: Source::Model(files),
};

/// Version of the format.
const SPEC: f64 = 1.2;
const CREATOR: &str = concat!("tatamu ", env!("CARGO_PKG_VERSION"));
/// Distance between sheets in the crease pattern, mm.
const SHEET_GAP_MM: f64 = 20.0;

/// Choices for FOLD files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FoldOptions {
    /// Whether each piece is written to a file of its own, besides the master.
    pub pieces: bool,
}

/// The master of a model, with its sheets side by side, and the pieces.
fn files(product: &Product<'_>, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let output = product.output();
    let layout = output.layout();
    let components: Vec<FoldComponent> = output
        .model()
        .parts()
        .iter()
        .zip(output.nets())
        .enumerate()
        .map(|(n, (part, net))| FoldComponent {
            name: &part.name,
            set: part.component.panels(),
            net,
            pieces: layout.places(n),
            deployed: part.deployed(),
            flat: part.flat,
        })
        .collect();
    let step_mm = layout.options().paper.width_mm() + SHEET_GAP_MM;
    let sheet_offsets: Vec<DVec2> =
        (0..layout.sheet_count()).map(|k| DVec2::X * (step_mm * k as f64)).collect();
    let title = product.title();
    let model = FoldModel { title, components: &components, sheet_offsets: &sheet_offsets };
    let failed = |error| ExportError::writer(&FORMAT, error);
    let mut files = vec![ExportFile::single(write(&model).map_err(failed)?)];
    let pieces = components.iter().flat_map(|c| c.net.pieces().iter().map(move |piece| (c, piece)));
    for (component, piece) in pieces.filter(|_| options.fold.pieces) {
        let bytes = write_piece(title, component, piece).map_err(failed)?;
        files.push(ExportFile::named(piece.name(), bytes));
    }
    Ok(files)
}

/// One component with its net.
#[derive(Debug, Clone, Copy)]
pub struct FoldComponent<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its panels.
    pub set: &'a PanelSet,
    /// Its net, made from `set`.
    pub net: &'a Net,
    /// Places of the net's pieces, in the net's order.
    pub pieces: &'a [PiecePlace],
    /// Rigid motion from the component's axes to the model's in the deployed state.
    pub deployed: DAffine3,
    /// The same in the final state of folding.
    pub flat: DAffine3,
}

/// Everything that the master holds.
#[derive(Debug, Clone, Copy)]
pub struct FoldModel<'a> {
    /// Title of the file.
    pub title: &'a str,
    /// All components.
    pub components: &'a [FoldComponent<'a>],
    /// Where the origin of sheet k stands in the crease pattern: sheets must not overlap. Sheets
    /// beyond the list stand at the last one's place.
    pub sheet_offsets: &'a [DVec2],
}

/// Writes the master.
///
/// # Errors
/// Only what `serde_json` reports; no input is known that brings it about.
pub fn write(model: &FoldModel<'_>) -> Result<Vec<u8>, serde_json::Error> {
    let mut graph = Graph::default();
    for component in model.components {
        for (piece, place) in component.net.pieces().iter().zip(component.pieces) {
            graph.add_piece(model, component, piece, *place);
        }
    }
    let Graph { pattern, edges, faces, deployed, flat } = graph;
    let master = Master {
        file_spec: SPEC,
        file_creator: CREATOR,
        file_title: model.title,
        file_classes: ["singleModel"],
        frame_title: "crease pattern",
        frame_classes: ["creasePattern"],
        frame_attributes: ["2D"],
        frame_unit: "mm",
        vertices_coords: pattern,
        edges,
        faces,
        file_frames: vec![
            Frame::folded("deployed", deployed.coords, deployed.angles_deg),
            Frame::folded("flat", flat.coords, flat.angles_deg),
        ],
    };
    serde_json::to_vec(&master)
}

#[derive(Serialize)]
struct Master<'a> {
    file_spec: f64,
    file_creator: &'static str,
    file_title: &'a str,
    file_classes: [&'static str; 1],
    frame_title: &'static str,
    frame_classes: [&'static str; 1],
    frame_attributes: [&'static str; 1],
    frame_unit: &'static str,
    vertices_coords: Vec<[f64; 3]>,
    #[serde(flatten)]
    edges: Edges,
    #[serde(flatten)]
    faces: Faces,
    file_frames: Vec<Frame>,
}

#[derive(Default, Serialize)]
struct Edges {
    edges_vertices: Vec<[usize; 2]>,
    edges_faces: Vec<Vec<usize>>,
    edges_assignment: Vec<&'static str>,
    #[serde(rename = "edges_foldAngle")]
    fold_angle_deg: Vec<f64>,
    #[serde(rename = "edges_tatamu:kind")]
    kind: Vec<&'static str>,
    #[serde(rename = "edges_tatamu:label")]
    label: Vec<Option<String>>,
}

#[derive(Default, Serialize)]
struct Faces {
    faces_vertices: Vec<Vec<usize>>,
    #[serde(rename = "faces_tatamu:component")]
    component: Vec<String>,
    #[serde(rename = "faces_tatamu:kind")]
    kind: Vec<&'static str>,
    #[serde(rename = "faces_tatamu:chain")]
    chain: Vec<Option<usize>>,
    #[serde(rename = "faces_tatamu:panel")]
    panel: Vec<Option<usize>>,
    #[serde(rename = "faces_tatamu:sheet")]
    sheet: Vec<usize>,
}

#[derive(Serialize)]
struct Frame {
    frame_title: &'static str,
    frame_classes: [&'static str; 1],
    frame_attributes: [&'static str; 1],
    frame_unit: &'static str,
    frame_parent: usize,
    frame_inherit: bool,
    vertices_coords: Vec<[f64; 3]>,
    #[serde(rename = "edges_foldAngle")]
    fold_angle_deg: Vec<f64>,
}

impl Frame {
    fn folded(title: &'static str, coords: Vec<[f64; 3]>, angles_deg: Vec<f64>) -> Self {
        Self {
            frame_title: title,
            frame_classes: ["foldedForm"],
            frame_attributes: ["3D"],
            frame_unit: "mm",
            frame_parent: 0,
            frame_inherit: true,
            vertices_coords: coords,
            fold_angle_deg: angles_deg,
        }
    }
}

/// What a folded frame overrides.
#[derive(Default)]
struct State {
    coords: Vec<[f64; 3]>,
    angles_deg: Vec<f64>,
}

/// The master as it grows, piece by piece.
#[derive(Default)]
struct Graph {
    pattern: Vec<[f64; 3]>,
    edges: Edges,
    faces: Faces,
    deployed: State,
    flat: State,
}

impl Graph {
    fn add_piece(
        &mut self,
        model: &FoldModel<'_>,
        component: &FoldComponent<'_>,
        piece: &Piece,
        at: PiecePlace,
    ) {
        let (first_vertex, first_face) = (self.pattern.len(), self.faces.faces_vertices.len());
        let offsets = model.sheet_offsets;
        let offset = offsets.get(at.sheet).or(offsets.last()).copied().unwrap_or_default();
        for vertex in piece.mesh().vertices() {
            let flat = at.place.transform_point2(vertex.at) + offset;
            self.pattern.push([flat.x, flat.y, 0.0]);
            let (deployed, flat) = folded(component, piece, vertex.of);
            self.deployed.coords.push(deployed.into());
            self.flat.coords.push(flat.into());
        }
        for edge in piece.mesh().edges() {
            self.edges.edges_vertices.push(edge.ends.map(|v| first_vertex + v));
            self.edges.edges_faces.push(edge.faces.iter().map(|f| first_face + f).collect());
            self.add_edge_kind(component, edge.kind);
        }
        for face in piece.mesh().faces() {
            self.faces.faces_vertices.push(face.vertices.iter().map(|v| first_vertex + v).collect());
            self.add_face_kind(component, face.kind);
            self.faces.component.push(component.name.to_owned());
            self.faces.sheet.push(at.sheet);
        }
    }

    fn add_edge_kind(&mut self, component: &FoldComponent<'_>, kind: EdgeKind) {
        let hinge = |h: HingeId| component.set.hinges()[h.0];
        let label = |h: HingeId| component.net.label(h).map(str::to_owned);
        let (name, label, fold) = match kind {
            EdgeKind::Border => ("border", None, None),
            EdgeKind::Slit => ("slit", None, None),
            EdgeKind::Hinge(h) if hinge(h).is_fold => ("fold-hinge", None, Some(hinge(h))),
            EdgeKind::Hinge(h) => ("hinge", None, Some(hinge(h))),
            EdgeKind::Tab(h) => ("tab", label(h), Some(hinge(h))),
            EdgeKind::Mate(h) => ("mate", label(h), None),
        };
        let (deployed_rad, flat_rad) = fold.map_or((0.0, 0.0), |h| (h.deployed_rad, h.flat_rad));
        let assignment = match fold {
            None => "B",
            Some(_) if deployed_rad > 0.0 || flat_rad > 0.0 => "M",
            Some(_) => "F",
        };
        self.edges.kind.push(name);
        self.edges.label.push(label);
        self.edges.edges_assignment.push(assignment);
        self.edges.fold_angle_deg.push(mountain_deg(deployed_rad));
        self.deployed.angles_deg.push(mountain_deg(deployed_rad));
        self.flat.angles_deg.push(mountain_deg(flat_rad));
    }

    fn add_face_kind(&mut self, component: &FoldComponent<'_>, kind: FaceKind) {
        let panel_kind = match kind {
            FaceKind::Panel(id) => Some(component.set.panel(id).kind),
            FaceKind::Tab(_) => None,
        };
        let (name, chain, panel) = match panel_kind {
            Some(PanelKind::Top) => ("top", None, None),
            Some(PanelKind::Bottom) => ("bottom", None, None),
            Some(PanelKind::Side { chain, index }) => ("side", Some(chain), Some(index)),
            None => ("tab", None, None),
        };
        self.faces.kind.push(name);
        self.faces.chain.push(chain);
        self.faces.panel.push(panel);
    }
}

/// FOLD's sign: mountain folds are negative; a flat edge is plain 0.
fn mountain_deg(angle_rad: f64) -> f64 {
    if angle_rad == 0.0 { 0.0 } else { -angle_rad.to_degrees() }
}

/// A vertex in the deployed and in the flat state. A tab lies on the inside of its mate.
fn folded(component: &FoldComponent<'_>, piece: &Piece, of: Corner) -> (DVec3, DVec3) {
    let (panel, point) = match of {
        Corner::Panel { panel, corner } => (panel, component.set.panel(panel).outline[corner]),
        Corner::Tab { tab, corner } => {
            let tab = &piece.tabs()[tab];
            let mate = component.set.hinges()[tab.hinge.0].sides[1 - tab.side].panel;
            (mate, tab.on_mate[corner])
        }
    };
    let panel = component.set.panel(panel);
    let point = point.extend(0.0);
    (
        (component.deployed * panel.deployed).transform_point3(point),
        (component.flat * panel.flat).transform_point3(point),
    )
}
