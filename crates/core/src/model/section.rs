//! Sections of hulls by planes, and what two of them share.

use crate::geom::{Hull, Plane, polygon};
use glam::{DVec2, DVec3};

/// What the sections of two hulls share, in the plane's [`Plane::basis`]; empty where that is nothing.
pub(super) fn shared_section(plane: &Plane, first: &Hull, second: &Hull) -> Vec<DVec2> {
    common_outline(&flat_section(plane, first), &flat_section(plane, second))
}

/// What two convex polygons share; either may be nothing.
pub(super) fn common_outline(first: &[DVec2], second: &[DVec2]) -> Vec<DVec2> {
    let is_nothing = first.is_empty() || second.is_empty();
    if is_nothing { Vec::new() } else { polygon::intersect_convex(first, second) }
}

/// The section of a hull; empty where it has no area.
pub(super) fn outline(plane: &Plane, hull: &Hull) -> Vec<DVec3> {
    Some(hull.section(plane)).filter(|section| section.len() >= 3).unwrap_or_default()
}

/// The section of a hull, in the plane's [`Plane::basis`], counter-clockwise; empty where it has no area.
pub(super) fn flat_section(plane: &Plane, hull: &Hull) -> Vec<DVec2> {
    flattened(plane, outline(plane, hull))
}

/// A convex polygon in the plane's [`Plane::basis`], counter-clockwise.
pub(super) fn flattened(plane: &Plane, outline: impl IntoIterator<Item = DVec3>) -> Vec<DVec2> {
    let mut flat: Vec<DVec2> = outline.into_iter().map(|p| plane.flat(p)).collect();
    if polygon::area(&flat) < 0.0 {
        flat.reverse();
    }
    flat
}
