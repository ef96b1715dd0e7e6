//! `tatamu make`

use super::choice::Choice;
use super::error::CliError;
use super::flags::{Flags, OfFiles, OfFilm, OfMachine, OfModel};
use super::guide::GuideArgs;
use super::made::Made;
use super::output::{self, Target};
use super::progress::TerminalProgress;
use super::{batch, formats, input, names, terminal};
use clap::Args;
use std::path::{Path, PathBuf};
use tatamu::export::{FormatOptions, Source};
use tatamu::mesh::{Mesh, Repairs};
use tatamu::net::Side;
use tatamu::product::{Content, Product};
use tatamu::project::options::Given;
use tatamu::report::Run;

/// Makes a model of a mesh, or of a project file.
///
/// The mesh is divided into components; each of them becomes a convex solid that folds flat; the
/// nets of all of them are laid out on sheets of paper.
#[derive(Debug, Args)]
#[command(after_help = after_help())]
pub struct MakeArgs {
    /// Mesh (OBJ, STL, PLY, OFF, glTF, GLB) or project file (TOML); may be several
    ///
    /// The format is found from the content, whatever the file's name. Open borders, edges of more
    /// than two faces and several bodies are accepted with a warning. Several inputs are made at
    /// the same time, each as it would be alone; one that fails does not stop the others.
    #[arg(value_name = "INPUT", required = true)]
    inputs: Vec<PathBuf>,

    #[command(flatten)]
    model: Flags<OfModel>,

    /// File to write; may be given several times [default: the input's name with .pdf]
    ///
    /// The extension chooses the format; the end of this page lists them. An existing file is
    /// replaced, but only when the new one is complete. {name} stands for the input's name without
    /// its extension; a folder, or a name that ends in a slash, gets a PDF of that name.
    /// Example: -o teddy.pdf -o teddy.json, -o 'models/{name}.svg', -o models/
    #[arg(short, long = "output", value_name = "FILE")]
    output: Vec<PathBuf>,

    #[command(flatten)]
    guide: GuideArgs,

    #[command(flatten)]
    film: Flags<OfFilm>,

    /// Writes what is printed and what is cut into two files, NAME-print and NAME-cut
    ///
    /// Both have the same pages with the same origin. NAME-cut holds contours, slits and creases;
    /// NAME-print holds labels, glue marks, scale bars and registration marks. Formats that are
    /// no pages are written once. Example: --print-and-cut --marks silhouette -o teddy.svg
    #[arg(long)]
    print_and_cut: bool,

    /// File for the segmentation: one number a line
    ///
    /// For each face of the input file, in its order, the index of its component from 0; -1 for
    /// a face that was dropped in the repair, or whose part has no volume. {name} and folders as
    /// with -o. Example: --segments teddy.seg
    #[arg(long, value_name = "FILE")]
    segments: Option<PathBuf>,

    #[command(flatten)]
    files: Flags<OfFiles>,

    #[command(flatten)]
    machine: Flags<OfMachine>,

    /// No summary and no progress bar; warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

impl MakeArgs {
    /// The meshes and project files.
    pub fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }

    /// Whether only warnings and errors are told.
    pub fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// The options that the user gave.
    pub fn given(&self) -> Vec<Given> {
        let lists = [
            self.model.given(),
            self.guide.given(),
            self.film.given(),
            self.files.given(),
            self.machine.given(),
        ];
        lists.concat()
    }
}

const EXAMPLES: &str = "\
Examples:
  tatamu make teddy.obj
  tatamu make teddy.obj -o teddy.pdf --guide teddy.html
  tatamu make teddy.obj --size 30cm --paper a3 -o teddy.pdf -o teddy.json
  tatamu make bunny.stl --up z --parts 5 --top-edges 8
  tatamu make teddy.obj bunny.stl -o models/
  tatamu make *.obj --size 30cm -o 'models/{name}.svg' --guide 'models/{name}.html'
  tatamu make teddy.toml --direction head=90";

fn after_help() -> String {
    format!("{}\n{EXAMPLES}", formats::list())
}

