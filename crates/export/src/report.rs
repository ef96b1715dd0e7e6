//! The report: what was made, in numbers, as JSON.

use crate::json;
use glam::DAffine2;
use serde::Serialize;
use tatamu_core::component::PanelId;
use tatamu_core::fold::{Clash, Overlap, Pull, Stack, Step};
use tatamu_core::geom::polygon;
use tatamu_core::mesh::{MirrorPlane, Repairs};
use tatamu_core::model::{ModelPart, PartId, Plug};
use tatamu_net::net::{Net, Piece};
use tatamu_net::sheet::SheetId;
use tatamu_pipeline::{Output, Warning, openings_mm2};

/// Version of the report's structure.
const SCHEMA: u32 = 1;

/// What the caller knows and the pipeline does not.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// Path of the mesh, as the user gave it.
    pub path: &'a str,
    /// What was mended in it.
    pub repairs: &'a Repairs,
    /// Name and duration of each stage, seconds.
    pub stages: &'a [(&'static str, f64)],
    /// Warnings about the input.
    pub warnings: &'a [Warning],
    /// The sentence for a warning.
    pub say: fn(&Warning) -> String,
}

#[derive(Serialize)]
struct Report<'a> {
    schema: u32,
    input: Input<'a>,
    stages: Vec<Stage>,
    components: Vec<Component<'a>>,
    fold: Fold<'a>,
    nets: Vec<NetNumbers<'a>>,
    sheets: Sheets<'a>,
    warnings: Vec<WarningText>,
}

#[derive(Serialize)]
struct Input<'a> {
    path: &'a str,
    faces: usize,
    vertices: usize,
    diagonal_mm: f64,
    symmetry: Option<SymmetryNumbers>,
    repairs: RepairNumbers,
}

/// The mirror plane of the model.
#[derive(Serialize)]
struct SymmetryNumbers {
    normal: [f64; 3],
    offset_mm: f64,
    error_percent: f64,
}

#[derive(Serialize)]
struct RepairNumbers {
    input_faces: usize,
    welded_vertices: usize,
    loose_bodies: usize,
    degenerate_faces: usize,
    duplicate_faces: usize,
    flipped_faces: usize,
    components: usize,
    boundary_edges: usize,
    non_manifold_edges: usize,
}

#[derive(Serialize)]
struct Stage {
    name: &'static str,
    seconds: f64,
}

#[derive(Serialize)]
struct Component<'a> {
    name: &'a str,
    faces: usize,
    fold_axis: [f64; 3],
    direction_deg: f64,
    top_edges: usize,
    profiles: Vec<Profile>,
    hausdorff_mm: f64,
    hausdorff_ratio: f64,
    min_panel_width_mm: f64,
    openings_mm2: Vec<f64>,
    parent: Option<&'a str>,
    joint: Option<Joint>,
    placement: [f64; 16],
}

#[derive(Serialize)]
struct Profile {
    vertices: usize,
    fold_vertices: Vec<usize>,
    gap_mm: f64,
    mean_segment_mm: f64,
}

#[derive(Serialize)]
struct Joint {
    parent_panel: String,
    child_panel: String,
    support_ratio: f64,
    glue_mm2: f64,
    plug: Option<PlugNumbers>,
}

/// A tab and its slits.
#[derive(Serialize)]
struct PlugNumbers {
    slit_mm: f64,
    cross_mm: f64,
    foot_mm: f64,
    head_mm: f64,
    length_mm: f64,
}

/// How the model folds.
#[derive(Serialize)]
struct Fold<'a> {
    thickness_mm: f64,
    order: Vec<&'a str>,
    unplugged: Vec<Unplugged<'a>>,
    steps: Vec<FoldStep<'a>>,
    clashes: Vec<FoldClash<'a>>,
    deployed_overlaps: Vec<DeployedOverlap<'a>>,
    flat: Vec<Flat<'a>>,
}

#[derive(Serialize)]
struct Unplugged<'a> {
    component: &'a str,
    way_mm: f64,
}

#[derive(Serialize)]
struct FoldStep<'a> {
    component: &'a str,
    from: f64,
    to: f64,
}

#[derive(Serialize)]
struct FoldClash<'a> {
    components: [&'a str; 2],
    panels: [String; 2],
    folding: &'a str,
    folded: f64,
    depth_mm: f64,
}

