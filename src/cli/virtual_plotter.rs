//! `tatamu virtual-plotter`

use super::flags::{Flags, OfMachine};
use super::numbers::whole;
use super::{progress, terminal};
use crate::app::choice::Choice;
use crate::app::error::AppError;
use crate::app::sources::Sources;
use crate::app::{names, output};
use clap::Args;
use glam::DVec2;
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use std::fs::File;
use std::io::{Read, Write};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tatamu::drawing::{Drawing, Layer, LineStyles, Mark, Pages};
use tatamu::export::FormatOptions;
use tatamu::plotter::{Cutter, Faults, VirtualMachine, VirtualOptions, virtual_machine};

/// Simulates a plotter on a virtual serial port, to try jobs without a machine.
///
/// It prints the name of the port, for "tatamu plot --port" and other programs. It reads at the
/// speed of its line, even after XOFF, as real plotters do. When the host closes the port, it
/// reports how many bytes it lost and whether the pen is up.
#[derive(Debug, Args)]
pub struct VirtualPlotterArgs {
    #[command(flatten)]
    machine: Flags<OfMachine>,

    /// Size of the buffer in bytes [default: from the profile]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(80..=u64::MAX))]
    buffer: Option<u32>,

    /// Speed of the line in bits per second [default: from the profile]
    #[arg(long, value_name = "N", value_parser = whole::<u32>(300..=u64::MAX))]
    baud: Option<u32>,

    /// Speed of the tool, relative to the profile; 0.2 is slower, 10 faster
    #[arg(long, value_name = "N", default_value_t = 1.0, value_parser = factor)]
    speedup: f64,

    /// Never answers the host
    #[arg(long)]
    mute: bool,

    /// Sends XOFF when fewer than N bytes are free, and XON later
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=u64::MAX))]
    xoff_below: Option<u32>,

    /// Replaces every Nth answer with noise
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole::<u32>(0..=u64::MAX))]
    garbage_every: u32,

    /// Leaves out every Nth answer
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = whole::<u32>(0..=u64::MAX))]
    silence_every: u32,

    /// Reports a framing error (ESC.E) after N bytes
    #[arg(long, value_name = "N", value_parser = whole::<u64>(0..=u64::MAX))]
    error_at: Option<u64>,

    /// Closes the port after N bytes, as if unplugged
    #[arg(long, value_name = "N", value_parser = whole::<u64>(0..=u64::MAX))]
    unplug_at: Option<u64>,

    /// Where the corner of printed registration marks is along its axes, mm [default: it finds none]
    ///
    /// A Silhouette counts from the upper left corner of the mat, down and to the right. Example: --marks-at 11.5,9.2
    #[arg(long, value_name = "X,Y", value_parser = place)]
    marks_at: Option<[f64; 2]>,

    /// Writes what it drew when the host closes the port: .png, .svg, .dxf, .pdf
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Ends when the host closes the port
    #[arg(long)]
    once: bool,
}

fn factor(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| *x > 0.0 && *x <= 1e6);
    number.ok_or_else(|| "this must be a number above 0, such as 10".to_owned())
}

fn place(text: &str) -> Result<[f64; 2], String> {
    let numbers =
        text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    let found = numbers.filter(|at: &[f64; 2]| at.iter().all(|mm| mm.abs() < 1e4));
    found.ok_or_else(|| "this must be two lengths in mm, such as 11.5,9.2".to_owned())
}

/// Time between two looks at the port.
const LOOK: Duration = Duration::from_millis(1);

/// Runs the command.
pub fn run(args: &VirtualPlotterArgs) -> Result<(), AppError> {
    let cutter = Choice::new(None, args.machine.given())?.machine()?.cutter;
    if let Some(path) = &args.output {
        output::picture(path)?;
        output::check_places(std::slice::from_ref(path), &Sources::none())?;
    }
    let (mut host, name) = open().map_err(|error| AppError::Port {
        port: "of the virtual plotter".to_owned(),
        reason: error.to_string(),
    })?;
    progress::count_stops();
    terminal::say(&name);
    loop {
        let plotter = serve(args, &cutter, &mut host);
        if plotter.received() > 0 {
            report(args, &cutter, plotter.as_ref())?;
        }
        if args.once || args.unplug_at.is_some() || progress::stops() > 0 {
            return Ok(());
        }
    }
}

/// Opens a pair of ports: ours, and the name of the host's.
pub fn open() -> rustix::io::Result<(File, String)> {
    let ours = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
    grantpt(&ours)?;
    unlockpt(&ours)?;
    let name = ptsname(&ours, Vec::new())?.to_string_lossy().into_owned();
    // Nothing is echoed, even before the host has set its port up.
    let mut modes = tcgetattr(&ours)?;
    modes.make_raw();
    tcsetattr(&ours, OptionalActions::Now, &modes)?;
    fcntl_setfl(&ours, fcntl_getfl(&ours)? | OFlags::NONBLOCK)?;
    Ok((File::from(ours), name))
}

