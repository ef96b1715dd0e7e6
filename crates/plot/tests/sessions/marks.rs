//! Printed marks that a simulated Silhouette looks for.

use super::jobs::{meant, profile};
use super::rehearsal::TOO_LONG;
use super::usb::Rehearsal;
use glam::DVec2;
use std::time::Duration;
use tatamu_draw::drawing::{Drawing, Layer, LineStyles, Mark, Registration};
use tatamu_plot::plotter::profile::Handshake;
use tatamu_plot::plotter::session::{End, Session, Step};
use tatamu_plot::plotter::{
    Cutter, Faults, Job, Media, Motion, Plan, VirtualMachine, VirtualOptions, VirtualPlotter, preview,
    strokes,
};

/// A sheet of A4 with marks: a square to cut, and a crease.
fn marked_sheet(marks: Registration) -> Drawing {
    let styles = LineStyles::standard();
    let mut sheet = Drawing::new("sheet", DVec2::new(210.0, 297.0));
    sheet.registration = Some(marks);
    let square = [[100.0, 150.0], [120.0, 150.0], [120.0, 170.0], [100.0, 170.0]].map(DVec2::from).to_vec();
    sheet.marks = vec![
        Mark::polygon(Layer::Cut, square, styles.stroke(Layer::Cut)),
        Mark::line(
            Layer::Mountain,
            DVec2::new(20.0, 20.0),
            DVec2::new(40.0, 20.0),
            styles.stroke(Layer::Mountain),
        ),
    ];
    sheet
}

fn marked(cutter: &Cutter, marks: Registration) -> Plan {
    Plan::new(&marked_sheet(marks), cutter, &Media::usual()).expect("fits")
}

fn with_marks(marks_mm: Option<[f64; 2]>) -> VirtualOptions {
    VirtualOptions { buffer_bytes: 256, marks_mm, ..VirtualOptions::default() }
}

fn has_cut(machine: &VirtualPlotter) -> bool {
    machine.is_pen_down() || machine.motions().iter().any(|motion| motion.is_down)
}

#[test]
fn the_bytes_that_look_for_marks() {
    for (name, marks, search) in [
        ("silhouette", Registration::Silhouette, "TB123,5540,3800,0,0"),
        ("silhouette-classic", Registration::Silhouette, "TB123,5540,3800,0,0"),
        ("silhouette-alpha", Registration::Silhouette, "TB123,5540,3800,0,0"),
        ("silhouette-alpha", Registration::SilhouetteAlpha, "TB124,5540,3800,0,0"),
    ] {
        let plan = marked(&profile(name), marks);
        let text = String::from_utf8_lossy(plan.bytes()).replace('\u{3}', " ");
        let whole = format!("TB50,0 TB99 TB52,2 TB51,400 TB53,10 TB55,1 {search} ");
        assert!(text.contains(&whole) && plan.notes().is_empty(), "{name}: {text} {:?}", plan.notes());
        // The crease ends 30 mm right of the marks' upper left corner and 267 mm below it; the shaft is 0.9 mm ahead.
        assert!(text.contains(",5340,618 "), "{name}: {text}");
        assert!(text.find(&whole) < text.find('D'), "{name}: cuts before it looks");
    }
    // Nothing looks for marks that are to be aligned by eye, or for those of another machine.
    for (marks, note) in [(Registration::Corners, false), (Registration::SilhouetteAlpha, true)] {
        let plan = marked(&profile("silhouette"), marks);
        assert!(!String::from_utf8_lossy(plan.bytes()).contains("TB99"), "{marks:?}");
        assert_eq!(plan.notes().join("").contains("does not look for"), note, "{:?}", plan.notes());
    }
}

/// The preview of a job that counts from marks shows it where it lies on the sheet.
#[test]
fn a_preview_shows_the_marks_and_the_lines_on_the_sheet() {
    let cutter = profile("silhouette");
    let plan = marked(&cutter, Registration::Silhouette);
    let job = Job::parse(plan.bytes(), &cutter).expect("valid");
    assert_eq!(plan.placement().marks_mm(), Some([DVec2::splat(10.0), DVec2::new(200.0, 287.0)]));
    let corner = strokes(&job, &cutter, plan.placement())[0][0] - plan.toolpath().strokes()[0].shaft()[0];
    let lines = strokes(&job, &cutter, plan.placement());
    for (line, stroke) in lines.iter().zip(plan.toolpath().strokes()) {
        let off = line[0].distance(stroke.shaft()[0] + corner);
        assert!(off < 0.08, "{off}");
    }
    let without = Plan::new(
        &Drawing { registration: None, ..marked_sheet(Registration::Silhouette) },
        &cutter,
        &Media::usual(),
    );
    let without = without.expect("fits");
    let plain = Job::parse(without.bytes(), &cutter).expect("valid");
    // Each mark is a corner with arms of 8 mm.
    let is_corner = |mark: &&Mark| {
        mark.bounds().is_some_and(|(low, high)| (high - low).abs_diff_eq(DVec2::splat(8.0), 1e-9))
    };
    let corners = |job: &Job, plan: &Plan| {
        preview(job, &cutter, plan.placement()).marks.iter().filter(is_corner).count()
    };
    assert_eq!((corners(&job, &plan), corners(&plain, &without)), (4, 0));
}

