//! What the user should know about the components and their joints.

use super::Warning;
use crate::source::MeshParts;
use crate::{Options, openings_mm2};
use glam::DVec3;
use std::fmt;
use tatamu_core::codes;
use tatamu_core::component::{Component, Panel, PanelKind};
use tatamu_core::design::RefitError;
use tatamu_core::model::{Model, ModelPart, PartId};
use tatamu_core::remedy::Remedy;
use tatamu_core::segment::Details;
use tatamu_net::net::Net;
use tatamu_net::sheet::Layout;

/// Something that the user should know about components or joints.
#[derive(Debug, Clone, PartialEq)]
pub enum ModelWarning {
    /// The model is too small for hands.
    TinyModel {
        /// Its longest side.
        size_mm: f64,
    },
    /// The model takes more paper than most people mean.
    ManySheets {
        /// Number of sheets.
        sheets: usize,
        /// Name of their paper.
        paper: String,
    },
    /// Parts of the mesh have no volume and were left out.
    FlatParts {
        /// How many.
        parts: usize,
        /// Their faces.
        faces: usize,
    },
    /// What sticks out of parts was left out.
    LeftOut {
        /// Number of bodies.
        bodies: usize,
        /// Number of parts that were cut.
        cuts: usize,
    },
    /// The parts of the mesh are not one model.
    NotJoined {
        /// The first component of each group.
        roots: Vec<String>,
    },
    /// A panel is narrower or lower than panels should be.
    NarrowPanel {
        /// The component.
        component: String,
        /// The panel.
        panel: PanelKind,
        /// Which of its measures is too small.
        side: PanelSide,
        /// The measure.
        mm: f64,
        /// The least that was asked for.
        least_mm: f64,
    },
    /// A component is farther from its shape than was asked for.
    ToleranceMissed {
        /// The component.
        component: String,
        /// How far.
        error_mm: f64,
        /// How far was asked for.
        tolerance_mm: f64,
    },
    /// A part is thinner than its panels may be, so its component is larger.
    ThinPart {
        /// The component.
        component: String,
        /// How much larger.
        error_mm: f64,
        /// The least width of panels.
        least_mm: f64,
    },
    /// A joint has too little glue.
    WeakJoint {
        /// The component.
        component: String,
        /// The one that carries it.
        parent: String,
        /// The area to glue.
        glue_mm2: f64,
        /// The area from which it holds well.
        needed_mm2: f64,
    },
    /// A component has an opening that looks like a hole.
    Opening {
        /// The component.
        component: String,
        /// How many it has, smaller ones too.
        openings: usize,
        /// Area of the largest.
        largest_mm2: f64,
    },
    /// A component that could have dents stays convex.
    StaysConvex {
        /// The component.
        component: String,
        /// Why.
        reason: RefitError,
    },
}

/// A measure of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PanelSide {
    /// Along its hinges.
    Width,
    /// Across them.
    Height,
}

codes!(ModelWarning {
    TinyModel => "tiny_model",
    ManySheets => "many_sheets",
    FlatParts => "flat_segment",
    LeftOut => "details_left_out",
    NotJoined => "not_joined",
    NarrowPanel => "narrow_panel",
    ToleranceMissed => "tolerance_missed",
    ThinPart => "thin_part",
    WeakJoint => "weak_joint",
    Opening => "opening",
    StaysConvex => "concave_refused",
});

impl ModelWarning {
    /// What can be done, the likeliest first.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::TinyModel { .. } => vec![Remedy::LargerSize],
            Self::ManySheets { .. } => vec![Remedy::SmallerSize, Remedy::LargerPaper],
            Self::FlatParts { .. }
            | Self::LeftOut { .. }
            | Self::NotJoined { .. }
            | Self::StaysConvex { .. } => Vec::new(),
            Self::NarrowPanel { .. } => vec![Remedy::FewerPanels, Remedy::LargerSize],
            Self::ToleranceMissed { .. } => vec![Remedy::MorePanels],
            Self::ThinPart { least_mm, .. } => vec![Remedy::LargerSize, Remedy::NarrowerPanels(*least_mm)],
            Self::WeakJoint { .. } => vec![Remedy::TapeJoint],
            Self::Opening { .. } => vec![Remedy::CoverOpening],
        }
    }
}

