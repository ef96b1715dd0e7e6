//! `tatamu plot`

mod keys;
mod operator;

use super::flags::{Flags, OfMachine, OfModel};
use super::numbers::whole;
use super::progress::TerminalProgress;
use super::{terminal, words};
use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::plot::{Sheet, SystemPorts, handshake, journal, live, rest, sheets};
use crate::app::sources::Sources;
use crate::app::{names, output};
use clap::Args;
use operator::Terminal;
use std::path::{Path, PathBuf};
use tatamu::drawing::{LineStyles, Pages};
use tatamu::export::{FormatOptions, PltOptions};
use tatamu::plotter::journal::{Header, Position};
use tatamu::plotter::profile::Handshake;
use tatamu::plotter::{Cutter, preview};
use tatamu::project::options::MEDIA;

/// Sends a model to a cutter or plotter, sheet by sheet.
///
/// While it runs, press p to lift the tool and pause, p again to continue, and Ctrl-C to lift the
/// tool and stop. --resume continues a stopped job.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct PlotArgs {
    /// Mesh, project file, or files in the machine's language (.plt, .gcode), one per sheet
    #[arg(value_name = "INPUT", required_unless_present_any = ["test_cut", "resume"])]
    input: Vec<PathBuf>,

    #[command(flatten)]
    model: Flags<OfModel>,

    #[command(flatten)]
    machine: Flags<OfMachine>,

    /// Port of the machine, such as /dev/ttyUSB0 or COM3, or usb for a Silhouette
    ///
    /// "tatamu ports" lists the ports.
    #[arg(long, value_name = "PORT")]
    port: Option<String>,

    /// Speed of the port in bits per second [default: from the profile]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(300..=4_000_000))]
    baud: Option<u32>,

    /// Flow control: auto, escb, rtscts, xonxoff, paced, count, ok or usb [default: from the profile]
    ///
    /// auto asks the machine and chooses by its answer. escb asks for free bytes, rtscts and xonxoff
    /// follow the machine's signals, paced goes by time alone, count waits for the ok of GRBL, ok
    /// for that of an AxiDraw, usb asks a Silhouette whether it is ready.
    #[arg(long, value_name = "NAME", value_parser = handshake)]
    handshake: Option<Handshake>,

    /// Number of a sheet to send, from 1; repeat it for more [default: all]
    ///
    /// Example: --only 3, --only 1,4
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = whole::<u16>(1..=65_535))]
    only: Vec<u16>,

    /// Number of copies
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u16>(1..=1000))]
    copies: u16,

    /// Cuts a test figure instead of INPUT: a 10 mm square with a triangle in it and two creases
    #[arg(long, conflicts_with = "input")]
    test_cut: bool,

    /// Continues a stopped job from its journal (.tatamu-job)
    ///
    /// With --dry-run or --preview it shows what is left of the copy that it is at.
    #[arg(long, value_name = "JOB", conflicts_with_all = ["input", "test_cut", "only", "copies"])]
    resume: Option<PathBuf>,

    /// Does not wait for you to load sheets: each sheet is already in the machine
    #[arg(short, long)]
    yes: bool,

    /// Sends nothing; prints a summary of each sheet
    #[arg(long)]
    dry_run: bool,

    /// Writes a picture of the job: bed, order, travel, path of the blade tip, time
    ///
    /// The extension chooses the format, such as .png, .svg or .pdf. Example: --preview job.png
    #[arg(long, value_name = "FILE")]
    preview: Option<PathBuf>,

    /// Prints warnings and errors only
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  tatamu plot teddy.obj --dry-run --preview job.png
  tatamu plot --test-cut --cutter vinyl-cutter --media cardstock-200 --port /dev/ttyUSB0
  tatamu plot teddy.toml --cutter generic-hpgl --port /dev/ttyUSB0 --only 2
  tatamu plot --resume teddy.tatamu-job";

/// Runs the command.
pub fn run(args: &PlotArgs) -> Result<(), AppError> {
    if let Some(path) = &args.resume {
        check_use(args)?;
        let journal = journal::read(path)?;
        return resume(args, path, journal);
    }
    let chosen = Choice::new(None, args.machine.given())?;
    let machine = chosen.machine()?;
    check_use(args)?;
    let is_live = args.is_live();
    if is_live && args.port.is_none() {
        let message = "add --port (\"tatamu ports\" lists the ports), --dry-run or --preview";
        return Err(AppError::Options(message.to_owned()));
    }
    if is_live && chosen.settings().files.cutter.is_none() {
        let message = "add --cutter; \"tatamu profiles list\" lists the profiles";
        return Err(AppError::Options(message.to_owned()));
    }
    let sources = Sources::of(args.input.iter().map(PathBuf::as_path));
    check_preview(args, &sources)?;
    let mut sheets = wanted(args, &machine)?;
    if !args.only.is_empty() {
        let count = sheets.len();
        if let Some(n) = args.only.iter().find(|&&n| usize::from(n) > count) {
            return Err(AppError::Options(format!("there is no sheet {n}; the job has sheets 1 to {count}")));
        }
        let mut number = 0;
        sheets.retain(|_| {
            number += 1;
            args.only.contains(&number)
        });
    }
    sheets.iter().flat_map(Sheet::notes).for_each(|note| terminal::complain("note", note));
    show(args, &sources, &sheets, &machine.cutter)?;
    if is_live { start(args, &machine.cutter, &sheets) } else { Ok(()) }
}

