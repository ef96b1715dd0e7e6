//! What the studio does while one turns a dial or the view: `cargo bench --bench studio`.
//!
//! With the variable `TATAMU_MESHES` set to a folder, its meshes whose names stand in `NAMES` are
//! measured, too.

mod input;

use divan::Bencher;
use input::read;
use std::borrow::Cow;
use std::sync::atomic::{AtomicUsize, Ordering};
use tatamu::drawing::Rgb;
use tatamu::model::PartId;
use tatamu::pipeline::{ComponentOptions, Engine, Options};
use tatamu::progress::Silent;
use tatamu::render::Orbit;
use tatamu::render::zbuffer::{RenderedFrame, Solids};
use tatamu::show::upright;

const NAMES: [&str; 4] = ["teddy", "bunny", "armadillo", "20000"];

fn main() {
    divan::main();
}

fn meshes() -> Vec<String> {
    let mut found = vec!["samples/teddy.obj".to_owned()];
    let folder = std::env::var("TATAMU_MESHES").ok().and_then(|folder| std::fs::read_dir(folder).ok());
    for path in folder.into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path())) {
        let name = path.display().to_string();
        if NAMES.iter().any(|n| name.contains(n)) && path.extension().is_some_and(|e| e != "mtl") {
            found.push(name);
        }
    }
    found.sort();
    found
}

/// Options with another direction for one component at each turn.
fn turned(name: &str, turn: usize) -> Options {
    let mut options = Options::default();
    let direction_rad = Some(0.0123 + 0.0873 * turn as f64);
    let own = ComponentOptions { direction_rad, ..ComponentOptions::default() };
    options.components.insert(name.to_owned(), own);
    options
}

/// Makes something at each turn of a component's direction, one component after the other.
fn at_each_turn(bencher: Bencher, path: &str, make: impl Fn(&Engine<'_>, &Options, PartId) -> bool + Sync) {
    let Some(mesh) = read(path) else { return };
    let engine = Engine::new(Cow::Owned(mesh));
    let Ok(shaped) = engine.shape(&Options::default(), &Silent) else { return };
    let names = shaped.source().names().to_vec();
    let count = AtomicUsize::new(0);
    bencher.bench(|| {
        let turn = count.fetch_add(1, Ordering::Relaxed);
        let part = turn % names.len();
        make(&engine, &turned(&names[part], turn), PartId(part))
    });
}

/// From a turn to the new component.
#[divan::bench(args = meshes(), sample_count = 20, sample_size = 1)]
fn turn(bencher: Bencher, path: &str) {
    at_each_turn(bencher, path, |engine, options, part| engine.component(options, part, &Silent).is_ok());
}

/// The same, with all other components and the choice among their candidates.
#[divan::bench(args = meshes(), sample_count = 20, sample_size = 1)]
fn turn_model(bencher: Bencher, path: &str) {
    at_each_turn(bencher, path, |engine, options, _| engine.shape(options, &Silent).is_ok());
}

/// One picture of the mesh while the view turns, 1280 × 720 pixels.
#[divan::bench(args = meshes(), sample_count = 40, sample_size = 1)]
fn orbit(bencher: Bencher, path: &str) {
    let Some(mesh) = read(path) else { return };
    let mut solids = Solids::default();
    for face in 0..mesh.faces().len() {
        let corners = mesh.corners(face).map(|c| upright().transform_point3(c));
        solids.push_triangle(corners, Rgb(200, 190, 180), Some(Rgb::WHITE), face as u32, false);
    }
    let Some(mut orbit) = solids.ball().map(Orbit::of_ball) else { return };
    bencher.bench_local(|| {
        orbit.turn(0.05, 0.0);
        RenderedFrame::of_orbit(&solids, &orbit, [1280, 720], false, Rgb::WHITE)
    });
}

/// The same with smooth edges, once nothing moves.
#[divan::bench(args = meshes(), sample_count = 10, sample_size = 1)]
fn smooth(bencher: Bencher, path: &str) {
    let Some(mesh) = read(path) else { return };
    let mut solids = Solids::default();
    for face in 0..mesh.faces().len() {
        let corners = mesh.corners(face).map(|c| upright().transform_point3(c));
        solids.push_triangle(corners, Rgb(200, 190, 180), Some(Rgb::WHITE), face as u32, false);
    }
    let Some(orbit) = solids.ball().map(Orbit::of_ball) else { return };
    bencher.bench_local(|| RenderedFrame::of_orbit(&solids, &orbit, [1280, 720], true, Rgb::WHITE));
}
