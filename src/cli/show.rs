//! `tatamu show`

use super::flags::{Flags, OfModel};
use super::progress::TerminalProgress;
use super::{terminal, words};
use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::fit::fitted;
use crate::app::make::Timed;
use crate::app::sources::Sources;
use crate::app::text::printable;
use crate::app::{input, names, output};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use tatamu::drawing::{Drawing, LineStyles, Pages, Rgb};
use tatamu::export::{ExportError, ExportFile, FormatOptions, png};
use tatamu::fold::ModelMotion;
use tatamu::pipeline::Output;
use tatamu::render::Scene;
use tatamu::show::{
    FilmOptions, ShowError, Still, ViewAngle, captioned, clash_picture, components_scene, hulls_scene,
    mesh_scene, segments_scene, staged_scene,
};

/// Draws a mesh, a paper model, or a stage between them.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ShowArgs {
    /// Mesh (OBJ, STL, PLY, OFF, glTF, GLB, 3MF) or project file (TOML)
    #[arg(value_name = "INPUT")]
    input: PathBuf,

    /// Picture to write: .png, .svg, .pdf or .dxf [default: the input's name with .png]
    ///
    /// Example: -o half.png
    #[arg(short, long = "output", value_name = "FILE")]
    output: Option<PathBuf>,

    /// Stage to draw [default: components]
    ///
    /// mesh: the input; segments: its parts; hulls: the convex hull of each part; components: the
    /// paper model; flat: the paper model folded flat. Meshes of more than 50,000 faces are
    /// simplified for the picture. Example: --stage hulls
    #[arg(long, value_name = "STAGE", value_enum)]
    stage: Option<Stage>,

    /// How far the model is folded, from 0 (unfolded) to 1 (flat)
    ///
    /// Components fold one after another, in the order that "make" reports. Example: --pose 0.5
    #[arg(long, value_name = "SHARE", value_parser = share, conflicts_with = "stage")]
    pose: Option<f64>,

    /// Draws each place where components clash or overlap
    ///
    /// The place is red, the two components have their own colours, and a caption says what to do.
    /// Several pictures become numbered files, or pages of a PDF. If nothing clashes, the picture
    /// shows the paper model. Example: --clashes -o clashes.png
    #[arg(long, conflicts_with_all = ["stage", "pose"])]
    clashes: bool,

    /// Camera: a side or two angles [default: corner; with --clashes: the best view of the place]
    ///
    /// corner, front, back, left, right, top, or two angles in degrees: around the model from its
    /// front to its left, then up. Example: --view 30,20
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    view: Option<ViewAngle>,

    /// Longer side in pixels [default: 800]
    ///
    /// In SVG and PDF, 96 pixels are one inch. Example: --size-px 1600
    #[arg(long, value_name = "PIXELS", value_parser = size_px)]
    size_px: Option<u32>,

    /// Leaves out the ground and the shadow
    ///
    /// For pictures on a background of your own.
    #[arg(long)]
    transparent: bool,

    #[command(flatten)]
    model: Flags<OfModel>,

    /// Prints warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

/// What there is to see.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Stage {
    Mesh,
    Segments,
    Hulls,
    Components,
    Flat,
}

const EXAMPLES: &str = "\
Examples:
  tatamu show teddy.obj                                teddy.png, the paper model
  tatamu show teddy.obj --stage segments -o parts.svg
  tatamu show teddy.obj --pose 0.5 --view left -o half.png
  tatamu show teddy.obj --clashes -o clashes.png";

const SIZE_PX: u32 = 800;

fn size_px(text: &str) -> Result<u32, String> {
    let size_px = text.trim().parse().map_err(|_| "this must be a whole number such as 640".to_owned())?;
    FilmOptions::default().with_size_px(size_px).map(|_| size_px)
}

fn share(text: &str) -> Result<f64, String> {
    let share: Option<f64> = text.trim().parse().ok();
    let share = share.filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "this must be a number from 0 (unfolded) to 1 (flat)".to_owned())
}

