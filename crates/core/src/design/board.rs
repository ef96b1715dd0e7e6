//! A board in space.

use glam::DVec3;

/// The corners of a board: its inner face, then its outer one, in the component's axes deployed.
pub fn board(outline: &[DVec3], outward: DVec3, thickness_mm: f64) -> Vec<DVec3> {
    let outer = outline.iter().map(|&p| p + outward * thickness_mm);
    outline.iter().copied().chain(outer).collect()
}
