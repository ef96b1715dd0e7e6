//! The motion of one component: its top panel comes down along the fold axis, and every chain
//! follows as [`ChainMotion`] says. Chains are free of one another at their slits, so that the
//! height alone decides the pose.

use super::chain::{ChainMotion, HangsFrom, Shares, Sway};
use crate::component::{ChainId, Component, PanelId, PanelKind, Profile};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// How a component moves between deployed and flat.
///
/// # Guarantees
/// Panels are rigid and stay joined at their hinges in every pose, within rounding (1e-12 of the
/// component's size) and the profiles' gaps.
#[derive(Debug, Clone)]
pub struct ComponentMotion {
    chains: Vec<MovingChain>,
    panels: Vec<(PanelKind, DAffine3)>,
    levels: Vec<usize>,
    height_mm: f64,
    /// How far the top rises before it comes down.
    rise_mm: f64,
}

#[derive(Debug, Clone)]
struct MovingChain {
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
        let chain = |(j, profile): (ChainId, &Profile)| MovingChain {
            motion: ChainMotion::new(profile),
            outward: component.normal(j),
        };
        let panel = |p: &crate::component::Panel| (p.kind, p.deployed);
        let chains: Vec<MovingChain> = component.chain_ids().zip(component.profiles()).map(chain).collect();
        Self {
            rise_mm: chains.iter().map(|chain| chain.motion.rise_mm()).fold(0.0, f64::max),
            chains,
            panels: component.panels().panels().iter().map(panel).collect(),
            levels: levels(component),
            height_mm: component.top_mm() - component.bottom_mm(),
        }
    }

    /// Deployed height, mm.
    pub fn height_mm(&self) -> f64 {
        self.height_mm
    }

    /// Number of panels.
    pub fn panel_count(&self) -> usize {
        self.panels.len()
    }

    /// The linkage of chain j.
    pub fn chain(&self, j: ChainId) -> &ChainMotion {
        &self.chains[j.0].motion
    }

    /// Height of the top panel over the bottom panel at `folded`, from 0 (deployed) to 1 (flat). It
    /// falls as the cosine of a quarter turn: a straight wall then bends evenly, although its height
    /// hardly changes at first. Boards that lie between the two keep them apart; where chains have to
    /// rise first, it rises.
    pub fn height_at_mm(&self, folded: f64) -> f64 {
        let (way_mm, peak_mm) = (self.way_at_mm(folded), self.height_mm + self.rise_mm);
        if way_mm > peak_mm { 2.0 * peak_mm - way_mm } else { way_mm }
    }

    /// The height, counted on beyond the peak while it rises.
    fn way_at_mm(&self, folded: f64) -> f64 {
        let flat_mm = self.chains[0].motion.flat_height_mm();
        if folded >= 1.0 {
            flat_mm
        } else {
            flat_mm + (self.height_mm + 2.0 * self.rise_mm - flat_mm) * libm::cos(FRAC_PI_2 * folded)
        }
    }

    /// How many layers lie under each panel when flat, counted within the component, where it has
    /// more than the two layers of a convex one; else 0 for all.
    pub(super) fn levels(&self) -> &[usize] {
        &self.levels
    }

    /// How far each chain is at `folded`.
    pub fn shares(&self, folded: f64) -> Vec<Shares> {
        let way_mm = self.way_at_mm(folded);
        self.chains.iter().map(|c| c.motion.at_height(way_mm)).collect()
    }

    /// The same, found faster from a moment that is near.
    pub(super) fn shares_near(&self, folded: f64, near: &[Shares]) -> Vec<Shares> {
        let way_mm = self.way_at_mm(folded);
        self.chains.iter().zip(near).map(|(c, near)| c.motion.at_height_near(way_mm, *near)).collect()
    }

    /// The pose at `folded`.
    pub fn pose(&self, folded: f64) -> ComponentPose {
        let shares = self.shares(folded);
        let height_mm = self.height_at_mm(folded);
        let place = |(k, (_, deployed)): (usize, &(PanelKind, DAffine3))| {
            self.moved(PanelId(k), height_mm, &shares) * *deployed
        };
        let placements = self.panels.iter().enumerate().map(place).collect();
        ComponentPose { placements, height_mm, shares }
    }

    /// How a panel has moved from where it is when deployed, in the component's axes.
    pub(super) fn moved(&self, panel: PanelId, height_mm: f64, shares: &[Shares]) -> DAffine3 {
        match self.panels[panel.0].0 {
            PanelKind::Top => DAffine3::from_translation(DVec3::Z * (height_mm - self.height_mm)),
            PanelKind::Bottom => DAffine3::IDENTITY,
            PanelKind::Side { chain, index } => self.chains[chain.0].move_link(index, shares[chain.0]),
        }
    }
}

