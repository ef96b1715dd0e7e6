//! Jobs that end at any byte, and go on with the same machine.

use super::grbl;
use super::jobs::{drawn, is_on, job_of, profile};
use super::rehearsal::{Rehearsal, Simulated};
use std::time::Duration;
use tatamu_plot::plotter::session::{End, MOST_IN_FLIGHT};
use tatamu_plot::plotter::{
    Command, Cutter, Faults, Interruption, Job, Motion, Point, VirtualEbb, VirtualGrbl, VirtualOptions,
    VirtualPlotter,
};

/// Ends of a job, for each machine.
const ENDS: usize = 1000;
/// The machine stands still for this time before the job goes on.
const PAUSE: Duration = Duration::from_secs(600);

/// Strokes of three or four lines; no two lines are the same.
fn job(cutter: &Cutter, settings: &str, strokes: usize) -> Vec<u8> {
    let mm = cutter.frame().units_per_mm().value();
    let at = |x: f64, y: f64| Point::new((x * mm).round() as i32, (y * mm).round() as i32);
    let stroke = |k: usize| {
        let (x, y) = (5.0 + 2.2 * (k % 40) as f64, 5.0 + 2.2 * (k / 40) as f64);
        let mut points = vec![at(x, y), at(x + 1.5, y), at(x + 1.5, y + 1.5), at(x, y + 1.5)];
        points.extend(k.is_multiple_of(3).then(|| at(x + 0.5, y + 0.5)));
        points
    };
    job_of(cutter, settings, (0..strokes).map(stroke))
}

/// What a job draws: lines, each with its stroke.
fn lines_of(job: &Job) -> Vec<(usize, Motion)> {
    let motions = |command: &Command| command.motions().to_vec();
    let of_stroke = job.commands().chunk_by(|a, b| a.strokes_done() == b.strokes_done());
    let lines = of_stroke.flat_map(|commands| {
        let own = drawn(&commands.iter().flat_map(motions).collect::<Vec<_>>());
        own.into_iter().map(|line| (commands[0].strokes_done(), line))
    });
    lines.collect()
}

/// Lines of a job that motions draw, in its order, and whether each is drawn whole; `None` where one is not of the job.
fn followed(motions: &[Motion], lines: &[(usize, Motion)]) -> Option<Vec<(usize, bool)>> {
    let mut at = 0;
    let follow = |motion: &Motion| {
        at += lines[at..].iter().position(|(_, line)| is_on(line, motion))?;
        Some((at, is_on(motion, &lines[at].1)))
    };
    motions.iter().map(follow).collect()
}

/// Bytes of the commands that belong to strokes, from one to before another.
fn bytes_of(job: &Job, from: usize, to: usize) -> usize {
    let own = job.commands().iter().filter(|command| (from..to).contains(&command.strokes_done()));
    own.map(|command| command.bytes().len()).sum()
}

/// What a machine may still do of what it was sent, in bytes of the job.
type Held = fn(buffer_bytes: usize, longest: usize) -> usize;

