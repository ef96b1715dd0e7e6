//! Reading the input: a mesh, or a project file that names one.

use super::error::{AppError, reason};
use super::files::{Fetch, STANDARD_INPUT, beginning, fetch, whole};
use std::path::{Component, Path, PathBuf};
use tatamu::design::Sketch;
use tatamu::drawing::LineStyles;
use tatamu::mesh::painting::Painting;
use tatamu::mesh::{self, Mesh, Repairs};
use tatamu::pipeline::{ProjectWarning, Warning};
use tatamu::project::Project;
use tatamu::project::options::STYLE;

/// What a model is made of, with where it comes from.
pub struct Input {
    /// The mesh file, or the project file that holds the drawings.
    pub mesh_path: PathBuf,
    /// The project, where the user gave one.
    pub project: Option<Project>,
    /// The shape.
    pub shape: InputShape,
    /// What was done to make the mesh clean.
    pub repairs: Repairs,
    /// What the user should know about the project file.
    pub notes: Vec<Warning>,
}

/// A mesh, or drawings.
pub enum InputShape {
    /// A clean mesh.
    Mesh(Mesh),
    /// Drawn components.
    Drawn(Vec<Sketch>),
}

impl Input {
    /// The mesh, for commands that have no use for drawings.
    pub fn mesh(&self) -> Result<&Mesh, AppError> {
        match &self.shape {
            InputShape::Mesh(mesh) => Ok(mesh),
            InputShape::Drawn(_) => Err(AppError::Options(format!(
                "{} has drawn components and no mesh to divide; use \"tatamu make\"",
                self.mesh_path.display()
            ))),
        }
    }

    /// The mesh that a project names.
    pub fn named_mesh(&self) -> Option<&Path> {
        self.project.as_ref().and_then(|project| project.mesh.as_ref()).map(|_| self.mesh_path.as_path())
    }

    /// What the user should know about the files that were read.
    pub fn warnings(&self) -> Vec<Warning> {
        let repairs = self.repairs.warnings().into_iter().map(Warning::from);
        self.notes.iter().cloned().chain(repairs).collect()
    }
}

/// The bytes from the start of a file that tell whether it is a project file.
const HEAD_BYTES: u64 = 1 << 16;

/// The files that are read for an input, as far as is known without reading a mesh: itself, and the mesh
/// of a project.
pub fn files(path: &Path) -> Vec<PathBuf> {
    // Of a mesh, which may be large, the beginning is enough.
    let head = if path == Path::new(STANDARD_INPUT) { fetch(path) } else { beginning(path, HEAD_BYTES) };
    let is_project = head.is_ok_and(|head| is_project(path, &head));
    let whole = if is_project { fetch(path).ok() } else { None };
    let text = whole.map(String::from_utf8);
    let project = text.and_then(Result::ok).and_then(|text| Project::parse(&text).ok());
    let mesh = project.and_then(|project| project.mesh).map(|mesh| path.with_file_name(mesh));
    std::iter::once(path.to_owned()).chain(mesh).collect()
}

/// Reads a mesh or a project file.
pub fn read(path: &Path) -> Result<Input, AppError> {
    read_by(&fetch, path)
}

/// The same from a place that is not the disk.
pub fn read_by(fetch: Fetch<'_>, path: &Path) -> Result<Input, AppError> {
    let bytes = whole(fetch, path)?;
    if !is_project(path, &bytes) {
        return read_mesh(fetch, path, &bytes, None, Vec::new());
    }
    let text = String::from_utf8(bytes).map_err(|_| AppError::Input {
        path: path.to_owned(),
        reason: "a project file must be UTF-8 text".to_owned(),
    })?;
    let project =
        Project::parse(&text).map_err(|error| AppError::Project { path: path.to_owned(), error })?;
    let notes = outside_notes(path, &project);
    let Some(mesh) = &project.mesh else {
        let sketches = project.sketches();
        let sketches = sketches.map_err(|error| AppError::Project { path: path.to_owned(), error })?;
        let (shape, repairs) = (InputShape::Drawn(sketches), Repairs::default());
        return Ok(Input { mesh_path: path.to_owned(), project: Some(project), shape, repairs, notes });
    };
    let mesh_path = path.with_file_name(mesh);
    let bytes = fetch(&mesh_path).map_err(|error| AppError::ProjectMesh {
        path: mesh_path.clone(),
        project: path.to_owned(),
        reason: reason(&error),
    })?;
    read_mesh(fetch, &mesh_path, &bytes, Some(project), notes)
}

