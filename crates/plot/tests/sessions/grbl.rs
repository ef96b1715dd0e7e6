//! Sessions with GRBL: character counting, faults of the answers, machines that are not as they should be.

use super::jobs::{self, meant, moved, profile};
use super::rehearsal;
use tatamu_plot::plotter::session::End;
use tatamu_plot::plotter::{Cutter, Faults, Point, VirtualGrbl, VirtualMachine, VirtualOptions};

pub const MACHINES: [&str; 3] = ["grbl-laser", "grbl-knife", "grbl-pen"];

pub type Rehearsal = rehearsal::Rehearsal<VirtualGrbl>;

/// The test figure as a job for a machine.
pub fn figure(cutter: &Cutter) -> Vec<u8> {
    jobs::figure(cutter, if cutter.power().is_some() { "laser-card" } else { "cardstock-200" })
}

/// What sets speed and power.
pub fn settings(cutter: &Cutter) -> &'static str {
    if cutter.power().is_some() { "F6000\nS300\n" } else { "F6000\n" }
}

/// Many short lines, so that the buffer is what limits; some strokes are long.
pub fn long_job(cutter: &Cutter, strokes: usize, lines: usize) -> Vec<u8> {
    let stroke = |k: usize| {
        let (x, y) = ((k % 20) as i32 * 9000, (k / 20 % 25) as i32 * 9000);
        let next = (1..=lines as i32).map(|i| Point::new(x + 150 * i, y + 777 * (i % 3)));
        std::iter::once(Point::new(x, y)).chain(next).collect()
    };
    jobs::job_of(cutter, settings(cutter), (0..strokes).map(stroke))
}

pub fn options(faults: Faults) -> VirtualOptions {
    VirtualOptions { buffer_bytes: 128, faults, ..VirtualOptions::default() }
}

#[test]
fn a_job_arrives_whole_in_a_small_buffer() {
    for name in MACHINES {
        let cutter = profile(name);
        for job in [figure(&cutter), long_job(&cutter, 100, 40)] {
            let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
            let outcome = rehearsal.run();
            assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, true), "{name}");
            assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "{name}");
            assert_eq!(rehearsal.machine.motions(), moved(&meant(&job, &cutter)), "{name}");
            assert!(!rehearsal.machine.is_pen_down() && !rehearsal.worked_after_end, "{name}");
        }
    }
}

#[test]
fn a_megabyte_loses_nothing() {
    let cutter = profile("grbl-laser");
    let job = long_job(&cutter, 1300, 45);
    assert!(job.len() > 1_000_000, "{}", job.len());
    let mut rehearsal =
        Rehearsal::new(&job, &cutter, options(Faults { slowness: 0.02, ..Faults::default() }));
    assert_eq!(rehearsal.run().end, End::Finished);
    assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0));
    assert_eq!(rehearsal.machine.motions(), moved(&meant(&job, &cutter)));
}
#[test]
fn late_garbled_and_lost_answers_lose_nothing() {
    let mut rng = fastrand::Rng::with_seed(3);
    for round in 0..40 {
        let cutter = profile(MACHINES[round % 3]);
        let job = long_job(&cutter, 6, 30);
        let faults = Faults {
            slowness: 0.3 + 4.0 * rng.f64(),
            garbage_every: [0, 13, 37][rng.usize(0..3)],
            silence_every: [0, 11, 29][rng.usize(0..3)],
            error_at: None,
        };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(faults));
        let is_stopped = rng.bool();
        rehearsal.stop_at = Some(1 + rng.u64(0..job.len() as u64)).filter(|_| is_stopped);
        let outcome = rehearsal.run();
        let what = format!("round {round}: {faults:?} {outcome:?}");
        assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "{what}");
        assert!(!rehearsal.machine.is_pen_down() && !rehearsal.worked_after_end, "{what}");
        if outcome.end == End::Finished {
            assert_eq!(rehearsal.machine.motions(), moved(&meant(&job, &cutter)), "{what}");
        } else {
            assert!(is_stopped, "{what}");
        }
    }
}

