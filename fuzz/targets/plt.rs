//! Files for plotters in all their languages: read, and written again.

use std::sync::LazyLock;
use tatamu::plotter::profile::CUTTERS;
use tatamu::plotter::{Cutter, Job};

static MACHINES: LazyLock<Vec<Cutter>> =
    LazyLock::new(|| CUTTERS.iter().filter_map(|p| Cutter::parse(p.text).ok()).collect());

/// Reads one input.
pub fn run(bytes: &[u8]) {
    let Some((&which, bytes)) = bytes.split_first() else { return };
    let cutter = &MACHINES[usize::from(which) % MACHINES.len()];
    if let Ok(job) = Job::parse(bytes, cutter) {
        let again = Job::parse(&job.bytes(), cutter).expect("what was written is a job");
        assert_eq!(again.strokes(), job.strokes());
    }
}
