//! What the user is told when nothing comes of it.

use std::path::PathBuf;
use tatamu::export::ExportError;
use tatamu::mesh::{MeshError, ReadError};
use tatamu::model::ModelError;
use tatamu::net::NetsError;
use tatamu::pipeline;
use tatamu::product::ProductError;
use tatamu::progress::Cancelled;
use tatamu::project::ProjectError;
use tatamu::segment::SegmentError;
use tatamu::sheet::LayoutError;
use tatamu::sheet::nest::NestError;

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
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
    /// Options contradict each other.
    #[error("{0}")]
    Options(String),
    /// An output has no known extension.
    #[error("cannot tell the format of {path} by its extension; known are: {known}")]
    Extension { path: PathBuf, known: String },
    /// An output cannot be written.
    #[error("cannot write {path}: {reason}")]
    Output { path: PathBuf, reason: String },
    /// Ctrl-C.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A stage failed.
    #[error("{0}")]
    Pipeline(pipeline::Error),
    /// A document cannot be made.
    #[error(transparent)]
    Product(#[from] ProductError),
}

impl From<ExportError> for CliError {
    fn from(error: ExportError) -> Self {
        Self::Product(error.into())
    }
}

impl From<pipeline::Error> for CliError {
    /// Whichever stage was stopped, it is no failure.
    fn from(error: pipeline::Error) -> Self {
        match error {
            pipeline::Error::Cancelled(cancelled)
            | pipeline::Error::Segment(SegmentError::Cancelled(cancelled))
            | pipeline::Error::Model(ModelError::Cancelled(cancelled))
            | pipeline::Error::Net { error: NetsError::Cancelled(cancelled), .. }
            | pipeline::Error::Layout(LayoutError::Nest(NestError::Cancelled(cancelled))) => {
                Self::Cancelled(cancelled)
            }
            other => Self::Pipeline(other),
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
        _ => error.to_string(),
    }
}
