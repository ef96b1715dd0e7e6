//! The motion of one component: its top panel comes down along the fold axis, and every chain
//! follows as [`ChainMotion`] says. Chains are free of one another at their slits, so that the
//! height alone decides the pose.

use super::chain::{ChainMotion, Shares};
use crate::component::{Component, PanelKind, Profile};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// How a component moves between deployed and flat.
///
/// # Guarantees
/// Panels are rigid and stay joined at their hinges in every pose, within rounding (1e-12 of the
/// component's size) and the profiles' gaps.
#[derive(Debug, Clone)]
pub struct ComponentMotion {
    chains: Vec<Chain>,
    panels: Vec<(PanelKind, DAffine3)>,
    height_mm: f64,
}

#[derive(Debug, Clone)]
struct Chain {
    motion: ChainMotion,
    outward: DVec2,
}

/// A component in one pose.
#[derive(Debug, Clone)]
pub struct ComponentPose {
    /// Placement of each panel in the component's axes, by id; the bottom panel stays.
    pub placements: Vec<DAffine3>,
    /// Height of the top panel over the bottom panel.
    pub height_mm: f64,
    /// How far each chain is.
    pub shares: Vec<Shares>,
}

impl ComponentMotion {
    /// The motion of a component.
    pub fn new(component: &Component) -> Self {
        let chain = |(j, profile): (usize, &Profile)| Chain {
            motion: ChainMotion::new(profile),
            outward: component.solid().chains[j].normal(),
        };
        let panel = |p: &crate::component::Panel| (p.kind, p.deployed);
        Self {
            chains: component.profiles().iter().enumerate().map(chain).collect(),
            panels: component.panels().panels().iter().map(panel).collect(),
            height_mm: component.solid().top_mm - component.solid().bottom_mm,
        }
    }

    /// Deployed height, mm.
    pub fn height_mm(&self) -> f64 {
        self.height_mm
    }

    /// The linkage of chain j.
    pub fn chain(&self, j: usize) -> &ChainMotion {
        &self.chains[j].motion
    }

    /// The pose at `folded`, from 0 (deployed) to 1 (flat). The height falls as the cosine of a
    /// quarter turn: a straight wall then bends evenly, although its height hardly changes at
    /// first.
    pub fn pose(&self, folded: f64) -> ComponentPose {
        let height_mm = if folded >= 1.0 { 0.0 } else { self.height_mm * (FRAC_PI_2 * folded).cos() };
        let shares: Vec<Shares> = self.chains.iter().map(|c| c.motion.at_height(height_mm)).collect();
        let drop = DAffine3::from_translation(DVec3::Z * (height_mm - self.height_mm));
        let place = |&(kind, deployed): &(PanelKind, DAffine3)| match kind {
            PanelKind::Top => drop * deployed,
            PanelKind::Bottom => deployed,
            PanelKind::Side { chain, index } => self.chains[chain].move_link(index, shares[chain], deployed),
        };
        let placements = self.panels.iter().map(place).collect();
        ComponentPose { placements, height_mm, shares }
    }
}

impl Chain {
    fn in_space(&self, point: DVec2) -> DVec3 {
        (self.outward * point.x).extend(point.y)
    }

    /// The placement of a link's panel after the motion.
    fn move_link(&self, link: usize, shares: Shares, deployed: DAffine3) -> DAffine3 {
        let [before, after] = self.motion.link_ends(link, shares);
        let tangent = self.outward.perp().extend(0.0);
        let turn = DQuat::from_axis_angle(-tangent, self.motion.turn_rad(link, shares));
        let pivot = if self.motion.is_above(link) { 0 } else { 1 };
        DAffine3::from_translation(self.in_space(after[pivot]))
            * DAffine3::from_mat3(DMat3::from_quat(turn))
            * DAffine3::from_translation(-self.in_space(before[pivot]))
            * deployed
    }
}
