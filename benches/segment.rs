//! Seconds of the segmentation: `cargo bench --bench segment`. With `TATAMU_MESHES` a folder, its
//! mesh files are measured too.

use divan::{Bencher, black_box};
use std::path::PathBuf;
use tatamu::mesh::{self, Mesh};
use tatamu::progress::Silent;
use tatamu::segment::{Method, SegmentOptions, segment};

fn main() {
    divan::main();
}

/// The samples, and the meshes of the folder that the user names.
fn meshes() -> Vec<String> {
    let mut folders = vec![PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/samples"))];
    folders.extend(std::env::var_os("TATAMU_MESHES").map(PathBuf::from));
    let entries = folders.iter().filter_map(|f| std::fs::read_dir(f).ok()).flatten().flatten();
    let is_mesh = |name: &String| [".obj", ".off", ".stl", ".ply"].iter().any(|e| name.ends_with(e));
    let mut names: Vec<String> =
        entries.map(|e| e.path().to_string_lossy().into_owned()).filter(is_mesh).collect();
    names.sort();
    names
}

/// The mesh of a file; none where it is not one that can be divided.
fn read(path: &str) -> Option<Mesh> {
    let soup = mesh::read(&std::fs::read(path).ok()?).ok()?;
    Some(Mesh::from_soup(&soup).ok()?.0)
}

#[divan::bench(args = meshes(), sample_count = 10)]
fn merge(bencher: Bencher, path: &str) {
    run(bencher, path, SegmentOptions::default());
}

#[divan::bench(args = meshes(), sample_count = 10)]
fn sdf(bencher: Bencher, path: &str) {
    let method = Method::Sdf { clusters: Method::CLUSTERS, smoothing: Method::SMOOTHING };
    run(bencher, path, SegmentOptions { method, ..SegmentOptions::default() });
}

fn run(bencher: Bencher, path: &str, options: SegmentOptions) {
    if let Some(mesh) = read(path) {
        bencher.bench(|| segment(black_box(&mesh), &options, &Silent));
    }
}