impl fmt::Display for ModelWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TinyModel { size_mm } => {
                write!(
                    f,
                    "the model is only {size_mm} mm long, which is too small to fold; 20 cm is a usual size"
                )
            }
            Self::ManySheets { sheets, paper } => write!(f, "the model takes {sheets} sheets of {paper}"),
            Self::FlatParts { parts, faces } => {
                let (parts_have, were) =
                    if *parts == 1 { ("part has", "was") } else { ("parts have", "were") };
                write!(f, "{parts} flat {parts_have} no volume and {were} left out (faces: {faces})")
            }
            Self::LeftOut { bodies, cuts } => write!(
                f,
                "details that stick out were left out, because parts with them are much larger (bodies: {bodies}, \
                 parts that were cut: {cuts})"
            ),
            Self::NotJoined { roots } => write!(
                f,
                "the model is in {} groups that are not joined to one another, because they do not touch or no joint \
                 has room; they begin with {}",
                roots.len(),
                roots.join(", ")
            ),
            Self::NarrowPanel { component, panel, side, mm, least_mm } => {
                let word = match side {
                    PanelSide::Width => "wide",
                    PanelSide::Height => "high",
                };
                write!(f, "{component}: {panel} is only {mm:.2} mm {word}, less than {least_mm} mm")
            }
            Self::ToleranceMissed { component, error_mm, tolerance_mm } => write!(
                f,
                "{component}: it comes within {error_mm:.1} mm of its shape, not within {tolerance_mm} mm"
            ),
            Self::ThinPart { component, error_mm, .. } => write!(
                f,
                "{component}: its shape is thinner than its panels may be, and it comes out larger by up to \
                 {error_mm:.1} mm"
            ),
            Self::WeakJoint { component, parent, glue_mm2, needed_mm2 } => write!(
                f,
                "{component}: its joint with {parent} has {glue_mm2:.0} mm² to glue, and holds well from \
                 {needed_mm2:.0} mm²"
            ),
            Self::Opening { component, openings: 1, largest_mm2 } => write!(
                f,
                "{component}: its panels leave an opening of {largest_mm2:.0} mm² at a slit, because its flat layers \
                 would overlap without it"
            ),
            Self::Opening { component, openings, largest_mm2 } => write!(
                f,
                "{component}: its panels leave {openings} openings at slits, the largest of {largest_mm2:.0} mm², \
                 because its flat layers would overlap without them"
            ),
            Self::StaysConvex { component, reason } => {
                write!(f, "{component}: it stays convex, though concave was asked for: {reason}")
            }
        }
    }
}

/// More sheets than anybody cuts unless it is meant: a model of a metre, with eight components, takes about 90 of A4.
const MANY_SHEETS: usize = 60;

/// A warning where a model takes very many sheets.
pub(crate) fn many_sheets(layout: &Layout) -> Option<ModelWarning> {
    let sheets = layout.sheet_count();
    let paper = || layout.options().paper.name();
    (sheets > MANY_SHEETS).then(|| ModelWarning::ManySheets { sheets, paper: paper() })
}

/// Larger openings look like holes: a child's finger is 5 mm wide.
const MOST_OPEN_MM2: f64 = 20.0;

/// An error above this share of a component's thickness changes how it looks.
const SWOLLEN: f64 = 0.3;
/// Such an error comes from the least size of panels where the component is thinner than this many of them.
const THIN_PANELS: f64 = 4.0;

/// What of a mesh is not in its model.
fn left_out(parts: &MeshParts) -> Vec<Warning> {
    let (flat, Details { bodies, cuts }) = (parts.flat_faces(), parts.details());
    let flat_parts = ModelWarning::FlatParts { parts: flat.len(), faces: flat.iter().sum() };
    let details = ModelWarning::LeftOut { bodies, cuts };
    let both = [(!flat.is_empty(), flat_parts), (bodies + cuts > 0, details)];
    both.into_iter().filter(|(is_so, _)| *is_so).map(|(_, warning)| warning.into()).collect()
}

