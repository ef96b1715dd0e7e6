//! Draws a mesh, its paper model and the model when folded flat side by side:
//! `cargo run --release --example picture -- samples/teddy.obj teddy.png`.

use glam::{DAffine2, DAffine3, DMat3, DVec2, DVec3};
use std::error::Error;
use tatamu::component::{Panel, PanelSet};
use tatamu::drawing::{Drawing, Rgb};
use tatamu::export::png;
use tatamu::mesh::{self, Mesh};
use tatamu::model::Model;
use tatamu::pipeline::{self, Options, Output};
use tatamu::progress::Silent;
use tatamu::render::{Camera, Edge, Face, Look, Scene, View, contact_shadow, palette, picture};

/// One picture of the three, about 380 pixels wide and high.
const SIZE_MM: DVec2 = DVec2::splat(110.0);
const MARGIN_MM: f64 = 5.0;
const DOTS_PER_INCH: f64 = 88.0;
const WITHOUT_COMPONENT: Rgb = Rgb(200, 200, 200);
/// Height of a folded component in the flat picture: enough to tell what lies on what.
const FLAT_HEIGHT_MM: f64 = 0.02;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else {
        return Err("give a mesh and the name of the PNG file to write".into());
    };
    let (mesh, _) = Mesh::from_soup(&mesh::read(&std::fs::read(input)?)?)?;
    let result = pipeline::run(&mesh, &Options::default(), &Silent)?;
    let standing = Camera::new(0.5, 0.25, 0.3)?;
    let from_above = Camera::new(0.0, 0.0, 0.0)?;
    let pictures = [
        (mesh_scene(&result)?, standing, true),
        (deployed_scene(result.model()), standing, true),
        (flat_scene(result.model()), from_above, false),
    ];
    let mut drawing = Drawing::new("", SIZE_MM * DVec2::new(pictures.len() as f64, 1.0));
    drawing.ground = Some(Rgb::WHITE);
    for (k, (scene, camera, has_shadow)) in pictures.into_iter().enumerate() {
        let view = View::fit(camera, scene.points(), SIZE_MM, MARGIN_MM)?;
        let points: Vec<DVec3> = scene.points().filter(|_| has_shadow).collect();
        let shadow = contact_shadow(&points, &view, Rgb::WHITE);
        let marks = picture(&scene, &view, &Look::for_size(SIZE_MM), None, shadow).marks;
        drawing.place(marks, DAffine2::from_translation(DVec2::X * (SIZE_MM.x * k as f64)));
    }
    std::fs::write(output, png::render(&drawing, DOTS_PER_INCH)?)?;
    Ok(())
}

/// From the model's axes, z up, to those of pictures, y up.
fn upright() -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y))
}

fn mesh_scene(result: &Output) -> Result<Scene, Box<dyn Error>> {
    let positions = result.mesh().positions().iter();
    let vertices: Vec<DVec3> = positions.map(|p| upright().transform_point3(*p)).collect();
    let colour_of = |face: usize| {
        result.face_parts()[face].map_or(WITHOUT_COMPONENT, |part| palette::colour(part as usize))
    };
    let mut scene = Scene::new();
    scene.push_mesh(&vertices, result.mesh().faces(), colour_of, None)?;
    Ok(scene)
}

fn deployed_scene(model: &Model) -> Scene {
    let mut scene = Scene::new();
    for (index, part) in model.parts().iter().enumerate() {
        let motion = upright() * part.deployed();
        push_panels(&mut scene, part.component.panels(), |panel| motion * panel.deployed, index);
    }
    scene
}

/// Each tree of joints in its root's axes, seen against the root's top panel.
fn flat_scene(model: &Model) -> Scene {
    let parts = model.parts();
    let mut scene = Scene::new();
    for (index, part) in parts.iter().enumerate() {
        let mut height_mm = 0.0;
        let mut root = index;
        while let Some(joint) = &parts[root].joint {
            let parent = &parts[joint.parent];
            let carrier = parent.flat * parent.component.panels().panel(joint.parent_panel).flat;
            let side = carrier.matrix3.z_axis.dot(up_axis(model, root)).signum();
            height_mm += side * FLAT_HEIGHT_MM * (1.0 + 0.1 * root as f64);
            root = joint.parent;
        }
        let to_picture = DAffine3::from_translation(DVec3::Z * height_mm) * parts[root].flat.inverse();
        push_panels(&mut scene, part.component.panels(), |panel| to_picture * part.flat * panel.flat, index);
    }
    scene
}

/// Direction of the fold axis of a part's root when all is flat.
fn up_axis(model: &Model, part: usize) -> DVec3 {
    let parts = model.parts();
    let mut root = part;
    while let Some(joint) = &parts[root].joint {
        root = joint.parent;
    }
    parts[root].flat.matrix3.z_axis
}

/// Adds the panels of a component; those too thin to be seen are left out.
fn push_panels(scene: &mut Scene, set: &PanelSet, motion: impl Fn(&Panel) -> DAffine3, index: usize) {
    let colour = palette::colour(index);
    for (id, panel) in set.panels().iter().enumerate() {
        let to_picture = motion(panel);
        let corners = panel.outline.iter().map(|p| to_picture.transform_point3(p.extend(0.0))).collect();
        let mut edges = vec![Edge::Border; panel.outline.len()];
        for hinge in set.hinges() {
            let [a, b] = hinge.sides;
            for (here, there) in [(a, b), (b, a)] {
                if here.panel.0 == id {
                    edges[here.edge] = Edge::Crease(motion(set.panel(there.panel)).matrix3.z_axis);
                }
            }
        }
        if let Ok(face) = Face::new(corners, edges, colour, Some(colour)) {
            scene.push(face);
        }
    }
}
