//! Jobs on their way: the port, the clock and the user.

use super::grbl_words as words;
use super::journal::Journal;
use super::port::{Port, Ports, exchange};
use super::sheets::{self, Sheet};
use super::{Operator, handshake, rest};
use crate::app::error::AppError;
use std::path::Path;
use std::time::{Duration, Instant};
use tatamu::plotter::journal::{Header, Position, SheetEntry};
use tatamu::plotter::profile::Handshake;
use tatamu::plotter::session::{End, Outcome, Session, Step};
use tatamu::plotter::{Cutter, Job};
use tatamu::progress::Cancelled;
use tatamu::remedy::Remedy;

/// Longest time between two polls of port and keyboard.
const LOOK: Duration = Duration::from_millis(4);
/// Interval at which the journal is flushed to the disk: only a power cut loses what was written
/// since.
const SYNC_EVERY: Duration = Duration::from_millis(500);

/// What a journal says of a job.
pub fn header(sheets: &[Sheet], cutter: &Cutter, port: String, copies: u16) -> Header {
    let entry = |sheet: &Sheet| SheetEntry::new(sheet.name(), sheet.bytes(), sheet.turns());
    Header {
        cutter: cutter.text().to_owned(),
        port,
        baud: None,
        handshake: None,
        copies,
        sheets: sheets.iter().map(entry).collect(),
    }
}

/// Sends what is left of a job, and keeps a journal of it.
pub fn send_all(
    ports: &dyn Ports,
    operator: &mut dyn Operator,
    path: &Path,
    header: &Header,
    start: Position,
) -> Result<(), AppError> {
    let cutter = rest::cutter(path, header)?;
    let chosen = header.handshake.as_deref().map(handshake).transpose().map_err(AppError::Options)?;
    if let Some(chosen) = chosen.filter(|&handshake| !cutter.can_use(handshake)) {
        return Err(AppError::Options(format!(
            "{} cannot use the handshake {}, because it answers in another way; use that of its profile, {}",
            cutter.name(),
            chosen.name(),
            cutter.serial().handshake.name()
        )));
    }
    let mut port = ports.open(&header.port, header.baud, &cutter)?;
    operator.begin();
    let mut journal = Journal::create(path, header, start)?;
    let mut at = start;
    while at.copy < header.copies {
        while at.sheet < header.sheets.len() {
            let name = &header.sheets[at.sheet].name;
            let (whole, rest) = rest::of_sheet(path, header, at, &cutter)?;
            let job = sheets::parse(name, &rest, &cutter)?;
            let first = whole.strokes() - job.strokes();
            if let Err(error) = operator.load(name, (at.copy + 1, header.copies)) {
                operator.stopped(journal.path(), (journal.position().strokes, whole.strokes()));
                return Err(error);
            }
            let mut live = Live { operator, first, name, unwritten: None };
            let outcome = live.send(job, &cutter, chosen, port.as_mut(), &mut journal, at);
            let unwritten = live.unwritten.take();
            if outcome.end != End::Finished {
                let noted =
                    journal.note(Position { strokes: at.strokes.max(first + outcome.strokes_done), ..at });
                operator.stopped(journal.path(), (journal.position().strokes, whole.strokes()));
                let unwritten = unwritten.or(noted.err()).filter(|_| outcome.end == End::Stopped);
                return Err(unwritten.unwrap_or_else(|| failure(outcome)));
            }
            at = Position { sheet: at.sheet + 1, strokes: 0, ..at };
            journal.note(at)?;
        }
        at = Position { copy: at.copy + 1, sheet: 0, strokes: 0 };
        journal.note(at)?;
    }
    journal.remove();
    operator.done();
    Ok(())
}

