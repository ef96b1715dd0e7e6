//! A triangle mesh as a scene.

use std::collections::BTreeMap;

use glam::DVec3;

use super::scene::{Edge, Face, Scene, SceneError};
use crate::drawing::Rgb;

impl Scene {
    /// Adds the triangles of a mesh, `colour_of(k)` being the colour of triangle `k`; those without
    /// area are left out. Edges where the colour changes are drawn as creases, open ones as
    /// borders, the others only where they are silhouettes. `back` is the colour of the inside, if
    /// it can be seen.
    ///
    /// # Errors
    /// [`SceneError::NotFinite`] where a vertex is not finite.
    ///
    /// # Panics
    /// Where a triangle names a vertex that is not there.
    pub fn push_mesh(
        &mut self,
        vertices: &[DVec3],
        triangles: &[[u32; 3]],
        colour_of: impl Fn(usize) -> Rgb,
        back: Option<Rgb>,
    ) -> Result<(), SceneError> {
        let normals: Vec<DVec3> = triangles
            .iter()
            .map(|t| t.map(|v| vertices[v as usize]))
            .map(|[a, b, c]| (b - a).cross(c - a).normalize_or_zero())
            .collect();
        let mut owner_of_edge = BTreeMap::new();
        for (triangle, t) in triangles.iter().enumerate() {
            for k in 0..3 {
                owner_of_edge.insert([t[k], t[(k + 1) % 3]], triangle);
            }
        }
        for (triangle, t) in triangles.iter().enumerate() {
            let edge = |k: usize| match owner_of_edge.get(&[t[(k + 1) % 3], t[k]]) {
                None => Edge::Border,
                Some(&other) if colour_of(other) == colour_of(triangle) => Edge::Smooth(normals[other]),
                Some(&other) => Edge::Crease(normals[other]),
            };
            let corners = t.map(|v| vertices[v as usize]).to_vec();
            match Face::new(corners, (0..3).map(edge).collect(), colour_of(triangle), back) {
                Ok(face) => self.push(face),
                Err(SceneError::NoArea) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}
