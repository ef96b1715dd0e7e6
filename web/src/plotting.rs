//! Jobs for machines on a serial port or on USB. The page has the port and the clock.

use crate::desk::Desk;
use serde::Serialize;
use std::time::Duration;
use tatamu::app::catalogue::{MACHINES, Takes};
use tatamu::app::plot::{doing, failure, sheets};
use tatamu::app::profiles;
use tatamu::export::format_of;
use tatamu::plotter::profile::{CUTTERS, Parity};
use tatamu::plotter::session::{End, Session, Step};
use tatamu::plotter::{Cutter, Job};

/// A machine that a page can plot on.
#[derive(Serialize)]
pub struct MachineRow {
    profile: &'static str,
    name: String,
    /// What of the browser reaches it: `serial` or `usb`.
    port: &'static str,
}

/// The machines that a page can plot on.
pub fn machines() -> Vec<MachineRow> {
    let row = |machine: &tatamu::app::catalogue::Machine| {
        let (profile, port) = match machine.takes {
            Takes::Serial(profile) => (profile, "serial"),
            Takes::Usb(profile) => (profile, "usb"),
            Takes::Program(_) => return None,
        };
        Some(MachineRow { profile, name: format!("{}: {}", machine.maker, machine.models), port })
    };
    MACHINES.iter().filter_map(row).collect()
}

/// A sheet as a job.
#[derive(Serialize)]
pub struct SheetJob {
    name: String,
    summary: String,
    notes: Vec<String>,
    strokes: usize,
    seconds: f64,
    turns: Vec<usize>,
    bytes: String,
    /// Of its file, without the dot.
    extension: &'static str,
}

/// The sheets of the model as jobs of a machine.
///
/// # Errors
/// A message where the machine cannot work on a sheet.
pub fn jobs(desk: &Desk, cutter: &str, media: &str) -> Result<Vec<SheetJob>, String> {
    let message = |error: &tatamu::app::error::AppError| tatamu::front::words::error(error);
    let machine = profiles::machine(Some(cutter), Some(media)).map_err(|error| message(&error))?;
    let output = desk.finished().ok_or("the model is not finished yet")?;
    let pages = desk.opened.with_product(desk.document.project(), output, |product, _| {
        product.pages().map(|pages| pages.drawings().to_vec()).map_err(|error| error.to_string())
    });
    let pages = pages.map_err(|error| message(&error))??;
    let language = machine.cutter.dialect().name();
    let extension = format_of(language).map_or("plt", |format| format.extensions[0]);
    let sheets = sheets::of_drawings(&desk.opened.title(), &pages, &machine);
    let job = |sheet: &sheets::Sheet| SheetJob {
        name: sheet.name().to_owned(),
        summary: sheet.summary(&machine.cutter),
        notes: sheet.notes().to_vec(),
        strokes: sheet.job().strokes(),
        seconds: sheet.job().seconds(),
        turns: sheet.turns().to_vec(),
        // Languages of plotters are ASCII.
        bytes: String::from_utf8_lossy(sheet.bytes()).into_owned(),
        extension,
    };
    Ok(sheets.map_err(|error| message(&error))?.iter().map(job).collect())
}

/// How to open the port of a machine, with the names of the browser.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SerialSettings {
    baud_rate: u32,
    data_bits: u8,
    stop_bits: u8,
    parity: &'static str,
    flow_control: &'static str,
}

/// One job on its way.
pub struct Live {
    session: Session,
    cutter: Cutter,
    /// Strokes that were done before.
    first: usize,
}

/// What the page does next, and how far the job is.
#[derive(Serialize)]
pub struct StepReport {
    send: Option<String>,
    wait_ms: Option<f64>,
    /// What is done now.
    doing: String,
    strokes_done: usize,
    strokes: usize,
    seconds_left: f64,
    notes: Vec<String>,
    is_over: bool,
    is_finished: bool,
    /// Why it did not finish.
    problem: Option<String>,
}

impl Live {
    /// What is left of a job after some strokes.
    ///
    /// # Errors
    /// A message where the job is none.
    pub fn new(profile: &str, bytes: &str, turns: &[usize], done: usize) -> Result<Self, String> {
        let found = CUTTERS.iter().find(|own| own.name == profile);
        let text = found.ok_or_else(|| format!("there is no machine {profile}"))?.text;
        let cutter = Cutter::parse(text).map_err(|error| error.to_string())?;
        let job = |bytes: &[u8]| Job::parse(bytes, &cutter).map_err(|error| error.to_string());
        let whole = job(bytes.as_bytes())?;
        let rest = job(&whole.from_stroke(done, turns, cutter.dialect().as_ref()))?;
        let first = whole.strokes() - rest.strokes();
        let session = Session::new(rest, &cutter, cutter.serial().handshake, None);
        Ok(Self { session, cutter, first })
    }

    /// How to open the port.
    pub fn serial(&self) -> SerialSettings {
        let serial = self.cutter.serial();
        SerialSettings {
            baud_rate: serial.baud,
            data_bits: serial.data_bits,
            stop_bits: serial.stop_bits,
            parity: match serial.parity {
                Parity::None => "none",
                Parity::Even => "even",
                Parity::Odd => "odd",
            },
            // Nothing but the session steers the flow of bytes.
            flow_control: "none",
        }
    }

    /// The job.
    pub fn session(&mut self) -> &mut Session {
        &mut self.session
    }

    /// What to do now.
    pub fn step(&mut self, now_ms: f64, queued: usize) -> StepReport {
        let step = self.session.step(Duration::from_secs_f64(now_ms.max(0.0) / 1000.0), queued);
        let status = self.session.status();
        let (send, wait_ms, outcome) = match step {
            Step::Send(bytes) => (Some(String::from_utf8_lossy(&bytes).into_owned()), None, None),
            Step::Wait(wait) => (None, Some(wait.as_secs_f64() * 1000.0), None),
            Step::Done(outcome) => (None, None, Some(outcome)),
        };
        let strokes_done = outcome.map_or(status.strokes_done, |outcome| outcome.strokes_done);
        let is_finished = outcome.is_some_and(|outcome| outcome.end == End::Finished);
        StepReport {
            send,
            wait_ms,
            doing: doing(status.state).to_owned(),
            strokes_done: self.first + strokes_done,
            strokes: self.first + status.strokes,
            seconds_left: status.seconds_left,
            notes: self.session.take_notes(),
            is_over: outcome.is_some(),
            is_finished,
            problem: outcome
                .filter(|_| !is_finished)
                .map(|outcome| tatamu::front::words::error(&failure(outcome))),
        }
    }
}
