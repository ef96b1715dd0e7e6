//! Time and memory of `make` by the number of faces: `cargo run --release --example scale -- scale.svg`.
//!
//! The mesh is the sample teddy, made finer and finer. Each size has a process of its own, which reads
//! the OBJ file, makes the model and its PDF, and tells the most memory that it had. Prints a table in
//! Markdown and draws it. For Linux, where a process can read its own peak.

#[expect(dead_code, reason = "of the samples only the teddy is made")]
#[path = "make_samples/mod.rs"]
mod generator;

use glam::DVec2;
use std::error::Error;
use std::path::Path;
use std::process::Command;
use std::time::Instant;
use tatamu::drawing::{Align, Drawing, Layer, LineStyles, Mark, Pages, Rgb, Stroke, Text};
use tatamu::export::{FormatOptions, Source, format_of};
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;

/// Numbers of faces to aim at.
const FACES: [f64; 7] = [1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6];
/// What a million faces may take.
const LIMITS: (f64, f64) = (20.0, 2048.0);
/// The argument of the processes that measure.
const ONE: &str = "--one";

/// What one size takes.
struct Row {
    faces: f64,
    seconds: f64,
    mebibytes: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [ONE, path] => measure(Path::new(path)),
        [picture] => compare(Path::new(picture)),
        _ => Err("give the name of the SVG file to write".into()),
    }
}

/// Measures all sizes, each in a process of its own.
fn compare(picture: &Path) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("teddy.obj");
    let mut rows = Vec::new();
    println!("| faces | seconds | peak memory, MiB |\n|---|---|---|");
    for faces in FACES {
        std::fs::write(&path, teddy(faces).to_obj("teddy"))?;
        let output = Command::new(std::env::current_exe()?).arg(ONE).arg(&path).output()?;
        if !output.status.success() {
            return Err(String::from_utf8_lossy(&output.stderr).into());
        }
        let text = String::from_utf8(output.stdout)?;
        let numbers = text.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        let [faces, seconds, mebibytes] = numbers[..] else { return Err("three numbers were due".into()) };
        println!("| {faces:.0} | {seconds:.2} | {mebibytes:.0} |");
        rows.push(Row { faces, seconds, mebibytes });
    }
    std::fs::write(picture, plot(&rows)?)?;
    Ok(())
}

/// The sample teddy with about `faces` faces: their number grows with the square of the inverse edge length.
fn teddy(faces: f64) -> generator::mesh::Mesh {
    let usual = generator::figures::teddy(generator::TEDDY_CELL_MM).faces.len() as f64;
    generator::figures::teddy(generator::TEDDY_CELL_MM * (usual / faces).sqrt())
}

/// Makes one model, and prints faces, seconds and mebibytes.
fn measure(path: &Path) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(&std::fs::read(path)?)?)?;
    let output = pipeline::run(&mesh, &Options::default(), &Silent)?;
    let run =
        Run { path: "teddy.obj", repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let pdf = format_of("pdf").ok_or("no PDF")?;
    let files = pdf.write(&Product::new(&output, "teddy", run), &FormatOptions::default())?;
    std::fs::write(path.with_extension("pdf"), &files[0].bytes)?;
    let seconds = start.elapsed().as_secs_f64();
    println!("{} {seconds} {}", mesh.faces().len(), peak_mebibytes()?);
    Ok(())
}

/// The most memory that this process ever had (proc(5)).
fn peak_mebibytes() -> Result<f64, Box<dyn Error>> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).ok_or("no peak is told")?;
    Ok(peak.trim().trim_end_matches("kB").trim().parse::<f64>()? / 1024.0)
}

