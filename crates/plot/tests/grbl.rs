//! Sessions with GRBL, against a simulated machine, on a line of modelled speed and in modelled time.

use std::collections::VecDeque;
use std::time::Duration;
use tatamu_plot::plotter::profile::{CUTTERS, Handshake, MEDIA};
use tatamu_plot::plotter::session::{End, Outcome, Session, State, Step};
use tatamu_plot::plotter::{
    Cutter, Faults, Job, Media, Motion, Plan, Point, VirtualGrbl, VirtualMachine, VirtualOptions, test_cut,
};

const MACHINES: [&str; 3] = ["grbl-laser", "grbl-knife", "grbl-pen"];
/// No job of these tests takes longer.
const TOO_LONG: Duration = Duration::from_secs(3000);

fn profile(name: &str) -> Cutter {
    Cutter::parse(CUTTERS.iter().find(|p| p.name == name).expect("exists").text).expect("valid")
}

/// The test figure as a job for a machine.
fn figure(cutter: &Cutter) -> Vec<u8> {
    let medium = if cutter.power().is_some() { "laser-card" } else { "cardstock-200" };
    let medium = Media::parse(MEDIA.iter().find(|p| p.name == medium).expect("exists").text).expect("valid");
    Plan::new(&test_cut(), cutter, &medium).expect("fits").bytes().to_vec()
}

/// Many short lines, so that the buffer is what limits; some strokes are long.
fn long_job(cutter: &Cutter, strokes: usize, lines: usize) -> Vec<u8> {
    let mut job = cutter.start().as_bytes().to_vec();
    let lift = cutter.dialect().lift(Point::default());
    let lower = cutter.tool(tatamu_plot::toolpath::Operation::Cut).expect("cuts").lower();
    job.extend(lift.iter().chain(b"F6000\n"));
    job.extend(if cutter.power().is_some() { &b"S300\n"[..] } else { b"" });
    for k in 0..strokes {
        let (x, y) = ((k % 20) as i32 * 9000, (k / 20 % 25) as i32 * 9000);
        job.extend(cutter.dialect().travel(Point::default(), Point::new(x, y)));
        job.extend(lower.as_bytes());
        let to: Vec<Point> = (1..=lines as i32).map(|i| Point::new(x + 150 * i, y + 777 * (i % 3))).collect();
        job.extend(cutter.dialect().draw(Point::new(x, y), &to).concat());
        job.extend(&lift);
    }
    job.extend(cutter.end().as_bytes());
    job
}

fn meant(job: &[u8], cutter: &Cutter) -> Vec<Motion> {
    let job = Job::parse(job, cutter).expect("valid");
    let motions = job.commands().iter().flat_map(|command| command.motions().to_vec());
    motions.filter(|motion| motion.from != motion.to).collect()
}

/// Motions whose breaks by a hold are gone: parts of one straight line in one.
fn whole(motions: &[Motion]) -> Vec<Motion> {
    let mut out: Vec<Motion> = Vec::new();
    for motion in motions {
        match out.last_mut() {
            Some(last) if last.is_down == motion.is_down && is_between(last.from, last.to, motion.to) => {
                last.to = motion.to;
            }
            _ => out.push(*motion),
        }
    }
    out
}

/// Whether `p` is on the line from `a` to `b`, within the rounding of a hold.
fn is_between(a: Point, p: Point, b: Point) -> bool {
    a.distance(p) + p.distance(b) - a.distance(b) < 0.01
}

/// A host, a line and a machine.
struct Rehearsal {
    session: Session,
    machine: VirtualGrbl,
    stop_at: Option<u64>,
    stop_wishes: u32,
    /// The board starts when the port is opened.
    greets: bool,
    /// A line that does not arrive.
    swallowed: Option<&'static str>,
    byte: Duration,
    now: Duration,
    port: VecDeque<u8>,
    line_free: Duration,
    /// Time in which the beam was on since the session ended.
    beam_after_end: bool,
}

impl Rehearsal {
    fn new(job: &[u8], cutter: &Cutter, options: VirtualOptions) -> Self {
        let job = Job::parse(job, cutter).expect("valid");
        Self {
            session: Session::new(job, cutter, Handshake::Count, None),
            machine: VirtualGrbl::new(cutter, options),
            stop_at: None,
            stop_wishes: 1,
            greets: true,
            swallowed: None,
            byte: Duration::from_secs_f64(cutter.serial().byte_s()),
            now: Duration::ZERO,
            port: VecDeque::new(),
            line_free: Duration::ZERO,
            beam_after_end: false,
        }
    }

