//! See [`fold`].
#![no_main]

#[path = "../targets/fold.rs"]
mod fold;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fold::run(bytes));
