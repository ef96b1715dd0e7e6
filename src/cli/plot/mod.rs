//! `tatamu plot`

pub mod jobs;
pub mod journal;
mod keys;
pub mod live;
pub mod operator;

use super::choice::Choice;
use super::error::CliError;
use super::flags::{Flags, OfMachine, OfModel};
use super::{names, output, terminal};
use clap::Args;
use jobs::Sheet;
use std::path::{Path, PathBuf};
use tatamu::drawing::{LineStyles, Pages};
use tatamu::export::{FORMATS, FormatOptions, PltOptions, Source, format_of};
use tatamu::plotter::preview;
use tatamu::plotter::profile::Handshake;

/// Sends a model to a cutter or plotter, sheet after sheet.
///
/// While it runs: p lifts the tool and holds, p again goes on, Ctrl-C lifts the tool and stops.
/// A job that was stopped goes on with --resume.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct PlotArgs {
    /// Mesh, project file, or files in the machine's language (.plt), one a sheet
    #[arg(value_name = "INPUT", required_unless_present_any = ["test_cut", "resume"])]
    input: Vec<PathBuf>,

    #[command(flatten)]
    model: Flags<OfModel>,

    #[command(flatten)]
    machine: Flags<OfMachine>,

    /// Serial port of the machine, such as /dev/ttyUSB0 or COM3
    ///
    /// "tatamu ports" lists them.
    #[arg(long, value_name = "PORT")]
    port: Option<String>,

    /// Speed of the port in bits a second [default: as in the profile]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(300..=4_000_000))]
    baud: Option<u32>,

    /// How not to overrun the machine: auto, escb, rtscts, xonxoff or paced [default: as in the profile]
    ///
    /// auto asks the machine and takes what it answers. escb asks for free bytes, rtscts and
    /// xonxoff heed its signs, paced counts on nothing but time.
    #[arg(long, value_name = "NAME", value_parser = handshake)]
    handshake: Option<Handshake>,

    /// Numbers of the sheets to send, from 1 [default: all]
    ///
    /// Example: --only 3 or --only 1,4
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = clap::value_parser!(u16).range(1..))]
    only: Vec<u16>,

    /// Number of copies
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1000))]
    copies: u16,

    /// Cuts a square of 10 mm with a triangle in it and two creases, instead of INPUT
    #[arg(long, conflicts_with = "input")]
    test_cut: bool,

    /// Goes on with a job that was stopped, from its journal (.tatamu-job)
    #[arg(long, value_name = "JOB", conflicts_with_all = ["input", "test_cut", "only", "copies"])]
    resume: Option<PathBuf>,

    /// Asks nothing: the first sheet is loaded, and so is the next one when it is due
    #[arg(short, long)]
    yes: bool,

    /// Only says what would be sent
    #[arg(long)]
    dry_run: bool,

    /// Picture of the job: travel, order, way of the tip
    ///
    /// The extension chooses the format, such as .png, .svg or .pdf. Example: --preview job.png
    #[arg(long, value_name = "FILE")]
    preview: Option<PathBuf>,

    /// Warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  tatamu plot teddy.obj --dry-run --preview job.png
  tatamu plot --test-cut --cutter vinyl-cutter --media cardstock-200 --port /dev/ttyUSB0
  tatamu plot teddy.toml --cutter generic-hpgl --port /dev/ttyUSB0 --only 2
  tatamu plot --resume teddy.tatamu-job";

fn handshake(text: &str) -> Result<Handshake, String> {
    let found = Handshake::ALL.into_iter().find(|handshake| handshake.name() == text);
    found.ok_or_else(|| "it is one of auto, escb, rtscts, xonxoff, paced".to_owned())
}

/// Runs the command.
pub fn run(args: &PlotArgs) -> Result<(), CliError> {
    if let Some(path) = &args.resume {
        let journal = journal::read(path)?;
        return live::resume(args, path, journal);
    }
    let chosen = Choice::new(None, args.machine.given())?;
    let machine = chosen.machine()?;
    let is_live = !args.dry_run && (args.port.is_some() || args.preview.is_none());
    if is_live && args.port.is_none() {
        let message = "give the machine's --port (\"tatamu ports\" lists them), or --dry-run or --preview";
        return Err(CliError::Options(message.to_owned()));
    }
    if is_live && chosen.settings().files.cutter.is_none() {
        let message = "say which --cutter it is; \"tatamu profiles list\" names them";
        return Err(CliError::Options(message.to_owned()));
    }
    let mut sheets = jobs::sheets(args, &machine)?;
    if !args.only.is_empty() {
        let count = sheets.len();
        if let Some(n) = args.only.iter().find(|&&n| usize::from(n) > count) {
            return Err(CliError::Options(format!("there is no sheet {n}; there are {count}")));
        }
        let mut number = 0;
        sheets.retain(|_| {
            number += 1;
            args.only.contains(&number)
        });
    }
    sheets.iter().flat_map(Sheet::notes).for_each(|note| terminal::complain("note", note));
    if let Some(path) = &args.preview {
        draw(path, &sheets, &machine)?;
    }
    if args.dry_run || !args.quiet {
        sheets.iter().for_each(|sheet| terminal::say(&sheet.summary(&machine.cutter)));
    }
    if is_live { live::start(args, &machine.cutter, sheets) } else { Ok(()) }
}

/// Writes the pictures of all sheets.
fn draw(path: &Path, sheets: &[Sheet], machine: &PltOptions) -> Result<(), CliError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let format = format_of(&extension);
    let Some((Source::Pages(write), false)) = format.map(|f| (f.source, f.name == "plt")) else {
        let is_picture =
            |f: &&tatamu::export::Format| matches!(f.source, Source::Pages(_)) && f.name != "plt";
        let known: Vec<String> =
            FORMATS.iter().filter(is_picture).map(|f| format!(".{}", f.extensions[0])).collect();
        return Err(CliError::Extension { path: path.to_owned(), known: known.join(", ") });
    };
    output::check_places(&[path.to_owned()], &[])?;
    let pictures = sheets.iter().map(|sheet| preview(sheet.job(), &machine.cutter, sheet.placement()));
    let pages = Pages::new("preview", pictures.collect(), LineStyles::standard());
    let pages = pages.map_err(|error| CliError::Options(error.to_string()))?;
    let files = write(&pages, &FormatOptions::default())?;
    let files: Vec<(PathBuf, Vec<u8>)> =
        files.into_iter().map(|file| (names::with_suffix(path, &file.suffix), file.bytes)).collect();
    output::write(&files)
}
