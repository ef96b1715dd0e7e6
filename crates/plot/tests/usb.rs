//! Sessions over USB with a simulated Silhouette: its port takes bytes only while it has room.

use std::collections::VecDeque;
use std::time::Duration;
use tatamu_plot::plotter::profile::{CUTTERS, Handshake};
use tatamu_plot::plotter::session::{End, Outcome, Session, Step};
use tatamu_plot::plotter::{
    Cutter, Faults, Job, Media, Motion, Plan, VirtualMachine, VirtualOptions, VirtualPlotter, test_cut,
};

const TOO_LONG: Duration = Duration::from_secs(2000);

fn cutter(name: &str) -> Cutter {
    Cutter::parse(CUTTERS.iter().find(|p| p.name == name).expect("exists").text).expect("valid")
}

fn figure(cutter: &Cutter) -> Vec<u8> {
    Plan::new(&test_cut(), cutter, &Media::usual()).expect("fits").bytes().to_vec()
}

struct Rehearsal {
    session: Session,
    machine: VirtualPlotter,
    stop_at: Option<u64>,
    now: Duration,
    port: VecDeque<u8>,
    notes: Vec<String>,
}

impl Rehearsal {
    fn new(job: &[u8], cutter: &Cutter, options: VirtualOptions) -> Self {
        let job = Job::parse(job, cutter).expect("valid");
        Self {
            session: Session::new(job, cutter, Handshake::Usb, None),
            machine: VirtualPlotter::new(cutter, options),
            stop_at: None,
            now: Duration::ZERO,
            port: VecDeque::new(),
            notes: Vec::new(),
        }
    }

    fn run(&mut self) -> Outcome {
        let outcome = loop {
            match self.session.step(self.now, self.port.len()) {
                Step::Done(outcome) => break outcome,
                Step::Send(bytes) => self.port.extend(bytes),
                Step::Wait(_) => {}
            }
            self.notes.extend(self.session.take_notes());
            self.pass();
            assert!(self.now < TOO_LONG, "no end: {:?}", self.session.status());
        };
        (0..100_000).for_each(|_| self.pass());
        outcome
    }

    fn pass(&mut self) {
        self.now += Duration::from_millis(4);
        self.machine.run_until(self.now);
        // Questions are taken at any time, the job only where there is room.
        while self.machine.free() > 0
            && let Some(byte) = self.port.pop_front()
        {
            self.machine.receive(byte, self.now);
            if self.stop_at == Some(self.machine.received()) {
                self.session.stop();
            }
        }
        let answers = self.machine.take_answers(self.now);
        self.session.received(&answers);
    }
}

fn meant(job: &[u8], cutter: &Cutter) -> Vec<Motion> {
    let job = Job::parse(job, cutter).expect("valid");
    job.commands().iter().flat_map(|command| command.motions().to_vec()).collect()
}

#[test]
fn a_job_arrives_whole_and_the_machine_says_that_it_is_done() {
    for name in ["silhouette", "silhouette-classic"] {
        let cutter = cutter(name);
        let job = figure(&cutter).repeat(20);
        let options = VirtualOptions { buffer_bytes: 256, ..VirtualOptions::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options);
        let outcome = rehearsal.run();
        assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, true), "{name}");
        assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "{name}");
        assert_eq!(rehearsal.machine.motions(), meant(&job, &cutter), "{name}");
    }
}

#[test]
fn the_tool_is_lifted_after_a_stop_at_every_byte() {
    let cutter = cutter("silhouette");
    let job = figure(&cutter);
    for stop_at in 1..job.len() as u64 {
        let options = VirtualOptions { buffer_bytes: 256, ..VirtualOptions::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options);
        rehearsal.stop_at = Some(stop_at);
        let outcome = rehearsal.run();
        assert!(matches!(outcome.end, End::Stopped | End::Finished), "byte {stop_at}: {outcome:?}");
        assert!(!rehearsal.machine.is_pen_down(), "byte {stop_at}");
        assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "byte {stop_at}");
        // To lift is to move to where the tool is.
        let moved = |motions: &[Motion]| -> Vec<Motion> {
            motions.iter().filter(|motion| motion.from != motion.to).copied().collect()
        };
        let is_start = moved(&meant(&job, &cutter)).starts_with(&moved(rehearsal.machine.motions()));
        assert!(is_start, "byte {stop_at}: a wrong move");
    }
}

#[test]
fn a_machine_that_never_answers_is_told_and_ends_in_time() {
    let cutter = cutter("silhouette");
    let job = figure(&cutter);
    let options = VirtualOptions { answers: false, ..VirtualOptions::default() };
    let mut rehearsal = Rehearsal::new(&job, &cutter, options);
    let outcome = rehearsal.run();
    assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, false));
    assert!(rehearsal.notes.join("\n").contains("no answer"), "{:?}", rehearsal.notes);
    assert!(!rehearsal.machine.is_pen_down());
}

#[test]
fn lost_and_garbled_answers_do_no_harm() {
    let cutter = cutter("silhouette");
    let job = figure(&cutter);
    for (garbage_every, silence_every) in [(2, 0), (0, 2), (3, 2)] {
        let faults = Faults { garbage_every, silence_every, ..Faults::default() };
        let mut rehearsal =
            Rehearsal::new(&job, &cutter, VirtualOptions { faults, ..VirtualOptions::default() });
        assert_eq!(rehearsal.run().end, End::Finished);
        assert_eq!(rehearsal.machine.motions(), meant(&job, &cutter));
    }
}

#[test]
fn a_machine_without_a_sheet_is_sent_nothing_until_it_has_one() {
    let cutter = cutter("silhouette");
    let mut session =
        Session::new(Job::parse(&figure(&cutter), &cutter).unwrap(), &cutter, Handshake::Usb, None);
    let mut sent = Vec::new();
    for k in 0..2000u64 {
        if let Step::Send(bytes) = session.step(Duration::from_millis(4 * k), 0) {
            session.received(if k < 1500 { b"2\x03" } else { b"0\x03" });
            sent.push((k, bytes));
        }
    }
    let is_question = |bytes: &[u8]| [&b"\x1b\x04"[..], b"\x1b\x05"].contains(&bytes);
    assert!(sent.iter().filter(|(k, _)| *k < 1500).all(|(_, bytes)| is_question(bytes)));
    assert!(sent.iter().any(|(k, bytes)| *k >= 1500 && !is_question(bytes)));
    assert!(session.take_notes().join("\n").contains("load it"));
}
