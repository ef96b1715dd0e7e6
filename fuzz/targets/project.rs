//! Project files.

use tatamu::project::Project;

/// Reads one input.
pub fn run(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let _ = Project::parse(text);
}
