//! How close components come to their hulls, how well joints are supported, and how long it takes,
//! at the five settings of the paper's Table 2 and at the defaults:
//! `cargo run --release --example fidelity -- bunny.off:5 teapot.off`.
//! A number after a colon is the number of parts.

mod input;

use input::path_and_options;
use std::error::Error;
use std::time::Instant;
use tatamu::mesh::{self, Mesh};
use tatamu::model::{self, Assembly, Known, Model, Part, Unjudged};
use tatamu::pipeline::{self, Bodies, Hulls};
use tatamu::progress::Silent;

/// Edges of top panels and vertices of profiles, with the average and the worst Hausdorff ratio that
/// the paper has for the bunny, where it tells.
const SETTINGS: [(usize, usize, &str); 6] = [
    (5, 6, "paper .066"),
    (5, 10, ""),
    (8, 6, "paper .063"),
    (5, 3, "paper .070"),
    (4, 6, ""),
    (6, 6, "defaults"),
];
/// Runs of which the best time counts.
const RUNS: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    for argument in std::env::args().skip(1) {
        let (path, options) = path_and_options(&argument)?;
        let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(path)?)?)?;
        let (divided, _) = pipeline::find_parts(&mesh, &options, &Silent)?;
        let bodies = Bodies::new(&Hulls::new(&divided)?, &options)?;
        println!("{path}: {} components, thousandths of the diagonal", bodies.parts().len());
        println!("  edges vertices    mean  worst      time  each component | support of each joint, %");
        for setting in SETTINGS {
            measure(&bodies, setting, divided.mesh().diagonal_mm(), options.min_panel_width_mm)?;
        }
    }
    Ok(())
}

fn measure(
    bodies: &Bodies,
    (edges, vertices, note): (usize, usize, &str),
    diagonal_mm: f64,
    least_mm: f64,
) -> Result<(), Box<dyn Error>> {
    let mut parts: Vec<Part> = bodies.parts().to_vec();
    for part in &mut parts {
        (part.options.top_edges, part.options.profile_vertices) = (edges, vertices);
        part.options.panel_worth = 0.0;
    }
    let assembly = Assembly { parts: &parts, ..bodies.assembly(least_mm) };
    let mut fastest_ms = f64::INFINITY;
    let mut made: Option<Model> = None;
    for _ in 0..RUNS {
        let start = Instant::now();
        made = Some(model::build(&assembly, &Known::default(), &Unjudged, &Silent)?.model);
        fastest_ms = fastest_ms.min(start.elapsed().as_secs_f64() * 1e3);
    }
    let Some(model) = made else { return Ok(()) };
    let parts = model.parts();
    let thousandths: Vec<f64> =
        parts.iter().map(|p| 1e3 * p.component.hausdorff_mm() / diagonal_mm).collect();
    let mean = thousandths.iter().sum::<f64>() / parts.len() as f64;
    let worst = thousandths.iter().copied().fold(0.0, f64::max);
    let each: Vec<String> = thousandths.iter().map(|r| format!("{r:.1}")).collect();
    let joints = parts.iter().filter_map(|p| p.joint.as_ref());
    let support: Vec<String> = joints.map(|j| format!("{:.0}", 100.0 * j.support_ratio)).collect();
    println!(
        "  {edges:5} {vertices:8} {mean:7.1} {worst:6.1} {fastest_ms:6.0} ms  {} | {}  {note}",
        each.join(" "),
        support.join(" ")
    );
    Ok(())
}
