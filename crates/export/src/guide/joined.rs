//! Which hinges of a net are joined at some time of the gluing, and what that leaves open.

use glam::{DVec2, DVec3};
use tatamu_core::component::{ChainId, HingeId, PanelId, PanelSet};
use tatamu_core::geom::polygon;
use tatamu_net::net::Net;

/// A component while it is glued.
#[derive(Debug, Clone)]
pub struct Joined<'a> {
    set: &'a PanelSet,
    is_joined: Vec<bool>,
}

/// A side of a component through which one can reach into it.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// The panels that can be swung aside there, or are not glued yet.
    pub panels: Vec<PanelId>,
    /// Diameter of the disc that fits through it, mm.
    pub width_mm: f64,
}

impl<'a> Joined<'a> {
    /// The pieces of a net, cut out and not glued yet: only creases are joined.
    pub(crate) fn cut_out(net: &'a Net) -> Self {
        let set = net.panels();
        let mut is_joined = vec![false; set.hinges().len()];
        for crease in net.pieces().iter().flat_map(|piece| piece.creases()) {
            is_joined[crease.0] = true;
        }
        Self { set, is_joined }
    }

    /// The same with one more hinge joined.
    #[must_use]
    pub fn with(&self, hinge: HingeId) -> Self {
        let mut next = self.clone();
        next.is_joined[hinge.0] = true;
        next
    }

    /// The panels.
    pub fn set(&self) -> &'a PanelSet {
        self.set
    }

    /// Whether a hinge is joined.
    pub fn is_joined(&self, hinge: HingeId) -> bool {
        self.is_joined[hinge.0]
    }

    /// The hinges that are not joined.
    pub fn left(&self) -> impl Iterator<Item = HingeId> + '_ {
        (0..self.is_joined.len()).map(HingeId).filter(|&h| !self.is_joined(h))
    }

    /// For each panel the least panel that it hangs together with: panels with the same one make
    /// one body.
    pub fn bodies(&self) -> Vec<PanelId> {
        let mut body: Vec<usize> = (0..self.set.panels().len()).collect();
        loop {
            let mut is_settled = true;
            let joined = self.set.hinges().iter().zip(&self.is_joined).filter(|(_, is_joined)| **is_joined);
            for (hinge, _) in joined {
                let [a, b] = hinge.sides.map(|side| side.panel.0);
                let least = body[a].min(body[b]);
                is_settled &= body[a] == body[b];
                (body[a], body[b]) = (least, least);
            }
            if is_settled {
                return body.into_iter().map(PanelId).collect();
            }
        }
    }

    /// The body of the most panels; of several the first.
    pub(crate) fn main_body(&self) -> PanelId {
        let bodies = self.bodies();
        let size = |body: &PanelId| bodies.iter().filter(|b| *b == body).count();
        let best = bodies.iter().max_by(|a, b| size(a).cmp(&size(b)).then(b.cmp(a)));
        best.copied().unwrap_or(PanelId(0))
    }

    /// The chain that a hinge is part of; none for the seam of a split top or bottom panel.
    pub(crate) fn chain_of(&self, hinge: HingeId) -> Option<ChainId> {
        let sides = self.set.hinges()[hinge.0].sides;
        sides.into_iter().find_map(|side| chain_of_panel(self.set, side.panel))
    }

    /// Whether all hinges of a chain are joined: then it stands, and no longer swings aside.
    pub(crate) fn is_shut(&self, chain: ChainId) -> bool {
        let hinges = (0..self.is_joined.len()).map(HingeId);
        hinges.filter(|&h| self.chain_of(h) == Some(chain)).all(|h| self.is_joined(h))
    }

    /// The sides that are open: panels of chains that are not shut, and panels that do not hang
    /// together with the largest body yet. Neighbouring ones make one opening; the widest is first.
    pub fn openings(&self) -> Vec<Opening> {
        let (bodies, main) = (self.bodies(), self.main_body());
        let is_open = |panel: PanelId| {
            let is_loose = bodies[panel.0] != main;
            is_loose || chain_of_panel(self.set, panel).is_some_and(|chain| !self.is_shut(chain))
        };
        let mut left: Vec<PanelId> = (0..bodies.len()).map(PanelId).filter(|&p| is_open(p)).collect();
        let mut openings = Vec::new();
        while let Some(first) = left.pop() {
            let mut panels = vec![first];
            let mut next = 0;
            while next < panels.len() {
                let here = panels[next];
                let (near, far) = left.into_iter().partition(|&other| are_neighbours(self.set, here, other));
                left = far;
                panels.extend::<Vec<_>>(near);
                next += 1;
            }
            panels.sort();
            let width_mm = width_mm(self.set, &panels);
            openings.push(Opening { panels, width_mm });
        }
        openings.sort_by(|a, b| b.width_mm.total_cmp(&a.width_mm).then(a.panels.cmp(&b.panels)));
        openings
    }
}

fn chain_of_panel(set: &PanelSet, panel: PanelId) -> Option<ChainId> {
    set.panel(panel).kind.chain()
}

/// Panels of one chain or of neighbouring chains; top and bottom panels are neighbours of all.
fn are_neighbours(set: &PanelSet, a: PanelId, b: PanelId) -> bool {
    let (Some(a), Some(b)) = (chain_of_panel(set, a), chain_of_panel(set, b)) else { return true };
    let count = set.panels().iter().filter_map(|p| p.kind.chain()).max().map_or(1, ChainId::number);
    a == b || (a.0 + 1) % count == b.0 || (b.0 + 1) % count == a.0
}

/// Diameter of the disc that fits through the deployed panels, looking along their mean normal, or
/// through one of them. It is measured at the middle, so the true one is never smaller.
fn width_mm(set: &PanelSet, panels: &[PanelId]) -> f64 {
    let disc = |outline: &[DVec2]| -2.0 * polygon::depth_outside(outline, polygon::centroid(outline));
    let one = panels.iter().map(|&p| disc(&set.panel(p).outline)).fold(0.0, f64::max);
    let area = |p: PanelId| polygon::area(&set.panel(p).outline);
    let normal: DVec3 = panels.iter().map(|&p| set.panel(p).deployed.matrix3.z_axis * area(p)).sum();
    let total: f64 = panels.iter().map(|&p| area(p)).sum();
    if normal.length() < 0.5 * total {
        // They go more than half round: no direction looks through all of them.
        return one;
    }
    let (x, y) = normal.normalize().any_orthonormal_pair();
    let corners = panels.iter().flat_map(|&p| set.panel(p).deployed_outline());
    let seen: Vec<DVec2> = corners.map(|c| DVec2::new(x.dot(c), y.dot(c))).collect();
    disc(&polygon::convex_hull(&seen)).max(one)
}
