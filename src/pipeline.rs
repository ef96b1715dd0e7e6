//! The way from a mesh to sheets, stage by stage. Reading [`run`] is reading the program.

mod bodies;
mod concave;
mod drawn;
mod finish;

pub use bodies::Bodies;
pub use drawn::run_drawn;

use crate::design::{DesignError, ThickError};
use crate::fold::FoldPlan;
use crate::mesh::{Mesh, Up};
use crate::model::{self, Model, ModelError};
use crate::net::{Net, NetChoices, NetsError};
use crate::progress::{Cancelled, Progress};
use crate::segment::{self, Edit, EditError, Parts, SegmentError, SegmentOptions};
use crate::sheet::{Layout, LayoutError, SheetChoices};
use crate::units::Paper;
use finish::{Made, finish};
use glam::DAffine3;
use std::collections::BTreeMap;

/// What the user chose.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Longest side of the model's bounding box, mm.
    pub size_mm: f64,
    /// The axis of the mesh that points up.
    pub up: Up,
    /// How the mesh is divided.
    pub segmentation: SegmentOptions,
    /// Changes to the parts by hand, in the coordinates of the mesh as it was read.
    pub edits: Vec<Edit>,
    /// The part that all others hang on; without it the biggest.
    pub root: Option<String>,
    /// What differs for components of these names.
    pub components: BTreeMap<String, ComponentOptions>,
    /// Edges of top panels, at least 3.
    pub top_edges: usize,
    /// Vertices of profiles, at least 3.
    pub profile_vertices: usize,
    /// Distance between component and hull that is close enough, mm: then as few edges and
    /// vertices are used as reach it, and the two numbers above are the most.
    pub tolerance_mm: Option<f64>,
    /// Least width and height of panels, mm.
    pub min_panel_width_mm: f64,
    /// Width of glue tabs, mm.
    pub tab_width_mm: f64,
    /// Size of the sheets.
    pub paper: Paper,
    /// Border of the sheets that stays free, mm.
    pub margin_mm: f64,
    /// Thickness of the paper, mm.
    pub thickness_mm: f64,
    /// Whether panels are boards of that thickness, each cut by itself.
    pub is_thick: bool,
    /// What else is chosen about nets.
    pub nets: NetChoices,
    /// What else is chosen about sheets.
    pub sheets: SheetChoices,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size_mm: 200.0,
            up: Up::Y,
            segmentation: SegmentOptions::default(),
            edits: Vec::new(),
            root: None,
            components: BTreeMap::new(),
            top_edges: 6,
            profile_vertices: 6,
            tolerance_mm: None,
            min_panel_width_mm: 3.0,
            tab_width_mm: 6.0,
            paper: Paper::default(),
            margin_mm: 10.0,
            thickness_mm: 0.25,
            is_thick: false,
            nets: NetChoices::default(),
            sheets: SheetChoices::default(),
        }
    }
}

/// What the user chose for one component.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ComponentOptions {
    /// Another name.
    pub rename: Option<String>,
    /// Angle of the fold axis about the hull's first principal axis, radians.
    pub direction_rad: Option<f64>,
    /// Edges of the top panel.
    pub top_edges: Option<usize>,
    /// Vertices of profiles.
    pub profile_vertices: Option<usize>,
    /// Whether it may have dents, where that brings it nearer to its shape.
    pub is_concave: bool,
}

/// Why there is no model.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The user stopped the work.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Segmentation failed.
    #[error("the mesh could not be divided into parts: {0}")]
    Segment(#[from] SegmentError),
    /// A change to the parts cannot be made.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// No part has a volume.
    #[error("no part of the mesh has a volume; it is flat, so there is nothing to fold")]
    NothingSolid,
    /// A component failed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Thick panels have no room.
    #[error(transparent)]
    Thick(#[from] ThickError),
    /// Drawings make no model.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A net failed.
    #[error("{}", too_large(.error, *.size_mm))]
    Net {
        /// What went wrong.
        error: NetsError,
        /// The size that was asked for.
        size_mm: f64,
    },
    /// The layout failed.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// Two components were given the same name.
    #[error("two components are named \"{0}\"; give each a name of its own")]
    SameName(String),
    /// Options for a component that does not exist.
    #[error("there is no component \"{name}\"; there are: {known}")]
    NoComponent {
        /// The name that was given.
        name: String,
        /// The names of all components.
        known: String,
    },
}

/// A model scaled to fit exactly would miss by a little: least panel sizes do not shrink with it.
const FITS: f64 = 0.985;

/// The message of a failed net, with the largest size that fits where that is the matter.
fn too_large(error: &NetsError, size_mm: f64) -> String {
    match error {
        NetsError::Net(crate::net::NetError::PanelTooLarge {
            name, size_mm: panel, sheet_mm, scale, ..
        }) => {
            let fits = (size_mm * scale * FITS).floor();
            format!(
                "a panel of \"{name}\" measures {:.0} × {:.0} mm and does not fit the {:.0} × {:.0} mm within the \
                 sheet's margins; use --size {fits}mm at most, or larger --paper, or do without --no-split",
                panel.x, panel.y, sheet_mm.x, sheet_mm.y
            )
        }
        _ => error.to_string(),
    }
}

/// Something that the user should know about a model that was made all the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Short constant name, for programs.
    pub code: &'static str,
    /// A sentence.
    pub message: String,
}

