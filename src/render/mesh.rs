//! A triangle mesh as a scene.

use super::proxy::Proxy;
use super::scene::{Edge, Face, Scene, SceneError};
use crate::drawing::Rgb;
use glam::DVec3;
use std::collections::BTreeMap;

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
        let normals = normals(vertices, triangles);
        let owner_of_edge = owners(triangles);
        let edge = |t: usize, k: usize| match owner_of_edge.get(&reversed(triangles[t], k)) {
            None => Edge::Border,
            Some(&other) if colour_of(other) == colour_of(t) => Edge::Smooth(normals[other]),
            Some(&other) => Edge::Crease(normals[other]),
        };
        for (t, triangle) in triangles.iter().enumerate() {
            self.push_triangle(vertices, *triangle, |k| edge(t, k), colour_of(t), back)?;
        }
        Ok(())
    }

    /// Adds what stands for a mesh, `colour_of(k)` being the colour of the mesh's triangle `k`. Where
    /// that is the mesh itself, as [`Scene::push_mesh`] does; else the surface is dented and has small
    /// holes, so that only lines where the colour changes are drawn, and the inside looks like the
    /// outside.
    ///
    /// # Errors
    /// [`SceneError::NotFinite`] where a vertex is not finite.
    pub fn push_proxy(
        &mut self,
        proxy: &Proxy,
        colour_of: impl Fn(usize) -> Rgb,
        back: Option<Rgb>,
    ) -> Result<(), SceneError> {
        let (vertices, triangles) = (&proxy.vertices, &proxy.triangles);
        let colour_of = |t: usize| colour_of(proxy.origin[t] as usize);
        if proxy.is_whole {
            return self.push_mesh(vertices, triangles, colour_of, back);
        }
        let normals = normals(vertices, triangles);
        let owner_of_edge = owners(triangles);
        // A neighbour that faces the same way makes no silhouette.
        let edge = |t: usize, k: usize| match owner_of_edge.get(&reversed(triangles[t], k)) {
            Some(&other) if colour_of(other) != colour_of(t) => Edge::Crease(normals[t]),
            _ => Edge::Smooth(normals[t]),
        };
        for (t, triangle) in triangles.iter().enumerate() {
            let colour = colour_of(t);
            self.push_triangle(vertices, *triangle, |k| edge(t, k), colour, Some(colour))?;
        }
        Ok(())
    }

    /// Adds a triangle, unless it has no area.
    fn push_triangle(
        &mut self,
        vertices: &[DVec3],
        triangle: [u32; 3],
        edge: impl Fn(usize) -> Edge,
        front: Rgb,
        back: Option<Rgb>,
    ) -> Result<(), SceneError> {
        let corners = triangle.map(|v| vertices[v as usize]).to_vec();
        match Face::new(corners, (0..3).map(edge).collect(), front, back) {
            Ok(face) => self.push(face),
            Err(SceneError::NoArea) => {}
            Err(error) => return Err(error),
        }
        Ok(())
    }
}

fn normals(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let corners = triangles.iter().map(|t| t.map(|v| vertices[v as usize]));
    corners.map(|[a, b, c]| (b - a).cross(c - a).normalize_or_zero()).collect()
}

/// The triangle of each directed edge.
fn owners(triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], usize> {
    let edges = triangles.iter().enumerate();
    edges.flat_map(|(t, corners)| (0..3).map(move |k| ([corners[k], corners[(k + 1) % 3]], t))).collect()
}

/// Edge k as the neighbour across has it.
fn reversed(triangle: [u32; 3], k: usize) -> [u32; 2] {
    [triangle[(k + 1) % 3], triangle[k]]
}
