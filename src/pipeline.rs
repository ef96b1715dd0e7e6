//! The way from a mesh to a model, stage by stage.

use crate::mesh::{Mesh, Repairs, Up};
use crate::progress::{Cancelled, Progress};
use crate::units::Paper;
use std::collections::BTreeMap;

/// What the user chose.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Longest side of the model's bounding box, mm.
    pub size_mm: f64,
    /// The axis of the mesh that points up.
    pub up: Up,
    /// Number of components to aim at; without it the shape decides.
    pub parts: Option<usize>,
    /// What differs for components of these names.
    pub components: BTreeMap<String, ComponentOptions>,
    /// Edges of top panels, at least 3.
    pub top_edges: usize,
    /// Vertices of profiles, at least 3.
    pub profile_vertices: usize,
    /// Least width and height of panels, mm.
    pub min_panel_width_mm: f64,
    /// Width of glue tabs, mm.
    pub tab_width_mm: f64,
    /// Size of the sheets.
    pub paper: Paper,
    /// Border of the sheets that stays free, mm.
    pub margin_mm: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size_mm: 200.0,
            up: Up::Z,
            parts: None,
            components: BTreeMap::new(),
            top_edges: 6,
            profile_vertices: 6,
            min_panel_width_mm: 3.0,
            tab_width_mm: 6.0,
            paper: Paper::default(),
            margin_mm: 10.0,
        }
    }
}

/// What the user chose for one component.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ComponentOptions {
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
    /// Options for a component that does not exist.
    #[error("there is no component \"{name}\"; there are: {known}")]
    NoComponent {
        /// The name that was given.
        name: String,
        /// The names of all components.
        known: String,
    },
}

/// The result of all stages.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    mesh: Mesh,
}

impl Output {
    /// The mesh at the size of the model.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The names of the components, with the direction of each fold axis in radians.
    pub fn components(&self) -> Vec<(String, f64)> {
        vec![("part-1".to_owned(), 0.0)]
    }

    /// The segment of each face of [`Output::mesh`].
    pub fn face_segments(&self) -> Vec<u32> {
        vec![0; self.mesh.faces().len()]
    }
}

/// Runs all stages on a mesh as it was read.
///
/// # Errors
/// See [`Error`].
pub fn run(mesh: &Mesh, options: &Options, progress: &dyn Progress) -> Result<Output, Error> {
    progress.check()?;
    progress.stage("scaling the mesh");
    let (mesh, _) = mesh.scaled(options.size_mm, options.up);
    let output = Output { mesh };
    let known: Vec<String> = output.components().into_iter().map(|c| c.0).collect();
    if let Some(name) = options.components.keys().find(|name| !known.contains(name)) {
        return Err(Error::NoComponent {
            name: name.clone(),
            known: known.join(", "),
        });
    }
    progress.fraction(1.0);
    Ok(output)
}

/// What a run can be written as.
pub mod formats {
    use super::{Output, Repairs};

    /// One file of an export.
    pub struct ExportFile {
        /// What stands between the stem and the extension of the name that the user gave.
        pub suffix: String,
        /// Its content.
        pub bytes: Vec<u8>,
    }

    /// One file format.
    pub struct Format {
        /// Extensions in small letters, without the dot; the first is the usual one.
        pub extensions: &'static [&'static str],
        /// One line for help texts.
        pub description: &'static str,
    }

    /// All formats, in the order of help texts; the first is the default.
    pub const FORMATS: &[Format] = &[Format {
        extensions: &["json"],
        description: "report: components, nets, sheets, warnings",
    }];

    /// The format for an extension, in any case.
    pub fn format_of(extension: &str) -> Option<&'static Format> {
        let is = |known: &&str| known.eq_ignore_ascii_case(extension);
        FORMATS
            .iter()
            .find(|format| format.extensions.iter().any(|e| is(e)))
    }

    impl Format {
        /// The files of a run in this format.
        pub fn write(&self, output: &Output, repairs: &Repairs) -> Vec<ExportFile> {
            let report = serde_json::json!({
                "schema": 1,
                "input": {
                    "faces": repairs.input_faces,
                    "vertices": output.mesh.positions().len(),
                    "diagonal_mm": output.mesh.diagonal_mm(),
                },
            });
            let suffix = String::new();
            let bytes = format!("{report:#}\n").into_bytes();
            vec![ExportFile { suffix, bytes }]
        }
    }
}