/// Refuses a name for the pictures before the work.
fn check_preview(args: &PlotArgs, sources: &Sources) -> Result<(), AppError> {
    args.preview.as_ref().map_or(Ok(()), |path| {
        output::picture(path)?;
        output::check_places(std::slice::from_ref(path), sources)
    })
}

/// Refuses options that what is sent has no use for.
fn check_use(args: &PlotArgs) -> Result<(), AppError> {
    let (model, machine) = (args.model.given(), args.machine.given());
    let medium: Vec<_> = machine.iter().filter(|given| *given.option() == MEDIA).cloned().collect();
    let (unused, what) = if args.resume.is_some() {
        ([model, machine].concat(), "a job that continues")
    } else if args.test_cut {
        (model.to_vec(), "the test figure")
    } else if args.input.iter().all(|path| sheets::is_job(path)) {
        ([model, &medium].concat(), "files in the machine's language")
    } else {
        return Ok(());
    };
    let flag = unused.iter().find_map(|given| given.option().flag);
    flag.map_or(Ok(()), |flag| {
        Err(AppError::Options(format!("--{} has no effect on {what}; remove it", flag.name)))
    })
}

impl PlotArgs {
    /// Whether anything is sent.
    fn is_live(&self) -> bool {
        !self.dry_run && (self.port.is_some() || self.preview.is_none())
    }
}

/// Shows what is to be sent.
fn show(args: &PlotArgs, sources: &Sources, sheets: &[Sheet], cutter: &Cutter) -> Result<(), AppError> {
    if let Some(path) = &args.preview {
        draw(path, sources, sheets, cutter)?;
    }
    if args.dry_run || !args.quiet {
        sheets.iter().for_each(|sheet| terminal::say(&sheet.summary(cutter)));
    }
    Ok(())
}

/// The sheets that the user asked for.
fn wanted(args: &PlotArgs, machine: &PltOptions) -> Result<Vec<Sheet>, AppError> {
    if args.test_cut {
        return sheets::of_test_cut(machine);
    }
    let tell = |warning: &str| terminal::complain("warning", warning);
    let progress = TerminalProgress::new(args.quiet);
    sheets::of_inputs(&args.input, args.model.given(), machine, &progress, words::warning, &tell)
}

/// Sends sheets from the first on.
fn start(args: &PlotArgs, cutter: &Cutter, sheets: &[Sheet]) -> Result<(), AppError> {
    let port = args.port.clone().unwrap_or_default();
    let name = args.input.first().and_then(|path| path.file_stem()).unwrap_or("test-cut".as_ref());
    let mut name = name.to_owned();
    name.push(".tatamu-job");
    let path = PathBuf::from(name);
    journal::check_unused(&path)?;
    if path.exists() {
        terminal::complain(
            "note",
            &format!("this job replaces {}, the journal of a stopped job", path.display()),
        );
    }
    let header = live::header(sheets, cutter, port, args.copies);
    let handshake = args.handshake.map(|h| h.name().to_owned());
    let header = Header { baud: args.baud, handshake, ..header };
    output::check_places(std::slice::from_ref(&path), &Sources::none())?;
    send(args, &path, &header, Position::default())
}

/// Continues a job.
fn resume(args: &PlotArgs, path: &Path, (header, at): (Header, Position)) -> Result<(), AppError> {
    let sources = Sources::of([path]);
    check_preview(args, &sources)?;
    let mut header = header;
    header.port = args.port.clone().unwrap_or(header.port);
    header.baud = args.baud.or(header.baud);
    header.handshake = args.handshake.map(|h| h.name().to_owned()).or(header.handshake);
    let cutter = rest::cutter(path, &header)?;
    show(args, &sources, &rest::sheets(path, &header, at, &cutter)?, &cutter)?;
    if args.is_live() { send(args, path, &header, at) } else { Ok(()) }
}

fn send(args: &PlotArgs, path: &Path, header: &Header, at: Position) -> Result<(), AppError> {
    live::send_all(&SystemPorts, &mut Terminal::new(args.yes, args.quiet), path, header, at)
}

/// Writes the pictures of all sheets.
fn draw(path: &Path, sources: &Sources, sheets: &[Sheet], cutter: &Cutter) -> Result<(), AppError> {
    let (_, write) = output::picture(path)?;
    let pictures = sheets.iter().map(|sheet| preview(sheet.job(), cutter, sheet.placement()));
    let pages = Pages::new("preview", pictures.collect(), LineStyles::standard());
    let pages = pages.map_err(|error| AppError::Options(error.to_string()))?;
    let files = write(&pages, &FormatOptions::default())?;
    let files: Vec<(PathBuf, Vec<u8>)> =
        files.into_iter().map(|file| (names::with_suffix(path, &file.suffix), file.bytes)).collect();
    output::write(&files, sources)
}
