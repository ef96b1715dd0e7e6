//! See [`plt`].
#![no_main]

#[path = "../targets/plt.rs"]
mod plt;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| plt::run(bytes));
