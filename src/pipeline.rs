//! The way from a mesh to sheets, stage by stage. Reading [`run`] is reading the program.

use crate::fold::{FoldPlan, ModelMotion};
use crate::geom::Hull;
use crate::mesh::{Mesh, Up};
use crate::model::{self, Contact, Link, Model, ModelError, Part, PartOptions};
use crate::net::{Net, NetChoices, NetOptions, NetsError, develop_model};
use crate::progress::{Cancelled, Progress};
use crate::segment::{self, Edit, EditError, Parts, SegmentError, SegmentId, SegmentOptions, Segmentation};
use crate::sheet::{Layout, LayoutError, SheetChoices, SheetOptions};
use crate::units::Paper;
use glam::{DAffine3, DVec3};
use std::collections::{BTreeMap, BTreeSet};

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
    let Bodies { parts, links, part_of_segment, flat } = Bodies::new(&divided, options)?;
    progress.check()?;

    progress.stage("components");
    let model = model::build(&parts, &links, options.min_panel_width_mm, progress)?;

    progress.stage("folding");
    let fold_plan = FoldPlan::new(&ModelMotion::new(&model), options.thickness_mm, progress)?;

    progress.stage("nets");
    let sheets = SheetOptions { paper: options.paper, margin_mm: options.margin_mm, choices: options.sheets };
    let net_options =
        NetOptions { tab_width_mm: options.tab_width_mm, sheet_mm: sheets.room_mm(), choices: options.nets };
    let nets = develop_model(&model, &net_options, progress)
        .map_err(|error| Error::Net { error, size_mm: options.size_mm })?;

    progress.stage("sheets");
    let layout = Layout::new(&nets, &sheets, progress)?;

    let face_part: Vec<Option<u32>> = segmentation
        .face_segments()
        .iter()
        .map(|s| part_of_segment[s.0 as usize].map(|p| p as u32))
        .collect();
    let mut part_faces = vec![0; parts.len()];
    face_part.iter().flatten().for_each(|&p| part_faces[p as usize] += 1);
    let mut warnings = warnings(&model, &nets, &flat, options);
    let advice = fold_plan.advice(&model).into_iter();
    warnings.extend(advice.map(|(code, message)| Warning { code, message }));
    Ok(Output {
        options: options.clone(),
        mesh: mesh.clone(),
        to_model,
        face_part,
        part_faces,
        model,
        fold_plan,
        nets,
        layout,
        warnings,
    })
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

/// Hulls of the parts of a mesh, with the joints between them: what the components are made from.
#[derive(Debug, Clone)]
pub struct Bodies {
    parts: Vec<Part>,
    links: Vec<Link>,
    part_of_segment: Vec<Option<usize>>,
    /// Number of faces of each segment that is flat.
    flat: Vec<usize>,
}

impl Bodies {
    /// The hulls of `divided`, with what `options` says of each.
    ///
    /// # Errors
    /// [`Error::NothingSolid`], [`Error::NoComponent`], [`Error::SameName`].
    pub fn new(divided: &Parts, options: &Options) -> Result<Self, Error> {
        let solid = hulls(divided);
        let names = solid.names(divided.names());
        let parts = parts(solid.hulls, &names, options)?;
        let contacts = contacts(divided.mesh(), divided.segmentation(), &solid.part_of_segment);
        let hulls: Vec<&Hull> = parts.iter().map(|p| &p.hull).collect();
        let links = model::link_tree(&hulls, &contacts);
        Ok(Self { parts, links, part_of_segment: solid.part_of_segment, flat: solid.flat })
    }

    /// The parts; a component is made of each.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The tree of joints between them.
    pub fn links(&self) -> &[Link] {
        &self.links
    }
}

/// Hulls of the segments that have one.
#[derive(Debug, Clone)]
struct Solid {
    hulls: Vec<Hull>,
    part_of_segment: Vec<Option<usize>>,
    /// Number of faces of each segment that is flat.
    flat: Vec<usize>,
}

