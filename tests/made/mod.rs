//! The samples, made once, with their files, for all tests.

use glam::DVec2;
use rayon::prelude::*;
use serde::Deserialize;
use std::sync::LazyLock;
use tatamu::export::{FormatOptions, format_of};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options, Output};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;

const NAMES: [&str; 6] = ["teddy", "snowman", "rabbit", "teapot", "bottle", "box"];

/// A sample and what the program makes of it.
pub struct Made {
    pub name: &'static str,
    pub output: Output,
    pub fold: Vec<u8>,
    pub master: Fold,
    pub pdf: Vec<u8>,
}

/// What the tests read of a FOLD master.
#[derive(Deserialize)]
pub struct Fold {
    pub vertices_coords: Vec<[f64; 3]>,
    pub faces_vertices: Vec<Vec<usize>>,
    pub edges_vertices: Vec<[usize; 2]>,
    pub file_frames: Vec<Frame>,
    #[serde(rename = "faces_tatamu:component")]
    pub component: Vec<String>,
    #[serde(rename = "faces_tatamu:kind")]
    pub kind: Vec<String>,
    #[serde(rename = "faces_tatamu:chain")]
    pub chain: Vec<Option<usize>>,
    #[serde(rename = "edges_tatamu:kind")]
    pub edge_kind: Vec<String>,
    #[serde(rename = "edges_tatamu:label")]
    pub edge_label: Vec<Option<String>>,
}

#[derive(Deserialize)]
pub struct Frame {
    pub vertices_coords: Vec<[f64; 3]>,
}

impl Fold {
    /// The faces of a component, tabs among them.
    pub fn faces_of<'a>(&'a self, component: &'a str) -> impl Iterator<Item = usize> + 'a {
        (0..self.component.len()).filter(move |&f| self.component[f] == component)
    }

    /// A side panel's corners in the crease pattern, turned so that its hinges are horizontal.
    pub fn along_hinge(&self, face: usize) -> Vec<DVec2> {
        let corners = &self.faces_vertices[face];
        let at = |v: usize| DVec2::new(self.vertices_coords[v][0], self.vertices_coords[v][1]);
        let is_hinge = |edge: usize| !matches!(self.edge_kind[edge].as_str(), "border" | "slit");
        let hinge = (0..self.edges_vertices.len())
            .find(|&e| is_hinge(e) && self.edges_vertices[e].iter().all(|v| corners.contains(v)))
            .expect("a side panel has hinges");
        let [from, to] = self.edges_vertices[hinge].map(at);
        let along = (to - from).normalize();
        corners.iter().map(|&v| DVec2::new(along.dot(at(v)), along.perp_dot(at(v)))).collect()
    }
}

/// The samples, made at the first call.
pub fn samples() -> &'static [Made] {
    static MADE: LazyLock<Vec<Made>> = LazyLock::new(|| NAMES.par_iter().map(|name| make(name)).collect());
    &MADE
}

fn make(name: &'static str) -> Made {
    let path = format!("{}/samples/{name}.obj", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).expect("a committed file");
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(&bytes).expect("OBJ")).expect("a mesh");
    let output = pipeline::run(&mesh, &Options::default(), &Silent).expect("a model");
    let run = Run { path: name, repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let product = Product::new(&output, name, run);
    let [fold, pdf] = ["fold", "pdf"].map(|format| {
        let format = format_of(format).expect("registered");
        let mut files = format.write(&product, &FormatOptions::default()).expect("files");
        files.remove(0).bytes
    });
    let master = serde_json::from_slice(&fold).expect("FOLD");
    Made { name, output, fold, master, pdf }
}
