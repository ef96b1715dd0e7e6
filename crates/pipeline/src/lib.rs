//! The way from a mesh to sheets, stage by stage. Reading [`Engine`] is reading the program.
//!
//! [`run`] is for one run; an [`Engine`] remembers the result of each stage for the next.
//!
//! ```
//! use glam::DVec3;
//! use tatamu_core::mesh::{Mesh, Soup};
//! use tatamu_core::progress::Silent;
//!
//! let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
//! let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
//! let (mesh, _) = Mesh::from_soup(&Soup::new((0..8).map(corner).collect(), faces)?)?;
//! let output = tatamu_pipeline::run(&mesh, &tatamu_pipeline::Options::default(), &Silent)?;
//! assert_eq!(output.model().parts().len(), 1);
//! assert!(output.layout().sheet_count() > 0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bodies;
mod concave;
mod drawn;
mod engine;
mod judge;
mod level;
mod mend;
mod merge;
mod openings;
mod output;
mod plugs;
mod reach;
mod segmented;
mod size;
mod source;
mod touching;
mod trial;
mod warning;

pub use bodies::{Bodies, Hulls};
pub use drawn::{run_drawn, shape_drawn};
pub use engine::Engine;
pub use level::Level;
pub use openings::openings_mm2;
pub use output::{Output, Shaped};
pub use size::usual_size_mm;
pub use source::{Divided, Drawing, MeshParts, Source};
pub use warning::{Change, ModelWarning, PanelSide, ProjectWarning, TrialWarning, Warning};

use glam::DAffine3;
use std::borrow::Cow;
use std::collections::BTreeMap;
use tatamu_core::design::{DesignError, ThickError};
use tatamu_core::mesh::{Mesh, Up};
use tatamu_core::model::{JointChoice, ModelError};
use tatamu_core::progress::{Cancelled, Progress};
use tatamu_core::remedy::Remedy;
use tatamu_core::segment::{Edit, EditError, Parts, SegmentError, SegmentOptions};
use tatamu_core::units::Paper;
use tatamu_net::net::{NetChoices, NetError, NetHand, NetsError};
use tatamu_net::sheet::{LayoutError, Pin, SheetChoices};

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
    /// How many panels there may be, where the two numbers below leave it open.
    pub level: Level,
    /// Edges of top panels, at least 3.
    pub top_edges: Option<usize>,
    /// Vertices of profiles, at least 3.
    pub profile_vertices: Option<usize>,
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
    /// Pieces, by name, that lie where the user wants them.
    pub pins: BTreeMap<String, Pin>,
    /// What is chosen about the nets of components of these names, as they are printed.
    pub hands: BTreeMap<String, NetHand>,
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
            level: Level::default(),
            top_edges: None,
            profile_vertices: None,
            tolerance_mm: None,
            min_panel_width_mm: 3.0,
            tab_width_mm: 6.0,
            paper: Paper::default(),
            margin_mm: 10.0,
            thickness_mm: 0.25,
            is_thick: false,
            nets: NetChoices::default(),
            sheets: SheetChoices::default(),
            pins: BTreeMap::new(),
            hands: BTreeMap::new(),
        }
    }
}

impl Options {
    /// The same for the size at which such a model is designed. It has the same shape there, and a tolerance and a thickness
    /// to match, so that it clashes where it will; but panels have their least width. Also gives how many times as long
    /// the model is.
    fn designed(&self) -> (Self, f64) {
        let size_mm = size::designed_mm(self.size_mm);
        let smaller = size_mm / self.size_mm;
        let tolerance_mm = self.tolerance_mm.map(|mm| smaller * mm);
        let thickness_mm = smaller * self.thickness_mm;
        (Self { size_mm, tolerance_mm, thickness_mm, ..self.clone() }, self.size_mm / size_mm)
    }

    /// Top edges and profile vertices of a part, by the square root of its share of the surface of all.
    fn counts(&self, size_share: f64) -> (usize, usize) {
        let by_level = if self.tolerance_mm.is_some() { MOST_COUNTS } else { self.level.counts(size_share) };
        (self.top_edges.unwrap_or(by_level.0), self.profile_vertices.unwrap_or(by_level.1))
    }

    /// What a panel must be worth to be there: who asks for a number of them gets it.
    fn panel_worth(&self) -> f64 {
        let is_chosen = self.top_edges.is_none() && self.profile_vertices.is_none();
        if is_chosen { self.level.panel_worth() } else { 0.0 }
    }

    /// Whether panels come out too small for fingers. Whatever is wrong with such a model comes from its size, so that
    /// nothing else is tried: a snowman of 20 mm was mended for 86 s.
    fn is_tiny(&self) -> bool {
        self.size_mm < TINY_MM
    }

    /// Whether the user chose the parts, or names this one.
    fn speaks_of(&self, part: &str) -> bool {
        let is_edited = |edit: &Edit| match edit {
            Edit::Merge { parts } => parts.first().is_some_and(|kept| kept == part),
            // More pieces have numbers behind these names.
            Edit::Split { part: back, front, .. } => {
                part.starts_with(back) || front.as_ref().is_some_and(|front| part.starts_with(front))
            }
        };
        self.segmentation.parts.is_some()
            || self.root.as_deref() == Some(part)
            || self.components.contains_key(part)
            || self.hands.contains_key(part)
            || self.edits.iter().any(is_edited)
    }

