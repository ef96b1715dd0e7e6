//! Where two parts touch.

use super::PartId;
use glam::DVec3;

/// How two parts touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Interface {
    /// Along a border on one surface.
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
