//! A session with a machine that says anything at any time. It must end, and lift the tool last.

use std::time::Duration;
use tatamu::plotter::profile::Handshake;
use tatamu::plotter::session::{Session, Step};
use tatamu::plotter::{Cutter, Job};

/// More steps than any session takes that has not lost its way.
const STEPS: usize = 20_000;

/// Reads one input.
pub fn run(bytes: &[u8]) {
    let cutter = Cutter::generic();
    let job = Job::parse(b"IN;SP1;PU0,0;PD4000,0,4000,4000;PU0,400;PD400,400;PU;", &cutter).expect("a job");
    let mut session = Session::new(job, &cutter, Handshake::Auto, None);
    let mut now = Duration::ZERO;
    let mut sent = Vec::new();
    let mut said = bytes.chunks(5);
    for _ in 0..STEPS {
        match session.step(now, 0) {
            Step::Done(_) => {
                let last = |word: &[u8]| sent.windows(2).rposition(|w| w == word);
                assert!(last(b"PD") <= last(b"PU"), "the tool stays down");
                return;
            }
            Step::Send(bytes) => sent.extend(bytes),
            Step::Wait(time) => {
                now += time.max(Duration::from_millis(1));
                match said.next() {
                    Some(chunk) => session.received(chunk),
                    // Held for ever (XOFF) is what the user has to end.
                    None => session.stop(),
                }
            }
        }
    }
    panic!("the session does not end");
}
