//! The files that a model is read from. No output takes the place of one of them.

use super::error::AppError;
use super::files::fetch;
use super::input::{self, read_sibling};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tatamu::mesh;

/// The files that a model, or several, are read from.
#[derive(Debug, Default)]
pub struct Sources {
    inputs: Vec<PathBuf>,
    /// What meshes refer to, found when a file is first about to be replaced: that takes as long as to read them.
    siblings: OnceLock<Vec<PathBuf>>,
}

impl Sources {
    /// Of what is read from no file.
    pub fn none() -> Self {
        Self::default()
    }

    /// Of inputs: the project files, the meshes, and what these refer to, such as textures.
    pub fn of<'a>(inputs: impl IntoIterator<Item = &'a Path>) -> Self {
        Self { inputs: inputs.into_iter().flat_map(input::files).collect(), siblings: OnceLock::new() }
    }

    /// Refuses to replace one of the files.
    pub fn spare(&self, path: &Path) -> Result<(), AppError> {
        // A new file takes no place.
        let Ok(place) = path.canonicalize() else { return Ok(()) };
        let is_among = |files: &[PathBuf]| files.iter().any(|f| f.canonicalize().is_ok_and(|f| f == place));
        let what = if is_among(&self.inputs) {
            "the input"
        } else if is_among(
            self.siblings.get_or_init(|| self.inputs.iter().flat_map(|f| siblings(f)).collect()),
        ) {
            "a texture or another file of the mesh"
        } else {
            return Ok(());
        };
        let reason = format!("it is {what}; choose another name");
        Err(AppError::Output { path: path.to_owned(), reason })
    }
}

/// The files that a mesh file refers to.
fn siblings(mesh: &Path) -> Vec<PathBuf> {
    let Ok(bytes) = fetch(mesh) else { return Vec::new() };
    let names = mesh::siblings(&bytes, &|name| read_sibling(&fetch, mesh, name));
    names.into_iter().map(|name| mesh.with_file_name(name)).collect()
}
