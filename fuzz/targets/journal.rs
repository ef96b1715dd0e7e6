//! Journals of jobs, and the sheets in them.

use tatamu::plotter::{Cutter, Job, journal};

/// Reads one input.
pub fn run(bytes: &[u8]) {
    let Some((header, _)) = journal::parse(bytes) else { return };
    let Ok(cutter) = Cutter::parse(&header.cutter) else { return };
    for sheet in &header.sheets {
        if let Some(bytes) = sheet.bytes() {
            let _ = Job::parse(&bytes, &cutter);
        }
    }
}
