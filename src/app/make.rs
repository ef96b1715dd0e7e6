//! Making the files of one input.

use super::choice::Choice;
use super::error::AppError;
use super::fit::fitted_and_advised;
use super::made::Made;
use super::output::{self, Target};
use super::sources::Sources;
use super::words::Say;
use super::{input, names, soundness, text};
use std::path::{Path, PathBuf};
use tatamu::export::{FORMATS, Format, FormatOptions, GUIDES, Source, format_among};
use tatamu::mesh::{Mesh, Repairs};
use tatamu::net::Side;
use tatamu::product::{Content, Product, Selection};
use tatamu::progress::Progress;
use tatamu::project::options::{FOR, Given, Program, Settings};
use tatamu::report::Run;

/// Progress that knows how long the stages took.
pub trait Timed: Progress {
    /// The work is over; gives the name and duration of each stage, in seconds.
    fn finish(&self) -> Vec<(&'static str, f64)>;
}

/// Which file is to be a guide.
#[derive(Debug, Clone)]
pub enum Guide {
    /// Those of the outputs.
    Outputs,
    /// This one.
    File(PathBuf),
}

/// More sheets are written only if that is asked for: a box of 900 mm takes 192 of A4.
pub const MOST_SHEETS: usize = 200;

/// What to do for the sheets where all files are guides.
const GUIDES_ALONE: &str = "for the sheets, too, give them and the guide a file each";

/// What is asked for of all inputs.
pub struct Wish {
    /// The options that the user gave.
    pub given: Vec<Given>,
    /// Names of files, or patterns of names.
    pub outputs: Vec<PathBuf>,
    /// Guides.
    pub guides: Vec<Guide>,
    /// Name of a file for the segmentation.
    pub segments: Option<PathBuf>,
    /// Whether what is printed and what is cut go into files of their own.
    pub prints_and_cuts: bool,
    /// Whether the model may take more than [`MOST_SHEETS`].
    pub takes_any_sheets: bool,
    /// Whether the model is written even if it does not pass its own check.
    pub is_forced: bool,
    /// Which pieces and sheets the files show.
    pub selection: Selection,
}

impl Wish {
    /// The files to write for an input, guides among them.
    fn targets(&self, input: &Path) -> Result<Vec<Target>, AppError> {
        let is_output = self.guides.iter().any(|wanted| matches!(wanted, Guide::Outputs));
        let mut guides: Vec<PathBuf> = Vec::new();
        for wanted in &self.guides {
            match wanted {
                Guide::File(path) => guides.push(names::for_input(path, input, GUIDES[0].extensions[0])),
                Guide::Outputs if self.outputs.is_empty() => {
                    let name = names::default(input, GUIDES[GUIDES.len() - 1].extensions[0]);
                    guides.push(names::with_suffix(&name, "-guide"));
                }
                Guide::Outputs => {}
            }
        }
        let extension = program(&self.given).map_or(FORMATS[0].extensions[0], |program| program.extension);
        let default = [names::default(input, extension)];
        let outputs: Vec<PathBuf> =
            self.outputs.iter().map(|path| names::for_input(path, input, extension)).collect();
        let sheets = if outputs.is_empty() { &default[..] } else { &outputs[..] };
        let lists: &[&'static [Format]] =
            if is_output && !self.outputs.is_empty() { &[GUIDES, FORMATS] } else { &[FORMATS] };
        let mut targets = output::targets_among(sheets, lists)?;
        targets.extend(output::targets_among(&guides, &[GUIDES])?);
        Ok(targets)
    }
}

/// The program that files are asked for.
fn program(given: &[Given]) -> Option<&'static Program> {
    let mut settings = Settings::default();
    let wanted = given.iter().filter(|given| *given.option() == FOR);
    wanted.for_each(|given| {
        // A value that is given is one that is accepted.
        let _ = given.apply(&mut settings);
    });
    settings.files.program
}

/// One input, and the files to make of it.
pub struct Task<'a> {
    /// The mesh or project file.
    pub input: &'a Path,
    targets: Vec<Target>,
    segments: Option<PathBuf>,
    wish: &'a Wish,
}

impl<'a> Task<'a> {
    /// What is asked for of one of the inputs.
    pub fn new(wish: &'a Wish, input: &'a Path) -> Result<Self, AppError> {
        let targets = wish.targets(input)?;
        let segments = wish.segments.as_ref().map(|path| names::for_input(path, input, "seg"));
        Ok(Self { input, targets, segments, wish })
    }

    /// Whether guides take the places of the sheets, which are in no other file.
    fn lacks_sheets(&self) -> bool {
        let is_meant = self.wish.guides.iter().any(|wanted| matches!(wanted, Guide::Outputs));
        let named = |target: &Target| {
            let extension = target.path.extension().unwrap_or_default().to_string_lossy();
            format_among(GUIDES, &extension).is_some()
        };
        is_meant && !self.wish.outputs.is_empty() && self.targets.iter().all(named)
    }

