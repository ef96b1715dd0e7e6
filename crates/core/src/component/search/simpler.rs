//! Hulls with fewer corners, which take less time to fit.

use super::super::symmetry::{Crossing, Symmetry, Turning};
use super::super::target::Target;
use super::schedule::{FIT_DIRECTIONS, ROUGH_DIRECTIONS};
use crate::geom::{self, Hull};
use glam::DVec3;
use std::sync::OnceLock;

/// A hull with few corners, and one with more that is made when it is needed.
pub(super) struct Simpler<'h> {
    hull: &'h Hull,
    symmetry: Option<Symmetry>,
    pub(super) rough: Hull,
    fine: OnceLock<Hull>,
}

impl<'h> Simpler<'h> {
    pub(super) fn of(target: &Target<'h>) -> Self {
        let (hull, symmetry) = (target.hull, target.symmetry);
        Self { hull, symmetry, rough: simplified(hull, symmetry, ROUGH_DIRECTIONS), fine: OnceLock::new() }
    }

    pub(super) fn fine(&self) -> &Hull {
        self.fine.get_or_init(|| simplified(self.hull, self.symmetry, FIT_DIRECTIONS))
    }
}

/// Hull of the extreme points in evenly spread directions, and their images in straight planes.
fn simplified(hull: &Hull, symmetry: Option<Symmetry>, directions: usize) -> Hull {
    if hull.vertices().len() <= directions {
        return hull.clone();
    }
    let across: &[DVec3] = match symmetry {
        None => &[],
        Some(Symmetry::Level { .. }) => &[DVec3::Z],
        Some(Symmetry::Upright { crossing: None, .. }) => &[DVec3::Y],
        Some(Symmetry::Upright { crossing: Some(Crossing { turning: Turning::Half, .. }), .. }) => {
            &[DVec3::Y, DVec3::X]
        }
        // The hull is round more or less, not its own image.
        Some(Symmetry::Upright { .. }) => &[],
    };
    let one_side = geom::directions(directions).filter(|d| across.iter().all(|n| n.dot(*d) >= 0.0));
    let mut points: Vec<DVec3> = one_side.map(|d| hull.farthest(d)).collect();
    for &n in across {
        points.extend(points.clone().into_iter().map(|p| p - n * (2.0 * n.dot(p))));
    }
    Hull::of_points(&points).unwrap_or_else(|_| hull.clone())
}
