//! Draws the parts of a mesh, its paper model and the model when folded flat side by side:
//! `cargo run --release --example picture -- samples/teddy.obj teddy.png`.

use glam::{DAffine2, DVec2, DVec3};
use std::error::Error;
use tatamu::drawing::{Drawing, Rgb};
use tatamu::export::png;
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{self, Options};
use tatamu::progress::Silent;
use tatamu::render::{Camera, View};
use tatamu::show::{components_scene, framed, segments_scene, staged_scene};

/// One picture of the three, about 380 pixels wide and high.
const SIZE_MM: DVec2 = DVec2::splat(110.0);
const MARGIN_MM: f64 = 5.0;
const DOTS_PER_INCH: f64 = 88.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        return Err("give a mesh and the name of the PNG file to write".into());
    };
    let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(input)?)?)?;
    let result = pipeline::run(&mesh, &Options::default(), &Silent)?;
    let standing = Camera::new(0.5, 0.25, 0.3)?;
    let from_above = Camera::new(0.0, std::f64::consts::FRAC_PI_2, 0.0)?;
    let pictures = [
        (segments_scene(&result)?, standing),
        (components_scene(result.model()), standing),
        (staged_scene(&result, 1.0), from_above),
    ];
    let mut drawing = Drawing::new("", SIZE_MM * DVec2::new(pictures.len() as f64, 1.0));
    drawing.ground = Some(Rgb::WHITE);
    for (k, (scene, camera)) in pictures.into_iter().enumerate() {
        let points: Vec<DVec3> = scene.points().collect();
        let view = View::fit(camera, points, SIZE_MM, MARGIN_MM)?;
        let marks = framed(&scene, &view, Some(Rgb::WHITE)).marks;
        drawing.place(marks, DAffine2::from_translation(DVec2::X * (SIZE_MM.x * k as f64)));
    }
    std::fs::write(output, png::render(&drawing, DOTS_PER_INCH)?)?;
    Ok(())
}
