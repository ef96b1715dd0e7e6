//! A triangle mesh and its OBJ text.

use std::fmt::Write;

use glam::DVec3;

/// Corners and counter-clockwise triangles (seen from outside).
pub struct Mesh {
    /// Corners, mm.
    pub vertices: Vec<DVec3>,
    /// Indices of corners.
    pub faces: Vec<[usize; 3]>,
}

impl Mesh {
    /// The mesh standing on the ground y = 0, as OBJ, to a hundredth of a millimetre.
    pub fn to_obj(&self, name: &str) -> String {
        let ground = self.vertices.iter().map(|v| v.y).fold(f64::MAX, f64::min);
        let mut text = format!(
            "# {name}: made by examples/make_samples.rs of tatamu; do not edit\n# millimetres, y up\no {name}\n"
        );
        for v in &self.vertices {
            let (x, y, z) = (short(v.x), short(v.y - ground), short(v.z));
            writeln!(text, "v {x} {y} {z}").expect("a String takes every write");
        }
        for [a, b, c] in &self.faces {
            writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).expect("a String takes every write");
        }
        text
    }
}

/// A number with at most two decimals; never "-0".
fn short(value: f64) -> f64 {
    (value * 100.0).round() / 100.0 + 0.0
}