/// Two charts with logarithmic axes side by side.
fn plot(rows: &[Row]) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut drawing = Drawing::new("Time and memory by faces", DVec2::new(170.0, 76.0));
    drawing.ground = Some(Rgb::WHITE);
    let points =
        |of: fn(&Row) -> f64| rows.iter().map(|row| DVec2::new(row.faces, of(row))).collect::<Vec<_>>();
    let times = Chart { corner: DVec2::new(14.0, 14.0), low: 0.1, title: "seconds", limit: LIMITS.0 };
    times.draw(&points(|row| row.seconds), &mut drawing.marks);
    let memory =
        Chart { corner: DVec2::new(100.0, 14.0), low: 10.0, title: "peak memory, MiB", limit: LIMITS.1 };
    memory.draw(&points(|row| row.mebibytes), &mut drawing.marks);
    let svg = format_of("svg").ok_or("no SVG")?;
    let Source::Pages(write) = svg.source else { return Err("SVG is not made of pages".into()) };
    let pages = Pages::new("scale", vec![drawing], LineStyles::standard())?;
    let files = write(&pages, &FormatOptions::default())?;
    Ok(files[0].bytes.clone())
}

/// A chart of three decades.
struct Chart {
    /// Its lower left corner.
    corner: DVec2,
    /// The least value.
    low: f64,
    title: &'static str,
    /// The limit for the largest mesh.
    limit: f64,
}

impl Chart {
    const SIZE: DVec2 = DVec2::new(62.0, 50.0);
    const GREY: Rgb = Rgb(200, 200, 200);
    const BLUE: Rgb = Rgb(0, 90, 160);
    const RED: Rgb = Rgb(190, 40, 30);

    /// Where a number of faces and a value stand.
    fn at(&self, point: DVec2) -> DVec2 {
        let decades = DVec2::new((point.x / FACES[0]).log10(), (point.y / self.low).log10());
        self.corner + decades / 3.0 * Self::SIZE
    }

    fn draw(&self, points: &[DVec2], marks: &mut Vec<Mark>) {
        let end = |k: i32| (FACES[0] * 10f64.powi(k), self.low * 10f64.powi(k));
        let ((left, low), (right, high)) = (end(0), end(3));
        let mut line = |from: [f64; 2], to: [f64; 2], stroke: &Stroke| {
            let [from, to] = [from, to].map(|p| self.at(p.into()));
            marks.push(Mark::line(Layer::Picture, from, to, stroke));
        };
        let grid = Stroke::solid(0.15, Self::GREY);
        for k in 0..=3 {
            let (x, y) = end(k);
            line([x, low], [x, high], &grid);
            line([left, y], [right, y], &grid);
        }
        line([left, self.limit], [right, self.limit], &Stroke::solid(0.3, Self::RED));
        let stroke = Stroke::solid(0.5, Self::BLUE);
        points.windows(2).for_each(|pair| line(pair[0].into(), pair[1].into(), &stroke));
        for &point in points {
            let middle = self.at(point);
            let corners = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y].map(|d| middle + 0.9 * d);
            marks.push(Mark::filled(Layer::Picture, corners.to_vec(), Self::BLUE));
        }
        let mut write = |content: String, place: DVec2, align: Align, colour: Rgb| {
            let text = Text::new(content, place, 2.2).aligned(align).coloured(colour);
            marks.push(Mark::text(Layer::Picture, text));
        };
        for k in 0..=3 {
            let (x, y) = end(k);
            write(short(x), self.at(DVec2::new(x, low)) - DVec2::Y * 4.0, Align::Middle, Rgb::BLACK);
            write(short(y), self.at(DVec2::new(left, y)) - DVec2::new(1.5, 1.1), Align::End, Rgb::BLACK);
        }
        let limit = self.at(DVec2::new(left, self.limit)) + DVec2::new(1.5, 1.2);
        write(format!("limit at 1 000 000: {}", self.limit), limit, Align::Start, Self::RED);
        write(
            self.title.to_owned(),
            self.at(DVec2::new(left, high)) + DVec2::Y * 3.0,
            Align::Start,
            Rgb::BLACK,
        );
        let middle = self.corner + DVec2::new(0.5 * Self::SIZE.x, -9.5);
        write("faces".to_owned(), middle, Align::Middle, Rgb::BLACK);
    }
}

/// A power of ten as people write it.
fn short(value: f64) -> String {
    match value {
        v if v >= 1e6 => format!("{:.0}M", v / 1e6),
        v if v >= 1e3 => format!("{:.0}k", v / 1e3),
        v => format!("{v}"),
    }
}
