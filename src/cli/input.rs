//! Reading the input: a mesh, or a project file that names one.

use super::error::{CliError, reason};
use super::options::ModelArgs;
use super::progress::TerminalProgress;
use std::path::{Component, Path, PathBuf};
use tatamu::design::Sketch;
use tatamu::mesh::painting::Painting;
use tatamu::mesh::{self, Mesh, Repairs};
use tatamu::pipeline::{self, Options, Output};
use tatamu::project::Project;

/// What a model is made of, with where it comes from.
pub struct Input {
    /// The mesh file, or the project file that holds the drawings.
    pub mesh_path: PathBuf,
    /// The project, where the user gave one.
    pub project: Option<Project>,
    /// The shape.
    pub shape: Shape,
    /// What was done to make the mesh clean.
    pub repairs: Repairs,
}

/// A mesh, or drawings.
pub enum Shape {
    /// A clean mesh.
    Mesh(Mesh),
    /// Drawn components.
    Drawn(Vec<Sketch>),
}

impl Input {
    /// The mesh, for commands that have no use for drawings.
    pub fn mesh(&self) -> Result<&Mesh, CliError> {
        match &self.shape {
            Shape::Mesh(mesh) => Ok(mesh),
            Shape::Drawn(_) => Err(CliError::Options(format!(
                "{} holds drawn components and no mesh, so there is nothing to divide; \"make\" makes them",
                self.mesh_path.display()
            ))),
        }
    }

    /// Runs all stages.
    pub fn run(
        &self,
        model: &ModelArgs,
        options: &Options,
        progress: &TerminalProgress,
    ) -> Result<Output, CliError> {
        let result = match &self.shape {
            Shape::Mesh(mesh) => pipeline::run(mesh, options, progress),
            Shape::Drawn(sketches) => pipeline::run_drawn(sketches, model.size_mm(self), options, progress),
        };
        result.map_err(|error| CliError::of_run(error, progress))
    }
}

/// Reads a mesh or a project file.
pub fn read(path: &Path) -> Result<Input, CliError> {
    let bytes = read_file(path)?;
    if !is_project(path, &bytes) {
        return read_mesh(path, &bytes, None);
    }
    let text = String::from_utf8(bytes).map_err(|_| CliError::Input {
        path: path.to_owned(),
        reason: "a project file is text in UTF-8".to_owned(),
    })?;
    let project =
        Project::parse(&text).map_err(|error| CliError::Project { path: path.to_owned(), error })?;
    let Some(mesh) = &project.mesh else {
        let sketches = project.sketches();
        let sketches = sketches.map_err(|error| CliError::Project { path: path.to_owned(), error })?;
        let (shape, repairs) = (Shape::Drawn(sketches), Repairs::default());
        return Ok(Input { mesh_path: path.to_owned(), project: Some(project), shape, repairs });
    };
    let mesh_path = path.with_file_name(mesh);
    let bytes = std::fs::read(&mesh_path).map_err(|error| CliError::ProjectMesh {
        path: mesh_path.clone(),
        project: path.to_owned(),
        reason: reason(&error),
    })?;
    read_mesh(&mesh_path, &bytes, Some(project))
}

fn read_mesh(path: &Path, bytes: &[u8], project: Option<Project>) -> Result<Input, CliError> {
    let sibling = |name: &str| read_sibling(path, name);
    let soup = mesh::read_with_siblings(bytes, &sibling)
        .map_err(|error| CliError::Read { path: path.to_owned(), error })?;
    let (mesh, repairs) =
        Mesh::from_soup(&soup).map_err(|error| CliError::Mesh { path: path.to_owned(), error })?;
    Ok(Input { mesh_path: path.to_owned(), project, shape: Shape::Mesh(mesh), repairs })
}

/// The colours of a mesh file.
pub fn read_painting(path: &Path) -> Result<Painting, CliError> {
    let sibling = |name: &str| read_sibling(path, name);
    mesh::read_painting(&read_file(path)?, &sibling)
        .map_err(|error| CliError::Colour { path: path.to_owned(), error })
}

/// The content of a file.
pub fn read_file(path: &Path) -> Result<Vec<u8>, CliError> {
    std::fs::read(path).map_err(|error| CliError::Input { path: path.to_owned(), reason: reason(&error) })
}

/// By its extension, or because a line of it gives a mesh.
fn is_project(path: &Path, bytes: &[u8]) -> bool {
    let is_toml = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    let names_mesh = |line: &[u8]| {
        let rest = line.trim_ascii_start().strip_prefix(b"mesh");
        rest.is_some_and(|rest| rest.trim_ascii_start().starts_with(b"="))
    };
    is_toml || bytes.split(|&b| b == b'\n').take(100).any(names_mesh)
}

/// A file that the mesh file refers to: only beside or below it, so that a mesh from elsewhere
/// cannot have any file read.
fn read_sibling(mesh_path: &Path, name: &str) -> Result<Vec<u8>, String> {
    let name = Path::new(name);
    let is_below = name.components().all(|c| matches!(c, Component::Normal(_)));
    if !is_below {
        return Err("it must be in the same folder; move it there".to_owned());
    }
    std::fs::read(mesh_path.with_file_name(name)).map_err(|error| reason(&error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_project_shows_in_its_name_or_its_content() {
        assert!(is_project(Path::new("a.TOML"), b""));
        assert!(is_project(Path::new("a.txt"), b"# x\n mesh = 'a.obj'\n"));
        assert!(!is_project(Path::new("a.obj"), b"# mesh = 3\nv 0 0 0\n"));
        assert!(!is_project(Path::new("a"), b"meshes = 3"));
    }

    #[test]
    fn siblings_are_in_the_same_folder() {
        for name in ["/etc/hostname", "../x.bin", "a/../../x.bin", ""] {
            let result = read_sibling(Path::new("folder/mesh.gltf"), name);
            assert!(result.is_err(), "{name}");
        }
    }
}