#[test]
fn a_line_that_is_refused_ends_the_job_with_the_beam_off() {
    for name in MACHINES {
        let cutter = profile(name);
        let job = long_job(&cutter, 12, 20);
        let faults = Faults { error_at: Some(job.len() as u64 / 2), ..Faults::default() };
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(faults));
        let outcome = rehearsal.run();
        assert_eq!(outcome.end, End::Rejected(2), "{name}");
        assert!(outcome.strokes_done > 0 && outcome.strokes_done < 12, "{name}: {outcome:?}");
        assert!(!rehearsal.machine.is_pen_down() && !rehearsal.worked_after_end, "{name}");
    }
}

#[test]
fn an_alarm_in_the_middle_switches_off_and_moves_nothing() {
    let cutter = profile("grbl-laser");
    let job = long_job(&cutter, 12, 20);
    let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
    rehearsal.session.received(b"Grbl 1.1h\r\n");
    while rehearsal.machine.received() < 900 {
        assert_eq!(rehearsal.advance(), None);
    }
    rehearsal.machine.alarm(1);
    let moved = rehearsal.machine.motions().len();
    assert_eq!(rehearsal.run().end, End::Alarm(1));
    assert_eq!(rehearsal.machine.motions().len(), moved);
    assert!(!rehearsal.machine.is_beam_on() && !rehearsal.worked_after_end);
}
#[test]
fn a_laser_without_laser_mode_is_sent_nothing() {
    let cutter = profile("grbl-laser");
    for (number, value) in [(32, 0.0), (30, 255.0)] {
        let mut rehearsal = Rehearsal::new(&figure(&cutter), &cutter, options(Faults::default()));
        rehearsal.machine.set(number, value);
        assert!(matches!(rehearsal.run().end, End::Setting { number: n, .. } if n == number));
        assert!(rehearsal.machine.motions().is_empty());
    }
}

#[test]
fn a_machine_that_is_locked_or_silent_is_sent_nothing() {
    let cutter = profile("grbl-knife");
    let mut rehearsal = Rehearsal::new(&figure(&cutter), &cutter, options(Faults::default()));
    rehearsal.machine.alarm(1);
    // The board does not restart with the port: it is reset.
    rehearsal.greets = false;
    let started = rehearsal.now;
    assert_eq!(rehearsal.run().end, End::Alarm(1));
    assert!(rehearsal.machine.motions().is_empty() && started < rehearsal.now);
    let mute = VirtualOptions { answers: false, ..options(Faults::default()) };
    let mut rehearsal = Rehearsal::new(&figure(&cutter), &cutter, mute);
    rehearsal.greets = false;
    assert_eq!(rehearsal.run().end, End::NoAnswer);
    assert!(rehearsal.machine.motions().is_empty());
}

#[test]
fn a_line_that_does_not_arrive_ends_the_job_before_it_is_called_done() {
    let cutter = profile("grbl-laser");
    let job = b"G21\nG90\nM5\nF600\nS300\nG0 X10 Y10\nM4\nG1 X20 Y10\nG1 X20 Y30\nM5\n";
    let mut rehearsal = Rehearsal::new(job, &cutter, options(Faults::default()));
    rehearsal.swallowed = Some("G1 X20 Y30\n");
    assert_eq!(rehearsal.run().end, End::LinesLost);
    assert!(!rehearsal.machine.is_pen_down() && !rehearsal.worked_after_end);
}

#[test]
fn a_machine_that_restarts_by_itself_is_told() {
    let cutter = profile("grbl-pen");
    let job = long_job(&cutter, 12, 20);
    let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
    rehearsal.session.received(b"Grbl 1.1h\r\n");
    while rehearsal.machine.received() < 900 {
        assert_eq!(rehearsal.advance(), None);
    }
    rehearsal.session.received(b"\r\nGrbl 1.1h ['$' for help]\r\n");
    assert_eq!(rehearsal.run().end, End::Restarted);
    assert!(!rehearsal.machine.is_pen_down());
}