#[test]
fn what_is_cut_lies_in_the_frame_of_the_marks_wherever_the_sheet_lies() {
    for (name, marks) in
        [("silhouette", Registration::Silhouette), ("silhouette-alpha", Registration::SilhouetteAlpha)]
    {
        let cutter = profile(name);
        let plan = marked(&cutter, marks);
        // The sheet lies 3.3 mm too low and 2.45 mm too far to the left.
        let mut rehearsal = Rehearsal::new(plan.bytes(), &cutter, with_marks(Some([13.3, 7.55])));
        let outcome = rehearsal.run();
        assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, true), "{name}");
        assert!(rehearsal.notes.join("").contains("found the registration marks"));
        assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "{name}");
        let on_sheet = |p: tatamu_plot::plotter::Point| {
            let [down, right] = [f64::from(p.x()) / 20.0 - 3.3, f64::from(p.y()) / 20.0 + 2.45];
            DVec2::new(right, 297.0 - down)
        };
        let lines = |layer: Layer| -> Vec<[DVec2; 2]> {
            let marks = marked_sheet(marks).marks.into_iter().filter(|mark| mark.layer == layer);
            marks.filter_map(|mark| mark.bounds()).map(|(low, high)| [low, high]).collect()
        };
        let down: Vec<DVec2> =
            rehearsal.machine.motions().iter().filter(|m| m.is_down).map(|m| on_sheet(m.to)).collect();
        // Each corner of what is drawn is reached, but for the offset of the blade, and nothing outside of the marks is.
        for corner in lines(Layer::Cut).into_iter().chain(lines(Layer::Mountain)).flatten() {
            assert!(down.iter().any(|p| p.distance(corner) < 1.0), "{name}: {corner}");
        }
        let [low, high] = marks.frame_mm(DVec2::new(210.0, 297.0));
        assert!(down.iter().all(|p| p.clamp(low, high) == *p), "{name}: over the marks");
        // To a unit, all is where the job has it, counted from the marks.
        let meant: Vec<Motion> =
            meant(plan.bytes(), &cutter).into_iter().filter(|motion| motion.is_down).collect();
        let found: Vec<Motion> =
            rehearsal.machine.motions().iter().filter(|motion| motion.is_down).copied().collect();
        assert_eq!(meant.len(), found.len());
        for (meant, found) in meant.iter().zip(&found) {
            assert_eq!((found.to.x() - meant.to.x(), found.to.y() - meant.to.y()), (266, 151), "{name}");
        }
    }
}

#[test]
fn nothing_is_cut_where_the_marks_are_not_found() {
    let cutter = profile("silhouette");
    let plan = marked(&cutter, Registration::Silhouette);
    // None are printed, or they are farther off than the machine looks.
    for marks_mm in [None, Some([25.0, 10.0]), Some([10.0, -3.0])] {
        let mut rehearsal = Rehearsal::new(plan.bytes(), &cutter, with_marks(marks_mm));
        let outcome = rehearsal.run();
        assert_eq!((outcome.end, outcome.strokes_done), (End::MarksNotFound, 0), "{marks_mm:?}");
        assert!(!has_cut(&rehearsal.machine), "{marks_mm:?}");
    }
    // Its answer is lost, or noise.
    for (garbage_every, silence_every) in [(2, 0), (0, 2)] {
        let faults = Faults { garbage_every, silence_every, ..Faults::default() };
        let options = VirtualOptions { faults, ..with_marks(Some([10.0, 10.0])) };
        let mut rehearsal = Rehearsal::new(plan.bytes(), &cutter, options);
        assert_eq!(rehearsal.run().end, End::MarksUnanswered);
        assert!(!has_cut(&rehearsal.machine));
    }
    let mute = VirtualOptions { answers: false, ..with_marks(Some([10.0, 10.0])) };
    let mut rehearsal = Rehearsal::new(plan.bytes(), &cutter, mute);
    assert_eq!(rehearsal.run().end, End::MarksUnanswered);
    assert!(!has_cut(&rehearsal.machine));
}