    fn run(&mut self) -> Outcome {
        if self.greets && self.now.is_zero() {
            self.session.received(b"\r\nGrbl 1.1h ['$' for help]\r\n");
        }
        let outcome = loop {
            if let Some(outcome) = self.advance() {
                break outcome;
            }
            assert!(self.now < TOO_LONG, "no end: {:?}", self.session.status());
        };
        for _ in 0..2000 {
            self.pass(Duration::from_millis(5));
            self.beam_after_end |= self.machine.is_beam_on();
        }
        outcome
    }

    fn advance(&mut self) -> Option<Outcome> {
        match self.session.step(self.now, self.port.len()) {
            Step::Done(outcome) => return Some(outcome),
            Step::Send(bytes) => {
                let mut text = String::from_utf8_lossy(&bytes).into_owned();
                if let Some(line) = self.swallowed.filter(|line| text.contains(line)) {
                    text = text.replacen(line, "", 1);
                    self.swallowed = None;
                }
                self.port.extend(text.bytes());
            }
            Step::Wait(wait) => self.pass(wait.clamp(Duration::from_micros(200), Duration::from_millis(4))),
        }
        None
    }

    fn pass(&mut self, wait: Duration) {
        let end = self.now + wait;
        self.line_free = self.line_free.max(self.now);
        while self.line_free + self.byte <= end {
            let Some(byte) = self.port.pop_front() else { break };
            self.line_free += self.byte;
            self.machine.receive(byte, self.line_free);
            if self.stop_at == Some(self.machine.received()) {
                (0..self.stop_wishes).for_each(|_| self.session.stop());
            }
        }
        self.machine.run_until(end);
        self.now = end;
        let answers = self.machine.take_answers(end);
        self.session.received(&answers);
    }
}

fn options(faults: Faults) -> VirtualOptions {
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
            assert_eq!(rehearsal.machine.motions(), meant(&job, &cutter), "{name}");
            assert!(!rehearsal.machine.is_pen_down() && !rehearsal.beam_after_end, "{name}");
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
    assert_eq!(rehearsal.machine.motions(), meant(&job, &cutter));
}

#[test]
fn the_tool_is_up_and_the_beam_off_after_a_stop_at_every_byte() {
    for name in MACHINES {
        let cutter = profile(name);
        let job = figure(&cutter);
        let meant = meant(&job, &cutter);
        for wishes in [1, 2] {
            // What is asked before the job is 8 bytes long, and a question more comes now and then.
            for stop_at in 1..=job.len() as u64 + 8 {
                let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
                (rehearsal.stop_at, rehearsal.stop_wishes) = (Some(stop_at), wishes);
                let outcome = rehearsal.run();
                let at = format!("{name}, byte {stop_at}, {wishes} wishes: {outcome:?}");
                assert!(!rehearsal.machine.is_pen_down() && !rehearsal.beam_after_end, "{at}");
                assert!(!rehearsal.machine.is_beam_on(), "{at}");
                assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "{at}");
                assert!(matches!(outcome.end, End::Stopped | End::Finished), "{at}");
                assert!(outcome.is_confirmed, "{at}");
                assert!(!rehearsal.machine.has_alarm(), "{at}");
                // Nothing but what was meant was drawn, and what counts as done was.
                let drawn = drawn(rehearsal.machine.motions());
                assert!(drawn.iter().all(|d| is_part(d, &meant)), "{at}");
                let strokes = Job::parse(&job, &cutter).unwrap();
                let done = strokes.commands().iter().filter(|c| c.strokes_done() < outcome.strokes_done);
                for motion in done.flat_map(|c| c.motions()).filter(|m| m.is_down) {
                    assert!(covers(&drawn, motion), "{at}: {motion:?} was not drawn");
                }
            }
        }
    }
}

fn drawn(motions: &[Motion]) -> Vec<Motion> {
    whole(motions).into_iter().filter(|motion| motion.is_down).collect()
}

fn is_part(motion: &Motion, of: &[Motion]) -> bool {
    let on = |m: &Motion, p: Point| is_between(m.from, p, m.to);
    // Several meant lines in a row may be one straight line.
    whole(of).iter().any(|m| m.is_down && on(m, motion.from) && on(m, motion.to))
}