/// Runs the command.
pub fn run(args: &ShowArgs) -> Result<(), AppError> {
    let path = args.output.clone().unwrap_or_else(|| {
        let mut name = args.input.file_stem().unwrap_or("model".as_ref()).to_owned();
        name.push(".png");
        PathBuf::from(name)
    });
    let write = format_of(&path)?;
    let sources = Sources::of([args.input.as_path()]);
    output::check_places(std::slice::from_ref(&path), &sources)?;
    let input = input::read(&args.input)?;
    input.notes.iter().for_each(terminal::warn);
    let choice = Choice::of_input(&input, args.model.given())?;
    let options = choice.options();
    let still = Still {
        size_px: args.size_px.unwrap_or(SIZE_PX),
        angle: args.view.unwrap_or_default(),
        ground: (!args.transparent).then_some(Rgb::WHITE),
    };
    let drawings = if args.stage == Some(Stage::Mesh) {
        let mesh = input.mesh()?.scaled(options.size_mm, options.up).0;
        vec![still.take(&mesh_scene(&mesh).map_err(ShowError::from)?)?]
    } else {
        let progress = TerminalProgress::new(args.quiet);
        let (_, result) = fitted(&input, choice, &progress)?;
        progress.finish();
        if args.clashes { clashes(args, &still, &result)? } else { vec![still.take(&scene(args, &result)?)?] }
    };
    let title = printable(&args.input.file_stem().unwrap_or_default().to_string_lossy());
    let files = write(title, drawings)?.into_iter();
    let files: Vec<_> = files.map(|file| (names::with_suffix(&path, &file.suffix), file.bytes)).collect();
    output::write(&files, &sources)?;
    if !args.quiet {
        let written: Vec<String> = files.iter().map(|(path, _)| path.display().to_string()).collect();
        let line = format!("written     {}", written.join(", "));
        terminal::say_of_files(files.iter().map(|(path, _)| path.as_path()), &line);
    }
    Ok(())
}

/// A picture of each place where components clash or overlap. Without any, a picture of the model, so
/// that no picture of an earlier run stays in its place.
fn clashes(args: &ShowArgs, still: &Still, result: &Output) -> Result<Vec<Drawing>, AppError> {
    let motion = ModelMotion::new(result.model());
    let encounters = result.fold_plan().encounters(&motion);
    if encounters.is_empty() {
        if !args.quiet {
            terminal::say("clashes     none; the picture shows the model");
        }
        return Ok(vec![still.take(&components_scene(result.model()))?]);
    }
    let drawn = |encounter| {
        let drawing = clash_picture(&motion, encounter, args.view, still.landscape_mm())?;
        let captioned = captioned(drawing, &words::warning(&encounter.warning(result.model()).into()));
        Ok(Drawing { ground: still.ground, ..captioned })
    };
    encounters.iter().map(drawn).collect()
}

fn scene(args: &ShowArgs, result: &Output) -> Result<Scene, ShowError> {
    Ok(match (args.pose, args.stage) {
        (Some(pose), _) => staged_scene(result, pose),
        (None, Some(Stage::Mesh)) => mesh_scene(result.mesh())?,
        (None, Some(Stage::Segments)) => segments_scene(result)?,
        (None, Some(Stage::Hulls)) => hulls_scene(result)?,
        (None, Some(Stage::Flat)) => staged_scene(result, 1.0),
        (None, Some(Stage::Components) | None) => components_scene(result.model()),
    })
}

/// Turns pictures into files.
type Writer = Box<dyn Fn(String, Vec<Drawing>) -> Result<Vec<ExportFile>, AppError>>;

/// The writer for a file name.
fn format_of(path: &std::path::Path) -> Result<Writer, AppError> {
    let (format, write) = output::picture(path)?;
    let is_png = format.name == png::FORMAT.name;
    Ok(Box::new(move |title, drawings| {
        if is_png {
            // A picture is measured in pixels, whatever the resolution of sheets.
            let pixels = drawings.iter().map(|drawing| png::render(drawing, Still::dots_per_inch()));
            return Ok(ExportFile::of_pages(pixels.collect::<Result<_, _>>().map_err(ShowError::from)?));
        }
        let pages = Pages::new(title, drawings, LineStyles::standard()).map_err(ExportError::from)?;
        Ok(write(&pages, &FormatOptions::default())?)
    }))
}
