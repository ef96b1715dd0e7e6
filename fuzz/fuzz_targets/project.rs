//! See [`project`].
#![no_main]

#[path = "../targets/project.rs"]
mod project;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| project::run(bytes));
