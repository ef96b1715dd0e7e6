//! Seconds of each stage of `make`, from the file to the PDF, as a table in Markdown:
//! `cargo run --release --example stages -- snowman.off:6 bunny.off:5`.
//! A number after a colon is the number of parts. Each row is the fastest of three runs.

mod input;

use input::path_and_options;
use std::error::Error;
use std::sync::Mutex;
use std::time::Instant;
use tatamu::export::{FormatOptions, format_of};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::product::Product;
use tatamu::progress::Progress;
use tatamu::report::Run;

const RUNS: usize = 3;

/// Columns, each with the stages that it sums up.
const COLUMNS: [(&str, &[&str]); 7] = [
    ("read", &["read"]),
    ("parts", &["thickness", "patches", "parts", "borders", "hulls"]),
    ("components", &["components"]),
    ("nets", &["nets"]),
    ("sheets", &["sheets"]),
    // What is left of it when the sheets are done.
    ("folding", &["folding"]),
    ("PDF", &["PDF"]),
];

/// When each stage began.
#[derive(Default)]
struct Clock(Mutex<Vec<(&'static str, Instant)>>);

impl Progress for Clock {
    fn stage(&self, name: &'static str) {
        self.0.lock().expect("no thread panicked").push((name, Instant::now()));
    }
}

/// One run.
struct Timed {
    faces: usize,
    components: usize,
    /// Of each column.
    seconds: Vec<f64>,
}

impl Timed {
    fn total(&self) -> f64 {
        self.seconds.iter().sum()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let names = COLUMNS.map(|(name, _)| name).join(" | ");
    println!("| mesh | faces | components | {names} | all, s |\n|{}", "---|".repeat(4 + COLUMNS.len()));
    for argument in std::env::args().skip(1) {
        let (path, options) = path_and_options(&argument)?;
        let runs = (0..RUNS).map(|_| time(path, &options)).collect::<Result<Vec<_>, _>>()?;
        let fastest = runs.iter().min_by(|a, b| a.total().total_cmp(&b.total())).ok_or("no run")?;
        let seconds: Vec<String> = fastest.seconds.iter().map(|s| format!("{s:.2}")).collect();
        println!(
            "| {path} | {} | {} | {} | {:.2} |",
            fastest.faces,
            fastest.components,
            seconds.join(" | "),
            fastest.total()
        );
    }
    Ok(())
}

fn time(path: &str, options: &Options) -> Result<Timed, Box<dyn Error>> {
    let clock = Clock::default();
    clock.stage("read");
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(&std::fs::read(path)?)?)?;
    let output = pipeline::run(&mesh, options, &clock)?;
    clock.stage("PDF");
    let run = Run { path, repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let pdf = format_of("pdf").ok_or("no PDF")?;
    pdf.write(&Product::new(&output, "model", run), &FormatOptions::default())?;
    clock.stage("end");
    let begun = clock.0.into_inner()?;
    let of_stage = |pair: &[(&'static str, Instant)]| (pair[0].0, (pair[1].1 - pair[0].1).as_secs_f64());
    let stages: Vec<(&'static str, f64)> = begun.windows(2).map(of_stage).collect();
    let known = |name: &'static str| COLUMNS.iter().any(|(_, stages)| stages.contains(&name));
    if let Some((name, _)) = stages.iter().find(|(name, _)| !known(name)) {
        return Err(format!("no column counts the stage {name}").into());
    }
    let sum = |names: &[&str]| stages.iter().filter(|(name, _)| names.contains(name)).map(|(_, s)| s).sum();
    let seconds = COLUMNS.iter().map(|(_, names)| sum(names)).collect();
    Ok(Timed { faces: mesh.faces().len(), components: output.model().parts().len(), seconds })
}
