//! The mesh at the size of the model, standing on the ground.

use super::Mesh;
use glam::{DAffine3, DMat3, DVec3};

/// The axis of a file that points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Up {
    /// +x
    X,
    /// +y, as in glTF
    Y,
    /// +z
    Z,
    /// −x
    DownX,
    /// −y
    DownY,
    /// −z
    DownZ,
}

impl Up {
    /// The rotation that turns this axis to +z. It turns +z to −y for [`Up::Y`], so that what
    /// faces the viewer in a y-up program faces the viewer in a z-up one.
    fn turn(self) -> DMat3 {
        match self {
            Self::X => DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y),
            Self::Y => DMat3::from_cols(DVec3::X, DVec3::Z, -DVec3::Y),
            Self::Z => DMat3::IDENTITY,
            Self::DownX => Self::over() * Self::X.turn(),
            Self::DownY => Self::over() * Self::Y.turn(),
            Self::DownZ => Self::over(),
        }
    }

    /// Half a turn about the axis that faces the viewer, which keeps facing it: upside down.
    fn over() -> DMat3 {
        DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0))
    }
}

impl Mesh {
    /// The mesh turned so that `up` becomes +z, scaled so that the longest side of its bounding
    /// box measures `size_mm`, and moved so that the box stands centred on the origin at z = 0;
    /// together with the transform from the old coordinates to the new.
    ///
    /// `size_mm` must be positive and finite.
    pub fn scaled(&self, size_mm: f64, up: Up) -> (Self, DAffine3) {
        let (low, high) = self.bounds;
        let turn = up.turn();
        let linear = turn * (size_mm / (high - low).max_element());
        let (p, q) = (linear * low, linear * high);
        let centre = p.midpoint(q);
        let foot = DVec3::new(centre.x, centre.y, p.z.min(q.z));
        let transform = DAffine3::from_mat3_translation(linear, -foot);
        (self.with_positions(|p| transform.transform_point3(p)), transform)
    }

    /// The mesh with all lengths times `factor`, about the origin.
    #[must_use]
    pub fn resized(&self, factor: f64) -> Self {
        self.with_positions(|p| factor * p)
    }

    fn with_positions(&self, to: impl Fn(DVec3) -> DVec3) -> Self {
        let positions = self.positions.iter().map(|&p| to(p)).collect();
        Self::of_parts(positions, self.faces.clone(), self.input_face.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Soup;

    fn box_mesh() -> Mesh {
        let corner =
            |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1) * 2.0, f64::from(k >> 2) * 4.0);
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let soup = Soup::new((0..8).map(corner).collect(), sides).unwrap();
        Mesh::from_soup(&soup).unwrap().0
    }

    #[test]
    fn the_chosen_axis_becomes_the_height() {
        let heights = [(Up::X, 25.0), (Up::Y, 50.0), (Up::Z, 100.0)];
        let down = [(Up::DownX, 25.0), (Up::DownY, 50.0), (Up::DownZ, 100.0)];
        for (up, height) in heights.into_iter().chain(down) {
            let mesh = box_mesh();
            let (scaled, transform) = mesh.scaled(100.0, up);
            let (low, high) = scaled.bounds();
            assert!((high.z - height).abs() < 1e-12 && low.z.abs() < 1e-12);
            assert!((low + high).truncate().length() < 1e-12);
            assert!(((high - low).max_element() - 100.0).abs() < 1e-12);
            assert!((scaled.volume() - 8.0 * 25.0f64.powi(3)).abs() < 1e-6, "a mirror");
            for (p, q) in mesh.positions().iter().zip(scaled.positions()) {
                assert_eq!(transform.transform_point3(*p), *q);
            }
        }
    }

    #[test]
    fn an_axis_that_points_down_turns_the_model_upside_down_and_keeps_its_front() {
        for (up, down) in [(Up::X, Up::DownX), (Up::Y, Up::DownY), (Up::Z, Up::DownZ)] {
            let [stands, hangs] = [up, down].map(Up::turn);
            for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
                let (a, b) = (stands * axis, hangs * axis);
                assert_eq!((a.z, a.y), (-b.z, b.y), "{up:?} {axis}");
            }
        }
    }
}
