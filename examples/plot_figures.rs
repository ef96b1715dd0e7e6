//! Figures of cutters: how short the way with the tool up is, how true the tip, and what streaming
//! loses, measured on the virtual plotter.
//!
//! `cargo run --release --example plot_figures -- FOLDER/snowman.off:6 bunny.off:5`
//! A number after a colon is the number of parts.

mod input;
#[path = "../tests/plotting/measure.rs"]
mod measure;
#[path = "../tests/plotting/rehearsal.rs"]
mod rehearsal;

use input::path_and_options;
use measure::Figures;
use rehearsal::Rehearsal;
use std::error::Error;
use tatamu::drawing::Drawing;
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline;
use tatamu::plotter::profile::{CUTTERS, Handshake, MEDIA};
use tatamu::plotter::session::SLOWNESS;
use tatamu::plotter::{Cutter, Faults, Job, Media, Plan, VirtualMachine, VirtualOptions, test_cut};
use tatamu::product::Product;
use tatamu::progress::Silent;
use tatamu::report::Run;
use tatamu::toolpath::{Operation, tasks};

/// Machines and media of the first table.
const JOBS: [(&str, &str); 4] = [
    ("generic-hpgl", "cardstock-200"),
    ("graphtec", "cardstock-200"),
    ("pen-plotter", "pen"),
    ("silhouette", "cardstock-200"),
];
/// Length of the job that is streamed, bytes.
const STREAMED: usize = 1_000_000;
const HANDSHAKES: [Handshake; 4] = [Handshake::EscB, Handshake::RtsCts, Handshake::XonXoff, Handshake::Paced];

fn main() -> Result<(), Box<dyn Error>> {
    let mut sheets = Vec::new();
    println!(
        "sheets strokes   bytes  travel m  file order m  ratio  tip mm  missed mm  drawing mm  units  lost"
    );
    for argument in std::env::args().skip(1) {
        let pages = pages(&argument)?;
        for (cutter, media) in JOBS {
            measure_model(&pages, &cutter_of(cutter)?, &media_of(media)?)?;
            println!("  {argument}, {cutter}, {media}");
        }
        sheets.extend(pages);
    }
    stream(&sheets)?;
    stop_everywhere()
}

fn cutter_of(name: &str) -> Result<Cutter, Box<dyn Error>> {
    let found = CUTTERS.iter().find(|p| p.name == name).ok_or("no such cutter")?;
    Ok(Cutter::parse(found.text)?)
}

fn media_of(name: &str) -> Result<Media, Box<dyn Error>> {
    let found = MEDIA.iter().find(|p| p.name == name).ok_or("no such medium")?;
    Ok(Media::parse(found.text)?)
}

/// The sheets of a mesh.
fn pages(argument: &str) -> Result<Vec<Drawing>, Box<dyn Error>> {
    let (path, options) = path_and_options(argument)?;
    let (mesh, repairs) = Mesh::from_soup(&mesh::read(&std::fs::read(path)?)?)?;
    let output = pipeline::run(&mesh, &options, &Silent)?;
    let run = Run { path, repairs: &repairs, stages: &[], warnings: &[], say: ToString::to_string };
    let mut pages = Product::new(&output, path, run).pages()?.drawings().to_vec();
    // Sheets that only have words on them are nothing for a cutter.
    pages.retain(|page| !tasks(page, &[Operation::Cut]).is_empty());
    Ok(pages)
}

fn measure_model(pages: &[Drawing], cutter: &Cutter, media: &Media) -> Result<(), Box<dyn Error>> {
    let mut sum = Figures::default();
    for page in pages {
        sum = sum.and(measure::sheet(page, cutter, media)?);
    }
    print!(
        "{:6} {:7} {:7} {:9.2} {:13.2} {:6.2} {:7.4} {:10.4} {:11.6} {:6.3} {:5}",
        pages.len(),
        sum.strokes,
        sum.bytes,
        sum.travel_mm / 1000.0,
        sum.file_travel_mm / 1000.0,
        sum.travel_mm / sum.file_travel_mm,
        sum.tip_mm,
        sum.missed_mm,
        sum.drawing_mm,
        sum.unit_error,
        sum.lost
    );
    Ok(())
}

/// Streams a megabyte of the sheets, over and over, through a buffer of 1 KiB.
fn stream(pages: &[Drawing]) -> Result<(), Box<dyn Error>> {
    println!("\nhandshake    baud    bytes  lost  broken  line busy when there is room  modelled time");
    let own = [test_cut()];
    let pages = if pages.is_empty() { &own } else { pages };
    for baud in [9600, 115_200] {
        for handshake in HANDSHAKES {
            let answers = handshake != Handshake::Paced;
            let text = cutter_of("generic-hpgl")?.text().replace("baud = 9600", &format!("baud = {baud}"));
            let cutter = Cutter::parse(&text.replace("answers = true", &format!("answers = {answers}")))?;
            let media = media_of("cardstock-200")?;
            let mut bytes = Vec::new();
            for page in pages.iter().cycle() {
                bytes.extend(Plan::new(page, &cutter, &media)?.bytes());
                if bytes.len() >= STREAMED {
                    break;
                }
            }
            // Time alone allows for a machine that is slower than its profile: this is one.
            let slowness = if answers { 1.0 } else { SLOWNESS };
            let faults = Faults { slowness, ..Faults::default() };
            let options = VirtualOptions { answers, faults, ..VirtualOptions::default() };
            let mut rehearsal = Rehearsal::new(Job::parse(&bytes, &cutter)?, &cutter, handshake, options);
            let outcome = rehearsal.run();
            println!(
                "{:10} {baud:6} {:8} {:5} {:7} {:27.1} % {:12.0} s  {:?}",
                handshake.name(),
                bytes.len(),
                rehearsal.plotter.lost(),
                rehearsal.plotter.broken(),
                100.0 * rehearsal.busy_share(),
                rehearsal.now().as_secs_f64(),
                outcome.end
            );
        }
    }
    Ok(())
}

/// Stops the test cut after each of its bytes, on every machine by its own handshake.
fn stop_everywhere() -> Result<(), Box<dyn Error>> {
    println!(
        "\nstops  pen left down  lost  broken  machine, the test cut stopped once and twice at every byte"
    );
    for profile in CUTTERS {
        let cutter = Cutter::parse(profile.text)?;
        // Tests of these have simulated machines of their own.
        if matches!(cutter.serial().handshake, Handshake::Count | Handshake::Ok | Handshake::Usb) {
            continue;
        }
        let bytes = Plan::new(&test_cut(), &cutter, &Media::usual())?.bytes().to_vec();
        let job = Job::parse(&bytes, &cutter)?;
        let (mut stops, mut down, mut lost, mut broken) = (0, 0, 0, 0);
        for stop_at in 1..=bytes.len() as u64 {
            for stop_wishes in [1, 2] {
                let answers = cutter.serial().answers;
                let options = VirtualOptions { answers, ..VirtualOptions::default() };
                let mut rehearsal = Rehearsal::new(job.clone(), &cutter, cutter.serial().handshake, options);
                (rehearsal.stop_at, rehearsal.stop_wishes) = (Some(stop_at), stop_wishes);
                rehearsal.run();
                stops += 1;
                down += u32::from(rehearsal.plotter.is_pen_down());
                lost += rehearsal.plotter.lost();
                broken += rehearsal.plotter.broken();
            }
        }
        println!("{stops:5} {down:14} {lost:5} {broken:7}  {}", profile.name);
    }
    Ok(())
}
