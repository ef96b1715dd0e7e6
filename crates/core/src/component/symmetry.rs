//! Components that are their own mirror image.
//!
//! The fit sees a target moved so that its mirror plane is y = 0 or z = 0: there the image of a
//! chain or of a plane is a change of signs, which is exact.

use super::angles::turn;
use super::solid::Solid;
use glam::DVec2;
use std::f64::consts::PI;

/// The mirror plane of a component, in its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Symmetry {
    /// A vertical plane, in which the fold axis lies: { n·xy = offset }.
    Upright {
        /// Direction of its normal n.
        angle_rad: f64,
        /// Its distance from the origin, along n.
        offset_mm: f64,
    },
    /// A horizontal plane: the bottom is the image of the top, and all chains fold in it.
    Level {
        /// Its height.
        height_mm: f64,
    },
}

impl Symmetry {
    /// Whether the mirror plane is horizontal.
    pub(super) fn is_level(self) -> bool {
        matches!(self, Symmetry::Level { .. })
    }

    /// Whether the mirror plane is vertical.
    pub(super) fn is_upright(self) -> bool {
        !self.is_level()
    }

    /// The direction of a horizontal normal's image.
    pub(super) fn image(self, normal: DVec2) -> DVec2 {
        match self {
            Symmetry::Upright { angle_rad, .. } => {
                let across = DVec2::from_angle(angle_rad);
                normal - 2.0 * across.dot(normal) * across
            }
            Symmetry::Level { .. } => normal,
        }
    }
}

/// The same direction in (−π, π].
pub(super) fn wrapped(angle_rad: f64) -> f64 {
    if angle_rad > -PI && angle_rad <= PI { angle_rad } else { turn(angle_rad, 0.0) }
}

/// The direction itself, or the one in the upright plane that it comes so near to that its image
/// would be nearer to it than `least_rad`.
pub(super) fn settled(angle_rad: f64, symmetry: Option<Symmetry>, least_rad: f64) -> f64 {
    match symmetry {
        Some(Symmetry::Upright { .. }) if turn(angle_rad, -angle_rad).abs() < least_rad => {
            if libm::cos(angle_rad) > 0.0 { 0.0 } else { PI }
        }
        _ => angle_rad,
    }
}

/// The chain that is the image of chain j of a straight solid: itself, but for an upright plane.
pub(super) fn twin(solid: &Solid, symmetry: Option<Symmetry>, j: usize) -> usize {
    if !symmetry.is_some_and(Symmetry::is_upright) {
        return j;
    }
    let away = |k: usize| turn(solid.chains[k].angle_rad, -solid.chains[j].angle_rad).abs();
    (0..solid.chains.len()).min_by(|&a, &b| away(a).total_cmp(&away(b))).unwrap_or(j)
}

/// A straight solid whose chains are nearly images of one another, made exactly so: of two the
/// first counts. Chains are taken as they are where the plane is level, which ends are not.
pub(super) fn evened(mut solid: Solid, symmetry: Option<Symmetry>) -> Solid {
    match symmetry {
        Some(Symmetry::Upright { .. }) => {
            for j in 0..solid.chains.len() {
                let k = twin(&solid, symmetry, j);
                let own = &mut solid.chains[j];
                if k == j {
                    own.angle_rad = if libm::cos(own.angle_rad) > 0.0 { 0.0 } else { PI };
                } else if k > j {
                    own.angle_rad = wrapped(own.angle_rad);
                    let (angle_rad, facets) = (-own.angle_rad, own.facets.clone());
                    solid.chains[k].angle_rad = angle_rad;
                    solid.chains[k].facets = facets;
                }
            }
        }
        Some(Symmetry::Level { .. }) => {
            let half = (solid.top_mm - solid.bottom_mm) / 2.0;
            (solid.top_mm, solid.bottom_mm) = (half, -half);
        }
        None => {}
    }
    solid
}
