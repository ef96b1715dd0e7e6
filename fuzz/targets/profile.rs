//! Profiles of cutters and media, and styles of lines; with a cutter that is accepted, a job is
//! encoded.

use tatamu::drawing::LineStyles;
use tatamu::plotter::{Cutter, Job, Media};

/// Reads one input.
pub fn run(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Ok(cutter) = Cutter::parse(text) {
        let _ = Job::parse(b"IN;SP1;PU0,0;PD400,0,400,400;PU;", &cutter);
    }
    let _ = Media::parse(text);
    let _ = LineStyles::parse(text);
}
