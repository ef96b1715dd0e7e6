//! FOLD masters, as `tatamu check` reads them.

use tatamu::check;

/// Reads one input.
pub fn run(bytes: &[u8]) {
    if let Ok(report) = check::fold(bytes) {
        let _ = report.is_sound(1e-6);
    }
}