fn levels(component: &Component) -> Vec<usize> {
    let layers = |profile: &Profile| profile.layer(profile.points().len() - 2);
    let top = component.profiles().iter().map(layers).max().unwrap_or(0);
    let level = |kind: PanelKind| match kind {
        _ if top < 2 => 0,
        PanelKind::Top => top,
        PanelKind::Bottom => 0,
        PanelKind::Side { chain, index } => {
            let profile = &component.profiles()[chain.0];
            let layer = profile.layer(index);
            if layer == layers(profile) { 0 } else { top - layer }
        }
    };
    component.panels().panels().iter().map(|panel| level(panel.kind)).collect()
}

/// From which end of its component a panel hangs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// The top panel, by this chain; none for the top panel itself.
    Top(Option<ChainId>),
    /// The bottom panel.
    Bottom(Option<ChainId>),
}

impl ComponentMotion {
    /// The end that a panel hangs from.
    pub(super) fn end_of(&self, panel: PanelId) -> End {
        match self.panels[panel.0].0 {
            PanelKind::Top => End::Top(None),
            PanelKind::Bottom => End::Bottom(None),
            PanelKind::Side { chain, index } => match self.chains[chain.0].motion.hangs_from(index) {
                HangsFrom::Top => End::Top(Some(chain)),
                HangsFrom::Bottom => End::Bottom(Some(chain)),
            },
        }
    }

    /// How far points that ride on a panel move against the panel's end of the component, at most,
    /// for changes of the chain's shares by 1. The points are given as they lie when deployed.
    pub(super) fn sway_mm(&self, panel: PanelId, points: &[DVec3]) -> Sway {
        let PanelKind::Side { chain, index } = self.panels[panel.0].0 else { return [0.0; 2] };
        let chain = &self.chains[chain.0];
        let [ends, _] = chain.motion.link_ends(index, Shares::DEPLOYED);
        let pivot = ends[chain.pivot(index)];
        let in_plane = |p: &DVec3| DVec2::new(chain.outward.dot(p.truncate()), p.z);
        let reach = points.iter().map(|p| in_plane(p).distance(pivot)).fold(0.0, f64::max);
        chain.motion.sway_mm(index, reach)
    }
}

impl MovingChain {
    fn in_space(&self, point: DVec2) -> DVec3 {
        (self.outward * point.x).extend(point.y)
    }

    /// The end of a link that is nearer to the end of the chain that it hangs from.
    fn pivot(&self, link: usize) -> usize {
        match self.motion.hangs_from(link) {
            HangsFrom::Top => 0,
            HangsFrom::Bottom => 1,
        }
    }

    /// How a link has moved from where it is when deployed.
    fn move_link(&self, link: usize, shares: Shares) -> DAffine3 {
        let [before, after] = self.motion.link_ends(link, shares);
        let tangent = self.outward.perp().extend(0.0);
        let turn = DQuat::from_axis_angle(-tangent, self.motion.turn_rad(link, shares));
        let pivot = self.pivot(link);
        DAffine3::from_translation(self.in_space(after[pivot]))
            * DAffine3::from_mat3(DMat3::from_quat(turn))
            * DAffine3::from_translation(-self.in_space(before[pivot]))
    }
}