fn read_mesh(
    fetch: Fetch<'_>,
    path: &Path,
    bytes: &[u8],
    project: Option<Project>,
    notes: Vec<Warning>,
) -> Result<Input, AppError> {
    let sibling = |name: &str| read_sibling(fetch, path, name);
    let soup = mesh::read_with_siblings(bytes, &sibling)
        .map_err(|error| AppError::Read { path: path.to_owned(), error })?;
    let (mesh, repairs) =
        Mesh::from_soup(&soup).map_err(|error| AppError::Mesh { path: path.to_owned(), error })?;
    Ok(Input { mesh_path: path.to_owned(), project, shape: InputShape::Mesh(mesh), repairs, notes })
}

/// A project file may come from anybody: a warning names a style file that it reads from elsewhere. (Its
/// mesh is often in another folder, and is named in the summary of each run.)
fn outside_notes(path: &Path, project: &Project) -> Vec<Warning> {
    let style = STYLE.text(&project.settings()).filter(|name| LineStyles::built_in(name).is_none());
    let outside = style.filter(|name| !is_within(&path.with_file_name(""), Path::new(name)));
    let warning = |name| {
        let project = path.display().to_string();
        ProjectWarning::Outside { project, what: "style file", name }.into()
    };
    outside.into_iter().map(warning).collect()
}

/// Whether a name in a file of `folder` leads to something below that folder, links apart.
fn is_within(folder: &Path, name: &Path) -> bool {
    let absolute = std::path::absolute(folder).ok();
    let name = absolute.and_then(|folder| name.strip_prefix(folder).ok()).unwrap_or(name);
    let depth = name.components().try_fold(0usize, |depth, component| match component {
        Component::Normal(_) => Some(depth + 1),
        Component::CurDir => Some(depth),
        Component::ParentDir => depth.checked_sub(1),
        Component::RootDir | Component::Prefix(_) => None,
    });
    depth.is_some()
}

/// The colours of a mesh file.
pub fn read_painting(path: &Path) -> Result<Painting, AppError> {
    read_painting_by(&fetch, path)
}

/// The same from a place that is not the disk.
pub fn read_painting_by(fetch: Fetch<'_>, path: &Path) -> Result<Painting, AppError> {
    let sibling = |name: &str| read_sibling(fetch, path, name);
    mesh::read_painting(&whole(fetch, path)?, &sibling)
        .map_err(|error| AppError::Colour { path: path.to_owned(), error })
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
pub(super) fn read_sibling(fetch: Fetch<'_>, mesh_path: &Path, name: &str) -> Result<Vec<u8>, String> {
    let name = Path::new(name);
    let is_below = name.components().all(|c| matches!(c, Component::Normal(_)));
    if !is_below {
        return Err("it must be in the same folder; move it there".to_owned());
    }
    fetch(&mesh_path.with_file_name(name)).map_err(|error| reason(&error))
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
            let result = read_sibling(&fetch, Path::new("folder/mesh.gltf"), name);
            assert!(result.is_err(), "{name}");
        }
    }

    #[test]
    fn a_name_leads_outside_when_it_leaves_the_folder() {
        let is_within = |name: &str| is_within(Path::new("/home/me/bear/"), Path::new(name));
        for name in ["a.obj", "./a.obj", "meshes/a.obj", "meshes/../a.obj", "/home/me/bear/a.obj"] {
            assert!(is_within(name), "{name}");
        }
        for name in
            ["../a.obj", "a/../../b.obj", "/etc/hostname", "/home/me/bear/../a.obj", "/home/me/bears/a.obj"]
        {
            assert!(!is_within(name), "{name}");
        }
    }
}