#[derive(Serialize)]
struct DeployedOverlap<'a> {
    components: [&'a str; 2],
    depth_mm: f64,
}

#[derive(Serialize)]
struct Flat<'a> {
    root: &'a str,
    size_mm: [f64; 2],
    layers: usize,
    stack_mm: f64,
}

#[derive(Serialize)]
struct NetNumbers<'a> {
    component: &'a str,
    pieces: usize,
    panels: usize,
    tabs: usize,
    cut_mm: f64,
    crease_mm: f64,
}

#[derive(Serialize)]
struct Sheets<'a> {
    count: usize,
    paper: String,
    utilisation: f64,
    pages: Vec<Page<'a>>,
}

/// What is cut and folded on one sheet.
#[derive(Serialize)]
struct Page<'a> {
    /// Colour of its card, where one is chosen.
    card: Option<&'a str>,
    cut_mm: f64,
    crease_mm: f64,
    /// Least x and y, largest x and y of all outlines, from the sheet's lower left corner.
    bounds_mm: [f64; 4],
}

#[derive(Serialize)]
struct WarningText {
    code: &'static str,
    message: String,
}

/// The report of a run.
///
/// # Errors
/// Only what `serde_json` reports; no run is known that brings it about.
pub fn to_json(output: &Output, run: &Run<'_>) -> Result<Vec<u8>, serde_json::Error> {
    let diagonal_mm = output.mesh().diagonal_mm();
    let parts = output.model().parts();
    let report = Report {
        schema: SCHEMA,
        input: Input {
            path: run.path,
            faces: output.mesh().faces().len(),
            vertices: output.mesh().positions().len(),
            diagonal_mm,
            symmetry: output.mirror_plane().map(symmetry),
            repairs: repairs(run.repairs),
        },
        stages: run.stages.iter().map(|&(name, seconds)| Stage { name, seconds }).collect(),
        components: output.model().ids().map(|p| component(output, p, diagonal_mm)).collect(),
        fold: fold(output),
        nets: parts.iter().zip(output.nets()).map(|(part, net)| numbers(&part.name, net)).collect(),
        sheets: Sheets {
            count: output.layout().sheet_count(),
            paper: output.options().paper.name(),
            utilisation: output.layout().utilisation(),
            pages: output.layout().sheet_ids().map(|sheet| page(output, sheet)).collect(),
        },
        warnings: run
            .warnings
            .iter()
            .chain(output.warnings())
            .map(|w| WarningText { code: w.code(), message: (run.say)(w) })
            .collect(),
    };
    json::pretty(&report)
}

fn symmetry(found: &MirrorPlane) -> SymmetryNumbers {
    let plane = found.mirror.plane();
    let (normal, offset_mm) = (plane.normal().to_array(), plane.offset());
    SymmetryNumbers { normal, offset_mm, error_percent: found.error_percent }
}

fn repairs(repairs: &Repairs) -> RepairNumbers {
    RepairNumbers {
        input_faces: repairs.input_faces,
        welded_vertices: repairs.welded_vertices,
        loose_bodies: repairs.loose_bodies,
        degenerate_faces: repairs.degenerate_faces,
        duplicate_faces: repairs.duplicate_faces,
        flipped_faces: repairs.flipped_faces,
        components: repairs.components,
        boundary_edges: repairs.boundary_edges,
        non_manifold_edges: repairs.non_manifold_edges,
    }
}

