//! How far the surface of the mesh is from its components.

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use tatamu::component::Solid;
use tatamu::component::distance::Polytope;
use tatamu::drawing::Rgb;
use tatamu::pipeline::Shaped;
use tatamu::render::light;

/// Signed distances of the mesh's faces, at their middles.
#[derive(Debug, Clone, PartialEq)]
pub struct Distances {
    /// By face, mm: more than 0 where the surface sticks out of its component; none where the face
    /// belongs to no component.
    pub of_face_mm: Vec<Option<f32>>,
    /// The farthest.
    pub most_mm: f32,
}

const LEVEL: Rgb = Rgb(240, 240, 236);
const OUTSIDE: Rgb = Rgb(200, 60, 40);
const INSIDE: Rgb = Rgb(50, 90, 190);

impl Distances {
    /// The colour of a face: red where the surface sticks out, blue where the component does.
    pub fn colour(&self, face: usize) -> Rgb {
        let mm = self.of_face_mm.get(face).copied().flatten().unwrap_or(0.0);
        let share = f64::from(mm.abs() / self.most_mm.max(1e-6));
        light::mixed(LEVEL, if mm > 0.0 { OUTSIDE } else { INSIDE }, share.sqrt())
    }
}

/// Measures the distances.
pub fn distances(shaped: &Shaped) -> Distances {
    let source = shaped.source();
    let solids: Vec<(Option<Polytope>, DAffine3)> = shaped
        .model()
        .parts()
        .iter()
        .map(|p| (p.component.solid().map(Solid::polytope), p.frame.inverse()))
        .collect();
    let of_face_mm: Vec<Option<f32>> = source
        .face_parts()
        .par_iter()
        .enumerate()
        .map(|(face, part)| {
            let (solid, to_local) = &solids[(*part)? as usize];
            let middle = to_local.transform_point3(source.mesh().corners(face).iter().sum::<DVec3>() / 3.0);
            let position = solid.as_ref()?.position(middle);
            Some(position.nearest.map_or(position.signed_mm, |(point, _)| point.distance(middle)) as f32)
        })
        .collect();
    let most_mm = of_face_mm.iter().flatten().fold(0.0f32, |most, mm| most.max(mm.abs()));
    Distances { of_face_mm, most_mm }
}
