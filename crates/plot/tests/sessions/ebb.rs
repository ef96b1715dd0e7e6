//! Sessions with an EiBotBoard (AxiDraw).

use super::jobs::{self, meant, moved, profile};
use super::rehearsal;
use std::time::Duration;
use tatamu_plot::plotter::profile::Handshake;
use tatamu_plot::plotter::session::{End, Session, State, Step};
use tatamu_plot::plotter::{Cutter, Faults, Job, Motion, Point, VirtualEbb, VirtualMachine, VirtualOptions};

type Rehearsal = rehearsal::Rehearsal<VirtualEbb>;

fn axidraw() -> Cutter {
    profile("axidraw")
}

/// The test figure as a job.
fn figure(cutter: &Cutter) -> Vec<u8> {
    jobs::figure(cutter, "pen")
}

/// What is drawn, without the pauses within a line.
pub fn drawn(motions: &[Motion]) -> Vec<(Point, Point)> {
    moved(motions).iter().filter(|motion| motion.is_down).map(|motion| (motion.from, motion.to)).collect()
}

fn options(faults: Faults) -> VirtualOptions {
    VirtualOptions { buffer_bytes: 256, faults, ..VirtualOptions::default() }
}

#[test]
fn a_job_is_drawn_as_it_is_meant_and_ends_at_home_with_the_motors_off() {
    let cutter = axidraw();
    let job = figure(&cutter);
    let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
    let outcome = rehearsal.run();
    assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, true));
    assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0));
    assert_eq!(rehearsal.machine.motions(), moved(&meant(&job, &cutter)));
    assert_eq!(rehearsal.machine.motions().last().map(|motion| motion.to), Some(Point::default()));
    assert!(!rehearsal.machine.is_pen_down() && !rehearsal.machine.is_powered());
    assert!(rehearsal.notes.join("").contains("firmware 2.7.0"), "{:?}", rehearsal.notes);
}

#[test]
fn answers_that_are_lost_or_noise_change_nothing_of_what_is_drawn() {
    let cutter = axidraw();
    let job = figure(&cutter);
    for (garbage_every, silence_every) in [(7, 0), (0, 7), (5, 3), (3, 0), (0, 3)] {
        let faults = Faults { garbage_every, silence_every, slowness: 1.2, ..Faults::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(faults));
        let outcome = rehearsal.run();
        assert!(!rehearsal.machine.is_pen_down(), "{faults:?}");
        assert_eq!(outcome.end, End::Finished, "{faults:?}");
        assert_eq!(rehearsal.machine.motions(), moved(&meant(&job, &cutter)), "{faults:?}");
    }
    // Where every second answer is lost, the job may end, but no line is wrong and the pen is up.
    for (garbage_every, silence_every) in [(2, 0), (0, 2)] {
        let faults = Faults { garbage_every, silence_every, ..Faults::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(faults));
        let outcome = rehearsal.run();
        assert!(matches!(outcome.end, End::Finished | End::NoAnswer), "{faults:?}: {outcome:?}");
        assert!(!rehearsal.machine.is_pen_down(), "{faults:?}");
        assert!(drawn(&meant(&job, &cutter)).starts_with(&drawn(rehearsal.machine.motions())), "{faults:?}");
    }
}

/// A lift that does not arrive is sent again: otherwise the way to the next line is drawn.
#[test]
fn a_command_that_does_not_arrive_is_sent_again_or_ends_the_job() {
    let cutter = axidraw();
    let job = figure(&cutter);
    for swallowed in ["SP,1,300", "SP,0,300", "SC,5", "EM,1,1"] {
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
        rehearsal.swallowed = Some(swallowed);
        assert_eq!(rehearsal.run().end, End::Finished, "{swallowed}");
        assert!(rehearsal.swallowed.is_none(), "{swallowed}");
        assert_eq!(drawn(rehearsal.machine.motions()), drawn(&meant(&job, &cutter)), "{swallowed}");
    }
    let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
    rehearsal.swallowed = Some("XM,");
    assert_eq!(rehearsal.run().end, End::LinesLost);
    assert!(!rehearsal.machine.is_pen_down() && !rehearsal.machine.is_powered());
}

#[test]
fn an_error_answer_lifts_the_pen_and_ends_the_job() {
    let cutter = axidraw();
    let job = figure(&cutter);
    for error_at in [60, 300, 600] {
        let faults = Faults { error_at: Some(error_at), ..Faults::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(faults));
        assert_eq!(rehearsal.run().end, End::Refused(3), "{error_at}");
        assert!(!rehearsal.machine.is_pen_down() && !rehearsal.machine.is_powered(), "{error_at}");
    }
}

#[test]
fn the_pen_is_up_after_a_stop_at_every_byte_once_and_twice() {
    let cutter = axidraw();
    let job = figure(&cutter);
    for stop_at in 1..job.len() as u64 {
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
        rehearsal.stop_at = Some(stop_at);
        rehearsal.stop_wishes = 1 + (stop_at % 2) as u32;
        let outcome = rehearsal.run();
        assert!(matches!(outcome.end, End::Stopped | End::Finished), "byte {stop_at}: {outcome:?}");
        assert!(!rehearsal.machine.is_pen_down(), "byte {stop_at}");
        assert!(stop_at < 3 || !rehearsal.machine.is_powered(), "byte {stop_at}: motors on");
        assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "byte {stop_at}");
    }
}

