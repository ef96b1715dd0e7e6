//! Many models in one process: what one of them takes is given back.

use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use std::alloc::System;
use std::fmt::Write;
use std::sync::{Mutex, PoisonError};
use tatamu::export::{FormatOptions, format_of};
use tatamu::mesh::{self, Mesh, Repairs};
use tatamu::pipeline::{self, Options, Output};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::report::Run;

/// Counts what the program has taken and not given back. The size of the process would say less: the
/// allocator keeps some MB for itself, now more and now less.
#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Bytes that all models together may leave behind: 144 were seen, 270 models that keep 6 each go beyond it.
const GROWTH: usize = 1600;

/// Threads that make models.
const THREADS: usize = 4;

/// Bytes taken and not given back.
fn in_use() -> usize {
    let stats = ALLOCATOR.stats();
    stats.bytes_allocated - stats.bytes_deallocated
}

/// A prism that differs a little from those of all other `k`.
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

/// Reads a mesh, makes a model of it, and writes it.
fn make(k: usize) {
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(prism(k).as_bytes()).unwrap()).unwrap();
    let mut options =
        Options { size_mm: 80.0, top_edges: Some(4), profile_vertices: Some(3), ..Options::default() };
    options.sheets.effort = 0;
    options.segmentation.parts = Some(1);
    let output = pipeline::run(&mesh, &options, &Silent).unwrap();
    write(&output, &repairs, &["svg", "fold", "json"]);
}

/// Writes a model.
fn write(output: &Output, repairs: &Repairs, formats: &[&str]) {
    let run = Run { path: "a.obj", repairs, stages: &[], warnings: &[], say: ToString::to_string };
    for format in formats {
        let product = Product::new(output, "a", run);
        assert!(!format_of(format).unwrap().write(&product, &FormatOptions::default()).unwrap().is_empty());
    }
}

/// The same of a small prism that is drawn, which takes a few milliseconds.
fn draw(k: usize) {
    let (edges, radius, height) = (3 + k % 4, 12 + k * 31 % 17, 10 + k % 7);
    let project = format!(
        "[[component]]\nname = 'a'\ntop = {{ edges = {edges}, radius = {radius} }}\nprofiles = [[[0, {height}], [0, 0]]]\n"
    );
    let sketches = Project::parse(&project).unwrap().sketches().unwrap();
    let mut options = Options::default();
    options.sheets.effort = 0;
    let output = pipeline::run_drawn(&sketches, None, &options, &Silent).unwrap();
    write(&output, &Repairs::default(), &["fold"]);
}

/// The allocator counts what all tests take, so that they run one after the other.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

fn makes_without_growth(models: usize, make: fn(usize)) {
    let _alone = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
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
    let before = in_use();
    make_all(warm..models);
    let after = in_use();
    println!("{before} bytes after {warm} models, {after} after {models}");
    assert!(after < before + GROWTH, "{before} bytes after {warm} models, {after} after {models}");
}

#[test]
#[ignore = "a minute; .ci/test runs it"]
fn three_hundred_models_in_one_process() {
    makes_without_growth(300, make);
}

#[test]
#[ignore = "a minute; .ci/test runs it"]
fn ten_thousand_drawn_models_in_one_process() {
    makes_without_growth(10_000, draw);
}

#[test]
#[ignore = "ten minutes in a release build"]
fn ten_thousand_models_in_one_process() {
    makes_without_growth(10_000, make);
}
