//! A file that is open.

use super::words;
use crate::app::choice::{self, Choice};
use crate::app::error::AppError;
use crate::app::input::InputShape;
use crate::app::{input, locale, project};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::design::Sketch;
use tatamu::export::FormatOptions;
use tatamu::mesh::Repairs;
use tatamu::mesh::painting::Painting;
use tatamu::pipeline::{Engine, Options, Output, Warning, shape_drawn};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::project::options::Settings;
use tatamu::report::Run;

/// Gives the content of a file, on any thread.
pub type Fetch = Arc<dyn Fn(&Path) -> std::io::Result<Vec<u8>> + Send + Sync>;

/// A file that is open.
#[derive(Clone)]
pub struct Opened {
    /// Where its files are.
    fetch: Fetch,
    /// What the user opened: a mesh or a project file.
    pub source: PathBuf,
    /// The drawings, where the components are drawn.
    pub drawn: Option<Arc<Vec<Sketch>>>,
    /// The mesh file, or the project file that holds the drawings.
    pub mesh_path: PathBuf,
    /// What was done to the mesh to make it clean.
    pub repairs: Repairs,
    /// The mesh, with all that is made of it.
    pub engine: Arc<Engine<'static>>,
    /// Text of the project file as it was read or written last; a fresh one for a mesh.
    pub text: String,
    /// Whether the source is a project file.
    pub is_project: bool,
}

impl Opened {
    /// Reads a file. A mesh begins on the usual paper of the country that the system names.
    ///
    /// # Errors
    /// A message that says what is wrong with which file.
    pub fn read(fetch: Fetch, source: &Path) -> Result<Self, String> {
        Self::read_with(fetch, source, &locale::settings())
    }

    /// The same where a mesh begins with other settings. A project has its own.
    ///
    /// # Errors
    /// As [`Opened::read`].
    pub fn read_with(fetch: Fetch, source: &Path, fresh: &Settings) -> Result<Self, String> {
        let input = input::read_by(&*fetch, source).map_err(|error| words::error(&error))?;
        let (mesh, drawn) = match input.shape {
            InputShape::Mesh(mesh) => (mesh, None),
            InputShape::Drawn(sketches) => {
                let options = Options::default();
                let shaped = shape_drawn(&sketches, None, &options, &Silent)
                    .map_err(|error| words::failure(&error))?;
                (shaped.source().mesh().clone(), Some(Arc::new(sketches)))
            }
        };
        let is_project = input.project.is_some();
        let text = if is_project {
            let bytes = fetch(source).map_err(|error| error.to_string())?;
            String::from_utf8(bytes).map_err(|error| error.to_string())?
        } else {
            let project = source.with_extension("toml");
            let name = project::mesh_from(&project, source).map_err(|error| error.to_string())?;
            project::project_text(&name, &choice::fresh(&mesh, fresh.clone()), &[], &[])
        };
        Ok(Self {
            fetch,
            source: source.to_owned(),
            drawn,
            mesh_path: input.mesh_path,
            repairs: input.repairs,
            engine: Arc::new(Engine::new(Cow::Owned(mesh))),
            text,
            is_project,
        })
    }

    /// The same project with the mesh of a file that was read again.
    pub fn with_mesh(&self, fresh: &Self) -> Self {
        Self { repairs: fresh.repairs.clone(), engine: fresh.engine.clone(), ..self.clone() }
    }

    /// The same after the project was saved with a text in a file, which is its source from now on.
    pub fn saved_as(&self, path: &Path, text: String) -> Self {
        let mesh_path = if self.drawn.is_some() { path.to_owned() } else { self.mesh_path.clone() };
        Self { source: path.to_owned(), mesh_path, text, is_project: true, ..self.clone() }
    }

    /// Gives what was made, with the look and the colours that the project asks for, and its options of
    /// formats.
    ///
    /// # Errors
    /// The style file or the colours cannot be read.
    pub fn with_product<T>(
        &self,
        project: &Project,
        output: &Output,
        give: impl FnOnce(Product<'_>, FormatOptions) -> T,
    ) -> Result<T, AppError> {
        let choice = Choice::new(Some(project), &[])?.files(&self.source)?;
        let painting =
            choice.is_coloured.then(|| input::read_painting_by(&*self.fetch, &self.mesh_path)).transpose()?;
        let warnings: Vec<Warning> = self.repairs.warnings().into_iter().map(Warning::from).collect();
        let mesh_path = self.mesh_path.to_string_lossy();
        let run = Run {
            path: &mesh_path,
            repairs: &self.repairs,
            stages: &[],
            warnings: &warnings,
            say: words::warning,
        };
        let title = self.title();
        let product = Product::new(output, &title, run).with_styles(choice.styles);
        Ok(give(product.with_painting(painting.as_ref()), choice.formats))
    }

    /// The colours of the mesh.
    ///
    /// # Errors
    /// It has none, or they cannot be read.
    pub fn painting(&self) -> Result<Painting, String> {
        input::read_painting_by(&*self.fetch, &self.mesh_path).map_err(|error| words::error(&error))
    }

    /// The title of what is made: the file's name without its extension.
    pub fn title(&self) -> String {
        let stem = self.source.file_stem().unwrap_or_default();
        crate::app::text::printable(&stem.to_string_lossy())
    }
}