/// Stopped anywhere and continued: each line of the figure is drawn, and none that is not of it.
#[test]
fn a_stopped_job_that_goes_on_draws_the_same() {
    let cutter = axidraw();
    let job = figure(&cutter);
    let all = drawn(&meant(&job, &cutter));
    let whole = Job::parse(&job, &cutter).expect("valid");
    for stop_at in (1..job.len() as u64).step_by(11) {
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
        rehearsal.stop_at = Some(stop_at);
        let outcome = rehearsal.run();
        if outcome.end == End::Finished {
            continue;
        }
        let rest = whole.from_stroke(outcome.strokes_done, &[], cutter.dialect().as_ref());
        let mut second = Rehearsal::new(&rest, &cutter, options(Faults::default()));
        assert_eq!(second.run().end, End::Finished, "byte {stop_at}");
        let (before, after) = (drawn(rehearsal.machine.motions()), drawn(second.machine.motions()));
        for line in &all {
            assert!(before.contains(line) || after.contains(line), "byte {stop_at}: {line:?} is missing");
        }
        assert!(after.iter().all(|line| all.contains(line)), "byte {stop_at}: drew something else");
        // A line that was stopped in its middle is a part of one of the figure.
        let is_part = |&(a, b): &(Point, Point)| {
            all.iter()
                .any(|&(from, to)| a == from && from.distance(b) + b.distance(to) - from.distance(to) < 1.0)
        };
        assert!(before.iter().all(is_part), "byte {stop_at}: drew something else before the stop");
        assert!(
            stop_at < job.len() as u64 / 2 || outcome.strokes_done > 0,
            "byte {stop_at}: nothing counts as done"
        );
    }
}

#[test]
fn a_pause_lifts_the_pen_and_changes_nothing() {
    let cutter = axidraw();
    let job = figure(&cutter);
    let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
    while !(rehearsal.machine.received() > 300 && rehearsal.machine.is_pen_down()) {
        assert_eq!(rehearsal.advance(), None);
    }
    rehearsal.session.pause();
    let until = rehearsal.now + Duration::from_secs(40);
    while rehearsal.now < until {
        assert_eq!(rehearsal.advance(), None);
    }
    assert_eq!(rehearsal.session.status().state, State::Paused);
    assert!(!rehearsal.machine.is_pen_down());
    rehearsal.session.go_on();
    assert_eq!(rehearsal.run().end, End::Finished);
    assert_eq!(drawn(rehearsal.machine.motions()), drawn(&meant(&job, &cutter)));
}

#[test]
fn a_board_that_is_silent_or_old_is_sent_nothing() {
    let cutter = axidraw();
    let job = figure(&cutter);
    let mute = VirtualOptions { answers: false, ..options(Faults::default()) };
    let mut rehearsal = Rehearsal::new(&job, &cutter, mute);
    assert_eq!(rehearsal.run().end, End::NoAnswer);
    assert!(rehearsal.machine.motions().is_empty() && rehearsal.now < Duration::from_secs(20));
    let mut session = Session::new(Job::parse(&job, &cutter).expect("valid"), &cutter, Handshake::Ok, None);
    assert_eq!(session.step(Duration::ZERO, 0), Step::Send(b"V\r".to_vec()));
    session.received(b"EBBv13_and_above EB Firmware Version 2.5.3\r\n");
    let Step::Done(outcome) = session.step(Duration::from_millis(5), 0) else { panic!("goes on") };
    assert_eq!(outcome.end, End::Firmware { found: [2, 5, 3], needed: [2, 6, 2] });
}

#[test]
fn answers_that_come_late_change_nothing_of_what_is_drawn() {
    let cutter = axidraw();
    let job = figure(&cutter);
    for late_ms in [30, 700, 2500] {
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
        rehearsal.late = Duration::from_millis(late_ms);
        let outcome = rehearsal.run();
        assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, true), "{late_ms} ms");
        assert_eq!(drawn(rehearsal.machine.motions()), drawn(&meant(&job, &cutter)), "{late_ms} ms");
        assert!(!rehearsal.machine.is_pen_down() && !rehearsal.machine.is_powered(), "{late_ms} ms");
    }
}

#[test]
fn a_megabyte_loses_nothing() {
    let cutter = axidraw();
    let figure = figure(&cutter);
    // Each figure begins by switching the motors on at home, where the one before ends.
    let job = figure.repeat(1_100_000 / figure.len());
    let faults = Faults { slowness: 1e-3, ..Faults::default() };
    let mut rehearsal = Rehearsal::new(&job, &cutter, options(faults));
    assert_eq!(rehearsal.run().end, End::Finished);
    assert!(rehearsal.machine.received() > 1_000_000);
    assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0));
    assert_eq!(drawn(rehearsal.machine.motions()), drawn(&meant(&job, &cutter)));
}
