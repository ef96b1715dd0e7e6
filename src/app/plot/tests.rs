//! The driver of the session, with a machine in memory at its port.

use super::port::{Port, Ports};
use super::{Operator, live, sheets};
use crate::app::error::AppError;
use std::cell::RefCell;
use std::io::{Error, ErrorKind, Result};
use std::path::Path;
use std::rc::Rc;
use std::time::Instant;
use tatamu::export::PltOptions;
use tatamu::plotter::journal::Position;
use tatamu::plotter::session::Status;
use tatamu::plotter::{Cutter, Faults, VirtualMachine, VirtualOptions, VirtualPlotter};

/// A machine that may lose its line after some bytes.
struct Machine {
    plotter: VirtualPlotter,
    start: Instant,
    answers: Vec<u8>,
    unplugged_at: Option<u64>,
}

/// Its end of the line.
struct Line(Rc<RefCell<Machine>>);

impl Line {
    fn to(cutter: &Cutter, unplugged_at: Option<u64>) -> Self {
        let faults = Faults { slowness: 1e-3, ..Faults::default() };
        let options = VirtualOptions { faults, ..VirtualOptions::default() };
        let plotter = VirtualPlotter::new(cutter, options);
        Self(Rc::new(RefCell::new(Machine {
            plotter,
            start: Instant::now(),
            answers: Vec::new(),
            unplugged_at,
        })))
    }
}

impl Ports for Line {
    fn open(&self, _: &str, _: Option<u32>, _: &Cutter) -> std::result::Result<Box<dyn Port>, AppError> {
        Ok(Box::new(Self(self.0.clone())))
    }
}

impl Port for Line {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        let machine = &mut *self.0.borrow_mut();
        if machine.unplugged_at.is_some_and(|at| machine.plotter.received() >= at) {
            return Err(Error::from(ErrorKind::BrokenPipe));
        }
        let count = bytes.len().min(machine.plotter.free()).min(64);
        let now = machine.start.elapsed();
        bytes[..count].iter().for_each(|&byte| machine.plotter.receive(byte, now));
        if count > 0 { Ok(count) } else { Err(Error::from(ErrorKind::WouldBlock)) }
    }

    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let machine = &mut *self.0.borrow_mut();
        let count = buffer.len().min(machine.answers.len());
        for (to, from) in buffer.iter_mut().zip(machine.answers.drain(..count)) {
            *to = from;
        }
        Ok(count)
    }

    fn waiting(&mut self) -> Result<usize> {
        let machine = &mut *self.0.borrow_mut();
        let now = machine.start.elapsed();
        machine.plotter.run_until(now);
        machine.answers.extend(machine.plotter.take_answers(now));
        Ok(machine.answers.len())
    }
}

/// An operator who loads every sheet and remembers what happened.
#[derive(Default)]
struct Watcher {
    loaded: Vec<String>,
    stopped: Option<(usize, usize)>,
    is_done: bool,
}

impl Operator for Watcher {
    fn load(&mut self, sheet: &str, _: (u16, u16)) -> std::result::Result<(), AppError> {
        self.loaded.push(sheet.to_owned());
        Ok(())
    }

    fn stops(&mut self) -> u32 {
        0
    }

    fn pauses(&mut self, now: bool) -> bool {
        now
    }

    fn note(&mut self, _: &str) {}

    fn show(&mut self, _: &str, _: usize, _: &Status) {}

    fn stopped(&mut self, _: &Path, strokes: (usize, usize)) {
        self.stopped = Some(strokes);
    }

    fn done(&mut self) {
        self.is_done = true;
    }
}

/// Sends the test figure; how it ended, what was seen, the machine, and whether a journal is left.
fn sent(unplugged_at: Option<u64>, copies: u16) -> (std::result::Result<(), AppError>, Watcher, Line, bool) {
    let machine = PltOptions::default();
    let sheets = sheets::of_test_cut(&machine).unwrap();
    let header = live::header(&sheets, &machine.cutter, "memory".to_owned(), copies);
    let folder = tempfile::tempdir().unwrap();
    let journal = folder.path().join("a.tatamu-job");
    let (line, mut watcher) = (Line::to(&machine.cutter, unplugged_at), Watcher::default());
    let end = live::send_all(&line, &mut watcher, &journal, &header, Position::default());
    let is_left = journal.exists();
    (end, watcher, line, is_left)
}

#[test]
fn a_job_reaches_any_port_whole() {
    let (end, watcher, line, is_left) = sent(None, 2);
    end.unwrap();
    assert_eq!(watcher.loaded, ["test cut", "test cut"]);
    assert!(watcher.is_done && watcher.stopped.is_none() && !is_left);
    let plotter = &line.0.borrow().plotter;
    assert!(plotter.received() > 100 && plotter.lost() == 0 && plotter.broken() == 0);
    assert!(!plotter.is_pen_down());
}

#[test]
fn a_port_that_is_gone_leaves_a_journal() {
    let (end, watcher, _, is_left) = sent(Some(60), 1);
    assert!(end.unwrap_err().to_string().contains("the port is gone"));
    assert!(watcher.stopped.is_some_and(|(done, all)| done < all));
    assert!(is_left && !watcher.is_done);
}
