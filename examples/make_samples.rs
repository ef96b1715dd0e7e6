//! Writes the sample meshes into the folder `samples`: `cargo run --example make_samples`.
//!
//! The same bytes come out of every run; `tests/samples.rs` holds the committed files to that.

#[path = "make_samples/mod.rs"]
mod generator;

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    for sample in generator::all() {
        let path = folder.join(format!("{}.obj", sample.name));
        if let Err(error) = std::fs::write(&path, &sample.obj) {
            eprintln!("cannot write {}: {error}", path.display());
            return ExitCode::FAILURE;
        }
        println!("{} ({} bytes)", path.display(), sample.obj.len());
    }
    ExitCode::SUCCESS
}
