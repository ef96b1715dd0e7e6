//! Sessions against the virtual plotter, on a line of modelled speed.

use super::profile;
use super::rehearsal::Rehearsal;
use std::time::Duration;
use tatamu::plotter::profile::Handshake;
use tatamu::plotter::session::{End, MOST_IN_FLIGHT, SLOWNESS, State};
use tatamu::plotter::{Cutter, Faults, Job, Motion, VirtualMachine, VirtualOptions, VirtualPlotter};

/// A cutter like a profile, with another speed of the line and another answer to questions.
fn cutter(name: &str, baud: u32, answers: bool) -> Cutter {
    let text = profile(name).text().replace("baud = 9600", &format!("baud = {baud}"));
    let text = text.replace("answers = true", &format!("answers = {answers}"));
    Cutter::parse(&text).expect("valid")
}

fn rehearse(job: &[u8], cutter: &Cutter, handshake: Handshake, options: VirtualOptions) -> Rehearsal {
    Rehearsal::new(Job::parse(job, cutter).expect("valid"), cutter, handshake, options)
}

/// Short vectors, so that the line is the limit, with some long ones between.
fn long_job(bytes: usize) -> Vec<u8> {
    let mut job = b"IN;PA;SP1;".to_vec();
    let mut k = 0u32;
    while job.len() < bytes {
        let (x, y) = ((k * 40) % 9000, (k * 40 / 9000 * 40) % 7000);
        job.extend(format!("PU{x},{y};").bytes());
        for i in 1..40 {
            job.extend(format!("PD{},{};", x + i * 3, y + i % 7).bytes());
        }
        k += 1;
    }
    job.extend(b"PU;SP0;");
    job
}

fn small_job() -> &'static [u8] {
    b"IN;PA;SP1;PU400,400;PD2400,400,2400,2400,400,2400,400,400;PU3000,0;PD3000,900;PU0,0;PD12,345;PU;SP0;"
}

fn meant(job: &[u8], cutter: &Cutter) -> Vec<Motion> {
    let job = Job::parse(job, cutter).expect("valid");
    job.commands().iter().flat_map(|c| c.motions().to_vec()).collect()
}

const REAL: [Handshake; 4] = [Handshake::EscB, Handshake::RtsCts, Handshake::XonXoff, Handshake::Paced];

#[test]
fn a_megabyte_arrives_whole_by_every_handshake_at_two_speeds() {
    let job = long_job(1_000_000);
    std::thread::scope(|scope| {
        for baud in [9600, 115_200] {
            for handshake in REAL {
                let job = &job;
                scope.spawn(move || arrives_whole(job, handshake, baud));
            }
        }
    });
}

fn arrives_whole(job: &[u8], handshake: Handshake, baud: u32) {
    let answers = !matches!(handshake, Handshake::Paced);
    let cutter = cutter("generic-hpgl", baud, answers);
    // Time alone allows for a machine that is slower than its profile: this is one.
    let slowness = if handshake == Handshake::Paced { SLOWNESS } else { 1.0 };
    let faults = Faults { slowness, ..Faults::default() };
    let options = VirtualOptions { answers, faults, ..VirtualOptions::default() };
    let mut rehearsal = rehearse(job, &cutter, handshake, options);
    let outcome = rehearsal.run();
    assert_eq!(outcome.end, End::Finished, "{handshake:?} {baud}");
    assert_eq!((rehearsal.plotter.lost(), rehearsal.plotter.broken()), (0, 0), "{handshake:?} {baud}");
    assert_eq!(rehearsal.plotter.motions(), meant(job, &cutter), "{handshake:?} {baud}");
    assert_eq!(outcome.is_confirmed, answers);
    let line = cutter.serial().byte_s() * job.len() as f64;
    assert!(rehearsal.now().as_secs_f64() >= line, "faster than the line");
    assert!(rehearsal.most_queued <= MOST_IN_FLIGHT + 40, "{handshake:?} {baud}");
    let busy = rehearsal.busy_share();
    assert!(busy >= 0.95, "{handshake:?} {baud}: {busy}");
}

