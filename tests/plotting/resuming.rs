//! Jobs that end at any byte, and go on with the same machine.

use super::profile;
use super::rehearsal::Rehearsal;
use std::time::Duration;
use tatamu::plotter::profile::Handshake;
use tatamu::plotter::session::{End, MOST_IN_FLIGHT};
use tatamu::plotter::{Cutter, Faults, Interruption, Job, Motion, VirtualMachine, VirtualOptions};

/// Ends of a job, for each handshake.
const ENDS: usize = 1000;
/// The machine stands still for so long before the job goes on.
const PAUSE: Duration = Duration::from_secs(600);

/// A cutter with a buffer of `buffer_bytes` bytes.
fn cutter(buffer_bytes: usize, answers: bool) -> Cutter {
    let text = profile("generic-hpgl")
        .text()
        .replace("buffer_bytes = 1024", &format!("buffer_bytes = {buffer_bytes}"));
    Cutter::parse(&text.replace("answers = true", &format!("answers = {answers}"))).expect("valid")
}

/// Strokes of two or three lines each; no two lines are the same.
fn job(strokes: usize) -> Vec<u8> {
    let mut job = "IN;PA;SP1;VS10;".to_owned();
    for k in 0..strokes {
        let (x, y) = (1000 + 37 * k, 1000 + 211 * (k % 5));
        job += &format!("PU{x},{y};PD{},{y};PD{},{};", x + 20, x + 20, y + 15);
        if k % 3 == 0 {
            job += &format!("PD{},{},{x},{};", x + 5, y + 25, y + 9);
        }
    }
    job += "PU;SP0;";
    job.into_bytes()
}

fn drawn(motions: &[Motion]) -> Vec<Motion> {
    motions.iter().filter(|motion| motion.is_down).copied().collect()
}

/// How many strokes of a job are begun by its first lines.
fn strokes_of(lines: usize, job: &Job) -> usize {
    let mut left = lines;
    let mut begun = 0;
    for command in job.commands() {
        let drawn = command.motions().iter().filter(|motion| motion.is_down).count();
        if left == 0 {
            break;
        }
        left -= drawn.min(left);
        begun = command.strokes_done() + usize::from(command.is_down_after());
    }
    begun
}

/// Bytes of the lines and travels of the strokes `from..to`.
fn bytes_of(job: &Job, from: usize, to: usize) -> usize {
    let of_strokes = job.commands().iter().filter(|command| !command.motions().is_empty());
    let commands = of_strokes.filter(|command| (from..to).contains(&command.strokes_done()));
    commands.map(|command| command.bytes().len()).sum()
}

/// The host dies: what the port holds goes out as it does.
fn die(first: &mut Rehearsal) {
    while !first.port.is_empty() {
        first.pass(Duration::from_millis(4), false);
    }
}

/// Another session with the machine as the first one left it, after some time.
fn again(first: Rehearsal, rest: &[u8], cutter: &Cutter, handshake: Handshake) -> Rehearsal {
    let job = Job::parse(rest, cutter).expect("valid");
    let mut second = Rehearsal::new(job, cutter, handshake, VirtualOptions::default());
    (second.plotter, second.now) = (first.plotter, first.now + PAUSE);
    second.plotter.run_until(second.now);
    // Nobody reads what was answered meanwhile.
    second.plotter.take_answers(second.now);
    second
}

