//! Reading the input: a mesh, or a project file that names one.

use super::choice::Choice;
use super::error::{AppError, reason};
use std::fs::File;
use std::io::{Error, ErrorKind, Read, Take};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tatamu::design::Sketch;
use tatamu::drawing::LineStyles;
use tatamu::mesh::painting::Painting;
use tatamu::mesh::{self, Mesh, Repairs};
use tatamu::pipeline::{self, Options, Output, ProjectWarning, Warning};
use tatamu::progress::Progress;
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

    /// Runs all stages.
    pub fn run(&self, choice: &Choice, progress: &dyn Progress) -> Result<Output, AppError> {
        self.run_by(pipeline::run, choice, progress)
    }

    /// The same, and tries what helps where problems are left. Drawings are made as they are drawn.
    pub fn run_and_advise(&self, choice: &Choice, progress: &dyn Progress) -> Result<Output, AppError> {
        self.run_by(pipeline::run_and_advise, choice, progress)
    }

    fn run_by(
        &self,
        run: impl Fn(&Mesh, &Options, &dyn Progress) -> Result<Output, pipeline::Error>,
        choice: &Choice,
        progress: &dyn Progress,
    ) -> Result<Output, AppError> {
        let options = choice.options();
        let result = match &self.shape {
            InputShape::Mesh(mesh) => run(mesh, options, progress),
            InputShape::Drawn(sketches) => pipeline::run_drawn(sketches, choice.size_mm(), options, progress),
        };
        result.map_err(|error| AppError::of_run(error, progress))
    }
}

/// The bytes from the start of a file that tell whether it is a project file.
const HEAD_BYTES: u64 = 1 << 16;

/// The files that are read for an input, as far as is known without reading a mesh: itself, and the mesh
/// of a project.
pub fn files(path: &Path) -> Vec<PathBuf> {
    // Of a mesh, which may be large, the beginning is enough.
    let head = if path == Path::new(STANDARD_INPUT) { standard_input() } else { beginning(path) };
    let is_project = head.is_ok_and(|head| is_project(path, &head));
    let whole = if is_project { fetch(path).ok() } else { None };
    let text = whole.map(String::from_utf8);
    let project = text.and_then(Result::ok).and_then(|text| Project::parse(&text).ok());
    let mesh = project.and_then(|project| project.mesh).map(|mesh| path.with_file_name(mesh));
    std::iter::once(path.to_owned()).chain(mesh).collect()
}

fn beginning(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut head = Vec::new();
    open(path)?.take(HEAD_BYTES).read_to_end(&mut head)?;
    Ok(head)
}

/// Largest input, bytes: a mesh of twenty million triangles in text has fewer.
const MOST_BYTES: u64 = 2 << 30;

/// Gives the content of a file.
pub type Fetch<'a> = &'a dyn Fn(&Path) -> std::io::Result<Vec<u8>>;

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

/// Stands for the standard input.
pub const STANDARD_INPUT: &str = "-";

/// The content of a file, or of the standard input.
pub fn read_file(path: &Path) -> Result<Vec<u8>, AppError> {
    whole(&fetch, path)
}

/// The content of a text file; `kind` is what messages call it.
pub fn read_text(path: &Path, kind: &str) -> Result<String, AppError> {
    String::from_utf8(read_file(path)?).map_err(|_| AppError::Input {
        path: path.to_owned(),
        reason: format!("a {kind} must be UTF-8 text"),
    })
}

fn whole(fetch: Fetch<'_>, path: &Path) -> Result<Vec<u8>, AppError> {
    fetch(path).map_err(|error| AppError::Input { path: path.to_owned(), reason: reason(&error) })
}

/// From the disk, or from the standard input.
pub fn fetch(path: &Path) -> std::io::Result<Vec<u8>> {
    if path == Path::new(STANDARD_INPUT) { standard_input() } else { at_most(open(path)?, MOST_BYTES) }
}

/// Opens a file, and nothing else: a pipe may wait for its writer for ever, and a device has no end.
fn open(path: &Path) -> std::io::Result<Take<File>> {
    let metadata = std::fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        return Err(Error::other("it is a pipe or a device; use a file, or - for the standard input"));
    }
    if metadata.len() > MOST_BYTES {
        return Err(too_large(MOST_BYTES));
    }
    // A file of /proc says that it has no bytes, and /proc/kmsg waits for the next message for ever.
    let most = if metadata.len() == 0 { 0 } else { MOST_BYTES + 1 };
    Ok(File::open(path)?.take(most))
}

/// All that a source has, unless it is more than this many bytes.
fn at_most(source: impl Read, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large(most)) } else { Ok(bytes) }
}

fn too_large(most: u64) -> Error {
    Error::other(format!("it has more than {} GB; reduce the mesh first", most >> 30))
}

/// The standard input, which is kept: a mesh is read once for its shape and once for its colours.
fn standard_input() -> std::io::Result<Vec<u8>> {
    static READ: Mutex<Option<Vec<u8>>> = Mutex::new(None);
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(bytes) = &*read {
        return Ok(bytes.clone());
    }
    let bytes = at_most(std::io::stdin().lock(), MOST_BYTES)?;
    Ok(read.insert(bytes).clone())
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
    fn a_source_without_end_is_left() {
        assert_eq!(at_most(&b"12345"[..], 5).unwrap(), b"12345");
        assert!(at_most(&b"123456"[..], 5).is_err());
        assert!(at_most(std::io::repeat(0), 1 << 20).is_err());
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