/// Strokes of 64 cm, each as slow as a machine can draw it.
#[test]
fn a_job_of_a_day_and_a_night_arrives_whole_by_every_handshake() {
    const DAY: Duration = Duration::from_secs(24 * 3600);
    let mut job = "IN;PA;SP1;VS1;".to_owned();
    for k in 0..1400 {
        let y = 4 * k;
        job += &format!("PU0,{y};PD24000,{y};");
    }
    job += "PU;SP0;";
    std::thread::scope(|scope| {
        for handshake in REAL {
            let job = job.as_bytes();
            scope.spawn(move || {
                let answers = handshake != Handshake::Paced;
                let cutter = cutter("generic-hpgl", 9600, answers);
                let options = VirtualOptions { answers, ..VirtualOptions::default() };
                let mut rehearsal = rehearse(job, &cutter, handshake, options);
                (rehearsal.least_look, rehearsal.too_long) = (Duration::from_millis(250), 2 * DAY);
                assert_eq!(rehearsal.run().end, End::Finished, "{handshake:?}");
                assert!(rehearsal.now() >= DAY, "{handshake:?}: {:?}", rehearsal.now());
                assert_eq!((rehearsal.plotter.lost(), rehearsal.plotter.broken()), (0, 0), "{handshake:?}");
                assert_eq!(rehearsal.plotter.motions(), meant(job, &cutter), "{handshake:?}");
            });
        }
    });
}

#[test]
fn a_naive_host_loses_bytes_here() {
    // The virtual plotter is worth something only if it catches hosts that do not wait.
    let cutter = cutter("generic-hpgl", 9600, true);
    let mut plotter = VirtualPlotter::new(&cutter, VirtualOptions::default());
    let byte = Duration::from_secs_f64(cutter.serial().byte_s());
    for (k, b) in small_job().repeat(60).into_iter().enumerate() {
        plotter.receive(b, byte * k as u32);
    }
    assert!(plotter.lost() > 1000, "{}", plotter.lost());
}

#[test]
fn the_tool_is_lifted_after_a_stop_at_every_byte() {
    let job = small_job();
    for handshake in REAL {
        for wishes in [1, 2] {
            for stop_at in 1..=job.len() as u64 {
                let answers = handshake == Handshake::EscB;
                let cutter = cutter("generic-hpgl", 9600, answers);
                let options = VirtualOptions { answers, ..VirtualOptions::default() };
                let mut rehearsal = rehearse(job, &cutter, handshake, options);
                rehearsal.stop_at = Some(stop_at);
                rehearsal.stop_wishes = wishes;
                let outcome = rehearsal.run();
                let at = format!("{handshake:?}, byte {stop_at}, {wishes} wishes");
                assert!(!rehearsal.plotter.is_pen_down(), "{at}");
                assert_eq!((rehearsal.plotter.lost(), rehearsal.plotter.broken()), (0, 0), "{at}");
                assert!(matches!(outcome.end, End::Stopped | End::Finished), "{at}");
                assert!(meant(job, &cutter).starts_with(rehearsal.plotter.motions()), "{at}: a wrong move");
                let drawn = strokes_in(rehearsal.plotter.motions());
                assert!(outcome.strokes_done <= drawn, "{at}: {outcome:?}, but {drawn} drawn");
            }
        }
    }
}

/// Strokes of the small job that these motions have finished.
fn strokes_in(motions: &[Motion]) -> usize {
    let ends = motions.windows(2).filter(|w| w[0].is_down && !w[1].is_down).count();
    ends + usize::from(motions.last().is_some_and(|m| m.is_down))
}

#[test]
fn a_stopped_job_goes_on_where_it_was() {
    let job = long_job(6000);
    let cutter = cutter("generic-hpgl", 9600, true);
    for handshake in REAL {
        let mut rehearsal = rehearse(&job, &cutter, handshake, VirtualOptions::default());
        rehearsal.stop_at = Some(4000);
        let outcome = rehearsal.run();
        assert_eq!(outcome.end, End::Stopped);
        assert!(handshake != Handshake::EscB || outcome.strokes_done > 3, "{handshake:?} {outcome:?}");
        let rest = Job::parse(&job, &cutter).unwrap().from_stroke(
            outcome.strokes_done,
            &[],
            cutter.dialect().as_ref(),
        );
        let mut again = rehearse(&rest, &cutter, handshake, VirtualOptions::default());
        assert_eq!(again.run().end, End::Finished);
        let down = |motions: &[Motion]| motions.iter().filter(|m| m.is_down).copied().collect::<Vec<_>>();
        let mut both = down(rehearsal.plotter.motions());
        both.extend(down(again.plotter.motions()));
        for motion in down(&meant(&job, &cutter)) {
            assert!(both.contains(&motion), "{handshake:?}: {motion:?} was never drawn");
        }
    }
}

