//! See [`mesh`].
#![no_main]

#[path = "../targets/mesh.rs"]
mod mesh;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| mesh::run(bytes));
