//! Meshes and their models side by side, as a person compares them: the mesh and the model from the
//! front, then both from a corner, a row for each mesh.
//! `cargo run --release --example contact_sheet -- samples/*.obj sheet.png`.

#[path = "input/pictures.rs"]
mod pictures;

use glam::{DAffine2, DVec2, DVec3};
use pictures::inputs_and_picture;
use std::borrow::Cow;
use std::error::Error;
use tatamu::drawing::{Drawing, Rgb};
use tatamu::export::png;
use tatamu::mesh::{self, Mesh};
use tatamu::pipeline::{Engine, Options};
use tatamu::progress::Silent;
use tatamu::render::{Camera, Scene, View};
use tatamu::show::{components_scene, framed, mesh_scene};

/// One picture, about 280 pixels wide and high.
const SIZE_MM: DVec2 = DVec2::splat(80.0);
const MARGIN_MM: f64 = 3.0;
const DOTS_PER_INCH: f64 = 88.0;
/// Meshes in a row, with four pictures each.
const ROW: usize = 2;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((inputs, output)) = inputs_and_picture(&arguments) else {
        return Err("give meshes, and the name of the PNG file to write".into());
    };
    let cells = DVec2::new(4.0 * inputs.len().min(ROW) as f64, inputs.len().div_ceil(ROW) as f64);
    let mut drawing = Drawing::new("", SIZE_MM * cells);
    drawing.ground = Some(Rgb::WHITE);
    for (place, input) in inputs.iter().enumerate() {
        let [mesh, model] = match scenes(input) {
            Ok(scenes) => scenes,
            Err(error) => {
                eprintln!("{input}: {error}");
                continue;
            }
        };
        let (front, corner) = (Camera::new(0.0, 0.0, 0.0)?, Camera::new(0.6, 0.3, 0.0)?);
        let pictures = [(&mesh, front), (&model, front), (&mesh, corner), (&model, corner)];
        for (k, (scene, camera)) in pictures.into_iter().enumerate() {
            // Both in one frame, so that they are seen at one scale.
            let points: Vec<DVec3> = mesh.points().chain(model.points()).collect();
            let view = View::fit(camera, points, SIZE_MM, MARGIN_MM)?;
            let marks = framed(scene, &view, Some(Rgb::WHITE)).marks;
            let (column, row) = (4 * (place % ROW) + k, place / ROW);
            let cell = DVec2::new(column as f64, cells.y - 1.0 - row as f64);
            drawing.place(marks, DAffine2::from_translation(SIZE_MM * cell));
        }
    }
    std::fs::write(output, png::render(&drawing, DOTS_PER_INCH)?)?;
    Ok(())
}

/// The mesh at the size of the model, and the model.
fn scenes(input: &str) -> Result<[Scene; 2], Box<dyn Error>> {
    let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(input)?)?)?;
    let shaped = Engine::new(Cow::Owned(mesh)).shape(&Options::default(), &Silent)?;
    Ok([mesh_scene(shaped.source().mesh())?, components_scene(shaped.model())])
}
