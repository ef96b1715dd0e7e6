//! See [`threemf`].
#![no_main]

#[path = "../targets/threemf.rs"]
mod threemf;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| threemf::run(bytes));