/// Works for one host until it closes the port.
pub fn serve(args: &VirtualPlotterArgs, cutter: &Cutter, host: &mut File) -> Box<dyn VirtualMachine> {
    let faults = Faults {
        slowness: 1.0 / args.speedup,
        garbage_every: args.garbage_every,
        silence_every: args.silence_every,
        error_at: args.error_at,
    };
    let options = VirtualOptions {
        buffer_bytes: args.buffer.map_or(cutter.serial().buffer_bytes, |n| n as usize),
        answers: !args.mute,
        xoff_below: args.xoff_below.map(|n| n as usize),
        marks_mm: args.marks_at,
        faults,
    };
    let mut plotter = virtual_machine(cutter, options);
    let serial = cutter.serial();
    let byte_s = serial.byte_s() * f64::from(serial.baud) / f64::from(args.baud.unwrap_or(serial.baud));
    let start = Instant::now();
    // What the line could have carried while nobody looked: two bytes even of a slow one.
    let backlog = (10 * LOOK).max(Duration::from_secs_f64(2.0 * byte_s));
    let mut line_free = Duration::ZERO;
    let mut is_gone = false;
    let is_unplugged =
        |plotter: &dyn VirtualMachine| args.unplug_at.is_some_and(|bytes| plotter.received() >= bytes);
    while progress::stops() == 0 && !is_unplugged(plotter.as_ref()) && !(is_gone && plotter.is_idle()) {
        let now = start.elapsed();
        line_free = line_free.max(now.saturating_sub(backlog));
        let due = ((now.saturating_sub(line_free)).as_secs_f64() / byte_s) as usize;
        let mut bytes = [0; 4096];
        match host.read(&mut bytes[..due.min(4096)]) {
            Ok(n) => {
                is_gone = false;
                for &byte in &bytes[..n] {
                    line_free += Duration::from_secs_f64(byte_s);
                    plotter.receive(byte, line_free);
                }
            }
            // On Linux a port without a host is an error to read.
            Err(error) => is_gone = error.raw_os_error() == Some(5) && plotter.received() > 0,
        }
        plotter.run_until(now);
        let answers = plotter.take_answers(now);
        if !answers.is_empty() {
            // A host that has gone misses nothing.
            let _ = host.write_all(&answers);
        }
        std::thread::sleep(LOOK);
    }
    plotter
}

/// Says what happened, and draws it.
fn report(args: &VirtualPlotterArgs, cutter: &Cutter, plotter: &dyn VirtualMachine) -> Result<(), AppError> {
    let pen = if plotter.is_pen_down() { "down" } else { "up" };
    let drawn = plotter.motions().iter().filter(|m| m.is_down).count();
    terminal::say(&format!(
        "received {} bytes, lost {}, broken commands {}, lines drawn {drawn}, pen {pen}",
        plotter.received(),
        plotter.lost(),
        plotter.broken()
    ));
    let Some(path) = &args.output else {
        return Ok(());
    };
    let (_, write) = output::picture(path)?;
    let pages = Pages::new("drawn", vec![drawing(cutter, plotter)], LineStyles::standard());
    let pages = pages.map_err(|error| AppError::Options(error.to_string()))?;
    let files = write(&pages, &FormatOptions::default())?.into_iter();
    let files: Vec<_> = files.map(|file| (names::with_suffix(path, &file.suffix), file.bytes)).collect();
    output::write(&files, &Sources::none())
}

/// What was drawn, in the machine's coordinates, mm.
fn drawing(cutter: &Cutter, plotter: &dyn VirtualMachine) -> Drawing {
    let units = cutter.frame().units_per_mm().value();
    let at = |p: tatamu::plotter::Point| DVec2::new(f64::from(p.x()), f64::from(p.y())) / units;
    let places = plotter.motions().iter().flat_map(|m| [at(m.from), at(m.to)]);
    let (low, high) = places.fold((DVec2::ZERO, DVec2::ONE), |(l, h), p| (l.min(p), h.max(p)));
    let border = DVec2::splat(5.0);
    let mut page = Drawing::new("drawn", high - low + 2.0 * border);
    page.ground = Some(tatamu::drawing::Rgb::WHITE);
    let styles = LineStyles::standard();
    let line = |layer, m: &tatamu::plotter::Motion| {
        Mark::line(layer, at(m.from) - low + border, at(m.to) - low + border, styles.stroke(layer))
    };
    let travel = plotter.motions().iter().filter(|m| !m.is_down).map(|m| line(Layer::Glue, m));
    let drawn = plotter.motions().iter().filter(|m| m.is_down).map(|m| line(Layer::Cut, m));
    page.marks = travel.chain(drawn).collect();
    page
}
