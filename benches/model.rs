//! Seconds of the stages after the components, and of all stages together, for whole models:
//! `cargo bench --bench model`. With the environment variable `TATAMU_MESHES`, a folder, the models are
//! those of its meshes `*.off` instead of the samples.

mod input;

use divan::Bencher;
use input::read;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tatamu::fold::{FoldPlan, ModelMotion};
use tatamu::model::Model;
use tatamu::net::{BlankNet, KnownNets, NetOptions, develop_model};
use tatamu::pipeline::{self, Engine, Options};
use tatamu::progress::Silent;
use tatamu::sheet::{Layout, SheetOptions};
use tatamu::units::Paper;

fn main() {
    divan::main();
}

fn meshes() -> Vec<String> {
    let (folder, extension) = match std::env::var_os("TATAMU_MESHES").map(PathBuf::from) {
        Some(folder) => (folder, "off"),
        None => (Path::new(env!("CARGO_MANIFEST_DIR")).join("samples"), "obj"),
    };
    let entries = std::fs::read_dir(folder).expect("a folder of meshes");
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let of_kind = paths.filter(|path| path.extension().is_some_and(|e| e == extension));
    let mut names: Vec<String> = of_kind.map(|path| path.display().to_string()).collect();
    names.sort();
    names
}

fn model(path: &str) -> Option<Model> {
    let shaped = Engine::new(Cow::Owned(read(path)?)).shape(&Options::default(), &Silent).ok()?;
    Some(shaped.model().clone())
}

fn sheet_options() -> SheetOptions {
    SheetOptions::new(Paper::default(), Options::default().margin_mm)
}

fn alternatives(model: &Model) -> Option<Vec<Vec<Arc<BlankNet>>>> {
    let options = NetOptions::new(Options::default().tab_width_mm, sheet_options().room_mm());
    develop_model(model, &options, &BTreeMap::new(), &KnownNets::default(), &Silent).ok()
}

/// The check of the folding, and the search for its order.
#[divan::bench(args = meshes(), sample_count = 3, sample_size = 1)]
fn folding(bencher: Bencher, path: &str) {
    let Some(model) = model(path) else { return };
    let thickness_mm = Options::default().thickness_mm;
    bencher.bench(|| FoldPlan::new(&ModelMotion::new(&model), thickness_mm, &Silent).is_ok());
}

#[divan::bench(args = meshes(), sample_count = 3, sample_size = 1)]
fn nets(bencher: Bencher, path: &str) {
    let Some(model) = model(path) else { return };
    bencher.bench(|| alternatives(&model));
}

#[divan::bench(args = meshes(), sample_count = 3, sample_size = 1)]
fn sheets(bencher: Bencher, path: &str) {
    let Some(nets) = model(path).and_then(|model| alternatives(&model)) else { return };
    let (options, pins) = (sheet_options(), Options::default().pins);
    bencher.bench(|| Layout::of_alternatives(&nets, &[], &options, &pins, &Silent).is_ok());
}

/// From the mesh to the sheets.
#[divan::bench(args = meshes(), sample_count = 3, sample_size = 1)]
fn whole(bencher: Bencher, path: &str) {
    let Some(mesh) = read(path) else { return };
    bencher.bench(|| pipeline::run(&mesh, &Options::default(), &Silent).is_ok());
}
