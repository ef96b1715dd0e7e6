//! See [`folding`].
#![no_main]

#[path = "../targets/folding.rs"]
mod folding;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| folding::run(bytes));