impl Solid {
    /// The names of the segments that have a hull.
    fn names(&self, of_segment: &[String]) -> Vec<String> {
        let has_hull = self.part_of_segment.iter().zip(of_segment);
        has_hull.filter(|(part, _)| part.is_some()).map(|(_, name)| name.clone()).collect()
    }
}

fn hulls(parts: &Parts) -> Solid {
    let mut solid = Solid { hulls: Vec::new(), part_of_segment: Vec::new(), flat: Vec::new() };
    for (hull, faces) in parts.hulls().into_iter().zip(parts.face_counts()) {
        match hull {
            Ok(hull) => {
                solid.part_of_segment.push(Some(solid.hulls.len()));
                solid.hulls.push(hull);
            }
            Err(_) => {
                solid.part_of_segment.push(None);
                solid.flat.push(faces);
            }
        }
    }
    solid
}

/// Panels are comfortable from this many times the least width; a component whose numbers the user
/// has set gets them down to the least width.
const COMFORTABLE: f64 = 1.5;

fn parts(hulls: Vec<Hull>, names: &[String], options: &Options) -> Result<Vec<Part>, Error> {
    if hulls.is_empty() {
        return Err(Error::NothingSolid);
    }
    if let Some(name) = options.components.keys().find(|name| !names.contains(name)) {
        return Err(Error::NoComponent { name: name.clone(), known: names.join(", ") });
    }
    let part = |(hull, name): (Hull, &String)| {
        let own = options.components.get(name).cloned().unwrap_or_default();
        let is_set = own.top_edges.is_some() || own.profile_vertices.is_some();
        let comfortable_mm = options.min_panel_width_mm * if is_set { 1.0 } else { COMFORTABLE };
        Part {
            hull,
            options: PartOptions {
                name: own.rename.unwrap_or_else(|| name.clone()),
                direction_rad: own.direction_rad,
                top_edges: own.top_edges.unwrap_or(options.top_edges),
                profile_vertices: own.profile_vertices.unwrap_or(options.profile_vertices),
                tolerance_mm: options.tolerance_mm,
                comfortable_mm,
            },
        }
    };
    let parts: Vec<Part> = hulls.into_iter().zip(names).map(part).collect();
    let mut seen = BTreeSet::new();
    match parts.iter().find(|part| !seen.insert(part.options.name.as_str())) {
        Some(part) => Err(Error::SameName(part.options.name.clone())),
        None => Ok(parts),
    }
}

fn contacts(mesh: &Mesh, segmentation: &Segmentation, part_of_segment: &[Option<usize>]) -> Vec<Contact> {
    let part = |s: SegmentId| part_of_segment[s.0 as usize];
    let borders = segmentation.borders(mesh);
    let near = segment::near_contacts(mesh, segmentation);
    let touching = near.into_iter().filter(|(pair, _)| !borders.contains_key(pair)).map(|(pair, points)| {
        let length_mm = rim_mm(&points);
        (pair, points, length_mm)
    });
    let bordering = borders.iter().map(|(&pair, interface)| {
        let points = interface.vertices().iter().map(|&v| mesh.positions()[v as usize]).collect();
        (pair, points, interface.length())
    });
    bordering
        .chain(touching)
        .filter_map(|((a, b), points, length_mm)| {
            Some(Contact { parts: (part(a)?, part(b)?), points, length_mm })
        })
        .collect()
}

/// Length of the circle whose points are as far from their centre as these, on the whole.
fn rim_mm(points: &[DVec3]) -> f64 {
    let n = points.len().max(1) as f64;
    let centre = points.iter().sum::<DVec3>() / n;
    let square = points.iter().map(|p| p.distance_squared(centre)).sum::<f64>() / n;
    std::f64::consts::TAU * square.sqrt()
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
    for net in nets {
        out.extend(net.warnings().iter().map(|w| Warning { code: w.code(), message: w.to_string() }));
    }
    out
}