/// Ends a job at a byte, and goes on with it. Returns how many strokes are drawn again, and how many bytes are sent
/// for those before the last two that were begun: the machine had them in its buffer.
fn ends_and_goes_on(handshake: Handshake, random: &mut fastrand::Rng, bytes: &[u8]) -> [usize; 2] {
    let buffer_bytes = random.usize(60..=1024);
    let answers = handshake == Handshake::EscB || handshake != Handshake::Paced && random.bool();
    let cutter = cutter(buffer_bytes, answers);
    let whole = Job::parse(bytes, &cutter).expect("valid");
    let faults = Faults { slowness: 0.5 + 0.7 * random.f64(), ..Faults::default() };
    let options = VirtualOptions {
        buffer_bytes,
        answers,
        xoff_below: Some((buffer_bytes / 2).min(256)),
        faults,
        ..VirtualOptions::default()
    };
    let interruption = Interruption::ALL[random.usize(..3)];
    let at = random.u64(1..=bytes.len() as u64);
    let case =
        format!("{handshake:?}, buffer of {buffer_bytes}, answers {answers}, {interruption:?} at byte {at}");

    let mut first = Rehearsal::new(whole.clone(), &cutter, handshake, options);
    let mut done = 0;
    let is_finished = match interruption {
        Interruption::Kill => loop {
            if first.plotter.received() >= at {
                die(&mut first);
                break false;
            }
            if let Some(outcome) = first.advance() {
                break outcome.end == End::Finished;
            }
            done = first.session.status().strokes_done;
        },
        _ => {
            let when =
                if interruption == Interruption::Stop { &mut first.stop_at } else { &mut first.unplug_at };
            *when = Some(at);
            let outcome = first.run();
            done = outcome.strokes_done;
            assert!(interruption != Interruption::Stop || !first.plotter.is_pen_down(), "{case}");
            outcome.end == End::Finished
        }
    };
    if is_finished {
        return [0; 2];
    }
    assert!(done <= whole.strokes(), "{case}");

    let rest = whole.from_stroke(done, &[], cutter.dialect().as_ref());
    if interruption == Interruption::Unplug && !answers {
        // No command makes it forget the part of a command: the message says to switch it off and on.
        first.plotter.switch_off_and_on();
    }
    let mut second = again(first, &rest, &cutter, handshake);
    let before = drawn(second.plotter.motions());
    let outcome = second.run();
    assert_eq!(outcome.end, End::Finished, "{case}");
    assert!(!second.plotter.is_pen_down(), "{case}");
    assert_eq!((second.plotter.lost(), second.plotter.broken()), (0, 0), "{case}");

    let meant: Vec<Motion> =
        drawn(&whole.commands().iter().flat_map(|c| c.motions().to_vec()).collect::<Vec<_>>());
    let after = drawn(second.plotter.motions()).split_off(before.len());
    assert!(meant.starts_with(&before), "{case}: drew what the job does not contain");
    assert!(meant.ends_with(&after), "{case}: drew what the job does not contain, going on");
    assert!(before.len() + after.len() >= meant.len(), "{case}: lines are missing");
    // Two strokes, and those that were in the buffer or on their way to it, with the command that it was at.
    let begun = strokes_of(before.len(), &whole);
    let longest = whole.commands().iter().map(|command| command.bytes().len()).max();
    let held = buffer_bytes + MOST_IN_FLIGHT + longest.unwrap_or_default();
    let again = bytes_of(&whole, done, begun.saturating_sub(2));
    assert!(again <= held, "{case}: {again} bytes from stroke {done} on are sent again, {begun} were begun");
    [begun.saturating_sub(done), again]
}

/// Once a line was drawn that was not in the job, and with small buffers bytes were lost.
#[test]
fn a_job_that_ends_at_any_byte_goes_on_exactly() {
    let bytes = job(40);
    let handshakes = [Handshake::EscB, Handshake::RtsCts, Handshake::XonXoff, Handshake::Paced];
    std::thread::scope(|scope| {
        for (seed, handshake) in handshakes.into_iter().enumerate() {
            let bytes = &bytes;
            scope.spawn(move || {
                let mut random = fastrand::Rng::with_seed(seed as u64);
                let ends = (0..ENDS).map(|_| ends_and_goes_on(handshake, &mut random, bytes));
                let [strokes, again] = ends.fold([0; 2], |[a, b], [c, d]| [a.max(c), b.max(d)]);
                println!(
                    "{handshake:?}: {ENDS} ends, again at most {strokes} strokes, {again} bytes of a buffer"
                );
            });
        }
    });
}
