//! Draws the hulls of a mesh's parts and the components made of them side by side:
//! `cargo run --release --example hulls -- samples/teddy.obj hulls.png`.

use glam::{DAffine2, DAffine3, DMat3, DVec2, DVec3};
use std::error::Error;
use tatamu::drawing::{Drawing, Rgb};
use tatamu::export::png;
use tatamu::mesh::{self, Mesh};
use tatamu::model::{self, Model, Part};
use tatamu::pipeline::{self, Bodies, Options};
use tatamu::progress::Silent;
use tatamu::render::{Camera, Edge, Face, Look, Scene, View, palette, picture};

const SIZE_MM: DVec2 = DVec2::splat(140.0);
const MARGIN_MM: f64 = 5.0;
const DOTS_PER_INCH: f64 = 88.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        return Err("give a mesh and the name of the PNG file to write".into());
    };
    let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(input)?)?)?;
    let options = Options::default();
    let (divided, _) = pipeline::find_parts(&mesh, &options, &Silent)?;
    let bodies = Bodies::new(&divided, &options)?;
    let model = model::build(bodies.parts(), bodies.links(), options.min_panel_width_mm, &Silent)?;
    let camera = Camera::new(0.5, 0.25, 0.3)?;
    let scenes = [hulls(bodies.parts()), components(&model)];
    let mut drawing = Drawing::new("", SIZE_MM * DVec2::new(scenes.len() as f64, 1.0));
    drawing.ground = Some(Rgb::WHITE);
    for (k, scene) in scenes.iter().enumerate() {
        let view = View::fit(camera, scene.points(), SIZE_MM, MARGIN_MM)?;
        let marks = picture(scene, &view, &Look::for_size(SIZE_MM), None, Vec::new()).marks;
        drawing.place(marks, DAffine2::from_translation(DVec2::X * (SIZE_MM.x * k as f64)));
    }
    std::fs::write(output, png::render(&drawing, DOTS_PER_INCH)?)?;
    Ok(())
}

/// From the model's axes, z up, to those of pictures, y up.
fn upright() -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y))
}

fn hulls(parts: &[Part]) -> Scene {
    let mut scene = Scene::new();
    for (index, part) in parts.iter().enumerate() {
        for facet in part.hull.facets() {
            push(&mut scene, part.hull.facet_points(facet), index);
        }
    }
    scene
}

fn components(model: &Model) -> Scene {
    let mut scene = Scene::new();
    for (index, part) in model.parts().iter().enumerate() {
        for panel in part.component.panels().panels() {
            let motion = part.deployed() * panel.deployed;
            push(&mut scene, panel.outline.iter().map(|p| motion.transform_point3(p.extend(0.0))), index);
        }
    }
    scene
}

/// Adds a polygon; those too thin to be seen are left out.
fn push(scene: &mut Scene, corners: impl Iterator<Item = DVec3>, index: usize) {
    let corners: Vec<DVec3> = corners.map(|p| upright().transform_point3(p)).collect();
    let colour = palette::colour(index);
    let edges = vec![Edge::Border; corners.len()];
    if let Ok(face) = Face::new(corners, edges, colour, Some(colour)) {
        scene.push(face);
    }
}