/// "0" is the answer to the question for the state: one that comes late says nothing about marks.
#[test]
fn a_late_answer_about_the_state_is_not_taken_for_found_marks() {
    let cutter = profile("silhouette");
    let plan = marked(&cutter, Registration::Silhouette);
    let job = Job::parse(plan.bytes(), &cutter).expect("valid");
    let mut session = Session::new(job, &cutter, Handshake::Usb, None);
    let (mut now, mut sent) = (Duration::ZERO, Vec::new());
    let outcome = loop {
        match session.step(now, 0) {
            Step::Done(outcome) => break outcome,
            Step::Send(bytes) => sent.extend(bytes),
            Step::Wait(_) => now += Duration::from_millis(5),
        }
        session.received(b"0\x03");
        assert!(now < TOO_LONG);
    };
    assert_eq!(outcome.end, End::MarksUnanswered);
    assert!(!sent.contains(&b'D'), "{}", String::from_utf8_lossy(&sent));
}

#[test]
fn a_stop_at_every_byte_of_a_job_with_marks_leaves_the_tool_up() {
    let cutter = profile("silhouette");
    let plan = marked(&cutter, Registration::Silhouette);
    for stop_at in 1..plan.bytes().len() as u64 {
        let mut rehearsal = Rehearsal::new(plan.bytes(), &cutter, with_marks(Some([11.0, 9.0])));
        rehearsal.stop_at = Some(stop_at);
        let outcome = rehearsal.run();
        assert!(matches!(outcome.end, End::Stopped | End::Finished), "byte {stop_at}: {outcome:?}");
        assert!(!rehearsal.machine.is_pen_down(), "byte {stop_at}");
        assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "byte {stop_at}");
    }
}

#[test]
fn a_resumed_job_looks_for_the_marks_again() {
    let cutter = profile("silhouette");
    let plan = marked(&cutter, Registration::Silhouette);
    let job = Job::parse(plan.bytes(), &cutter).expect("valid");
    let turns: Vec<usize> = plan
        .toolpath()
        .strokes()
        .iter()
        .enumerate()
        .filter(|(_, stroke)| stroke.is_turn())
        .map(|(k, _)| k)
        .collect();
    let last = job.strokes() - 1;
    let rest = job.from_stroke(last, &turns, cutter.dialect().as_ref());
    let text = String::from_utf8_lossy(&rest).replace('\u{3}', " ");
    assert!(text.contains("TB50,0 TB99 TB52,2 TB51,400 TB53,10 TB55,1 TB123,5540,3800,0,0 "), "{text}");
    let mut rehearsal = Rehearsal::new(&rest, &cutter, with_marks(Some([10.0, 10.0])));
    assert_eq!(rehearsal.run().end, End::Finished);
    // Turned, and the last stroke again, in the same frame.
    let found: Vec<Motion> =
        rehearsal.machine.motions().iter().filter(|motion| motion.is_down).copied().collect();
    let whole: Vec<Motion> =
        meant(plan.bytes(), &cutter).into_iter().filter(|motion| motion.is_down).collect();
    let ends = |motions: &[Motion]| motions.last().map(|motion| (motion.to.x(), motion.to.y()));
    assert_eq!(ends(&found), ends(&whole).map(|(x, y)| (x + 200, y + 200)));
}

#[test]
fn answers_that_come_late_do_no_harm() {
    let cutter = profile("silhouette");
    let plan = marked(&cutter, Registration::Silhouette);
    for late_ms in [300, 1400, 4000] {
        let mut rehearsal = Rehearsal::new(plan.bytes(), &cutter, with_marks(Some([10.0, 10.0])));
        rehearsal.late = Duration::from_millis(late_ms);
        let outcome = rehearsal.run();
        assert_eq!(outcome.end, End::Finished, "{late_ms} ms");
        let down = |motions: &[Motion]| motions.iter().filter(|motion| motion.is_down).count();
        assert_eq!(down(rehearsal.machine.motions()), down(&meant(plan.bytes(), &cutter)), "{late_ms} ms");
        assert!(!rehearsal.machine.is_pen_down(), "{late_ms} ms");
    }
}