    /// What was chosen for the component of a name, and the name before it was renamed.
    fn component(&self, name: &str) -> Option<(&String, &ComponentOptions)> {
        self.components.iter().find(|(key, own)| own.rename.as_ref().unwrap_or(key) == name)
    }

    /// The colour of card of the component of a name, if that was chosen.
    fn card(&self, name: &str) -> Option<&String> {
        self.component(name).and_then(|(_, own)| own.card.as_ref())
    }

    /// How the component of a name is held, if that was chosen.
    fn joint_choice(&self, name: &str) -> Option<JointChoice> {
        self.component(name).and_then(|(_, own)| own.joint)
    }
}

/// Models that are smaller have panels that no finger holds: at 50 mm those of the samples are 3 to 15 mm wide.
const TINY_MM: f64 = 50.0;

/// Most top edges and profile vertices with a tolerance.
const MOST_COUNTS: (usize, usize) = (12, 10);

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
    /// Colour of its card, in the user's words; components of one colour share sheets.
    pub card: Option<String>,
    /// How it is held on its parent; where that is left out, it is glued unless that leaves no free
    /// way to fold.
    pub joint: Option<JointChoice>,
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
    #[error("none of the {parts} parts of the mesh has a volume, so there is nothing to fold")]
    NothingSolid {
        /// Number of parts.
        parts: usize,
    },
    /// A component failed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// Thick panels have no room.
    #[error(transparent)]
    Thick(#[from] ThickError),
    /// The panels of a mesh cannot be boards.
    #[error("{0}; boards suit drawn components and boxes, not the slanted panels of most meshes")]
    ThickMesh(ThickError),
    /// A joint cannot be unplugged.
    #[error("{name}: it cannot be plugged: {reason}")]
    NoPlug {
        /// The component.
        name: String,
        /// Why, and what to do.
        reason: &'static str,
    },
    /// Drawings make no model.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// A net failed.
    #[error("{}", too_large(.error))]
    Net {
        /// What went wrong.
        error: NetsError,
        /// The size that was asked for.
        size_mm: f64,
        /// The margin of the sheets.
        margin_mm: f64,
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

impl Error {
    /// What can be done, where the text does not say so.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::Net {
                error: NetsError::Net(NetError::PanelTooLarge { scale, may_split, sheet_mm, .. }),
                size_mm,
                margin_mm,
            } => {
                let fits_mm = (size_mm * scale * FITS).floor();
                // Margins that take eight times as much of the sheet as they leave are a slip; those of a note of
                // 40 mm are not.
                let is_mostly_margin = *margin_mm > 4.0 * sheet_mm.min_element();
                let size = if is_mostly_margin { Remedy::SmallerMargin } else { Remedy::SizeAtMost(fits_mm) };
                let split = (!may_split).then_some(Remedy::SplitPanels);
                [size, Remedy::LargerPaper].into_iter().chain(split).collect()
            }
            Self::Layout(error) => error.remedies(),
            Self::Thick(error) => error.remedies(),
            Self::ThickMesh(_) => vec![Remedy::NoBoards],
            Self::Design(error) => error.remedies(),
            _ => Vec::new(),
        }
    }
}

/// The message of a failed net: the room is that within margins.
fn too_large(error: &NetsError) -> String {
    match error {
        NetsError::Net(NetError::PanelTooLarge { name, size_mm: panel, sheet_mm, .. }) => {
            format!(
                "a panel of \"{name}\" measures {:.0} × {:.0} mm and does not fit the {:.0} × {:.0} mm within the \
                 sheet's margins",
                panel.x, panel.y, sheet_mm.x, sheet_mm.y
            )
        }
        _ => error.to_string(),
    }
}

/// Runs all stages on a mesh as it was read.
///
/// # Errors
/// See [`Error`].
pub fn run(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Output, Error> {
    Engine::new(Cow::Borrowed(mesh)).run(options, progress)
}

/// The same, and where problems are left, tries other options: [`Engine::advise`].
///
/// # Errors
/// See [`Error`].
pub fn run_and_advise(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Output, Error> {
    let engine = Engine::new(Cow::Borrowed(mesh));
    engine.advise(engine.run(options, progress)?, progress)
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
    Engine::new(Cow::Borrowed(mesh)).find_parts(options, progress)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use tatamu_core::geom::Plane;

    /// A part that a split had named could become a piece of another.
    #[test]
    fn the_user_speaks_of_all_pieces_of_a_split() {
        let plane = Plane::through(DVec3::ZERO, DVec3::Y).unwrap();
        let split = Edit::Split { part: "body".to_owned(), plane, front: Some("chest".to_owned()) };
        let merge = Edit::Merge { parts: vec!["left".to_owned(), "right".to_owned()] };
        let options = Options { edits: vec![split, merge], ..Options::default() };
        let spoken_of = ["body", "chest", "chest-2", "left"].map(|part| options.speaks_of(part));
        assert_eq!((spoken_of, options.speaks_of("top")), ([true; 4], false));
    }
}
