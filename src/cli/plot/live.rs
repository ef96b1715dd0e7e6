//! Jobs on their way: the port, the clock, the keyboard and the user.

use super::journal::Journal;
use super::operator::{Operator, Terminal};
use super::{PlotArgs, Sheet, handshake, jobs};
use crate::cli::error::{CliError, reason};
use crate::cli::{output, ports, terminal};
use serialport::{ClearBuffer, DataBits, FlowControl, SerialPort, StopBits};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use tatamu::plotter::journal::{Header, Position, SheetEntry};
use tatamu::plotter::profile::{Handshake, Parity};
use tatamu::plotter::session::{End, Outcome, Session, Step};
use tatamu::plotter::{Cutter, Job};
use tatamu::progress::Cancelled;

/// A port that is not ready for so long is asked again.
const PORT_TIMEOUT: Duration = Duration::from_millis(100);
/// Longest time between two looks at port and keyboard.
const LOOK: Duration = Duration::from_millis(4);
/// The journal is written so often.
const NOTE_EVERY: Duration = Duration::from_millis(500);

/// Sends sheets from the first on.
pub fn start(args: &PlotArgs, cutter: &Cutter, sheets: Vec<Sheet>) -> Result<(), CliError> {
    let port = args.port.clone().unwrap_or_default();
    let name = args.input.first().and_then(|path| path.file_stem()).unwrap_or("test-cut".as_ref());
    let mut name = name.to_owned();
    name.push(".tatamu-job");
    let path = PathBuf::from(name);
    if path.exists() {
        terminal::complain(
            "note",
            &format!("{} of a job that was stopped is replaced by this one", path.display()),
        );
    }
    let header = header(&sheets, cutter, port, args.copies);
    let handshake = args.handshake.map(|h| h.name().to_owned());
    let header = Header { baud: args.baud, handshake, ..header };
    let mut terminal = Terminal::new(args.yes, args.quiet);
    output::check_places(std::slice::from_ref(&path), &[])?;
    send_all(&mut terminal, &path, &header, Position::default())
}

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

/// Goes on with a job.
pub fn resume(args: &PlotArgs, path: &Path, (header, at): (Header, Position)) -> Result<(), CliError> {
    let mut header = header;
    header.port = args.port.clone().unwrap_or(header.port);
    header.baud = args.baud.or(header.baud);
    header.handshake = args.handshake.map(|h| h.name().to_owned()).or(header.handshake);
    send_all(&mut Terminal::new(args.yes, args.quiet), path, &header, at)
}