    /// The names that the user gave; sheets may get numbers.
    pub fn places(&self) -> Vec<PathBuf> {
        self.targets.iter().map(|target| &target.path).chain(&self.segments).cloned().collect()
    }
}

/// Makes the model of one input, and the content of its files, which take no place of a source. Warnings are reported
/// as they come.
pub fn make(
    task: Task<'_>,
    sources: &Sources,
    progress: &dyn Timed,
    say: Say,
    tell: &dyn Fn(&str),
) -> Result<Made, AppError> {
    output::check_places(&task.places(), sources)?;
    let input = input::read(task.input)?;
    let choice = Choice::of_input(&input, &task.wish.given)?;
    let files = choice.files(task.input)?;
    let sheets = choice.options().sheets;
    if files.is_coloured && sheets.side == Side::Inside && !sheets.is_duplex {
        return Err(AppError::ColouredInside);
    }
    let painting = files.is_coloured.then(|| input::read_painting(&input.mesh_path)).transpose()?;
    let warnings = input.warnings();
    warnings.iter().for_each(|warning| tell(&say(warning)));

    let (choice, result) = fitted_and_advised(&input, choice, progress)?;
    let sheets = result.layout().sheet_count();
    if sheets > MOST_SHEETS && !task.wish.takes_any_sheets {
        return Err(AppError::TooManySheets { sheets, most: MOST_SHEETS });
    }
    let selection = task.wish.selection.checked(&result).map_err(AppError::Options)?;
    let stages = progress.finish();
    text::first_of_each_kind(result.warnings(), say).iter().for_each(|message| tell(message));

    let stem = names::stem(task.input);
    let run = Run {
        path: &input.mesh_path.to_string_lossy(),
        repairs: &input.repairs,
        stages: &stages,
        warnings: &warnings,
        say,
    };
    let title = text::printable(&stem.to_string_lossy());
    let product = |content| {
        Product::new(&result, &title, run)
            .with_styles(files.styles.clone())
            .with_painting(painting.as_ref())
            .with_content(content)
            .with_selection(selection.clone())
    };
    check_sound(&product(files.content), &files.formats, task.wish.is_forced, tell)?;
    let products = match task.wish.prints_and_cuts {
        false => vec![("", product(files.content))],
        true => vec![("-print", product(Content::Print)), ("-cut", product(Content::Cut))],
    };
    let lacks_sheets = task.lacks_sheets();
    let mut written = written(task.targets, &products, &files.formats)?;
    if let Some(path) = task.segments {
        written.push((path, segments(result.mesh(), result.face_parts(), &input.repairs)));
    }
    let advice = choice.settings().files.program.map(|program| program.advice);
    let advice = advice.or(lacks_sheets.then_some(GUIDES_ALONE));
    Ok(Made::new(&result, input.named_mesh(), written).with_advice(advice))
}

/// Refuses a model that does not pass its own check, or only tells it where it is to be written all the same.
fn check_sound(
    product: &Product<'_>,
    formats: &FormatOptions,
    is_forced: bool,
    tell: &dyn Fn(&str),
) -> Result<(), AppError> {
    soundness::check(product, formats).or_else(|error| match error {
        AppError::Unsound { .. } if is_forced => {
            tell(&error.to_string());
            Ok(())
        }
        error => Err(error),
    })
}

/// The files of all targets; pages of each product, all else of the first.
pub fn written(
    targets: Vec<Target>,
    products: &[(&str, Product<'_>)],
    formats: &FormatOptions,
) -> Result<Vec<(PathBuf, Vec<u8>)>, AppError> {
    let mut files = Vec::new();
    for target in targets {
        let first = files.len();
        let is_paged = matches!(target.format.source, Source::Pages(_));
        for (name, product) in if is_paged { products } else { &products[..1] } {
            let name = if is_paged { name } else { "" };
            for file in target.format.write(product, formats)? {
                let suffix = format!("{name}{}", file.suffix);
                files.push((names::with_suffix(&target.path, &suffix), file.bytes));
            }
        }
        if output::is_standard_output(&target.path) {
            let one_file =
                AppError::Output { path: target.path.clone(), reason: output::ONE_FILE.to_owned() };
            let [(name, _)] = &mut files[first..] else { return Err(one_file) };
            *name = target.path;
        }
    }
    Ok(files)
}

/// One component index a line for each face of the input file, -1 for a dropped one.
pub fn segments(mesh: &Mesh, part_of_face: &[Option<u32>], repairs: &Repairs) -> Vec<u8> {
    let of_input = mesh.labels_of_input(part_of_face, repairs.input_faces);
    let line = |label: Option<u32>| match label {
        Some(label) => format!("{label}\n"),
        None => "-1\n".to_owned(),
    };
    let text: String = of_input.into_iter().map(line).collect();
    text.into_bytes()
}