fn covers(drawn: &[Motion], motion: &Motion) -> bool {
    drawn.iter().any(|d| is_between(d.from, motion.from, d.to) && is_between(d.from, motion.to, d.to))
}

#[test]
fn a_stopped_job_goes_on_with_the_same_drawn_geometry() {
    for name in MACHINES {
        let cutter = profile(name);
        let job = long_job(&cutter, 12, 20);
        let meant = meant(&job, &cutter);
        for stop_at in (200..job.len() as u64).step_by(211) {
            let mut first = Rehearsal::new(&job, &cutter, options(Faults::default()));
            first.stop_at = Some(stop_at);
            let outcome = first.run();
            let rest = Job::parse(&job, &cutter).unwrap().from_stroke(
                outcome.strokes_done,
                &[],
                cutter.dialect().as_ref(),
            );
            let mut again = Rehearsal::new(&rest, &cutter, options(Faults::default()));
            assert_eq!(again.run().end, End::Finished);
            let mut both = drawn(first.machine.motions());
            both.extend(drawn(again.machine.motions()));
            for motion in meant.iter().filter(|motion| motion.is_down) {
                assert!(covers(&both, motion), "{name}, byte {stop_at}: {motion:?} was never drawn");
            }
            assert!(both.iter().all(|motion| is_part(motion, &meant)), "{name}, byte {stop_at}");
            assert!(
                stop_at < 1500 || outcome.strokes_done > 0,
                "{name}, byte {stop_at}: nothing counts as done"
            );
        }
    }
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
        assert!(!rehearsal.machine.is_pen_down() && !rehearsal.beam_after_end, "{what}");
        if outcome.end == End::Finished {
            assert_eq!(rehearsal.machine.motions(), meant(&job, &cutter), "{what}");
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
        assert!(!rehearsal.machine.is_pen_down() && !rehearsal.beam_after_end, "{name}");
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
    assert!(!rehearsal.machine.is_beam_on() && !rehearsal.beam_after_end);
}

#[test]
fn a_pause_has_the_tool_up_or_the_beam_off_and_changes_nothing() {
    for name in MACHINES {
        let cutter = profile(name);
        let job = long_job(&cutter, 6, 40);
        let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
        rehearsal.session.received(b"Grbl 1.1h\r\n");
        while rehearsal.machine.received() < 1500 {
            assert_eq!(rehearsal.advance(), None);
        }
        rehearsal.session.pause();
        let until = rehearsal.now + Duration::from_secs(40);
        while rehearsal.now < until {
            assert_eq!(rehearsal.advance(), None);
        }
        assert_eq!(rehearsal.session.status().state, State::Paused, "{name}");
        assert!(!rehearsal.machine.is_beam_on(), "{name}");
        assert!(name == "grbl-laser" || !rehearsal.machine.is_pen_down(), "{name}");
        rehearsal.session.go_on();
        assert_eq!(rehearsal.run().end, End::Finished, "{name}");
        let down = |motions: &[Motion]| drawn(motions);
        assert_eq!(down(rehearsal.machine.motions()), down(&meant(&job, &cutter)), "{name}");
    }
}

#[test]
fn a_laser_holds_when_all_is_sent_and_it_still_cuts() {
    let cutter = profile("grbl-laser");
    let job = b"G21\nG90\nM5\nF600\nS300\nG0 X10 Y10\nM4\nG1 X210 Y10\nG0 X10 Y20\n";
    let mut rehearsal = Rehearsal::new(job, &cutter, options(Faults::default()));
    rehearsal.session.received(b"Grbl 1.1h\r\n");
    while rehearsal.session.status().state != State::Finishing {
        assert_eq!(rehearsal.advance(), None);
    }
    while !rehearsal.machine.is_beam_on() {
        assert_eq!(rehearsal.advance(), None);
    }
    rehearsal.session.pause();
    let until = rehearsal.now + Duration::from_secs(60);
    while rehearsal.now < until {
        assert_eq!(rehearsal.advance(), None);
    }
    assert!(!rehearsal.machine.is_beam_on() && rehearsal.machine.motions().len() < 3);
    rehearsal.session.go_on();
    assert_eq!(rehearsal.run().end, End::Finished);
    assert_eq!(whole(rehearsal.machine.motions()), whole(&meant(job, &cutter)));
}

/// A machine that was reset while it homed does not know where it is: no tool moves.
#[test]
fn a_stop_while_the_machine_homes_moves_nothing() {
    let text = profile("grbl-knife").text().replace("home = false", "home = true");
    let cutter = Cutter::parse(&text).unwrap();
    let job = Job::parse(&figure(&cutter), &cutter).unwrap();
    let mut session = Session::new(job, &cutter, Handshake::Count, None);
    session.received(b"Grbl 1.1h\r\n<Alarm|MPos:0,0,0>\r\n");
    let (mut now, mut sent) = (Duration::ZERO, Vec::new());
    let outcome = loop {
        match session.step(now, 0) {
            Step::Done(outcome) => break outcome,
            Step::Send(bytes) => {
                match bytes.as_slice() {
                    b"?" => session.received(b"<Alarm|MPos:0,0,0>\r\n"),
                    b"$H\n" => session.stop(),
                    [0x18] => session.received(b"ALARM:6\r\n\r\nGrbl 1.1h\r\n"),
                    _ => {}
                }
                sent.extend(bytes);
            }
            Step::Wait(_) => now += Duration::from_millis(5),
        }
        assert!(now < Duration::from_secs(60));
    };
    assert_eq!(outcome.end, End::Stopped);
    let text = String::from_utf8_lossy(&sent).into_owned();
    assert!(text.contains("$H") && text.contains('\u{18}') && !text.contains('Z'), "{text:?}");
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
    // The board does not start anew with the port: it is reset.
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
    assert!(!rehearsal.machine.is_pen_down() && !rehearsal.beam_after_end);
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

/// A machine that says anything at any time: the session ends, and a beam that was switched on is switched off.
#[test]
fn whatever_the_machine_says_the_session_ends_with_the_beam_off() {
    const SAYS: [&[u8]; 14] = [
        b"ok\r\n",
        b"ok\r\nok\r\nok\r\n",
        b"error:2\r\n",
        b"ALARM:1\r\n",
        b"ALARM:99999999\r\n",
        b"<Idle|MPos:1.0,2.0,0.0|WCO:0,0,0>\r\n",
        b"<Idle>\r\n",
        b"<Hold:0|WPos:x,,>\r\n",
        b"<Alarm>\r\n",
        b"Grbl 1.1h\r\n",
        b"$30=1000\r\n$32=1\r\nok\r\n",
        b"\x11\x13\xff\xc3",
        b"\xc3\xa9rb\r\n",
        b"",
    ];
    let cutter = profile("grbl-laser");
    let job = figure(&cutter);
    let mut started = 0;
    for seed in 0..600 {
        let mut rng = fastrand::Rng::with_seed(seed);
        let job = Job::parse(&job, &cutter).expect("valid");
        let mut session = Session::new(job, &cutter, Handshake::Count, None);
        // Half of the machines begin as they should.
        if rng.bool() {
            session.received(b"Grbl 1.1h\r\n");
        }
        let (mut now, mut sent, mut wishes) = (Duration::ZERO, Vec::new(), 0);
        let outcome = loop {
            match session.step(now, 0) {
                Step::Done(outcome) => break outcome,
                Step::Send(bytes) => sent.extend(bytes),
                Step::Wait(_) => now += Duration::from_millis(5),
            }
            let is_lucky = seed % 3 == 0;
            let answers: &[usize] =
                if is_lucky { &[0, 6, 6, 10] } else { &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13] };
            if rng.u8(0..8) == 0 {
                session.received(SAYS[answers[rng.usize(0..answers.len())]]);
            }
            if wishes < 2 && now > Duration::from_secs(30 * (wishes + 1)) {
                wishes += 1;
                session.stop();
            }
            assert!(now < Duration::from_secs(400), "seed {seed}: no end, {:?}", session.status());
        };
        let last = |word: &[u8]| sent.windows(word.len()).rposition(|bytes| bytes == word);
        let (on, off) = (last(b"M4"), last(b"M5").max(last(&[0x18])));
        started += u32::from(on.is_some());
        assert!(on <= off, "seed {seed}: {outcome:?}");
        assert!(
            on.is_none() || outcome.end == End::Finished || last(b"M4") < last(&[0x18]),
            "seed {seed}: {outcome:?}"
        );
    }
    assert!(started > 50, "only {started} jobs began");
}
