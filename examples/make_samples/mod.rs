//! The sample meshes: blended implicit surfaces, a lathe and a box.

mod block;
mod figures;
mod implicit;
mod lathe;
mod mesh;
mod surface_nets;
mod wares;

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
        ("teddy", figures::teddy()),
    ]
    .into_iter()
    .map(|(name, mesh)| Sample { name, obj: mesh.to_obj(name) })
    .collect()
}
