//! Colours of PLY files: properties `red`, `green` and `blue` of vertices and of faces.

use super::super::{ColourError, fan};
use super::elements::Colour;
use super::{Elements, narrow, read_all};
use crate::painting::{Paint, Painting, light_of};
use glam::DVec3;

/// The colours of a file; none where it has none.
pub(in super::super) fn read_painting(bytes: &[u8]) -> Result<Option<Painting>, ColourError> {
    let Elements { vertices, faces } = read_all(bytes)?;
    let is_painted =
        vertices.iter().any(|v| v.colour.is_given()) || faces.iter().any(|f| f.colour.is_given());
    let light = |colour: &Colour| colour.srgb().map(light_of);
    let mut triangles = Vec::new();
    for (k, face) in faces.iter().enumerate() {
        let polygon = narrow(k, &face.corners, vertices.len())?;
        for triangle in fan(polygon.len()) {
            let of = triangle.map(|k| &vertices[polygon[k] as usize]);
            let own = light(&face.colour);
            let lights = of.map(|v| own.or(light(&v.colour)).unwrap_or(DVec3::ONE));
            triangles.push((of.map(|v| DVec3::from_array(v.position)), Paint::Corners(lights)));
        }
    }
    Ok(if is_painted { Painting::new(triangles, Vec::new()) } else { None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu_core::colour::Rgb;

    #[test]
    fn bytes_and_floats() {
        for (kind, red) in [("uchar", "255 0 51"), ("float", "1.0 0.0 0.2")] {
            let text = format!(
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                 property {kind} red\nproperty {kind} green\nproperty {kind} blue\nelement face 1\n\
                 property list uchar int vertex_indices\nend_header\n0 0 0 {red}\n1 0 0 {red}\n0 1 0 {red}\n3 0 1 2\n"
            );
            let painting = read_painting(text.as_bytes()).unwrap().expect("colours");
            assert_eq!(painting.colour(0, DVec3::X), Rgb(255, 0, 51), "{kind}");
        }
    }
}
