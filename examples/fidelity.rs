//! How close components come to their hulls, how well joints are supported, and how long it takes:
//! `cargo run --release --example fidelity -- bunny.off:5 teapot.off`.
//! A number after a colon is the number of parts.

use std::error::Error;
use std::time::Instant;
use tatamu::mesh::{self, Mesh};
use tatamu::model::{self, Model, Part};
use tatamu::pipeline::{self, Bodies, Options};
use tatamu::progress::Silent;
use tatamu::segment::SegmentOptions;

/// Edges of top panels and vertices of profiles: the five settings of the paper's Table 2, then the
/// defaults.
const SETTINGS: [(usize, usize); 6] = [(5, 6), (5, 10), (8, 6), (5, 3), (4, 6), (6, 6)];
/// Each time is the best of so many runs.
const RUNS: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    for argument in std::env::args().skip(1) {
        let (path, parts) = match argument.rsplit_once(':') {
            Some((path, parts)) => (path, Some(parts.parse()?)),
            None => (argument.as_str(), None),
        };
        let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(path)?)?)?;
        let segmentation = SegmentOptions { parts, ..SegmentOptions::default() };
        let options = Options { segmentation, ..Options::default() };
        let (divided, _) = pipeline::find_parts(&mesh, &options, &Silent)?;
        let bodies = Bodies::new(&divided, &options)?;
        println!("{path}: {} parts", bodies.parts().len());
        for setting in SETTINGS {
            measure(&bodies, setting, divided.mesh().diagonal_mm(), options.min_panel_width_mm)?;
        }
    }
    Ok(())
}

fn measure(
    bodies: &Bodies,
    (edges, vertices): (usize, usize),
    diagonal_mm: f64,
    least_mm: f64,
) -> Result<(), Box<dyn Error>> {
    let mut parts: Vec<Part> = bodies.parts().to_vec();
    for part in &mut parts {
        (part.options.top_edges, part.options.profile_vertices) = (edges, vertices);
    }
    let mut seconds = f64::INFINITY;
    let mut cpu = f64::INFINITY;
    let mut made: Option<Model> = None;
    for _ in 0..RUNS {
        let start = Instant::now();
        let before = cpu_ms();
        made = Some(model::build(&parts, bodies.links(), least_mm, &Silent)?);
        seconds = seconds.min(start.elapsed().as_secs_f64());
        cpu = cpu.min(cpu_ms() - before);
    }
    let Some(model) = made else { return Ok(()) };
    let ratios: Vec<f64> = model.parts().iter().map(|p| p.component.hausdorff_mm() / diagonal_mm).collect();
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    let worst = ratios.iter().copied().fold(0.0, f64::max);
    let list = |values: Vec<String>| values.join(" ");
    println!(
        "  ({edges}, {vertices:2}) mean {mean:.4} worst {worst:.4} {:4.0} ms cpu {cpu:4.0} | {} | support {} | deg {}",
        seconds * 1e3,
        list(ratios.iter().map(|r| format!("{r:.4}")).collect()),
        list(
            model
                .parts()
                .iter()
                .map(|p| p.joint.as_ref().map_or("-".into(), |j| format!("{:.0}", 100.0 * j.support_ratio)))
                .collect()
        ),
        list(model.parts().iter().map(|p| format!("{:.0}", p.direction_rad.to_degrees())).collect())
    );
    Ok(())
}

fn cpu_ms() -> f64 {
    let mut sum = 0.0;
    for task in std::fs::read_dir("/proc/self/task").unwrap() {
        let text = std::fs::read_to_string(task.unwrap().path().join("schedstat")).unwrap();
        sum += text.split(' ').next().unwrap().parse::<f64>().unwrap() / 1e6;
    }
    sum
}
