//! `tatamu make`

use super::flags::{Flags, OfFiles, OfFilm, OfMachine, OfModel};
use super::guide::GuideArgs;
use super::numbers::whole;
use super::progress::TerminalProgress;
use super::{batch, formats, mistakes, terminal, words};
use crate::app::error::AppError;
use crate::app::make::{Task, Wish, make};
use crate::app::output;
use crate::app::sources::Sources;
use clap::Args;
use std::path::PathBuf;
use tatamu::product::Selection;
use tatamu::sheet::SheetId;

/// Makes a paper model from a mesh or a project file.
///
/// tatamu divides the mesh into parts, makes each part a convex component that folds flat, and
/// arranges the pieces of all components on sheets of paper.
#[derive(Debug, Args)]
#[command(after_help = after_help())]
pub struct MakeArgs {
    /// Meshes (OBJ, STL, PLY, OFF, glTF, GLB, 3MF) or project files (TOML)
    ///
    /// A single "-" is the standard input. tatamu detects the format from the content, not from the file's name. It accepts open edges,
    /// edges with more than two faces, and several bodies, with a warning. It makes several inputs in
    /// parallel, with the same results as one by one; an input that fails does not stop the others.
    #[arg(value_name = "INPUT", required = true)]
    inputs: Vec<PathBuf>,

    #[command(flatten)]
    model: Flags<OfModel>,

    /// File to write; repeat it for more [default: the input's name with .pdf]
    ///
    /// The extension chooses the format; see the list at the end of this page. An existing file is
    /// replaced once the new one is complete. {name} stands for the input's name without its
    /// extension. In a folder, or a name that ends in a slash, tatamu writes a PDF with that name.
    /// -.pdf writes a PDF to the standard output.
    /// Example: -o teddy.pdf -o teddy.json, -o 'models/{name}.svg', -o models/
    #[arg(short, long = "output", value_name = "FILE", allow_hyphen_values = true)]
    output: Vec<PathBuf>,

    #[command(flatten)]
    guide: GuideArgs,

    #[command(flatten)]
    film: Flags<OfFilm>,

    /// Writes two files, NAME-print for the printer and NAME-cut for the cutter
    ///
    /// Both have the same pages with the same origin. NAME-cut has cut lines, slits and creases;
    /// NAME-print has labels, glue marks, scale bars and registration marks. Formats without pages
    /// are written once. Example: --print-and-cut --marks silhouette -o teddy.svg
    #[arg(long, help_heading = None::<&'static str>)]
    print_and_cut: bool,

    /// Shows only the pieces of this component; repeat it for more
    ///
    /// They stay at their places; sheets without them are left out. Example: --only head --only left-arm
    #[arg(long, value_name = "PART", help_heading = None::<&'static str>)]
    only: Vec<String>,

    /// Shows only this sheet, from 1; repeat it for more
    ///
    /// To print a sheet again, or to cut sheets one by one. Example: --sheet 3
    #[arg(long, value_name = "N", value_parser = sheet, help_heading = None::<&'static str>)]
    sheet: Vec<SheetId>,

    /// Writes the component of each face to a text file, one number per line
    ///
    /// One line per face of the input, in its order: the index of its component, from 0, or -1 if
    /// the repair dropped the face or its part has no volume. {name} and folders work as with -o.
    /// Example: --segments teddy.seg
    #[arg(long, value_name = "FILE", help_heading = None::<&'static str>)]
    segments: Option<PathBuf>,

    #[command(flatten)]
    files: Flags<OfFiles>,

    #[command(flatten)]
    machine: Flags<OfMachine>,

    /// Writes the model even if it takes more than 200 sheets
    ///
    /// A model with more sheets usually comes from a mistyped size.
    #[arg(long, help_heading = None::<&'static str>)]
    yes: bool,

    /// Writes the model even if it does not pass its own check
    ///
    /// tatamu folds each model again from its FOLD file before it writes anything, as "tatamu check"
    /// does. A model that fails is an error; with this option it is a warning.
    #[arg(long, help_heading = None::<&'static str>)]
    force: bool,

    /// Prints warnings and errors only
    #[arg(short, long, help_heading = None::<&'static str>)]
    quiet: bool,
}

impl MakeArgs {
    /// The meshes and project files.
    pub fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }

    /// What is asked for.
    pub fn wish(&self) -> Wish {
        let lists = [
            self.model.given(),
            self.guide.given(),
            self.film.given(),
            self.files.given(),
            self.machine.given(),
        ];
        Wish {
            given: lists.concat(),
            outputs: self.output.clone(),
            guides: self.guide.wanted().to_vec(),
            segments: self.segments.clone(),
            prints_and_cuts: self.print_and_cut,
            takes_any_sheets: self.yes,
            is_forced: self.force,
            selection: Selection { parts: self.only.clone(), sheets: self.sheet.clone() },
        }
    }
}

/// A sheet by its number.
fn sheet(text: &str) -> Result<SheetId, String> {
    whole::<usize>(1..=u64::MAX)(text).map(|number| SheetId(number - 1))
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
pub fn run(args: &MakeArgs) -> Result<(), AppError> {
    mistakes::check_inputs(args.inputs())?;
    let wish = args.wish();
    let [input] = args.inputs() else { return batch::run(&wish, args.inputs(), args.quiet) };
    let progress = TerminalProgress::new(args.quiet);
    let tell = |warning: &str| terminal::complain("warning", warning);
    let sources = Sources::of([input.as_path()]);
    let made = make(Task::new(&wish, input)?, &sources, &progress, words::warning, &tell)?;
    output::write(&made.files, &sources)?;
    if !args.quiet {
        made.summary.iter().for_each(|line| terminal::say_of_files(made.paths(), line));
    }
    Ok(())
}
