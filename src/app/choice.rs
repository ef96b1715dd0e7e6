//! What is chosen for an input: flags first, then its project file, then the defaults.

use super::error::AppError;
use super::input::{Input, InputShape};
use super::{files, locale, profiles};
use std::collections::BTreeMap;
use std::path::Path;
use tatamu::drawing::{Layer, LineStyles};
use tatamu::export::{FormatOptions, PltOptions, Timestamp};
use tatamu::mesh::Mesh;
use tatamu::pipeline::{Options, usual_size_mm};
use tatamu::product::Content;
use tatamu::project::options::{Entry, Given, SIZE, STYLE, Settings};
use tatamu::project::{Project, choose_on};

/// What is chosen for an input.
#[derive(Clone)]
pub struct Choice {
    settings: Settings,
    is_sized: bool,
    is_style_of_flag: bool,
}

/// What is chosen about files, with all that was read for it.
pub struct FileChoice {
    /// For the formats.
    pub formats: FormatOptions,
    /// Look of the lines.
    pub styles: LineStyles,
    /// Whether panels have the mesh's colours.
    pub is_coloured: bool,
    /// What is drawn on the pages.
    pub content: Content,
}

impl Choice {
    /// The choice of an input.
    pub fn of_input(input: &Input, flags: &[Given]) -> Result<Self, AppError> {
        let base = match (&input.project, &input.shape) {
            (None, InputShape::Mesh(_)) if flags.iter().any(|flag| flag.option() == &SIZE) => {
                locale::settings()
            }
            (None, InputShape::Mesh(mesh)) => fresh(mesh, locale::settings()),
            _ => Settings::standard().clone(),
        };
        Self::on(base, input.project.as_ref(), flags)
    }

    /// The choice of a project, or of flags alone.
    pub fn new(project: Option<&Project>, flags: &[Given]) -> Result<Self, AppError> {
        Self::on(Settings::standard().clone(), project, flags)
    }

    fn on(base: Settings, project: Option<&Project>, flags: &[Given]) -> Result<Self, AppError> {
        let settings = choose_on(base, project, flags);
        let settings = settings.map_err(|refusal| AppError::Options(refusal.to_string()))?;
        let is_flag = |option: &Entry| flags.iter().any(|flag| flag.option() == option);
        let is_sized = is_flag(&SIZE) || project.is_some_and(|project| project.has(&SIZE));
        Ok(Self { settings, is_sized, is_style_of_flag: is_flag(&STYLE) })
    }

    /// All of it.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The same at another size, mm.
    pub fn resized(mut self, size_mm: f64) -> Self {
        self.settings.model.size_mm = size_mm;
        self.is_sized = true;
        self
    }

    /// The same for any number of sheets.
    pub fn of_any_sheets(mut self) -> Self {
        self.settings.most_sheets = None;
        self
    }

    /// The same with colours of card for components of these names that have none.
    pub fn with_cards(mut self, cards: BTreeMap<String, &'static str>) -> Self {
        let components = &mut self.settings.model.components;
        for (name, card) in cards {
            // Tables of a project may rename their component.
            let renamed = components.iter().find(|(_, own)| own.rename.as_ref() == Some(&name));
            let key = renamed.map(|(key, _)| key.clone()).unwrap_or(name);
            components.entry(key).or_default().card.get_or_insert_with(|| card.to_owned());
        }
        self
    }

    /// The options of the model.
    pub fn options(&self) -> &Options {
        &self.settings.model
    }

    /// The size that the user chose, mm; drawings have their own.
    pub fn size_mm(&self) -> Option<f64> {
        self.is_sized.then_some(self.settings.model.size_mm)
    }

    /// The machine.
    pub fn machine(&self) -> Result<PltOptions, AppError> {
        let files = &self.settings.files;
        profiles::machine(files.cutter.as_deref(), files.media.as_deref())
    }

    /// The choices about files of an input, whose project file, if it is one, is at `input_path`.
    pub fn files(&self, input_path: &Path) -> Result<FileChoice, AppError> {
        let files = &self.settings.files;
        let mut formats = files.formats.clone();
        let pdf = formats.pdf.with_created(source_date()?);
        formats.pdf = pdf.with_tile(files.tile).map_err(AppError::Options)?;
        formats.plt = self.machine()?;
        let styles = match &files.style {
            Some(name) if self.is_style_of_flag => styles(name, Path::new(name))?,
            Some(name) => styles(name, &input_path.with_file_name(name))?,
            None => LineStyles::standard(),
        };
        let styles = if files.has_plain_tabs { styles.with_plain(Layer::Tab) } else { styles };
        let content = match files.program {
            Some(program) if program.is_job => Content::Job,
            _ => Content::All,
        };
        Ok(FileChoice { formats, styles, is_coloured: files.is_coloured, content })
    }
}

/// The settings of a mesh without a project: these, with the size that suits its shape. A project gives the same
/// result everywhere; a mesh is for the user's own printer.
pub fn fresh(mesh: &Mesh, mut settings: Settings) -> Settings {
    settings.model.size_mm = usual_size_mm(mesh);
    settings
}

/// The built-in style of this name, or the file at `path`.
fn styles(name: &str, path: &Path) -> Result<LineStyles, AppError> {
    if let Some(styles) = LineStyles::built_in(name) {
        return Ok(styles);
    }
    if !path.exists() {
        return Err(AppError::Options(format!(
            "there is no style file {}, and no built-in style of that name; built-in styles are: {}",
            path.display(),
            style_names()
        )));
    }
    let text = files::read_text(path, "style file")?;
    LineStyles::parse(&text).map_err(|error| AppError::Style { path: path.to_owned(), error })
}

/// Names of the built-in styles.
pub fn style_names() -> String {
    LineStyles::BUILT_IN.map(|(name, _)| name).join(", ")
}

/// The date of reproducible builds (<https://reproducible-builds.org/specs/source-date-epoch/>).
fn source_date() -> Result<Option<Timestamp>, AppError> {
    let Some(value) = std::env::var_os("SOURCE_DATE_EPOCH") else {
        return Ok(None);
    };
    let text = value.to_string_lossy();
    let date = text.parse().ok().and_then(Timestamp::of_unix);
    date.map(Some).ok_or_else(|| {
        let message =
            "the environment variable SOURCE_DATE_EPOCH must be a whole number of seconds since 1970, not";
        AppError::Options(format!("{message} \"{text}\""))
    })
}
