//! Jobs that take a day and a night: long strokes, each as slow as 1 mm/s.

use super::grbl;
use super::jobs::{drawn, job_of, meant, profile};
use super::rehearsal::{Rehearsal, Simulated};
use std::time::Duration;
use tatamu_plot::plotter::session::End;
use tatamu_plot::plotter::{Cutter, Point, VirtualEbb, VirtualGrbl, VirtualOptions, VirtualPlotter};

const DAY: Duration = Duration::from_secs(24 * 3600);
/// Strokes of 28 cm each fill a day.
const STROKES: usize = 310;
const STROKE_MM: f64 = 280.0;

/// A cutter of the library that draws at 1 mm/s.
fn slow(name: &str) -> Cutter {
    let cutter = profile(name);
    let is_speed = |line: &&str| line.starts_with("draw_mm_s");
    let old = cutter.text().lines().find(is_speed).expect("has a speed");
    Cutter::parse(&cutter.text().replace(old, "draw_mm_s = 1")).expect("valid")
}

/// Level lines, one above the other.
fn job(cutter: &Cutter, settings: &str) -> Vec<u8> {
    let mm = cutter.frame().units_per_mm().value();
    let at = |x: f64, y: f64| Point::new((x * mm).round() as i32, (y * mm).round() as i32);
    let stroke = |k: usize| [5.0, 5.0 + STROKE_MM].map(|x| at(x, 5.0 + 0.6 * k as f64)).to_vec();
    job_of(cutter, settings, (0..STROKES).map(stroke))
}

fn takes_a_day<M: Simulated>(name: &str, settings: &str) {
    let cutter = slow(name);
    let job = job(&cutter, settings);
    let mut rehearsal = Rehearsal::<M>::new(&job, &cutter, VirtualOptions::default());
    (rehearsal.least_look, rehearsal.too_long) = (Duration::from_millis(100), 2 * DAY);
    let outcome = rehearsal.run();
    let what = format!("{name}: {outcome:?} after {:?}", rehearsal.ended_at);
    assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, true), "{what}");
    assert_eq!(outcome.strokes_done, STROKES, "{what}");
    // The machine, not the host, is what takes the time.
    assert!((DAY..DAY + DAY / 20).contains(&rehearsal.ended_at), "{what}");
    assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "{what}");
    assert!(!rehearsal.machine.is_pen_down() && !rehearsal.worked_after_end, "{what}");
    assert_eq!(drawn(rehearsal.machine.motions()), drawn(&meant(&job, &cutter)), "{what}");
}

#[test]
fn a_machine_with_grbl_works_for_a_day_and_a_night() {
    std::thread::scope(|scope| {
        for name in grbl::MACHINES {
            let settings = grbl::settings(&profile(name)).replace("F6000", "F60");
            scope.spawn(move || takes_a_day::<VirtualGrbl>(name, &settings));
        }
    });
}

#[test]
fn an_axidraw_works_for_a_day_and_a_night() {
    takes_a_day::<VirtualEbb>("axidraw", "");
}

#[test]
fn a_silhouette_works_for_a_day_and_a_night() {
    takes_a_day::<VirtualPlotter>("silhouette", "");
}