/// What is to be known about a model and its nets.
pub(crate) fn warnings(
    model: &Model,
    nets: &[Net],
    parts: Option<&MeshParts>,
    options: &Options,
) -> Vec<Warning> {
    let mut out: Vec<Warning> = Vec::new();
    if options.is_tiny() {
        out.push(ModelWarning::TinyModel { size_mm: options.size_mm }.into());
    }
    out.extend(parts.into_iter().flat_map(left_out));
    out.extend(model.parts().iter().flat_map(|part| part_warnings(part, options)).map(Warning::from));
    out.extend(model.ids().filter_map(|part| weak_joint(model, part)).map(Warning::from));
    // Board is taped at all hinges.
    for net in nets.iter().filter(|_| !options.is_thick) {
        out.extend(net.warnings().iter().cloned().map(Warning::from));
    }
    out
}

/// What is to be known about one component.
fn part_warnings(part: &ModelPart, options: &Options) -> Vec<ModelWarning> {
    let least_mm = options.min_panel_width_mm;
    let component = || part.name.clone();
    let mut out = Vec::new();
    let sizes = [
        (PanelSide::Width, part.component.narrowest_panel()),
        (PanelSide::Height, part.component.lowest_panel()),
    ];
    for (side, (panel, mm)) in sizes.into_iter().filter(|size| size.1.1 < least_mm - 1e-6) {
        let panel = part.component.panels().panel(panel).kind;
        out.push(ModelWarning::NarrowPanel { component: component(), panel, side, mm, least_mm });
    }
    let error_mm = part.component.hausdorff_mm();
    if let Some(tolerance_mm) = options.tolerance_mm.filter(|t| error_mm > *t) {
        out.push(ModelWarning::ToleranceMissed { component: component(), error_mm, tolerance_mm });
    }
    // Boards are taped at all edges.
    let openings = if options.is_thick { Vec::new() } else { openings_mm2(part.component.panels()) };
    if let Some(&largest_mm2) = openings.first().filter(|&&mm2| mm2 > MOST_OPEN_MM2) {
        out.push(ModelWarning::Opening { component: component(), openings: openings.len(), largest_mm2 });
    }
    let thickness_mm = thickness_mm(&part.component);
    if error_mm > SWOLLEN * thickness_mm && thickness_mm < THIN_PANELS * least_mm {
        out.push(ModelWarning::ThinPart { component: component(), error_mm, least_mm });
    }
    out
}

/// A joint with too little glue.
fn weak_joint(model: &Model, part: PartId) -> Option<ModelWarning> {
    let joint = model.part(part).joint.as_ref().filter(|_| model.is_weak(part))?;
    let (glue_mm2, needed_mm2) = (joint.glue_mm2, model.needed_glue_mm2(part)?);
    let [component, parent] = [part, joint.parent].map(|p| model.part(p).name.clone());
    Some(ModelWarning::WeakJoint { component, parent, glue_mm2, needed_mm2 })
}

/// Least distance between parallel planes with the whole standing component between them, of those
/// along its panels.
fn thickness_mm(component: &Component) -> f64 {
    let panels = component.panels().panels();
    let corners: Vec<DVec3> = panels.iter().flat_map(|p| p.deployed_outline()).collect();
    let across = |panel: &Panel| {
        let normal = panel.deployed.matrix3.z_axis;
        let reach = corners.iter().map(|c| normal.dot(*c));
        let (low, high) =
            reach.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), r| (low.min(r), high.max(r)));
        high - low
    };
    panels.iter().map(across).fold(f64::INFINITY, f64::min)
}

/// A warning where the parts of a mesh are not one model. (Of components that are drawn, those without
/// a joint are separate models on purpose.)
pub(crate) fn not_joined(model: &Model) -> Option<ModelWarning> {
    let roots = model.parts().iter().filter(|p| p.joint.is_none()).map(|p| p.name.clone());
    let roots: Vec<String> = roots.collect();
    (roots.len() > 1).then_some(ModelWarning::NotJoined { roots })
}
