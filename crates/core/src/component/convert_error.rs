//! Why a hull becomes no component.

use super::assemble_error::AssembleError;
use crate::geom::HullError;

/// Why a hull becomes no component.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ConvertError {
    /// The hull has no volume.
    #[error(transparent)]
    Hull(#[from] HullError),
    /// No shape tried gives panels.
    #[error("no foldable shape was found for it; the last try failed because {0}")]
    Assemble(#[from] AssembleError),
    /// A joint has no image in the mirror plane, or would be creased by it.
    #[error("its joints are not mirror images of one another as the component is to be")]
    Lopsided,
}