/// Sends what is left of a job, and keeps a journal of it.
pub fn send_all(
    operator: &mut dyn Operator,
    path: &Path,
    header: &Header,
    start: Position,
) -> Result<(), CliError> {
    let cutter = Cutter::parse(&header.cutter)
        .map_err(|error| CliError::Profile { name: path.display().to_string(), error })?;
    let damaged =
        || CliError::Input { path: path.to_owned(), reason: "the journal is damaged; begin anew".to_owned() };
    let chosen = header.handshake.as_deref().map(handshake).transpose().map_err(CliError::Options)?;
    if chosen == Some(Handshake::EscB) && !cutter.can_be_asked() {
        return Err(CliError::Options(format!(
            "{} does not answer questions (answers in its profile), so --handshake escb cannot work; use \
             paced, or what \"tatamu profiles show\" says",
            cutter.name()
        )));
    }
    let mut port = open(header, &cutter)?;
    operator.begin();
    let mut journal = Journal::create(path, header, start)?;
    let mut at = start;
    while at.copy < header.copies {
        while at.sheet < header.sheets.len() {
            let sheet = &header.sheets[at.sheet];
            let name = &sheet.name;
            let whole = jobs::parse(name, &sheet.bytes().ok_or_else(damaged)?, &cutter)?;
            let rest = whole.from_stroke(at.strokes, &sheet.turns, cutter.dialect());
            let job = jobs::parse(name, &rest, &cutter)?;
            let first = whole.strokes() - job.strokes();
            if let Err(error) = operator.load(name, (at.copy + 1, header.copies)) {
                operator.stopped(journal.path(), (journal.position().strokes, whole.strokes()));
                return Err(error);
            }
            let mut live = Live { operator, first, name };
            let outcome = live.send(job, &cutter, chosen, port.as_mut(), &mut journal, at)?;
            if outcome.end != End::Finished {
                journal.note(Position { strokes: at.strokes.max(first + outcome.strokes_done), ..at })?;
                operator.stopped(journal.path(), (journal.position().strokes, whole.strokes()));
                return Err(failure(outcome));
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

fn failure(outcome: Outcome) -> CliError {
    let what = match outcome.end {
        End::Finished | End::Stopped => return CliError::Cancelled(Cancelled),
        End::Device(16) => "the machine's buffer ran over (error 16); try --handshake paced".to_owned(),
        End::Device(15) => {
            "the machine misread bytes (error 15); check --baud, parity and the cable".to_owned()
        }
        End::Device(code) => format!("the machine reports the error {code} (ESC.E)"),
        End::NoAnswer => "the machine does not answer; check port, baud and cable, or try --handshake paced \
                          or rtscts"
            .to_owned(),
        End::PortLost => {
            "the port is gone: the tool may be down; lift it by hand before you do anything else".to_owned()
        }
    };
    CliError::Machine(what)
}

/// Opens the port without any flow control of the system: the session does it.
fn open(header: &Header, cutter: &Cutter) -> Result<Box<dyn SerialPort>, CliError> {
    let serial = cutter.serial();
    let failed = |error: serialport::Error| CliError::Port {
        port: header.port.clone(),
        reason: match error.kind() {
            serialport::ErrorKind::Io(ErrorKind::NotFound) => {
                "there is no such port; \"tatamu ports\" lists those that there are".to_owned()
            }
            serialport::ErrorKind::Io(kind) => reason(&kind.into()) + ports::hint(&header.port),
            serialport::ErrorKind::NoDevice => {
                "another program uses it, or it is gone; close that program and try again".to_owned()
            }
            _ => format!("it does not work as a serial port ({error}); \"tatamu ports\" lists the ports"),
        },
    };
    let mut port = serialport::new(&header.port, header.baud.unwrap_or(serial.baud))
        .timeout(PORT_TIMEOUT)
        .data_bits(if serial.data_bits == 7 { DataBits::Seven } else { DataBits::Eight })
        .stop_bits(if serial.stop_bits == 2 { StopBits::Two } else { StopBits::One })
        .parity(match serial.parity {
            Parity::None => serialport::Parity::None,
            Parity::Even => serialport::Parity::Even,
            Parity::Odd => serialport::Parity::Odd,
        })
        .flow_control(FlowControl::None)
        .open()
        .map_err(failed)?;
    // Not every port has these lines, and not every machine needs them.
    let _ = port.write_request_to_send(true);
    let _ = port.write_data_terminal_ready(true);
    let _ = port.clear(ClearBuffer::Input);
    Ok(port)
}

/// One job on its way.
struct Live<'a> {
    operator: &'a mut dyn Operator,
    /// Strokes of the sheet that were done before.
    first: usize,
    name: &'a str,
}

impl Live<'_> {
    fn send(
        &mut self,
        job: Job,
        cutter: &Cutter,
        chosen: Option<Handshake>,
        port: &mut dyn SerialPort,
        journal: &mut Journal,
        at: Position,
    ) -> Result<Outcome, CliError> {
        let handshake = chosen.unwrap_or(cutter.serial().handshake);
        let baud = port.baud_rate().ok();
        let clear_to_send = port.read_clear_to_send().ok();
        let mut session = Session::new(job, cutter, handshake, clear_to_send);
        if let Some(baud) = baud {
            session.set_baud(baud);
        }
        let (start, mut noted) = (Instant::now(), Instant::now());
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
            let queued = pending.len() + port.bytes_to_write().map_or(0, |n| n as usize);
            let step = session.step(start.elapsed(), queued);
            let status = session.status();
            if status.handshake == Handshake::RtsCts && !has_hardware {
                has_hardware = port.set_flow_control(FlowControl::Hardware).is_ok();
            }
            session.take_notes().iter().for_each(|note| self.operator.note(note));
            match step {
                Step::Send(bytes) => pending.extend(bytes),
                Step::Wait(wait) => std::thread::sleep(wait.min(LOOK)),
                Step::Done(outcome) => {
                    self.operator.sheet_over();
                    return Ok(outcome);
                }
            }
            if noted.elapsed() >= NOTE_EVERY {
                noted = Instant::now();
                journal.note(Position { strokes: at.strokes.max(self.first + status.strokes_done), ..at })?;
                self.operator.show(self.name, self.first, &status);
            }
        }
    }
}

/// Writes what is pending, as far as the port takes it, and reads what came.
fn exchange(port: &mut dyn SerialPort, pending: &mut Vec<u8>, session: &mut Session) -> std::io::Result<()> {
    let is_passing =
        |kind| matches!(kind, ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted);
    if !pending.is_empty() {
        match port.write(pending) {
            Ok(n) => drop(pending.drain(..n)),
            Err(error) if is_passing(error.kind()) => {}
            Err(error) => return Err(error),
        }
    }
    let mut buffer = [0; 256];
    let waiting = port.bytes_to_read()? as usize;
    if waiting > 0 {
        match port.read(&mut buffer[..waiting.min(256)]) {
            Ok(n) => session.received(&buffer[..n]),
            Err(error) if is_passing(error.kind()) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