#[test]
fn a_pause_lifts_the_pen_and_sets_it_down_at_the_same_place() {
    let job = &long_job(3000);
    let cutter = cutter("generic-hpgl", 9600, true);
    let mut rehearsal = rehearse(job, &cutter, Handshake::EscB, VirtualOptions::default());
    while rehearsal.plotter.received() < 500 {
        assert_eq!(rehearsal.advance(), None);
    }
    assert!(rehearsal.plotter.is_pen_down());
    rehearsal.session.pause();
    for _ in 0..5000 {
        assert_eq!(rehearsal.advance(), None);
    }
    assert_eq!(rehearsal.session.status().state, State::Paused);
    assert!(!rehearsal.plotter.is_pen_down() && rehearsal.plotter.is_idle());
    rehearsal.session.go_on();
    assert_eq!(rehearsal.run().end, End::Finished);
    assert_eq!(rehearsal.plotter.motions(), meant(job, &cutter));
}

#[test]
fn a_stop_during_a_pause_ends_the_session() {
    let cutter = cutter("generic-hpgl", 9600, false);
    let mut rehearsal = rehearse(small_job(), &cutter, Handshake::Paced, VirtualOptions::default());
    rehearsal.session.pause();
    rehearsal.session.stop();
    assert_eq!(rehearsal.run().end, End::Stopped);
}

#[test]
fn auto_asks_first_and_falls_back_to_what_the_profile_says() {
    let job = long_job(5000);
    for (answers, expected) in [(true, Handshake::EscB), (false, Handshake::XonXoff)] {
        let cutter = cutter("generic-hpgl", 9600, true);
        let options = VirtualOptions { answers, xoff_below: Some(256), ..VirtualOptions::default() };
        let mut rehearsal = rehearse(&job, &cutter, Handshake::Auto, options);
        let outcome = rehearsal.run();
        assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, answers));
        assert_eq!(rehearsal.session.status().handshake, expected);
        assert_eq!(rehearsal.plotter.lost(), 0);
        let notes = rehearsal.session.take_notes().join("\n");
        assert!(notes.contains(expected.name()), "{notes}");
        assert!(!answers || notes.contains("virtual"), "{notes}");
    }
}

#[test]
fn a_machine_that_has_to_answer_and_does_not_is_sent_nothing() {
    let cutter = cutter("generic-hpgl", 9600, true);
    let options = VirtualOptions { answers: false, ..VirtualOptions::default() };
    let mut rehearsal = rehearse(small_job(), &cutter, Handshake::EscB, options);
    assert_eq!(rehearsal.run().end, End::NoAnswer);
    assert!(rehearsal.plotter.motions().is_empty());
}

#[test]
fn a_silent_machine_is_waited_for_as_long_as_the_job_takes_and_no_longer() {
    // All of it fits the buffer, so that the machine works on for long after the last byte.
    let job = format!("IN;SP1;{}PU;", "PU0,0;PD8000,0;".repeat(30)).into_bytes();
    let cutter = cutter("generic-hpgl", 9600, true);
    let estimate_s = Job::parse(&job, &cutter).unwrap().seconds();
    assert!(estimate_s > 20.0, "{estimate_s}");
    // The user names the handshake, so that nothing is asked before the end.
    let options = VirtualOptions { answers: false, xoff_below: Some(256), ..VirtualOptions::default() };
    let mut rehearsal = rehearse(&job, &cutter, Handshake::XonXoff, options);
    let outcome = rehearsal.advance_to_end();
    assert_eq!((outcome.end, outcome.is_confirmed), (End::Finished, false));
    let took_s = rehearsal.now().as_secs_f64();
    assert!(took_s <= estimate_s * SLOWNESS + 5.0, "{took_s} s for a job of {estimate_s} s");
    assert!(rehearsal.plotter.is_idle() && rehearsal.plotter.motions() == meant(&job, &cutter));
    let notes = rehearsal.session.take_notes().join("\n");
    assert!(notes.contains("waiting about") && notes.contains("did not say"), "{notes}");
}

#[test]
fn an_error_of_the_machine_lifts_the_tool() {
    let cutter = cutter("generic-hpgl", 9600, true);
    let faults = Faults { error_at: Some(3000), ..Faults::default() };
    let options = VirtualOptions { faults, ..VirtualOptions::default() };
    let mut rehearsal = rehearse(&long_job(60_000), &cutter, Handshake::EscB, options);
    assert_eq!(rehearsal.run().end, End::Device(15));
    assert!(!rehearsal.plotter.is_pen_down());
}