fn fold(output: &Output) -> Fold<'_> {
    let (model, plan) = (output.model(), output.fold_plan());
    let name = |part: PartId| model.part(part).name.as_str();
    let panel =
        |part: PartId, panel: PanelId| model.part(part).component.panels().panel(panel).kind.to_string();
    let step = |step: &Step| FoldStep { component: name(step.part), from: step.from, to: step.to };
    let unplugged = |pull: &Pull| Unplugged { component: name(pull.part), way_mm: pull.way_mm };
    let clash = |clash: &Clash| FoldClash {
        components: clash.parts.map(name),
        panels: [0, 1].map(|k| panel(clash.parts[k], clash.panels[k])),
        folding: name(clash.mover),
        folded: clash.folded,
        depth_mm: clash.depth_mm,
    };
    let overlap = |overlap: &Overlap| DeployedOverlap {
        components: overlap.parts.map(name),
        depth_mm: overlap.depth_mm,
    };
    let flat = |stack: &Stack| Flat {
        root: name(stack.root),
        size_mm: stack.size_mm.to_array(),
        layers: stack.layers,
        stack_mm: stack.height_mm,
    };
    Fold {
        thickness_mm: plan.thickness_mm(),
        order: plan.order().iter().map(|&p| name(p)).collect(),
        unplugged: plan.pulls().iter().map(unplugged).collect(),
        steps: plan.steps().iter().map(step).collect(),
        clashes: plan.clashes().iter().map(clash).collect(),
        deployed_overlaps: plan.overlaps().iter().map(overlap).collect(),
        flat: plan.stacks().iter().map(flat).collect(),
    }
}

fn component(output: &Output, p: PartId, diagonal_mm: f64) -> Component<'_> {
    let model = output.model();
    let part = model.part(p);
    let shape = &part.component;
    let panel_name = |part: &ModelPart, panel: PanelId| part.component.panels().panel(panel).kind.to_string();
    let joint = part.joint.as_ref();
    Component {
        name: &part.name,
        faces: output.part_faces()[p.0],
        fold_axis: part.fold_axis().to_array(),
        direction_deg: part.direction_rad.to_degrees(),
        top_edges: shape.profiles().len(),
        profiles: shape
            .profiles()
            .iter()
            .map(|profile| Profile {
                vertices: profile.points().len(),
                fold_vertices: profile.fold_vertices().collect(),
                gap_mm: profile.gap_mm().abs(),
                mean_segment_mm: profile.mean_segment_mm(),
            })
            .collect(),
        hausdorff_mm: shape.hausdorff_mm(),
        hausdorff_ratio: shape.hausdorff_mm() / diagonal_mm,
        min_panel_width_mm: shape.narrowest_panel().1,
        openings_mm2: openings_mm2(shape.panels()),
        parent: joint.map(|j| model.part(j.parent).name.as_str()),
        joint: joint.map(|j| Joint {
            parent_panel: panel_name(model.part(j.parent), j.parent_panel),
            child_panel: panel_name(part, j.child_panel),
            support_ratio: j.support_ratio,
            glue_mm2: j.glue_mm2,
            plug: j.plug().map(plug),
        }),
        placement: glam::DMat4::from(part.placement).to_cols_array(),
    }
}

fn plug(plug: &Plug) -> PlugNumbers {
    PlugNumbers {
        slit_mm: plug.slit_mm(),
        cross_mm: plug.cross_mm(),
        foot_mm: plug.foot_mm(),
        head_mm: plug.head_mm(),
        length_mm: plug.length_mm(),
    }
}

fn page(output: &Output, sheet: SheetId) -> Page<'_> {
    let layout = output.layout();
    let nets = output.model().ids().zip(output.nets());
    let pieces: Vec<(&Piece, DAffine2)> = nets
        .flat_map(|(part, net)| net.pieces().iter().zip(layout.places(part)))
        .filter(|(_, at)| at.sheet == sheet)
        .map(|(piece, at)| (piece, at.place))
        .collect();
    let corners = pieces
        .iter()
        .flat_map(|(piece, place)| piece.outline().iter().map(|&corner| place.transform_point2(corner)));
    let (low, high) = polygon::bounds(corners).unwrap_or_default();
    Page {
        card: layout.card(sheet),
        cut_mm: pieces.iter().map(|(piece, _)| piece.cut_mm()).sum(),
        crease_mm: pieces.iter().map(|(piece, _)| piece.crease_mm()).sum(),
        bounds_mm: [low.x, low.y, high.x, high.y],
    }
}

fn numbers<'a>(name: &'a str, net: &Net) -> NetNumbers<'a> {
    NetNumbers {
        component: name,
        pieces: net.pieces().len(),
        panels: net.pieces().iter().map(|p| p.panels().len()).sum(),
        tabs: net.pieces().iter().map(|p| p.tabs().len()).sum(),
        cut_mm: net.pieces().iter().map(|p| p.cut_mm()).sum(),
        crease_mm: net.pieces().iter().map(|p| p.crease_mm()).sum(),
    }
}
