//! Profiles of cutters and media, and styles of lines; with a cutter that is accepted, a job is
//! encoded.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tatamu::drawing::LineStyles;
use tatamu::plotter::{Cutter, Job, Media};

fuzz_target!(|text: &str| {
    if let Ok(cutter) = Cutter::parse(text) {
        let _ = Job::parse(b"IN;SP1;PU0,0;PD400,0,400,400;PU;", &cutter);
    }
    let _ = Media::parse(text);
    let _ = LineStyles::parse(text);
});
