//! The sample meshes: blended implicit surfaces, a lathe and a box.

mod block;
pub mod figures;
mod implicit;
mod lathe;
pub mod mesh;
mod surface_nets;
mod wares;

/// Edges of the sample teddy.
pub const TEDDY_CELL_MM: f64 = 4.5;

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
