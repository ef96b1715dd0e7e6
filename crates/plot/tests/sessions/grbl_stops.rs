//! Stops and pauses of machines with GRBL: the tool is up, the beam off, and the job goes on.

use super::grbl::{MACHINES, Rehearsal, figure, long_job, options};
use super::jobs::{drawn, is_on, meant, profile, whole};
use std::time::Duration;
use tatamu_plot::plotter::profile::Handshake;
use tatamu_plot::plotter::session::{End, Session, State, Step};
use tatamu_plot::plotter::{Cutter, Faults, Job, Motion, VirtualMachine};

#[test]
fn the_tool_is_up_and_the_beam_off_after_a_stop_at_every_byte() {
    for name in MACHINES {
        let cutter = profile(name);
        let job = figure(&cutter);
        let meant = meant(&job, &cutter);
        let lines = drawn(&meant);
        for wishes in [1, 2] {
            // What is asked before the job is 8 bytes long, and a question more comes now and then.
            for stop_at in 1..=job.len() as u64 + 8 {
                let mut rehearsal = Rehearsal::new(&job, &cutter, options(Faults::default()));
                (rehearsal.stop_at, rehearsal.stop_wishes) = (Some(stop_at), wishes);
                let outcome = rehearsal.run();
                let at = format!("{name}, byte {stop_at}, {wishes} wishes: {outcome:?}");
                assert!(!rehearsal.machine.is_pen_down() && !rehearsal.worked_after_end, "{at}");
                assert!(!rehearsal.machine.is_beam_on(), "{at}");
                assert_eq!((rehearsal.machine.lost(), rehearsal.machine.broken()), (0, 0), "{at}");
                assert!(matches!(outcome.end, End::Stopped | End::Finished), "{at}");
                assert!(outcome.is_confirmed, "{at}");
                assert!(!rehearsal.machine.has_alarm(), "{at}");
                // Nothing but what was meant was drawn, and what counts as done was.
                let drawn = drawn(rehearsal.machine.motions());
                assert!(drawn.iter().all(|d| lines.iter().any(|line| is_on(line, d))), "{at}");
                let strokes = Job::parse(&job, &cutter).unwrap();
                let done = strokes.commands().iter().filter(|c| c.strokes_done() < outcome.strokes_done);
                for motion in done.flat_map(|c| c.motions()).filter(|m| m.is_down) {
                    assert!(drawn.iter().any(|line| is_on(line, motion)), "{at}: {motion:?} was not drawn");
                }
            }
        }
    }
}

#[test]
fn a_stopped_job_goes_on_with_the_same_drawn_geometry() {
    for name in MACHINES {
        let cutter = profile(name);
        let job = long_job(&cutter, 12, 20);
        let meant = meant(&job, &cutter);
        let lines = drawn(&meant);
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
                assert!(
                    both.iter().any(|line| is_on(line, motion)),
                    "{name}, byte {stop_at}: {motion:?} was never drawn"
                );
            }
            assert!(
                both.iter().all(|motion| lines.iter().any(|line| is_on(line, motion))),
                "{name}, byte {stop_at}"
            );
            assert!(
                stop_at < 1500 || outcome.strokes_done > 0,
                "{name}, byte {stop_at}: nothing counts as done"
            );
        }
    }
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
