//! FOLD 1.2: the multi-frame master, from crease pattern to flat model.
//!
//! Frame 0 holds the crease pattern, all pieces at their places on the sheets; `file_frames` hold
//! the deployed and the flat state of the same vertices, and as many poses between them as are
//! asked for: components fold in them one after another, and the bottom panels of roots stay where
//! they are when deployed. Coordinates are written with as many
//! digits as they have, so every face is congruent in all frames within rounding.

mod options;
mod pieces;

pub use options::{FoldOptions, PoseCount};

use pieces::write_piece;

use super::{ExportError, ExportFile, Format, FormatOptions, SHEET_GAP_MM, Source};
use crate::product::Product;
use glam::{DAffine3, DVec2, DVec3};
use serde::Serialize;
use tatamu_core::component::{HingeId, PanelId, PanelKind, PanelSet};
use tatamu_core::fold::{ModelMotion, PartPose, Sequence};
use tatamu_net::net::{Corner, EdgeKind, FaceKind, Net, Piece, PieceMesh};
use tatamu_net::sheet::PiecePlace;
use tatamu_pipeline::Output;

/// The registry's entry.
pub const FORMAT: Format = Format {
    name: "fold",
    extensions: &["fold"],
    description: "FOLD 1.2: crease pattern, unfolded and flat model; or each piece",
    source: Source::Model(files),
};

/// Version of the format.
const SPEC: f64 = 1.2;
const CREATOR: &str = concat!("tatamu ", env!("CARGO_PKG_VERSION"));
/// Shorter edges are points. A face may be stretched by twice this, which is far below what its readers allow
/// (1e-6 mm).
const SHORTEST_MM: f64 = 1e-7;

/// The panels of all components in evenly spread poses between deployed and flat.
fn poses_between(output: &Output, PoseCount(count): PoseCount) -> Vec<Vec<Vec<DAffine3>>> {
    let motion = ModelMotion::new(output.model());
    let sequence = Sequence::of_plan(output.fold_plan());
    let poses: Vec<_> =
        (1..=count).map(|k| motion.pose_at(&sequence.moment(k as f64 / (count + 1) as f64))).collect();
    let panels = |part: &PartPose| -> Vec<DAffine3> {
        part.pose.placements.iter().map(|placement| part.frame * *placement).collect()
    };
    let parts = 0..output.model().parts().len();
    parts.map(|p| poses.iter().map(|pose| panels(&pose.parts[p])).collect()).collect()
}

/// The master of a model, with its sheets side by side, and the pieces.
fn files(product: &Product<'_>, options: &FormatOptions) -> Result<Vec<ExportFile>, ExportError> {
    let output = product.output();
    let between = poses_between(output, options.fold.poses);
    let layout = output.layout();
    let components: Vec<FoldComponent> = output
        .model()
        .ids()
        .zip(output.model().parts())
        .zip(output.nets())
        .map(|((id, part), net)| FoldComponent {
            name: &part.name,
            set: net.panels(),
            net,
            pieces: layout.places(id),
            deployed: part.deployed(),
            between: &between[id.0],
            flat: part.flat,
        })
        .collect();
    let step_mm = layout.options().paper.width_mm() + SHEET_GAP_MM;
    let sheet_offsets: Vec<DVec2> =
        layout.sheet_ids().map(|sheet| DVec2::X * (step_mm * sheet.0 as f64)).collect();
    let title = product.title();
    let model = FoldModel { title, components: &components, sheet_offsets: &sheet_offsets };
    let failed = |error| ExportError::writer(&FORMAT, error);
    let mut files = vec![ExportFile::single(write(&model).map_err(failed)?)];
    if options.fold.pieces {
        let pieces = components.iter().flat_map(|c| c.net.pieces().iter().map(move |piece| (c, piece)));
        let bytes = |(component, piece): (&FoldComponent<'_>, &Piece)| write_piece(title, component, piece);
        let named = pieces.clone().map(bytes).collect::<Result<Vec<_>, _>>().map_err(failed)?;
        files.extend(ExportFile::named(pieces.map(|(_, piece)| piece.name()).zip(named)));
    }
    Ok(files)
}

/// One component with its net.
#[derive(Debug, Clone, Copy)]
pub struct FoldComponent<'a> {
    /// Its name.
    pub name: &'a str,
    /// The panels that the net was made of: [`Net::panels`].
    pub set: &'a PanelSet,
    /// Its net, made from `set`.
    pub net: &'a Net,
    /// Places of the net's pieces, in the net's order.
    pub pieces: &'a [PiecePlace],
    /// Rigid motion from the component's axes to the model's in the deployed state.
    pub deployed: DAffine3,
    /// Poses between deployed and flat: from the coordinates of each panel, by id, to the model's
    /// axes. All components have as many.
    pub between: &'a [Vec<DAffine3>],
    /// The same as `deployed` in the final state of folding.
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
    let between = model.components.iter().map(|c| c.between.len()).min().unwrap_or(0);
    let mut graph = Graph::with_poses(between);
    for component in model.components {
        for (piece, place) in component.net.pieces().iter().zip(component.pieces) {
            graph.add_piece(model, component, piece, *place);
        }
    }
    let Graph { pattern, edges, faces, states } = graph;
    let title = |k: usize| match k {
        0 => "deployed".to_owned(),
        k if k == between + 1 => "flat".to_owned(),
        k => format!("pose {k} of {between}"),
    };
    let frame = |(k, state): (usize, State)| FoldFrame::folded(title(k), state.coords, state.angles_deg);
    let master = Master {
        head: Head::of_pattern(model.title, "crease pattern"),
        vertices_coords: pattern,
        edges,
        faces,
        file_frames: states.into_iter().enumerate().map(frame).collect(),
    };
    serde_json::to_vec(&master)
}

