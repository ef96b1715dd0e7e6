//! See [`planner`].
#![no_main]

#[path = "../targets/planner.rs"]
mod planner;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| planner::run(bytes));