/// The result of all stages.
#[derive(Debug, Clone)]
pub struct Output {
    options: Options,
    mesh: Mesh,
    to_model: DAffine3,
    face_part: Vec<Option<u32>>,
    part_faces: Vec<usize>,
    model: Model,
    fold_plan: FoldPlan,
    nets: Vec<Net>,
    layout: Layout,
    warnings: Vec<Warning>,
}

impl Output {
    /// What the run was asked for.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The mesh at the size of the model.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// From the file's coordinates to those of [`Output::mesh`].
    pub fn to_model(&self) -> &DAffine3 {
        &self.to_model
    }

    /// The component of each face of [`Output::mesh`]; none where its segment became none.
    pub fn face_parts(&self) -> &[Option<u32>] {
        &self.face_part
    }

    /// Number of faces of each component's segment.
    pub fn part_faces(&self) -> &[usize] {
        &self.part_faces
    }

    /// The components in their places.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// How the model folds.
    pub fn fold_plan(&self) -> &FoldPlan {
        &self.fold_plan
    }

    /// Their nets, in the same order.
    pub fn nets(&self) -> &[Net] {
        &self.nets
    }

    /// The pieces on their sheets.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// What the user should know.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }
}

/// Runs all stages on a mesh as it was read.
///
/// # Errors
/// See [`Error`].
pub fn run(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Output, Error> {
    let (divided, to_model) = find_parts(mesh, options, progress)?;
    let (mesh, segmentation) = (divided.mesh(), divided.segmentation());

    progress.stage("hulls");
    let bodies = Bodies::new(&divided, options)?;
    progress.check()?;

    progress.stage("components");
    let model = model::build(bodies.parts(), bodies.links(), options.min_panel_width_mm, progress)?;

    let face_part: Vec<Option<u32>> = segmentation
        .face_segments()
        .iter()
        .map(|&segment| bodies.part_of(segment).map(|p| p as u32))
        .collect();
    let (model, notes) = concave::refitted(model, mesh, &face_part, options, progress)?;
    let made = Made { model, mesh: mesh.clone(), to_model, face_part };
    let told = |model: &Model, nets: &[Net]| {
        [notes.clone(), warnings(model, nets, bodies.flat_faces(), options)].concat()
    };
    finish(made, told, options, progress)
}

/// Divides a mesh at the model's size into parts; also gives the transform from the coordinates of
/// the mesh as it was read.
///
/// # Errors
/// [`Error::Segment`], [`Error::Edit`], [`Error::Cancelled`].
pub fn find_parts(
    mesh: &Mesh,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(Parts, DAffine3), Error> {
    let (mesh, to_model) = mesh.scaled(options.size_mm, options.up);
    let segmentation = segment::segment(&mesh, &options.segmentation, progress)?;
    let mut parts = Parts::new(mesh, segmentation);
    for edit in &options.edits {
        parts = parts.edited(&edit.moved(&to_model))?;
    }
    if let Some(root) = &options.root {
        parts = parts.with_root(root)?;
    }
    Ok((parts, to_model))
}

/// Joint panels that carry less than this of their child are worth a warning.
const GOOD_SUPPORT: f64 = 0.8;

fn warnings(model: &Model, nets: &[Net], flat: &[usize], options: &Options) -> Vec<Warning> {
    let min_panel_mm = options.min_panel_width_mm;
    let mut out = Vec::new();
    let mut warn = |code, message| out.push(Warning { code, message });
    if !flat.is_empty() {
        let faces: usize = flat.iter().sum();
        warn(
            "flat_segment",
            format!("{} flat parts of {faces} faces in all have no volume and were left out", flat.len()),
        );
    }
    let roots: Vec<&str> =
        model.parts().iter().filter(|p| p.joint.is_none()).map(|p| p.name.as_str()).collect();
    if roots.len() > 1 {
        warn(
            "not_joined",
            format!(
                "the model is in {} groups that are not joined to one another, because they do not touch or no \
                 joint has room; they begin with {}",
                roots.len(),
                roots.join(", ")
            ),
        );
    }
    for part in model.parts() {
        let sizes = [
            ("narrow", "wide", part.component.narrowest_panel()),
            ("low", "high", part.component.lowest_panel()),
        ];
        for (_, word, (panel, mm)) in sizes.iter().filter(|s| s.2.1 < min_panel_mm - 1e-6) {
            let what = part.component.panels().panel(*panel).kind;
            warn(
                "narrow_panel",
                format!(
                    "{}: {what} is only {mm:.2} mm {word}, less than {min_panel_mm} mm; use fewer top edges or \
                     profile vertices for it, or a larger --size",
                    part.name
                ),
            );
        }
        let error_mm = part.component.hausdorff_mm();
        if let Some(tolerance_mm) = options.tolerance_mm.filter(|t| error_mm > *t) {
            warn(
                "tolerance_missed",
                format!(
                    "{}: it comes within {error_mm:.1} mm of its shape, not within {tolerance_mm} mm; allow more top \
                     edges or profile vertices, or narrower panels",
                    part.name
                ),
            );
        }
        if let Some(joint) = part.joint.as_ref().filter(|j| j.support_ratio < GOOD_SUPPORT) {
            let parent = &model.parts()[joint.parent].name;
            warn(
                "weak_joint",
                format!(
                    "{}: only {:.0}% of its joint panel lies on {parent}; try another direction for either of them, \
                     or more top edges for {parent}",
                    part.name,
                    joint.support_ratio * 100.0
                ),
            );
        }
    }
    // Board is taped at all hinges.
    for net in nets.iter().filter(|_| !options.is_thick) {
        out.extend(net.warnings().iter().map(|w| Warning { code: w.code(), message: w.to_string() }));
    }
    out
}