/// Runs the command.
pub fn run(args: &MakeArgs) -> Result<(), CliError> {
    let [input] = args.inputs() else { return batch::run(args) };
    let progress = TerminalProgress::new(args.quiet);
    let tell = |warning: &str| terminal::complain("warning", warning);
    let made = make(args, Task::new(args, input)?, &progress, &tell)?;
    output::write(&made.files)?;
    if !args.quiet {
        made.summary.iter().for_each(|line| terminal::say(line));
    }
    Ok(())
}

/// One input, and the files to make of it.
pub struct Task<'a> {
    /// The mesh or project file.
    pub input: &'a Path,
    targets: Vec<Target>,
    segments: Option<PathBuf>,
}

impl<'a> Task<'a> {
    /// What is asked for of one of the inputs.
    pub fn new(args: &MakeArgs, input: &'a Path) -> Result<Self, CliError> {
        let targets = args.guide.targets(input, &args.output)?;
        let segments = args.segments.as_ref().map(|path| names::for_input(path, input, "seg"));
        Ok(Self { input, targets, segments })
    }

    /// The names that the user gave; sheets may get numbers.
    pub fn places(&self) -> Vec<PathBuf> {
        self.targets.iter().map(|target| &target.path).chain(&self.segments).cloned().collect()
    }
}

/// Makes the model of one input, and the content of its files. Warnings are told as they come.
pub fn make(
    args: &MakeArgs,
    task: Task<'_>,
    progress: &TerminalProgress,
    tell: &dyn Fn(&str),
) -> Result<Made, CliError> {
    let places = task.places();
    output::check_places(&places, &[task.input])?;
    let input = input::read(task.input)?;
    output::check_places(&places, &[task.input, &input.mesh_path])?;
    let choice = Choice::new(input.project.as_ref(), &args.given())?;
    let files = choice.files(task.input)?;
    if files.is_coloured && choice.options().sheets.side == Side::Inside {
        let reason = "--color is for the outside of the paper; leave out --side inside, or --color";
        return Err(CliError::Options(reason.to_owned()));
    }
    let painting = files.is_coloured.then(|| input::read_painting(&input.mesh_path)).transpose()?;
    let warnings = input.warnings();
    warnings.iter().for_each(|warning| tell(&warning.message));

    let result = input.run_and_advise(&choice, progress)?;
    let stages = progress.finish();
    terminal::first_of_each_kind(result.warnings()).iter().for_each(|message| tell(message));

    let stem = task.input.file_stem().unwrap_or_default();
    let run = Run {
        path: &input.mesh_path.to_string_lossy(),
        repairs: &input.repairs,
        stages: &stages,
        warnings: &warnings,
    };
    let title = terminal::printable(&stem.to_string_lossy());
    let product = |content| {
        Product::new(&result, &title, run)
            .with_styles(files.styles.clone())
            .with_painting(painting.as_ref())
            .with_content(content)
    };
    let products = match args.print_and_cut {
        false => vec![("", product(Content::All))],
        true => vec![("-print", product(Content::Print)), ("-cut", product(Content::Cut))],
    };
    let mut written = written(task.targets, &products, &files.formats)?;
    if let Some(path) = task.segments {
        written.push((path, segments(result.mesh(), result.face_parts(), &input.repairs)));
    }
    Ok(Made::new(&result, written))
}

/// The files of all targets; pages of each product, all else of the first.
pub fn written(
    targets: Vec<Target>,
    products: &[(&str, Product<'_>)],
    formats: &FormatOptions,
) -> Result<Vec<(PathBuf, Vec<u8>)>, CliError> {
    let mut files = Vec::new();
    for target in targets {
        let is_paged = matches!(target.format.source, Source::Pages(_));
        for (name, product) in if is_paged { products } else { &products[..1] } {
            let name = if is_paged { name } else { "" };
            for file in target.format.write(product, formats)? {
                let suffix = format!("{name}{}", file.suffix);
                files.push((names::with_suffix(&target.path, &suffix), file.bytes));
            }
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