/// What a file begins with: the crease pattern is its first frame.
#[derive(Serialize)]
struct Head<'a> {
    file_spec: f64,
    file_creator: &'static str,
    file_title: &'a str,
    file_classes: [&'static str; 1],
    frame_title: &'a str,
    frame_classes: [&'static str; 1],
    frame_attributes: [&'static str; 1],
    frame_unit: &'static str,
}

impl<'a> Head<'a> {
    fn of_pattern(file_title: &'a str, frame_title: &'a str) -> Self {
        Self {
            file_spec: SPEC,
            file_creator: CREATOR,
            file_title,
            file_classes: ["singleModel"],
            frame_title,
            frame_classes: ["creasePattern"],
            frame_attributes: ["2D"],
            frame_unit: "mm",
        }
    }
}

#[derive(Serialize)]
struct Master<'a> {
    #[serde(flatten)]
    head: Head<'a>,
    vertices_coords: Vec<[f64; 3]>,
    #[serde(flatten)]
    edges: Edges,
    #[serde(flatten)]
    faces: Faces,
    file_frames: Vec<FoldFrame>,
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
    /// Paper has no such key.
    #[serde(rename = "edges_tatamu:lift_mm", skip_serializing_if = "is_level")]
    lift_mm: Vec<f64>,
}

/// Whether all hinges have their axes in the planes of the panels.
fn is_level(lifts_mm: &[f64]) -> bool {
    lifts_mm.iter().all(|lift| *lift == 0.0)
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
struct FoldFrame {
    frame_title: String,
    frame_classes: [&'static str; 1],
    frame_attributes: [&'static str; 1],
    frame_unit: &'static str,
    frame_parent: usize,
    frame_inherit: bool,
    vertices_coords: Vec<[f64; 3]>,
    #[serde(rename = "edges_foldAngle")]
    fold_angle_deg: Vec<f64>,
}

impl FoldFrame {
    fn folded(title: String, coords: Vec<[f64; 3]>, angles_deg: Vec<f64>) -> Self {
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
    /// Deployed, the poses between, flat.
    states: Vec<State>,
}

impl Graph {
    /// An empty master with `between` poses between unfolded and flat.
    fn with_poses(between: usize) -> Self {
        let mut graph = Self::default();
        graph.states.resize_with(between + 2, State::default);
        graph
    }

    fn add_piece(
        &mut self,
        model: &FoldModel<'_>,
        component: &FoldComponent<'_>,
        piece: &Piece,
        at: PiecePlace,
    ) {
        let first_face = self.faces.faces_vertices.len();
        let offsets = model.sheet_offsets;
        let offset = offsets.get(at.sheet.0).or(offsets.last()).copied().unwrap_or_default();
        let kept = without_short_edges(piece.mesh());
        let mut number = vec![0; kept.len()];
        for (v, vertex) in piece.mesh().vertices().iter().enumerate() {
            if kept[v] != v {
                number[v] = number[kept[v]];
                continue;
            }
            number[v] = self.pattern.len();
            let flat = at.place.transform_point2(vertex.at) + offset;
            self.pattern.push([flat.x, flat.y, 0.0]);
            let last = self.states.len() - 1;
            for (k, state) in self.states.iter_mut().enumerate() {
                state.coords.push(folded(component, piece, vertex.of, k, last).into());
            }
        }
        for edge in piece.mesh().edges().iter().filter(|edge| kept[edge.ends[0]] != kept[edge.ends[1]]) {
            self.edges.edges_vertices.push(edge.ends.map(|v| number[v]));
            self.edges.edges_faces.push(edge.faces.iter().map(|f| first_face + f).collect());
            self.add_edge_kind(component, edge.kind);
        }
        for face in piece.mesh().faces() {
            let mut corners: Vec<usize> = face.vertices.iter().map(|&v| number[v]).collect();
            corners.dedup();
            if corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            self.faces.faces_vertices.push(corners);
            self.add_face_kind(component, face.kind);
            self.faces.component.push(component.name.to_owned());
            self.faces.sheet.push(at.sheet.0);
        }
    }

    fn add_edge_kind(&mut self, component: &FoldComponent<'_>, kind: EdgeKind) {
        let hinge = |h: HingeId| component.set.hinges()[h.0];
        let label = |h: HingeId| component.net.label(h).map(str::to_owned);
        self.edges.lift_mm.push(match kind {
            EdgeKind::Hinge(h) | EdgeKind::Tab(h) | EdgeKind::Mate(h) => hinge(h).lift_mm,
            EdgeKind::Border | EdgeKind::Slit => 0.0,
        });
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
            Some(hinge) if hinge.is_valley() => "V",
            Some(_) if deployed_rad > 0.0 || flat_rad > 0.0 => "M",
            Some(_) => "F",
        };
        self.edges.kind.push(name);
        self.edges.label.push(label);
        self.edges.edges_assignment.push(assignment);
        self.edges.fold_angle_deg.push(mountain_deg(deployed_rad));
        let last = self.states.len() - 1;
        for (k, state) in self.states.iter_mut().enumerate() {
            let angle_rad = match (k, fold) {
                (0, _) => deployed_rad,
                (k, _) if k == last => flat_rad,
                (k, Some(hinge)) => {
                    let placements = hinge.sides.map(|s| placed(component, s.panel, k, last));
                    hinge.angle_rad(component.set.panel(hinge.sides[0].panel), placements)
                }
                (_, None) => 0.0,
            };
            state.angles_deg.push(mountain_deg(angle_rad));
        }
    }

    fn add_face_kind(&mut self, component: &FoldComponent<'_>, kind: FaceKind) {
        let panel_kind = match kind {
            FaceKind::Panel(id) => Some(component.set.panel(id).kind),
            FaceKind::Tab(_) => None,
        };
        let (name, chain, panel) = match panel_kind {
            Some(PanelKind::Top) => ("top", None, None),
            Some(PanelKind::Bottom) => ("bottom", None, None),
            Some(PanelKind::Side { chain, index }) => ("side", Some(chain.0), Some(index)),
            None => ("tab", None, None),
        };
        self.faces.kind.push(name);
        self.faces.chain.push(chain);
        self.faces.panel.push(panel);
    }
}

/// For each vertex the first one that edges without length lead to: panels may have corners at the
/// same place, and readers sort edges by their directions.
fn without_short_edges(mesh: &PieceMesh) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..mesh.vertices().len()).collect();
    for edge in mesh.edges() {
        let [a, b] = mesh.segment(edge);
        if a.distance(b) < SHORTEST_MM {
            let ends = edge.ends.map(|v| kept[v]);
            let (first, last) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            kept.iter_mut().filter(|k| **k == last).for_each(|k| *k = first);
        }
    }
    kept
}

/// FOLD's sign: mountain folds are negative; a flat edge is plain 0.
fn mountain_deg(angle_rad: f64) -> f64 {
    if angle_rad == 0.0 { 0.0 } else { -angle_rad.to_degrees() }
}

/// A panel in a state: 0 is deployed, `last` is flat.
fn placed(component: &FoldComponent<'_>, panel: PanelId, state: usize, last: usize) -> DAffine3 {
    match state {
        0 => component.deployed * component.set.panel(panel).deployed,
        k if k == last => component.flat * component.set.panel(panel).flat,
        // A part of a split panel moves with it.
        k => component.between[k - 1][component.net.source(panel).0],
    }
}

/// A vertex in a state. A tab lies on the inside of its mate.
fn folded(component: &FoldComponent<'_>, piece: &Piece, of: Corner, state: usize, last: usize) -> DVec3 {
    let (panel, point) = match of {
        Corner::Panel { panel, corner } => (panel, component.set.panel(panel).outline[corner]),
        Corner::Tab { tab, corner } => {
            let tab = &piece.tabs()[tab];
            let mate = component.set.hinges()[tab.hinge.0].sides[1 - tab.side].panel;
            (mate, tab.on_mate[corner])
        }
    };
    placed(component, panel, state, last).transform_point3(point.extend(0.0))
}
