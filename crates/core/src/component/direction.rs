//! Fold directions: angles about the hull's first principal axis (§4.1.1).

use crate::geom::{Hull, eigen};
use glam::{DAffine3, DMat3, DVec3};

/// A fold axis is the principal axis where the sine of the angle between them is no more than this.
const ALONG: f64 = 1e-6;

/// The axes in which a hull's fold direction is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalAxis {
    axis: DVec3,
    zero: DVec3,
    centre: DVec3,
}

impl PrincipalAxis {
    /// First principal axis of the hull's corners. Angle 0 is the direction perpendicular to it
    /// that points up (z) as much as possible.
    pub fn of_hull(hull: &Hull) -> Self {
        let (_, vectors) = eigen::symmetric(eigen::covariance(hull.vertices()));
        let axis = vectors[2];
        let up = DVec3::Z - axis * axis.z;
        let zero = if up.length() > 1e-3 { up.normalize() } else { axis.cross(DVec3::Y).normalize() };
        Self { axis, zero, centre: hull.centroid() }
    }

    /// The axis about which fold directions turn.
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// The fold axis at an angle about the principal axis.
    pub fn fold_axis(&self, angle_rad: f64) -> DVec3 {
        self.zero * libm::cos(angle_rad) + self.axis.cross(self.zero) * libm::sin(angle_rad)
    }

    /// Angle of a fold axis (of its part perpendicular to the principal axis).
    pub fn angle_rad(&self, fold_axis: DVec3) -> f64 {
        libm::atan2(fold_axis.dot(self.axis.cross(self.zero)), fold_axis.dot(self.zero))
    }

    /// Component axes for a fold axis: z along it, x along the principal axis as far as that is
    /// perpendicular (along angle 0 for the principal axis itself), origin at the hull's centre. Maps component axes to the hull's.
    pub fn frame(&self, fold_axis: DVec3) -> DAffine3 {
        let across = |direction: DVec3| direction - fold_axis * direction.dot(fold_axis);
        let along = across(self.axis);
        // What is left of an axis that is almost the fold axis is rounding, and not perpendicular.
        let x = if along.length() > ALONG { along } else { across(self.zero) }.normalize();
        DAffine3::from_mat3_translation(DMat3::from_cols(x, fold_axis.cross(x), fold_axis), self.centre)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_go_round_the_long_axis_of_a_bar() {
        let points: Vec<DVec3> = (0..8)
            .map(|k| DVec3::new((k & 1) as f64 * 10.0, (k >> 1 & 1) as f64 * 3.0, (k >> 2) as f64 * 2.0))
            .collect();
        let hull = Hull::of_points(&points).unwrap();
        let axis = PrincipalAxis::of_hull(&hull);
        assert!((axis.fold_axis(0.0) - DVec3::Z).length() < 1e-12);
        for degrees in [-170.0f64, -30.0, 45.0, 120.0] {
            let fold = axis.fold_axis(degrees.to_radians());
            assert!(fold.x.abs() < 1e-12 && (fold.length() - 1.0).abs() < 1e-12);
            assert!((axis.angle_rad(fold).to_degrees() - degrees).abs() < 1e-9);
            let frame = axis.frame(fold);
            assert!((frame.matrix3.determinant() - 1.0).abs() < 1e-12);
            assert!((frame.transform_vector3(DVec3::Z) - fold).length() < 1e-12);
        }
        // A cylinder was folded 88 mm wide of itself along an axis that was almost its own.
        for off in [0.0, 1e-16, 1e-12, 5e-8, 1e-7, 1e-5] {
            let fold = (axis.axis() + DVec3::new(0.0, off, -0.3 * off)).normalize();
            let m = axis.frame(fold).matrix3;
            let unit = m.transpose() * m - DMat3::IDENTITY;
            assert!(unit.to_cols_array().iter().all(|v| v.abs() < 1e-9), "{off}: {unit}");
            assert!((m.determinant() - 1.0).abs() < 1e-9);
        }
    }
}
