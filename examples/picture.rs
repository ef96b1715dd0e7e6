//! Draws models side by side, two to a row: a mesh as its parts, its paper model and the model when
//! folded flat; a project file of drawn components standing, half folded and flat.
//! `cargo run --release --example picture -- samples/teddy.obj teddy.png`.

#[path = "input/pictures.rs"]
mod pictures;

use glam::{DAffine2, DVec2, DVec3};
use pictures::inputs_and_picture;
use std::error::Error;
use tatamu::drawing::{Drawing, Rgb};
use tatamu::export::png;
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::progress::Silent;
use tatamu::project::Project;
use tatamu::render::{Camera, Scene, View};
use tatamu::show::{components_scene, framed, segments_scene, staged_scene};

/// One picture of the three, about 380 pixels wide and high.
const SIZE_MM: DVec2 = DVec2::splat(110.0);
const MARGIN_MM: f64 = 5.0;
const DOTS_PER_INCH: f64 = 88.0;
/// Models in a row.
const ROW: usize = 2;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((inputs, output)) = inputs_and_picture(&arguments) else {
        return Err("give meshes or project files, and the name of the PNG file to write".into());
    };
    let cells = DVec2::new(3.0 * inputs.len().min(ROW) as f64, inputs.len().div_ceil(ROW) as f64);
    let mut drawing = Drawing::new("", SIZE_MM * cells);
    drawing.ground = Some(Rgb::WHITE);
    for (place, input) in inputs.iter().enumerate() {
        let (column, row) = (3 * (place % ROW), place / ROW);
        for (k, (scene, camera)) in scenes(input)?.into_iter().enumerate() {
            let points: Vec<DVec3> = scene.points().collect();
            let view = View::fit(camera, points, SIZE_MM, MARGIN_MM)?;
            let marks = framed(&scene, &view, Some(Rgb::WHITE)).marks;
            let cell = DVec2::new((column + k) as f64, cells.y - 1.0 - row as f64);
            drawing.place(marks, DAffine2::from_translation(SIZE_MM * cell));
        }
    }
    std::fs::write(output, png::render(&drawing, DOTS_PER_INCH)?)?;
    Ok(())
}

/// The three pictures of a model.
fn scenes(input: &str) -> Result<[(Scene, Camera); 3], Box<dyn Error>> {
    let (bytes, options) = (std::fs::read(input)?, Options::default());
    let standing = Camera::new(0.5, 0.25, 0.3)?;
    if !input.ends_with(".toml") {
        let (mesh, _) = Mesh::from_soup(&mesh::read(&bytes)?)?;
        let result = pipeline::run(&mesh, &options, &Silent)?;
        let from_above = Camera::new(0.0, std::f64::consts::FRAC_PI_2, 0.0)?;
        return Ok([
            (segments_scene(&result)?, standing),
            (components_scene(result.model()), standing),
            (staged_scene(&result, 1.0), from_above),
        ]);
    }
    let sketches = Project::parse(&String::from_utf8(bytes)?)?.sketches()?;
    let result = pipeline::run_drawn(&sketches, None, &options, &Silent)?;
    Ok([0.0, 0.5, 1.0].map(|progress| (staged_scene(&result, progress), standing)))
}
