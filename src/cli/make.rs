//! `tatamu make`

use super::flags::{Flags, OfFiles, OfFilm, OfMachine, OfModel};
use super::guide::GuideArgs;
use super::progress::TerminalProgress;
use super::{batch, formats, terminal, words};
use crate::app::error::AppError;
use crate::app::make::{Task, Wish, make};
use crate::app::output;
use clap::Args;
use std::path::PathBuf;

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
        }
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
pub fn run(args: &MakeArgs) -> Result<(), AppError> {
    let [input] = args.inputs() else { return batch::run(args) };
    let progress = TerminalProgress::new(args.quiet);
    let tell = |warning: &str| terminal::complain("warning", warning);
    let wish = args.wish();
    let made = make(Task::new(&wish, input)?, &progress, words::warning, &tell)?;
    output::write(&made.files)?;
    if !args.quiet {
        made.summary.iter().for_each(|line| terminal::say(line));
    }
    Ok(())
}
