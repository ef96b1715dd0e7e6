//! Where two parts touch.

use super::PartId;
use glam::DVec3;

/// How two parts touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Interface {
    /// Along a border on one surface.
    #[default]
    Border,
    /// As two bodies that are near each other: the points are samples.
    Bodies,
}

/// A place where two parts touch: candidate for a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The two parts, smaller id first.
    pub parts: (PartId, PartId),
    /// Where they do: vertices of their border, or points between two bodies.
    pub points: Vec<DVec3>,
    /// How they do.
    pub interface: Interface,
    /// Length of the border, mm: larger interfaces make better joints.
    pub length_mm: f64,
}

#[cfg(test)]
impl Contact {
    /// One along a border.
    pub(super) fn border([a, b]: [usize; 2], points: Vec<DVec3>, length_mm: f64) -> Self {
        Self { parts: (PartId(a), PartId(b)), points, interface: Interface::Border, length_mm }
    }
}
