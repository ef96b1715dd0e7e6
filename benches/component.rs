//! How long components take: `cargo bench --bench component`. With the environment variable
//! `TATAMU_MESHES`, a folder, whole models are those of its meshes `*.off` instead of the samples.

use divan::Bencher;
use std::fmt;
use std::path::{Path, PathBuf};
use tatamu::component::{Target, convert};
use tatamu::geom::{Hull, directions};
use tatamu::mesh::{self, Mesh};
use tatamu::model::{self, Known, Unjudged};
use tatamu::pipeline::{self, Bodies, Hulls, Options};
use tatamu::progress::Silent;

fn main() {
    divan::main();
}

/// One hull, one direction, by top edges and profile vertices.
#[divan::bench(args = [(5, 3), (4, 6), (5, 6), (6, 6), (8, 6), (5, 10)])]
fn one_component(bencher: Bencher, (top_edges, profile_vertices): (usize, usize)) {
    let points: Vec<_> = directions(400).map(|d| d * glam::DVec3::new(60.0, 45.0, 50.0)).collect();
    let hull = Hull::of_points(&points).expect("an ellipsoid");
    let target = Target {
        hull: &hull,
        filling: None,
        joints: Vec::new(),
        borders: Vec::new(),
        symmetry: None,
        top_edges,
        profile_vertices,
        min_panel_mm: 3.0,
        panel_worth: 0.0015,
        comfortable_mm: 4.5,
    };
    bencher.bench(|| convert(&target).expect("a component"));
}

/// A mesh file by its name.
struct Named(PathBuf);

impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0.file_stem().unwrap_or_default().to_string_lossy())
    }
}

fn meshes() -> Vec<Named> {
    let folder = std::env::var_os("TATAMU_MESHES").map(PathBuf::from);
    let (folder, extension) = match folder {
        Some(folder) => (folder, "off"),
        None => (Path::new(env!("CARGO_MANIFEST_DIR")).join("samples"), "obj"),
    };
    let entries = std::fs::read_dir(folder).expect("a folder of meshes");
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut paths: Vec<PathBuf> = paths.filter(|p| p.extension().is_some_and(|e| e == extension)).collect();
    paths.sort();
    paths.into_iter().map(Named).collect()
}

fn bodies(path: &Path) -> Option<Bodies> {
    let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(path).ok()?).ok()?).ok()?;
    let options = Options::default();
    let (divided, _) = pipeline::find_parts(&mesh, &options, &Silent).ok()?;
    Bodies::new(&Hulls::new(&divided).ok()?, &options).ok()
}

/// All components of a mesh at the default settings, without its segmentation.
#[divan::bench(args = meshes())]
fn whole_model(bencher: Bencher, mesh: &Named) {
    let Some(bodies) = bodies(&mesh.0) else { return };
    bencher.bench(|| model::build(&bodies.assembly(3.0), &Known::default(), &Unjudged, &Silent).is_ok());
}
