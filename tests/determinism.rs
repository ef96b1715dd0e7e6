//! The same mesh gives the same bytes, in every run and on any number of threads.

use tatamu::export::{FORMATS, Format, FormatOptions};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::plotter::Cutter;
use tatamu::plotter::profile::CUTTERS;
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;
use tatamu::segment::SegmentOptions;

/// A sample with a joint, made with few edges so that it is quick.
const SAMPLE: &[u8] = include_bytes!("../samples/bottle.obj");

/// Options of a format: those of G-code name a machine that speaks it.
fn options_of(format: &Format) -> FormatOptions {
    let mut options = FormatOptions::default();
    if format.name == "gcode" {
        let pen = CUTTERS.iter().find(|profile| profile.name == "grbl-pen").expect("exists");
        options.plt.cutter = Cutter::parse(pen.text).expect("valid");
    }
    options
}

/// Every file of every format, made on this number of threads.
fn files(threads: usize) -> Vec<(&'static str, Vec<u8>)> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let (mesh, repairs) = Mesh::from_soup(&mesh::read(SAMPLE).expect("OBJ")).expect("a mesh");
        let options = Options {
            segmentation: SegmentOptions { parts: Some(2), ..Default::default() },
            top_edges: Some(4),
            profile_vertices: Some(4),
            ..Options::default()
        };
        let output = pipeline::run(&mesh, &options, &Silent).expect("a model");
        assert_eq!(output.model().parts().len(), 2);
        let run = Run {
            path: "bottle.obj",
            repairs: &repairs,
            stages: &[],
            warnings: &[],
            say: ToString::to_string,
        };
        let product = Product::new(&output, "bottle", run);
        let written = FORMATS.iter().flat_map(|format| {
            let files = format.write(&product, &options_of(format)).expect("files");
            files.into_iter().map(|file| (format.name, file.bytes))
        });
        written.collect()
    })
}

#[test]
fn runs_and_threads_make_no_difference() {
    let [first, again, on_two] = std::thread::scope(|scope| {
        [1, 1, 2].map(|threads| scope.spawn(move || files(threads))).map(|made| made.join().expect("files"))
    });
    assert!(first.len() >= FORMATS.len());
    for (threads, other) in [(1, again), (2, on_two)] {
        assert_eq!(other.len(), first.len());
        for ((name, a), (_, b)) in first.iter().zip(&other) {
            assert!(a == b, "{name} differs on {threads} threads");
        }
    }
}
