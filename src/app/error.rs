//! Errors of commands, as users read them.

use std::path::PathBuf;
use tatamu::check::FoldCheckError;
use tatamu::drawing::StyleError;
use tatamu::export::ExportError;
use tatamu::mesh::{ColourError, MeshError, ReadError};
use tatamu::pipeline;
use tatamu::plotter::ProfileError;
use tatamu::progress::{Cancelled, Progress};
use tatamu::project::ProjectError;
use tatamu::remedy::Remedy;
use tatamu::show::ShowError;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    /// The input cannot be read.
    #[error("cannot read {path}: {reason}")]
    Input { path: PathBuf, reason: String },
    /// The input is no mesh.
    #[error("{path}: {error}")]
    Read { path: PathBuf, error: ReadError },
    /// The mesh is no solid.
    #[error("{path}: {error}")]
    Mesh { path: PathBuf, error: MeshError },
    /// The project file is wrong.
    #[error("project file {path}: {error}")]
    Project { path: PathBuf, error: ProjectError },
    /// The mesh has no colours that can be used.
    #[error("{path}: {error}")]
    Colour { path: PathBuf, error: ColourError },
    /// A style file is wrong.
    #[error("style file {path}: {error}")]
    Style { path: PathBuf, error: StyleError },
    /// A profile of a cutter or a medium is wrong.
    #[error("profile {name}: {error}")]
    Profile { name: String, error: ProfileError },
    /// A machine cannot cut or draw a sheet.
    #[error("{sheet}: {reason}")]
    Sheet { sheet: String, reason: String, remedies: Vec<Remedy> },
    /// The port cannot be used.
    #[error("cannot use the port {port}: {reason}")]
    Port { port: String, reason: String },
    /// The machine stopped the job.
    #[error("{reason}")]
    Machine { reason: String, remedies: Vec<Remedy> },
    /// The mesh that a project file names cannot be read.
    #[error("cannot read {path}, the mesh of project file {project}: {reason}")]
    ProjectMesh { path: PathBuf, project: PathBuf, reason: String },
    /// The file is no FOLD master.
    #[error("{path}: {error}")]
    Check { path: PathBuf, error: FoldCheckError },
    /// Options contradict each other, or the command has no use for its input.
    #[error("{0}")]
    Options(String),
    /// Colours are asked for where they cannot be seen.
    #[error("colours are printed on the outside of the paper")]
    ColouredInside,
    /// An output has no known extension.
    #[error("cannot tell the format of {path} by its extension; use one of: {known}")]
    Extension { path: PathBuf, known: String },
    /// An output cannot be written.
    #[error("cannot write {path}: {reason}")]
    Output { path: PathBuf, reason: String },
    /// Some of several inputs failed; the reasons are already printed.
    #[error("{} of {of} inputs failed: {}", failed.len(), failed.join(", "))]
    Several { failed: Vec<String>, of: usize },
    /// Ctrl-C.
    #[error(transparent)]
    Cancelled(Cancelled),
    /// Components were to have card of the mesh's colours.
    #[error("the card cannot have the colours of the mesh: {reason}")]
    NoCardColours { reason: String },
    /// No size takes so few sheets as were asked for.
    #[error("the model takes more than {most} sheets at every size that was tried")]
    ManySheets { most: usize },
    /// The model takes more sheets than anybody folds.
    #[error("the model takes {sheets} sheets, and more than {most} are written only if you ask for it")]
    TooManySheets { sheets: usize, most: usize },
    /// The model does not pass the check that "tatamu check" makes.
    #[error("the model does not pass its own check: {found}; please report this")]
    Unsound { found: String },
    /// A stage failed.
    #[error("{0}")]
    Pipeline(pipeline::Error),
    /// A picture cannot be made.
    #[error("cannot make the picture: {0}")]
    Show(#[from] ShowError),
    /// A document cannot be made.
    #[error(transparent)]
    Export(#[from] ExportError),
}

impl AppError {
    /// What can be done about it, where the text does not say so.
    pub fn remedies(&self) -> Vec<Remedy> {
        match self {
            Self::Pipeline(error) => error.remedies(),
            Self::Export(error) => error.remedies(),
            Self::Sheet { remedies, .. } | Self::Machine { remedies, .. } => remedies.clone(),
            Self::TooManySheets { .. } => vec![Remedy::SmallerSize, Remedy::LargerPaper],
            Self::ManySheets { .. } => vec![Remedy::MoreSheets],
            Self::NoCardColours { .. } => vec![Remedy::NameCards],
            Self::Colour { .. } => vec![Remedy::NoColours],
            Self::ColouredInside => vec![Remedy::BothSides, Remedy::NoColours],
            _ => Vec::new(),
        }
    }

    /// The error of a run that failed. Stages wrap an interruption in their own errors, so the
    /// user's request to stop is checked first.
    pub fn of_run(error: pipeline::Error, progress: &dyn Progress) -> Self {
        match progress.check() {
            Err(cancelled) => Self::Cancelled(cancelled),
            Ok(()) => Self::Pipeline(error),
        }
    }
}

/// What an input or output error means, in words that do not depend on the system.
pub fn reason(error: &std::io::Error) -> String {
    use std::io::ErrorKind as K;
    match error.kind() {
        K::NotFound => "there is no such file or folder".to_owned(),
        K::PermissionDenied => "permission denied".to_owned(),
        K::IsADirectory => "it is a folder, not a file".to_owned(),
        K::StorageFull => "the disk is full".to_owned(),
        K::ReadOnlyFilesystem => "the disk is read-only".to_owned(),
        K::FileTooLarge => {
            "the file is larger than this system allows; raise its limit (ulimit -f)".to_owned()
        }
        _ => error.to_string(),
    }
}
