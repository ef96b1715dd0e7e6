//! What a component has to match: a hull, its joints, and the user's limits.

use super::filling::Filling;
use super::panel::ChainId;
use super::solid::{FaceId, SideFacet, Solid};
use super::symmetry::Symmetry;
use crate::geom::Hull;
use glam::{DAffine3, DVec3};

/// Where a joint panel sits on a component, in the component's axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seat {
    /// It is the top panel.
    Top {
        /// Height of the joint plane.
        height_mm: f64,
    },
    /// It is the bottom panel.
    Bottom {
        /// Height of the joint plane.
        height_mm: f64,
    },
    /// It is a side panel.
    Side {
        /// Direction of the chain's outward normal.
        angle_rad: f64,
        /// Slope of the panel's normal above the horizontal.
        slope_rad: f64,
        /// Distance of its plane from the origin.
        offset_mm: f64,
    },
}

/// One joint as a component sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct JointTarget {
    /// Where it sits.
    pub seat: Seat,
    /// Points on the plane that the joint panel should cover (the partner's section).
    pub cover: Vec<DVec3>,
    /// Half-spaces `n·x <= c` that the joint panel's corners should stay within (the edges of
    /// the partner's panel).
    pub within: Vec<(DVec3, f64)>,
    /// Price of a millimetre by which the joint panel misses its partner, against a millimetre of
    /// error.
    pub price: f64,
}

/// All that a fit needs, in the component's axes.
#[derive(Debug, Clone)]
pub struct Target<'a> {
    /// The convex body to match.
    pub hull: &'a Hull,
    /// What of it is solid, with the way from the component's axes to those of the filling; nothing where all of it
    /// counts.
    pub filling: Option<(&'a Filling, DAffine3)>,
    /// Its joints.
    pub joints: Vec<JointTarget>,
    /// Half-spaces `n·x <= c` that the component should stay within: other parts are beyond them.
    pub borders: Vec<(DVec3, f64)>,
    /// The plane in which the component must be its own mirror image. The hull and the set of all
    /// joints are so within rounding; joints of one chain have exactly one direction.
    pub symmetry: Option<Symmetry>,
    /// Number of top edges wanted (joints may need more).
    pub top_edges: usize,
    /// Most vertices of a profile, at least 3.
    pub profile_vertices: usize,
    /// Least width and height of a side panel.
    pub min_panel_mm: f64,
    /// A panel that makes the component less alike by less than this share of its size, the cube root of
    /// its volume, is left out; 0 keeps all.
    pub panel_worth: f64,
    /// Width and height from which panels are comfortable to fold and to glue: fewer edges and
    /// vertices are used where that many would be smaller.
    pub comfortable_mm: f64,
}

/// Where the fold vertex of a chain is to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FoldSpot {
    /// Inside plane i of the chain.
    Inside(usize),
    /// At the bend between planes i and i + 1.
    Bend(usize),
}

impl Target<'_> {
    /// Directions of chains that hold a joint panel, each once, ascending.
    pub(super) fn locked_angles(&self) -> Vec<f64> {
        let mut angles: Vec<f64> = self
            .joints
            .iter()
            .filter_map(|j| match j.seat {
                Seat::Side { angle_rad, .. } => Some(angle_rad),
                _ => None,
            })
            .collect();
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        angles
    }

    /// Joint panels of the chain with exactly this direction.
    pub(super) fn side_joints(&self, chain_angle_rad: f64) -> impl Iterator<Item = SideFacet> + '_ {
        let mut seen: Vec<(f64, f64)> = Vec::new();
        self.joints.iter().filter_map(move |j| match j.seat {
            Seat::Side { angle_rad, slope_rad, offset_mm }
                if angle_rad == chain_angle_rad && !seen.contains(&(slope_rad, offset_mm)) =>
            {
                seen.push((slope_rad, offset_mm));
                Some(SideFacet { slope_rad, offset_mm, is_joint: true })
            }
            _ => None,
        })
    }

    /// The face of `solid` that is the panel of a joint.
    pub fn joint_face(&self, solid: &Solid, joint: &JointTarget) -> Option<FaceId> {
        match joint.seat {
            Seat::Top { .. } => Some(FaceId::Top),
            Seat::Bottom { .. } => Some(FaceId::Bottom),
            Seat::Side { angle_rad, slope_rad, offset_mm } => {
                let chain = solid.chains.iter().position(|c| c.angle_rad == angle_rad)?;
                let facet = solid.chains[chain]
                    .facets
                    .iter()
                    .position(|f| f.is_joint && f.slope_rad == slope_rad && f.offset_mm == offset_mm)?;
                Some(FaceId::Side(ChainId(chain), facet))
            }
        }
    }
}
