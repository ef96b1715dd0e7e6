//! Sessions over USB with a simulated Silhouette: its port takes bytes only while it has room.

use super::jobs::{self, meant, moved, profile};
use super::rehearsal;
use std::time::Duration;
use tatamu_plot::plotter::profile::Handshake;
use tatamu_plot::plotter::session::{End, SLOWNESS, Session, Step};
use tatamu_plot::plotter::{Cutter, Faults, Job, Motion, VirtualMachine, VirtualOptions, VirtualPlotter};

pub type Rehearsal = rehearsal::Rehearsal<VirtualPlotter>;

/// The test figure as a job.
fn figure(cutter: &Cutter) -> Vec<u8> {
    jobs::figure(cutter, "cardstock-200")
}

#[test]
fn a_job_arrives_whole_and_the_machine_says_that_it_is_done() {
    for name in ["silhouette", "silhouette-classic"] {
        let cutter = profile(name);
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
fn a_megabyte_loses_nothing() {
    let cutter = profile("silhouette");
    let figure = figure(&cutter);
    let job = figure.repeat(1_100_000 / figure.len());
    for buffer_bytes in [128, 1024] {
        let faults = Faults { slowness: 1e-3, garbage_every: 5, silence_every: 7, ..Faults::default() };
        let options = VirtualOptions { buffer_bytes, faults, ..VirtualOptions::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options);
        assert_eq!(rehearsal.run().end, End::Finished);
        assert!(rehearsal.machine.received() > 1_000_000);
        assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0));
        assert_eq!(rehearsal.machine.motions(), meant(&job, &cutter));
    }
}

/// Stopped anywhere and continued: each line of the figure is cut, and none that is not of it.
#[test]
fn a_stopped_job_goes_on_with_the_same_drawn_geometry() {
    let cutter = profile("silhouette");
    // More than the machine may hold, so that something counts as done.
    let job = figure(&cutter).repeat(40);
    let whole = Job::parse(&job, &cutter).expect("valid");
    let down =
        |motions: &[Motion]| -> Vec<Motion> { motions.iter().filter(|m| m.is_down).copied().collect() };
    let all = down(&meant(&job, &cutter));
    let mut most_done = 0;
    for stop_at in (1..job.len() as u64).step_by(997) {
        let options = VirtualOptions { buffer_bytes: 256, ..VirtualOptions::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options);
        rehearsal.stop_at = Some(stop_at);
        let outcome = rehearsal.run();
        most_done = most_done.max(outcome.strokes_done);
        let rest = whole.from_stroke(outcome.strokes_done, &[], cutter.dialect().as_ref());
        let mut second = Rehearsal::new(&rest, &cutter, options);
        assert_eq!(second.run().end, End::Finished, "byte {stop_at}");
        let (before, after) = (down(rehearsal.machine.motions()), down(second.machine.motions()));
        // The end of the job is the end of the rest, and what is before that was done before the stop.
        assert!(all.ends_with(&after), "byte {stop_at}: the rest is another");
        let missing = all.len() - after.len();
        assert!(
            before.len() >= missing && before[..missing] == all[..missing],
            "byte {stop_at}: lines are missing"
        );
    }
    assert!(most_done > 0);
}

#[test]
fn the_tool_is_lifted_after_a_stop_at_every_byte() {
    let cutter = profile("silhouette");
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
        let is_start = moved(&meant(&job, &cutter)).starts_with(&moved(rehearsal.machine.motions()));
        assert!(is_start, "byte {stop_at}: a wrong move");
    }
}

#[test]
fn a_machine_that_never_answers_is_told_and_ends_in_time() {
    let cutter = profile("silhouette");
    let job = figure(&cutter);
    let options = VirtualOptions { answers: false, ..VirtualOptions::default() };
    let mut rehearsal = Rehearsal::new(&job, &cutter, options);
    let outcome = rehearsal.run();
    assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, false));
    assert!(rehearsal.notes.join("\n").contains("no answer"), "{:?}", rehearsal.notes);
    let estimate_s = Job::parse(&job, &cutter).expect("valid").seconds();
    let took_s = rehearsal.ended_at.as_secs_f64();
    // Three questions before the job and three after it are waited for.
    assert!(took_s <= estimate_s * SLOWNESS + 15.0, "{took_s} s for a job of {estimate_s} s");
    assert!(!rehearsal.machine.is_pen_down());
}

#[test]
fn lost_and_garbled_answers_do_no_harm() {
    let cutter = profile("silhouette");
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
    let cutter = profile("silhouette");
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

/// The bytes of a question are on their way, too: once, each of them made the machine's last answer worthless, and the
/// job had no end.
#[test]
fn a_question_on_its_way_does_not_keep_a_job_from_its_end() {
    let cutter = profile("silhouette");
    let job = Job::parse(&figure(&cutter), &cutter).expect("valid");
    let mut session = Session::new(job, &cutter, Handshake::Usb, None);
    let mut now = Duration::ZERO;
    let outcome = loop {
        match session.step(now, 0) {
            Step::Done(outcome) => break outcome,
            Step::Send(bytes) if bytes == b"\x1b\x05" => session.received(b"0\x03"),
            Step::Send(_) | Step::Wait(_) => {}
        }
        now += Duration::from_micros(50);
        assert!(now < Duration::from_secs(10), "no end: {:?}", session.status());
    };
    assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, true));
}
