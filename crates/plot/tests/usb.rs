//! Sessions over USB with a simulated Silhouette: its port takes bytes only while it has room.

use glam::DVec2;
use std::collections::VecDeque;
use std::time::Duration;
use tatamu_draw::drawing::{Drawing, Layer, LineStyles, Mark, Registration};
use tatamu_plot::plotter::profile::{CUTTERS, Handshake};
use tatamu_plot::plotter::session::{End, Outcome, SLOWNESS, Session, Step};
use tatamu_plot::plotter::{
    Cutter, Faults, Job, Media, Motion, Plan, VirtualMachine, VirtualOptions, VirtualPlotter, preview,
    strokes, test_cut,
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
    /// How late each answer comes.
    late: Duration,
    answers: VecDeque<(Duration, Vec<u8>)>,
    now: Duration,
    port: VecDeque<u8>,
    notes: Vec<String>,
    ended_at: Duration,
}

impl Rehearsal {
    fn new(job: &[u8], cutter: &Cutter, options: VirtualOptions) -> Self {
        let job = Job::parse(job, cutter).expect("valid");
        Self {
            session: Session::new(job, cutter, Handshake::Usb, None),
            machine: VirtualPlotter::new(cutter, options),
            stop_at: None,
            late: Duration::ZERO,
            answers: VecDeque::new(),
            now: Duration::ZERO,
            port: VecDeque::new(),
            notes: Vec::new(),
            ended_at: Duration::ZERO,
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
        self.ended_at = self.now;
        // What the machine still has is worked off.
        (0..100_000).for_each(|_| {
            if !self.machine.is_idle() || !self.port.is_empty() {
                self.pass()
            }
        });
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
        self.answers.push_back((self.now + self.late, answers));
        while self.answers.front().is_some_and(|(due, _)| *due <= self.now) {
            self.answers.pop_front().iter().for_each(|(_, bytes)| self.session.received(bytes));
        }
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
fn a_megabyte_loses_nothing() {
    let cutter = cutter("silhouette");
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
    let cutter = cutter("silhouette");
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
    let estimate_s = Job::parse(&job, &cutter).expect("valid").seconds();
    let took_s = rehearsal.ended_at.as_secs_f64();
    // Three questions before the job and three after it are waited for.
    assert!(took_s <= estimate_s * SLOWNESS + 15.0, "{took_s} s for a job of {estimate_s} s");
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
fn answers_that_come_late_do_no_harm() {
    let cutter = cutter("silhouette");
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
        let plan = marked(&cutter(name), marks);
        let text = String::from_utf8_lossy(plan.bytes()).replace('\u{3}', " ");
        let whole = format!("TB50,0 TB99 TB52,2 TB51,400 TB53,10 TB55,1 {search} ");
        assert!(text.contains(&whole) && plan.notes().is_empty(), "{name}: {text} {:?}", plan.notes());
        // The crease ends 30 mm right of the marks' upper left corner and 267 mm below it; the shaft is 0.9 mm ahead.
        assert!(text.contains(",5340,618 "), "{name}: {text}");
        assert!(text.find(&whole) < text.find('D'), "{name}: cuts before it looks");
    }
    // Nothing looks for marks that are to be aligned by eye, or for those of another machine.
    for (marks, note) in [(Registration::Corners, false), (Registration::SilhouetteAlpha, true)] {
        let plan = marked(&cutter("silhouette"), marks);
        assert!(!String::from_utf8_lossy(plan.bytes()).contains("TB99"), "{marks:?}");
        assert_eq!(plan.notes().join("").contains("does not look for"), note, "{:?}", plan.notes());
    }
}

/// The preview of a job that counts from marks shows it where it lies on the sheet.
#[test]
fn a_preview_shows_the_marks_and_the_lines_on_the_sheet() {
    let cutter = cutter("silhouette");
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
    let count = |job: &Job, plan: &Plan| {
        let picture = preview(job, &cutter, plan.placement());
        picture.marks.len() - 2 * strokes(job, &cutter, plan.placement()).len()
    };
    assert_eq!(count(&job, &plan), count(&plain, &without) + 4);
}

#[test]
fn what_is_cut_lies_in_the_frame_of_the_marks_wherever_the_sheet_lies() {
    for (name, marks) in
        [("silhouette", Registration::Silhouette), ("silhouette-alpha", Registration::SilhouetteAlpha)]
    {
        let cutter = cutter(name);
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
    let cutter = cutter("silhouette");
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
    let cutter = cutter("silhouette");
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
    let cutter = cutter("silhouette");
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
    let cutter = cutter("silhouette");
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
