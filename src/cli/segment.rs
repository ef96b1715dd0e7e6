//! `tatamu segment`

use super::flags::{Flags, OfDivision};
use super::progress::TerminalProgress;
use super::terminal;
use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::make::Timed;
use crate::app::sources::Sources;
use crate::app::{input, make, output};
use clap::Args;
use std::path::{Path, PathBuf};
use tatamu::export::png;
use tatamu::geom::Hull;
use tatamu::parts_report::{self, PartsRun};
use tatamu::pipeline;
use tatamu::progress::Progress;
use tatamu::render::parts_picture;
use tatamu::segment::{Overlap, Parts, overlap};

/// Divides a mesh into parts and shows them, without making a model.
///
/// Each part becomes one component of the model. The picture shows the parts from two sides, with
/// colours and names. Use the names in a project file to merge, split and rename parts. --up rotates
/// only the picture.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct SegmentCommand {
    /// Mesh (OBJ, STL, PLY, OFF, glTF, GLB, 3MF) or project file (TOML)
    ///
    /// The parts include the merges and splits of a project file.
    #[arg(value_name = "INPUT")]
    input: PathBuf,

    /// Picture to write, a PNG file
    ///
    /// An existing file is replaced. Example: -o parts.png
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,

    /// Writes the part of each face to a text file, one number per line
    ///
    /// One line per face of the input, in its order: the index of its part, from 0, or -1 if the
    /// repair dropped the face. Example: --segments teddy.seg
    #[arg(long, value_name = "FILE")]
    segments: Option<PathBuf>,

    /// Writes a JSON report: parts, borders with their planes, seconds per step
    ///
    /// Example: --report parts.json
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,

    #[command(flatten)]
    division: Flags<OfDivision>,

    /// Prints warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  tatamu segment teddy.obj -o parts.png
  tatamu segment teddy.obj --parts 6 -o parts.png --report parts.json
  tatamu segment teddy.toml -o parts.png";

const DOTS_PER_INCH: f64 = 130.0;

/// Runs the command.
pub fn run(args: &SegmentCommand) -> Result<(), AppError> {
    if let Some(path) = args.output.as_ref().filter(|p| !is_png(p)) {
        return Err(AppError::Extension { path: path.clone(), known: ".png".to_owned() });
    }
    let places: Vec<PathBuf> =
        [&args.output, &args.segments, &args.report].into_iter().flatten().cloned().collect();
    let sources = Sources::of([args.input.as_path()]);
    output::check_places(&places, &sources)?;
    let input = input::read(&args.input)?;
    let choice = Choice::of_input(&input, args.division.given())?;
    input.warnings().iter().for_each(terminal::warn);

    let progress = TerminalProgress::new(args.quiet);
    let (parts, _) = pipeline::find_parts(input.mesh()?, choice.options(), &progress)
        .map_err(|error| AppError::of_run(error, &progress))?;
    progress.stage("hulls");
    let hulls: Vec<Option<Hull>> = parts.solids().hulls.into_iter().map(Result::ok).collect();
    progress.stage("overlap");
    let overlap = overlap(parts.mesh(), hulls.iter().flatten());
    let mut files = Vec::new();
    if let Some(path) = &args.output {
        progress.stage("picture");
        files.push((path.clone(), draw(&parts, path)?));
    }
    let stages = progress.finish();
    if let Some(path) = &args.segments {
        let labels: Vec<Option<u32>> =
            parts.segmentation().face_segments().iter().map(|id| Some(id.0)).collect();
        files.push((path.clone(), make::segments(parts.mesh(), &labels, &input.repairs)));
    }
    if let Some(path) = &args.report {
        let mesh_path = input.mesh_path.to_string_lossy();
        let run = PartsRun { path: &mesh_path, hulls: &hulls, overlap, stages: &stages };
        let bytes = parts_report::to_json(&parts, &run)
            .map_err(|error| AppError::Output { path: path.clone(), reason: error.to_string() })?;
        files.push((path.clone(), bytes));
    }
    output::write(&files, &sources)?;
    if !args.quiet {
        summarise(&parts, overlap, &stages);
        let written: Vec<String> = files.iter().map(|(path, _)| path.display().to_string()).collect();
        if !written.is_empty() {
            terminal::say(&format!("written     {}", written.join(", ")));
        }
    }
    Ok(())
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"))
}

fn draw(parts: &Parts, path: &Path) -> Result<Vec<u8>, AppError> {
    let refuse = |reason: String| AppError::Output { path: path.to_owned(), reason };
    let labels: Vec<u32> = parts.segmentation().face_segments().iter().map(|id| id.0).collect();
    let drawing =
        parts_picture(parts.mesh(), &labels, parts.names()).map_err(|error| refuse(error.to_string()))?;
    png::render(&drawing, DOTS_PER_INCH).map_err(|error| refuse(error.to_string()))
}

fn summarise(parts: &Parts, overlap: Option<Overlap>, stages: &[(&'static str, f64)]) {
    let shares = parts.names().iter().zip(parts.area_shares());
    let shares: Vec<String> = shares.map(|(name, share)| format!("{name} {:.0}%", 100.0 * share)).collect();
    terminal::say(&format!(
        "parts       {}, with their share of the surface: {}",
        shares.len(),
        shares.join(", ")
    ));
    let likeness = match overlap {
        Some(o) => format!("{:.3} (intersection over union of the hulls and the solid)", o.iou),
        None => "unknown: the mesh encloses no volume".to_owned(),
    };
    terminal::say(&format!("likeness    {likeness}"));
    let steps: Vec<String> = stages.iter().map(|(name, s)| format!("{name} {s:.2}")).collect();
    terminal::say(&format!("seconds     {}", steps.join(", ")));
}
