//! Turns an outline about the y axis.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::mesh::Mesh;

/// The solid of an outline of (radius, height) points, which runs from the axis at the bottom to
/// the axis at the top; every point between lies off the axis. Neighbouring rings are turned by
/// half a step against each other, which makes the triangles almost equilateral.
pub fn turn(outline: &[DVec2], steps: usize) -> Mesh {
    let (inner, rings) = (&outline[1..outline.len() - 1], outline.len() - 2);
    let mut vertices = vec![DVec3::new(0.0, outline[0].y, 0.0)];
    for (ring, point) in inner.iter().enumerate() {
        for step in 0..steps {
            let turn = (step as f64 + 0.5 * (ring % 2) as f64) / steps as f64 * TAU;
            vertices.push(DVec3::new(point.x * turn.sin(), point.y, point.x * turn.cos()));
        }
    }
    let top = vertices.len();
    vertices.push(DVec3::new(0.0, outline[rings + 1].y, 0.0));
    let at = |ring: usize, step: usize| 1 + ring * steps + step % steps;
    let mut faces = Vec::new();
    for step in 0..steps {
        faces.push([0, at(0, step + 1), at(0, step)]);
        for ring in 0..rings - 1 {
            let (a, b) = (at(ring, step), at(ring, step + 1));
            let (c, d) = (at(ring + 1, step), at(ring + 1, step + 1));
            if ring % 2 == 0 {
                faces.extend([[a, b, c], [b, d, c]]);
            } else {
                faces.extend([[a, b, d], [a, d, c]]);
            }
        }
        faces.push([at(rings - 1, step), at(rings - 1, step + 1), top]);
    }
    Mesh { vertices, faces }
}

/// Points along a polyline at equal distances of about `spacing`; its corners are kept.
pub fn resampled(corners: &[DVec2], spacing: f64) -> Vec<DVec2> {
    let mut points = vec![corners[0]];
    for pair in corners.windows(2) {
        let count = (pair[0].distance(pair[1]) / spacing).round().max(1.0);
        points.extend((1..=count as usize).map(|k| pair[0].lerp(pair[1], k as f64 / count)));
    }
    points
}
