//! Project files.
#![no_main]

use libfuzzer_sys::fuzz_target;
use tatamu::project::Project;

fuzz_target!(|text: &str| {
    let _ = Project::parse(text);
});
