//! Many models in one process: what one of them takes is given back.
#![cfg(target_os = "linux")]

use std::fmt::Write;
use tatamu::export::{FormatOptions, format_of};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;

/// The allocator keeps some of what it has, now more and now less. 450 models that keep 10 kB each go
/// beyond it.
const GROWTH: usize = 4 << 20;

/// Threads that make models.
const THREADS: usize = 4;

/// Memory of this process, bytes.
fn resident() -> usize {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap();
    let pages: usize = text.split_whitespace().nth(1).unwrap().parse().unwrap();
    pages * 4096
}

/// A prism with so many sides, a little different from all others.
fn prism(k: usize) -> String {
    let sides = 3 + k % 4;
    let mut text = String::new();
    for height in [0.0, 1.0 + (k % 7) as f64 / 5.0] {
        for side in 0..sides {
            let (sin, cos) = (std::f64::consts::TAU * side as f64 / sides as f64).sin_cos();
            let reach = 1.0 + (k * 31 % 97) as f64 / 500.0;
            let _ = writeln!(text, "v {} {} {height}", reach * cos, sin);
        }
    }
    let ring = |from: usize| (from..from + sides).map(|v| format!(" {v}")).collect::<Vec<_>>();
    let mut bottom = ring(1);
    bottom.reverse();
    let _ = writeln!(text, "f{}\nf{}", bottom.concat(), ring(sides + 1).concat());
    for side in 0..sides {
        let [a, b] = [side, (side + 1) % sides].map(|corner| corner + 1);
        let _ = writeln!(text, "f {a} {b} {} {}", b + sides, a + sides);
    }
    text
}

/// Reads a mesh, makes a model of it, and writes its pages and its report.
fn make(k: usize) {
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(prism(k).as_bytes()).unwrap()).unwrap();
    let mut options =
        Options { size_mm: 80.0, top_edges: Some(4), profile_vertices: Some(3), ..Options::default() };
    options.sheets.effort = 0;
    options.segmentation.parts = Some(1);
    let output = pipeline::run(&mesh, &options, &Silent).unwrap();
    let run = Run { path: "a.obj", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    for format in ["svg", "fold", "json"] {
        let product = Product::new(&output, "a", run);
        assert!(!format_of(format).unwrap().write(&product, &FormatOptions::default()).unwrap().is_empty());
    }
}

fn makes_without_growth(models: usize) {
    let warm = models / 10;
    let make_all = |range: std::ops::Range<usize>| {
        std::thread::scope(|scope| {
            let end = range.end;
            for start in range.take(THREADS) {
                scope.spawn(move || (start..end).step_by(THREADS).for_each(make));
            }
        });
    };
    make_all(0..warm);
    let before = resident();
    make_all(warm..models);
    let at_end = resident();
    // What the allocator keeps goes up and down by some MB; what leaks stays.
    make_all(models..models + warm);
    let after = at_end.min(resident());
    println!("{before} bytes after {warm} models, {after} after {models}");
    assert!(after < before + GROWTH, "{before} bytes after {warm} models, {after} after {models}");
}

#[test]
fn five_hundred_models_in_one_process() {
    makes_without_growth(500);
}

/// `.ci/interop` runs it.
#[test]
#[ignore = "minutes"]
fn three_thousand_models_in_one_process() {
    makes_without_growth(3_000);
}
