//! `tatamu make`

use super::cutters::CutterArgs;
use super::error::CliError;
use super::film::FilmArgs;
use super::formats::{self, FileArgs};
use super::guide::GuideArgs;
use super::options::ModelArgs;
use super::output::{self, Target};
use super::progress::TerminalProgress;
use super::{input, terminal};
use clap::Args;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tatamu::export::{FormatOptions, Source};
use tatamu::fold::Stack;
use tatamu::mesh::{Mesh, Repairs};
use tatamu::net::Side;
use tatamu::pipeline::{Output, Warning};
use tatamu::product::{self, Content, Product};
use tatamu::report::Run;

/// Makes a model of a mesh, or of a project file.
///
/// The mesh is divided into components; each of them becomes a convex solid that folds flat; the
/// nets of all of them are laid out on sheets of paper.
#[derive(Debug, Args)]
#[command(after_help = after_help())]
pub struct MakeArgs {
    /// Mesh (OBJ, STL, PLY, OFF, glTF, GLB) or project file (TOML)
    ///
    /// The format is found from the content, whatever the file's name. Open borders, edges of more
    /// than two faces and several bodies are accepted with a warning.
    #[arg(value_name = "INPUT")]
    input: PathBuf,

    #[command(flatten)]
    model: ModelArgs,

    /// File to write; may be given several times [default: the input's name with .pdf]
    ///
    /// The extension chooses the format; the end of this page lists them. An existing file is
    /// replaced, but only when the new one is complete. Example: -o teddy.pdf -o teddy.json
    #[arg(short, long = "output", value_name = "FILE")]
    output: Vec<PathBuf>,

    #[command(flatten)]
    guide: GuideArgs,

    #[command(flatten)]
    film: FilmArgs,

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
    /// a face that was dropped in the repair, or whose part has no volume.
    /// Example: --segments teddy.seg
    #[arg(long, value_name = "FILE")]
    segments: Option<PathBuf>,

    #[command(flatten)]
    files: FileArgs,

    #[command(flatten)]
    cutter: CutterArgs,

    /// No summary and no progress bar; warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

impl MakeArgs {
    /// The mesh or project file.
    pub fn input(&self) -> &Path {
        &self.input
    }

    /// Options of the model.
    pub fn model(&self) -> &ModelArgs {
        &self.model
    }
}

/// So many warnings of one kind are shown; a small model with many labels has dozens.
const MOST_OF_A_KIND: usize = 4;

const EXAMPLES: &str = "\
Examples:
  tatamu make teddy.obj
  tatamu make teddy.obj -o teddy.pdf --guide teddy.html
  tatamu make teddy.obj --size 30cm --paper a3 -o teddy.pdf -o teddy.json
  tatamu make bunny.stl --up z --parts 5 --top-edges 8
  tatamu make teddy.toml --direction head=90";

fn after_help() -> String {
    format!("{}\n{EXAMPLES}", formats::list())
}

/// Runs the command.
pub fn run(args: &MakeArgs) -> Result<(), CliError> {
    let targets = args.guide.targets(&args.input, &args.output)?;
    let paths: Vec<PathBuf> = targets.iter().map(|target| target.path.clone()).collect();
    output::check_places(&paths, &[&args.input])?;
    let input = input::read(&args.input)?;
    let places: Vec<PathBuf> = paths.iter().chain(&args.segments).cloned().collect();
    output::check_places(&places, &[&args.input, &input.mesh_path])?;
    let options = args.model.merge(input.project.as_ref())?;
    let mut choice = args.files.merge(input.project.as_ref().map(|p| &p.export), &args.input)?;
    if choice.is_coloured && options.sheets.side == Side::Inside {
        let reason = "--color is for the outside of the paper; leave out --side inside, or --color";
        return Err(CliError::Options(reason.to_owned()));
    }
    let painting = choice.is_coloured.then(|| input::read_painting(&input.mesh_path)).transpose()?;
    choice.formats.plt = args.cutter.choice()?;
    let warnings = repair_warnings(&input.repairs);
    warnings.iter().for_each(warn);

    let progress = TerminalProgress::new(args.quiet);
    let result = input.run(&args.model, &options, &progress)?;
    let stages = progress.finish();
    warn_by_kind(result.warnings());

    let stem = args.input.file_stem().unwrap_or_default();
    let run = Run {
        path: &input.mesh_path.to_string_lossy(),
        repairs: &input.repairs,
        stages: &stages,
        warnings: &warnings,
    };
    let title = terminal::printable(&stem.to_string_lossy());
    let product = |content| {
        Product::new(&result, &title, run)
            .with_styles(choice.styles.clone())
            .with_painting(painting.as_ref())
            .with_content(content)
    };
    let products = match args.print_and_cut {
        false => vec![("", product(Content::All))],
        true => vec![("-print", product(Content::Print)), ("-cut", product(Content::Cut))],
    };
    let formats = args.guide.choose(choice.formats, input.project.as_ref().map(|p| &p.export));
    let formats = args.film.choose(formats)?;
    let mut files = written(targets, &products, &formats)?;
    if let Some(path) = &args.segments {
        files.push((path.clone(), segments(result.mesh(), result.face_parts(), &input.repairs)));
    }
    output::write(&files)?;
    if !args.quiet {
        summarise(&result, &files);
    }
    Ok(())
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
                files.push((output::with_suffix(&target.path, &suffix), file.bytes));
            }
        }
    }
    Ok(files)
}

