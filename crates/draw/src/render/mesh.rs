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
    /// If a triangle names a vertex that does not exist.
    pub fn push_mesh(
        &mut self,
        vertices: &[DVec3],
        triangles: &[[u32; 3]],
        colour_of: impl Fn(usize) -> Rgb,
        back: Option<Rgb>,
    ) -> Result<(), SceneError> {
        let normals = normals(vertices, triangles);
        let edge = |t: usize, across: Option<usize>| match across {
            None => Edge::Border,
            Some(other) if colour_of(other) == colour_of(t) => Edge::Smooth(normals[other]),
            Some(other) => Edge::Crease(normals[other]),
        };
        self.push_triangles(vertices, triangles, |t| (colour_of(t), back), edge)
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
        // A neighbour that faces the same way makes no silhouette.
        let edge = |t: usize, across: Option<usize>| match across {
            Some(other) if colour_of(other) != colour_of(t) => Edge::Crease(normals[t]),
            _ => Edge::Smooth(normals[t]),
        };
        self.push_triangles(vertices, triangles, |t| (colour_of(t), Some(colour_of(t))), edge)
    }

    /// Adds triangles with the colours of their two sides and their edges, which depend on the
    /// triangle across; those without area are left out.
    fn push_triangles(
        &mut self,
        vertices: &[DVec3],
        triangles: &[[u32; 3]],
        colours: impl Fn(usize) -> (Rgb, Option<Rgb>),
        edge: impl Fn(usize, Option<usize>) -> Edge,
    ) -> Result<(), SceneError> {
        let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        let all = triangles.iter().enumerate();
        let owner: BTreeMap<[u32; 2], usize> =
            all.clone().flat_map(|(t, triangle)| sides(triangle).map(|side| (side, t))).collect();
        for (t, triangle) in all {
            let corners = triangle.map(|v| vertices[v as usize]).to_vec();
            let edges = sides(triangle).map(|[from, to]| edge(t, owner.get(&[to, from]).copied())).to_vec();
            let (front, back) = colours(t);
            match Face::new(corners, edges, front, back) {
                Ok(face) => self.push(face),
                Err(SceneError::NoArea) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }
}

fn normals(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let corners = triangles.iter().map(|t| t.map(|v| vertices[v as usize]));
    corners.map(|[a, b, c]| (b - a).cross(c - a).normalize_or_zero()).collect()
}