#[test]
fn random_faults_lose_nothing_and_leave_no_tool_down() {
    let job = long_job(12_000);
    let mut rng = fastrand::Rng::with_seed(8);
    for round in 0..60 {
        let handshake = REAL[rng.usize(0..3)];
        let cutter = cutter("generic-hpgl", [9600, 19_200, 115_200][rng.usize(0..3)], true);
        let faults = Faults {
            slowness: 0.2 + 8.0 * rng.f64(),
            garbage_every: [0, 3, 7][rng.usize(0..3)],
            silence_every: [0, 4, 9][rng.usize(0..3)],
            error_at: None,
        };
        let buffer_bytes = [512, 1024, 10_240][rng.usize(0..3)];
        let options =
            VirtualOptions { buffer_bytes, xoff_below: Some(256), faults, ..VirtualOptions::default() };
        let mut rehearsal = rehearse(&job, &cutter, handshake, options);
        let kind = rng.u8(0..3);
        let at = Some(1 + rng.u64(0..job.len() as u64));
        rehearsal.stop_at = at.filter(|_| kind == 0);
        rehearsal.unplug_at = at.filter(|_| kind == 1);
        let outcome = rehearsal.run();
        let what = format!("round {round}: {handshake:?} {options:?} {outcome:?}");
        assert_eq!((rehearsal.plotter.lost(), rehearsal.plotter.broken()), (0, 0), "{what}");
        assert!(meant(&job, &cutter).starts_with(rehearsal.plotter.motions()), "{what}");
        match outcome.end {
            End::PortLost => assert_eq!(kind, 1, "{what}"),
            _ => assert!(!rehearsal.plotter.is_pen_down(), "{what}"),
        }
        if outcome.end == End::Finished {
            assert_eq!(rehearsal.plotter.motions(), meant(&job, &cutter), "{what}");
        }
    }
}

/// Once, a late answer counted for the next question, and what was sent in between overflowed the buffer.
#[test]
fn late_and_lost_answers_overflow_no_buffer_however_small() {
    const LATE: [fn(Duration) -> Duration; 5] = [
        |_| Duration::ZERO,
        |_| Duration::from_millis(1500),
        // A machine that is late from the first question on is given up before anything is sent.
        |now| Duration::from_millis(3300) * u32::from(now.as_secs() > 9),
        |now| Duration::from_millis(1700) * u32::from(now.as_secs() % 7 < 3),
        |now| Duration::from_millis(if now.as_secs() > 9 { now.as_millis() as u64 * 7919 % 3500 } else { 0 }),
    ];
    let job = &long_job(2500);
    // Now the line is the limit, now the machine.
    let speeds = [(1200, 1.0), (1200, 20.0), (9600, 1.0), (9600, 20.0)];
    std::thread::scope(|scope| {
        for ((baud, slowness), late) in
            speeds.into_iter().flat_map(|speed| (0..LATE.len()).map(move |late| (speed, late)))
        {
            scope.spawn(move || {
                for buffer_bytes in [60, 100, 128, 256, 1024] {
                    for silence_every in [0, 3, 40] {
                        let cutter = cutter("generic-hpgl", baud, true);
                        let faults = Faults { slowness, silence_every, ..Faults::default() };
                        let options = VirtualOptions { buffer_bytes, faults, ..VirtualOptions::default() };
                        let mut rehearsal = rehearse(job, &cutter, Handshake::EscB, options);
                        (rehearsal.lateness, rehearsal.too_long) = (LATE[late], Duration::from_secs(5000));
                        let outcome = rehearsal.run();
                        let what = format!("{baud} baud, {late}: {options:?} {outcome:?}");
                        assert_eq!((rehearsal.plotter.lost(), rehearsal.plotter.broken()), (0, 0), "{what}");
                        assert!(!rehearsal.plotter.is_pen_down(), "{what}");
                        assert_eq!(outcome.end, End::Finished, "{what}");
                        assert_eq!(rehearsal.plotter.motions(), meant(job, &cutter), "{what}");
                    }
                }
            });
        }
    });
}

#[test]
fn gpgl_and_dmpl_are_paced_and_stopped_too() {
    for (name, job) in [
        ("graphtec", &b"H\x03J1\x03M100,-100\x03D900,-100,900,-900\x03M0,0\x03D50,-60\x03M50,-60\x03"[..]),
        ("dmpl", b";:HAL0,EC1,U100,100,D900,100,D900,900,U0,0,D50,60,U,P0,Z "),
    ] {
        for stop_at in (1..=job.len() as u64).map(Some).chain([None]) {
            let cutter = cutter(name, 9600, false);
            let options = VirtualOptions { answers: false, ..VirtualOptions::default() };
            let mut rehearsal = rehearse(job, &cutter, Handshake::Paced, options);
            rehearsal.stop_at = stop_at;
            let outcome = rehearsal.run();
            assert!(!rehearsal.plotter.is_pen_down(), "{name} {stop_at:?}");
            assert_eq!(rehearsal.plotter.broken(), 0, "{name} {stop_at:?}");
            if stop_at.is_none() {
                assert_eq!(outcome.end, End::Finished);
                assert_eq!(rehearsal.plotter.motions(), meant(job, &cutter), "{name}");
            }
        }
    }
}