/// What the repair found and did, as warnings.
pub fn repair_warnings(repairs: &Repairs) -> Vec<Warning> {
    let bodies = repairs.components.saturating_sub(1);
    let counts = [
        (repairs.boundary_edges, "open_edges", "open edges", "thickness near them is a guess"),
        (
            repairs.non_manifold_edges,
            "non_manifold_edges",
            "edges with more than two faces",
            "components may be divided there",
        ),
        (bodies, "several_bodies", "bodies besides the first", "joined where they touch"),
        (repairs.degenerate_faces, "degenerate_faces", "faces without area", "dropped"),
        (repairs.duplicate_faces, "duplicate_faces", "repeated faces", "dropped"),
        (repairs.flipped_faces, "flipped_faces", "faces that faced inwards", "turned"),
    ];
    counts
        .iter()
        .filter(|(count, ..)| *count > 0)
        .map(|(count, code, what, effect)| Warning {
            code,
            message: format!("the mesh has {what}: {count} ({effect})"),
        })
        .collect()
}

/// Shows a warning.
pub fn warn(warning: &Warning) {
    terminal::complain("warning", &warning.message);
}

/// Shows the first few warnings of each kind, and counts the others.
pub fn warn_by_kind(warnings: &[Warning]) {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for warning in warnings {
        let count = counts.entry(warning.code).or_default();
        *count += 1;
        if *count <= MOST_OF_A_KIND {
            warn(warning);
        }
    }
    for (code, count) in counts.into_iter().filter(|(_, count)| *count > MOST_OF_A_KIND) {
        let more = count - MOST_OF_A_KIND;
        terminal::complain(
            "warning",
            &format!("{more} more like these ({code}); -o FILE.json writes a report with all of them"),
        );
    }
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

/// The flat model, and the order of folding.
fn folding(result: &Output) -> String {
    let plan = result.fold_plan();
    let parts = result.model().parts();
    let order: Vec<&str> = plan.order().iter().map(|&p| parts[p].name.as_str()).collect();
    let flat = |s: &Stack| format!("{:.0} × {:.0} mm, {} layers", s.size_mm.x, s.size_mm.y, s.layers);
    let sizes: Vec<String> = plan.stacks().iter().map(flat).collect();
    format!("to {}, in the order {}", sizes.join(" and "), order.join(", "))
}

fn summarise(result: &Output, files: &[(PathBuf, Vec<u8>)]) {
    let names: Vec<&str> = result.model().parts().iter().map(|p| p.name.as_str()).collect();
    let pieces: usize = result.nets().iter().map(|net| net.pieces().len()).sum();
    let layout = result.layout();
    let written: Vec<String> = files.iter().map(|(path, _)| path.display().to_string()).collect();
    terminal::say(&format!("size        {}", product::size_note(result)));
    terminal::say(&format!("components  {}: {}", names.len(), names.join(", ")));
    terminal::say(&format!("folds       {}", folding(result)));
    result.remarks().iter().for_each(|remark| terminal::say(&format!("note        {remark}")));
    terminal::say(&format!("pieces      {pieces}"));
    terminal::say(&format!(
        "sheets      {} of {}, {:.0}% used",
        layout.sheet_count(),
        layout.options().paper.name(),
        100.0 * layout.utilisation()
    ));
    terminal::say(&format!("written     {}", written.join(", ")));
}
