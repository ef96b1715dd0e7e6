//! See [`profile`].
#![no_main]

#[path = "../targets/profile.rs"]
mod profile;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| profile::run(bytes));
