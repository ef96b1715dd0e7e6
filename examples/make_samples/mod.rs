//! The sample meshes: blended implicit surfaces, a lathe and a box.

mod block;
mod figures;
mod implicit;
mod lathe;
mod mesh;
mod surface_nets;
mod wares;

use mesh::Mesh;

/// Edges of the sample teddy.
const TEDDY_CELL_MM: f64 = 4.5;

/// One sample.
pub struct Sample {
    /// File name without its extension.
    pub name: &'static str,
    /// The Wavefront OBJ file: millimetres, y up, the front looks along +z.
    pub obj: String,
}

/// All samples, in alphabetical order.
pub fn all() -> Vec<Sample> {
    [
        ("bottle", wares::bottle()),
        ("box", wares::plain_box()),
        ("rabbit", figures::rabbit()),
        ("snowman", figures::snowman()),
        ("teapot", wares::teapot()),
        ("teddy", figures::teddy(TEDDY_CELL_MM)),
    ]
    .into_iter()
    .map(|(name, mesh)| Sample { name, obj: mesh.to_obj(name) })
    .collect()
}

/// The sample teddy with about so many faces, whose number grows as the square of the edges shrinks.
pub fn teddy_of(faces: f64) -> Mesh {
    let usual = figures::teddy(TEDDY_CELL_MM).faces.len() as f64;
    figures::teddy(TEDDY_CELL_MM * (usual / faces).sqrt())
}