/// Ends a job at a random byte and goes on with it.
fn ends_and_goes_on<M: Simulated>(cutter: &Cutter, bytes: &[u8], random: &mut fastrand::Rng, held: Held) {
    let buffer_bytes = random.usize(80..=1024);
    let faults = Faults { slowness: 0.02 + 0.1 * random.f64(), ..Faults::default() };
    let options = VirtualOptions { buffer_bytes, faults, ..VirtualOptions::default() };
    let interruption = Interruption::ALL[random.usize(..3)];
    let at = random.u64(1..=bytes.len() as u64);
    let case = format!("{:?}, buffer of {buffer_bytes}, {interruption:?} at byte {at}", M::HANDSHAKE);

    let cutter = &with_buffer(cutter, buffer_bytes);
    let whole = Job::parse(bytes, cutter).expect("valid");
    let mut first = Rehearsal::<M>::new(bytes, cutter, options);
    match interruption {
        Interruption::Stop => first.stop_at = Some(at),
        Interruption::Unplug => first.unplug_at = Some(at),
        Interruption::Kill => {}
    }
    let done = if interruption == Interruption::Kill {
        first.session.received(first.machine.greeting());
        while first.machine.received() < at {
            if first.advance().is_some() {
                return;
            }
        }
        let done = first.session.status().strokes_done;
        first.die();
        done
    } else {
        let outcome = first.run();
        if outcome.end == End::Finished {
            return;
        }
        assert!(interruption != Interruption::Stop || !first.machine.is_pen_down(), "{case}");
        outcome.strokes_done
    };

    let rest = whole.from_stroke(done, &[], cutter.dialect().as_ref());
    let mut second = first.again(&rest, cutter, PAUSE);
    let before = drawn(second.machine.motions());
    let broken = second.machine.broken();
    let after_from = second.machine.motions().len();
    let outcome = second.run();
    assert_eq!(outcome.end, End::Finished, "{case}");
    assert!(!second.machine.is_pen_down() && !second.worked_after_end, "{case}");
    assert_eq!(second.machine.lost(), 0, "{case}");
    // The part of a command that a board was left with is refused, together with the first question.
    assert!(second.machine.broken() <= broken + u64::from(interruption == Interruption::Unplug), "{case}");

    let after = drawn(&second.machine.motions()[after_from..]);
    let lines = lines_of(&whole);
    let [before, after] = [before, after].map(|motions| {
        followed(&motions, &lines).unwrap_or_else(|| panic!("{case}: drew what the job does not contain"))
    });
    let is_drawn = |k: usize| before.iter().chain(&after).any(|&(line, is_whole)| line == k && is_whole);
    assert!((0..lines.len()).all(is_drawn), "{case}: lines are missing");
    // Two strokes, and those that the machine still had.
    let begun = before.last().map_or(0, |&(line, _)| lines[line].0 + 1);
    let again = bytes_of(&whole, done, begun.saturating_sub(2));
    let longest = whole.commands().iter().map(|command| command.bytes().len()).max();
    let held = held(buffer_bytes, longest.unwrap_or_default());
    assert!(again <= held, "{case}: {again} bytes from stroke {done} on again, {begun} were begun");
}

/// The same cutter with another buffer.
fn with_buffer(cutter: &Cutter, bytes: usize) -> Cutter {
    let is_size = |line: &&str| line.starts_with("buffer_bytes");
    let old = cutter.text().lines().find(is_size).expect("has a buffer").to_owned();
    Cutter::parse(&cutter.text().replace(&old, &format!("buffer_bytes = {bytes}"))).expect("valid")
}

fn ends_anywhere<M: Simulated>(cutter: &Cutter, bytes: &[u8], held: Held) {
    let mut random = fastrand::Rng::with_seed(bytes.len() as u64);
    (0..ENDS).for_each(|_| ends_and_goes_on::<M>(cutter, bytes, &mut random, held));
}

/// The buffer, and the lines that are planned.
#[test]
fn a_machine_with_grbl_goes_on_exactly() {
    for name in grbl::MACHINES {
        let cutter = profile(name);
        let bytes = job(&cutter, grbl::settings(&cutter), 40);
        ends_anywhere::<VirtualGrbl>(&cutter, &bytes, |buffer, longest| buffer + 16 * longest);
    }
}

/// One command is worked on, one waits, and one is on its way.
#[test]
fn an_axidraw_goes_on_exactly() {
    let cutter = profile("axidraw");
    ends_anywhere::<VirtualEbb>(&cutter, &job(&cutter, "", 24), |_, longest| 3 * longest);
}

/// What a Silhouette holds is not known: 8 KiB count as held.
#[test]
fn a_silhouette_goes_on_exactly() {
    let cutter = profile("silhouette");
    let bytes = job(&cutter, "", 300);
    assert!(bytes.len() > 10_000, "{}", bytes.len());
    ends_anywhere::<VirtualPlotter>(&cutter, &bytes, |_, longest| 8192 + MOST_IN_FLIGHT + longest);
}
