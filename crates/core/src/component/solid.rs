//! A component's shape as an intersection of half-spaces whose normals lie in N vertical planes.
//!
//! Coordinates are the component's own: x and y span the top panel's plane, v (z) runs along the
//! fold axis. Every side panel is a half-space `u cos φ + v sin φ <= c` with u measured along the
//! outward normal of its top edge: the slopes φ fall from top to bottom, so every profile is
//! convex by construction (§3.3), and a joint panel is simply a half-space that is held fixed.

use super::panel::ChainId;
use glam::{DVec2, DVec3};

/// One side panel's plane: `u cos(slope) + v sin(slope) = offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideFacet {
    /// Angle of the outward normal above the horizontal.
    pub slope_rad: f64,
    /// Distance of the plane from the origin.
    pub offset_mm: f64,
    /// Whether this is a joint panel, whose plane may not move.
    pub is_joint: bool,
}

/// The normal of a side panel in this direction about the fold axis, at this slope above the horizontal.
pub(crate) fn side_normal(angle_rad: f64, slope_rad: f64) -> DVec3 {
    (DVec2::from_angle(angle_rad) * libm::cos(slope_rad)).extend(libm::sin(slope_rad))
}

/// The side planes under one top edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Direction of the edge's outward normal in the (x, y) plane.
    pub angle_rad: f64,
    /// Whether a joint panel fixes the direction.
    pub is_locked: bool,
    /// From top to bottom.
    pub facets: Vec<SideFacet>,
}

impl Chain {
    /// Outward normal in the (x, y) plane.
    pub fn normal(&self) -> DVec2 {
        DVec2::from_angle(self.angle_rad)
    }

    /// Direction of the edge, counter-clockwise round the top panel.
    pub fn tangent(&self) -> DVec2 {
        self.normal().perp()
    }
}

/// One face of the solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaceId {
    /// The top panel.
    Top,
    /// The bottom panel.
    Bottom,
    /// Facet `.1` of chain `.0`.
    Side(ChainId, usize),
}

/// The half-spaces of one component.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    /// Chains, counter-clockwise.
    pub chains: Vec<Chain>,
    /// Height of the top panel.
    pub top_mm: f64,
    /// Height of the bottom panel.
    pub bottom_mm: f64,
    /// Whether the top panel is a joint panel, held fixed.
    pub is_top_joint: bool,
    /// Whether the bottom panel is a joint panel, held fixed.
    pub is_bottom_joint: bool,
}

impl Solid {
    /// The chains' ids, counter-clockwise.
    pub fn chain_ids(&self) -> impl Iterator<Item = ChainId> + Clone + use<> {
        (0..self.chains.len()).map(ChainId)
    }

    /// Chain after chain `j`, counter-clockwise.
    pub fn next(&self, j: ChainId) -> ChainId {
        ChainId((j.0 + 1) % self.chains.len())
    }

    /// Chain before chain `j`.
    pub fn previous(&self, j: ChainId) -> ChainId {
        ChainId((j.0 + self.chains.len() - 1) % self.chains.len())
    }

    /// Outward unit normal and offset of a face.
    pub fn plane(&self, face: FaceId) -> (DVec3, f64) {
        match face {
            FaceId::Top => (DVec3::Z, self.top_mm),
            FaceId::Bottom => (-DVec3::Z, -self.bottom_mm),
            FaceId::Side(j, i) => {
                let chain = &self.chains[j.0];
                let facet = chain.facets[i];
                (side_normal(chain.angle_rad, facet.slope_rad), facet.offset_mm)
            }
        }
    }

    /// All faces: top, bottom, then the chains'.
    pub fn faces(&self) -> Vec<FaceId> {
        let sides = self.chain_ids().zip(&self.chains);
        let sides = sides.flat_map(|(j, chain)| (0..chain.facets.len()).map(move |i| FaceId::Side(j, i)));
        [FaceId::Top, FaceId::Bottom].into_iter().chain(sides).collect()
    }

    /// The same with all lengths times `factor`.
    #[must_use]
    pub fn resized(&self, factor: f64) -> Self {
        let facet = |facet: &SideFacet| SideFacet { offset_mm: factor * facet.offset_mm, ..*facet };
        let chain = |chain: &Chain| Chain { facets: chain.facets.iter().map(facet).collect(), ..*chain };
        Self {
            chains: self.chains.iter().map(chain).collect(),
            top_mm: factor * self.top_mm,
            bottom_mm: factor * self.bottom_mm,
            ..*self
        }
    }

    /// Its image in the plane x = 0. Chain j of the image is that of chain N − j.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let count = self.chains.len();
        let chains = (0..count).map(|j| {
            let chain = &self.chains[(count - j) % count];
            Chain { angle_rad: std::f64::consts::PI - chain.angle_rad, ..chain.clone() }
        });
        Self { chains: chains.collect(), ..*self }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A barrel: N equal chains with planes of slopes 45°, 0°, −45° tangent to radius `r`.
    pub(crate) fn barrel(n: usize, r: f64) -> Solid {
        let facets = [0.25, 0.0, -0.25].map(|turn: f64| SideFacet {
            slope_rad: turn * TAU / 2.0,
            offset_mm: r,
            is_joint: false,
        });
        let chains = (0..n).map(|j| Chain {
            angle_rad: TAU * j as f64 / n as f64,
            is_locked: false,
            facets: facets.to_vec(),
        });
        Solid {
            chains: chains.collect(),
            top_mm: 0.8 * r,
            bottom_mm: -0.8 * r,
            is_top_joint: false,
            is_bottom_joint: false,
        }
    }
}