/// Why a job did not finish.
pub fn failure(outcome: Outcome) -> AppError {
    let what = match outcome.end {
        End::Finished | End::Stopped => return AppError::Cancelled(Cancelled),
        End::Device(16) => "the machine's buffer overflowed (error 16)".to_owned(),
        End::Device(15) => "the machine misread bytes (error 15)".to_owned(),
        End::Device(code) => format!("the machine reports error {code} (ESC.E)"),
        End::NoAnswer => "the machine does not answer".to_owned(),
        End::PortLost => {
            "the port is gone, and the tool may be down; lift it by hand before you do anything else, and switch a \
             laser off. Switch the machine off and on before you continue the job, so that it forgets the part of a \
             command"
                .to_owned()
        }
        End::Rejected(code) => format!(
            "the machine refuses a line (error {code}: {}); check that its profile is right, then continue the job",
            words::rejected(code)
        ),
        End::Alarm(code) => format!(
            "the machine is in alarm ({code}: {}). Nothing was moved since, so the tool may be down; lift it by hand, \
             home the machine or set its zero again, then continue the job",
            words::alarm(code)
        ),
        End::Locked => "the machine is locked or busy, so nothing was sent; home it ($H), or unlock it ($X) when \
                        nothing is in its way, or set home = true in its profile"
            .to_owned(),
        End::Setting { number, needed } => format!(
            "the machine's setting ${number} is not {needed}, as its profile needs, so nothing was sent: {}; send \
             ${number}={needed} to the machine, or change [grbl.settings] in the profile",
            words::setting(number)
        ),
        End::Restarted => {
            "the machine restarted by itself; check its power supply and cable, home it or set its zero again, then \
             continue the job"
                .to_owned()
        }
        End::Refused(code) => format!(
            "the machine refuses a command (!{code}); check that its profile is right, then continue the job with the \
             carriage at home"
        ),
        End::Firmware { found: [a, b, c], needed: [d, e, f] } => format!(
            "the machine has firmware {a}.{b}.{c}, and tatamu needs {d}.{e}.{f} or newer, so nothing was sent; update it \
             (github.com/evil-mad/EggBot)"
        ),
        End::MarksNotFound => "the machine did not find the registration marks, so nothing was cut; load the sheet with \
                               its upper left corner at that of the mat, see that the marks are black, clean and \
                               printed at 100 %, then continue the job"
            .to_owned(),
        End::MarksUnanswered => "the machine did not say whether it found the registration marks, so nothing was cut; \
                                 see that its profile is the right one, then continue the job"
            .to_owned(),
        End::LinesLost => "the machine stands still at another place than the job has it, so lines were lost; check \
                           the cable, then continue the job"
            .to_owned(),
    };
    let remedies = match outcome.end {
        End::Device(16) => vec![Remedy::PacedHandshake],
        End::Device(15) => vec![Remedy::CheckSpeed],
        End::NoAnswer => vec![Remedy::CheckSpeed, Remedy::OtherHandshake],
        _ => Vec::new(),
    };
    AppError::Machine { reason: what, remedies }
}

/// One job on its way.
struct Live<'a> {
    operator: &'a mut dyn Operator,
    /// Strokes of the sheet that were done before.
    first: usize,
    name: &'a str,
    /// Why the journal could not be written.
    unwritten: Option<AppError>,
}

impl Live<'_> {
    fn send(
        &mut self,
        job: Job,
        cutter: &Cutter,
        chosen: Option<Handshake>,
        port: &mut dyn Port,
        journal: &mut Journal,
        at: Position,
    ) -> Outcome {
        let handshake = chosen.unwrap_or(cutter.serial().handshake);
        let baud = port.baud();
        let clear_to_send = port.is_clear_to_send();
        let mut session = Session::new(job, cutter, handshake, clear_to_send);
        if let Some(baud) = baud {
            session.set_baud(baud);
        }
        let (start, mut synced) = (Instant::now(), Instant::now());
        let mut stops = 0;
        let mut pending: Vec<u8> = Vec::new();
        let mut has_hardware = false;
        loop {
            while stops < self.operator.stops() {
                stops += 1;
                session.stop();
            }
            match self.operator.pauses(session.is_pausing()) {
                true => session.pause(),
                false => session.go_on(),
            }
            if exchange(port, &mut pending, &mut session).is_err() {
                session.port_lost();
            }
            let queued = pending.len() + port.queued();
            let step = session.step(start.elapsed(), queued);
            let status = session.status();
            if status.handshake == Handshake::RtsCts && !has_hardware {
                has_hardware = port.let_hardware_steer().is_ok();
            }
            session.take_notes().iter().for_each(|note| self.operator.note(note));
            match step {
                Step::Send(bytes) => pending.extend(bytes),
                Step::Wait(wait) => std::thread::sleep(wait.min(LOOK)),
                Step::Done(outcome) => {
                    self.operator.sheet_over();
                    return outcome;
                }
            }
            // A program that is killed leaves what was noted: each stroke, when it is done.
            let mut noted =
                journal.note(Position { strokes: at.strokes.max(self.first + status.strokes_done), ..at });
            if synced.elapsed() >= SYNC_EVERY {
                synced = Instant::now();
                noted = noted.and_then(|()| journal.sync());
                self.operator.show(self.name, self.first, &status);
            }
            // Without a journal the job could not go on later: the tool is lifted first.
            if let Some(error) = noted.err().filter(|_| self.unwritten.is_none()) {
                self.unwritten = Some(error);
                session.stop();
            }
        }
    }
}
