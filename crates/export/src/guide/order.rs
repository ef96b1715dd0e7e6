//! The order in which the tabs of a component are glued, so that a hand can reach them.
//!
//! **What can be reached** is judged on the deployed panels. A chain is *shut* when all its hinges
//! are joined, by a crease or by glue; until then it swings aside and leaves an opening of the size
//! of its panels. Neighbouring chains that are not shut make one opening ([`Joined::openings`]). A
//! component is convex, so a straight line from any place in an opening to any tab meets no panel:
//! a tab can be pressed from inside when, *after* it is glued, an opening is left that a finger or a
//! stick fits through and that is near enough. The tab of the last chain has only its own chain to
//! come in by: it is slid behind its edge while that chain shuts, and pressed by folding the
//! component flat, since all hinges but the fold hinges lie flat then.
//!
//! **The order**: first what shuts nothing; then always the tab that leaves the widest opening. So
//! the closing tab comes last, at the widest side.

use super::joined::{Joined, Opening};
use glam::{DVec2, DVec3};
use tatamu_core::component::{HingeId, PanelId};
use tatamu_core::geom::polygon;
use tatamu_net::net::Net;

/// A finger needs an opening this wide, and reaches [`FINGER_REACH_MM`].
const FINGER_MM: f64 = 16.0;
/// See [`FINGER_MM`].
const FINGER_REACH_MM: f64 = 80.0;
/// The blunt end of a pencil needs an opening this wide, and reaches [`STICK_REACH_MM`].
const STICK_MM: f64 = 8.0;
/// See [`STICK_MM`].
const STICK_REACH_MM: f64 = 150.0;

/// How a glued hinge is pressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// On the table: the chain swings freely before and after.
    Free,
    /// With a finger inside, through another opening.
    Finger,
    /// With a stick inside, through another opening.
    Stick,
    /// The tab slides in by its own chain, and the component is folded flat to press it.
    FoldFlat,
}

/// One hinge to glue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gluing {
    /// The hinge, of [`Net::panels`].
    pub hinge: HingeId,
    /// How it is pressed.
    pub access: Access,
}

/// All cut hinges of a net, in the order in which they are glued.
pub fn gluing_order(net: &Net) -> Vec<Gluing> {
    let mut joined = Joined::cut_out(net);
    let mut order = Vec::new();
    loop {
        // Whole millimetres, so that equal openings keep the order of the labels.
        let room = |after: &Joined| after.openings().first().map_or(0, |o| o.width_mm.round() as u64);
        let rank = |&hinge: &HingeId| {
            let after = joined.with(hinge);
            (shuts(&after, hinge), std::cmp::Reverse(room(&after)), hinge)
        };
        let Some(hinge) = joined.left().min_by_key(rank) else {
            return order;
        };
        joined = joined.with(hinge);
        order.push(Gluing { hinge, access: access(net, &joined, hinge) });
    }
}

/// Whether the chain of a hinge is shut.
fn shuts(joined: &Joined, hinge: HingeId) -> bool {
    joined.chain_of(hinge).is_some_and(|chain| joined.is_shut(chain))
}

/// How a hinge that has just been joined is pressed.
pub fn access(net: &Net, after: &Joined, hinge: HingeId) -> Access {
    if !shuts(after, hinge) {
        return Access::Free;
    }
    let tab = place(net, hinge);
    let is_reached = |width_mm: f64, reach_mm: f64| {
        let mut openings = after.openings().into_iter();
        openings.any(|o| o.width_mm >= width_mm && distance_mm(after, &o, tab) <= reach_mm)
    };
    if is_reached(FINGER_MM, FINGER_REACH_MM) {
        Access::Finger
    } else if is_reached(STICK_MM, STICK_REACH_MM) {
        Access::Stick
    } else {
        Access::FoldFlat
    }
}

/// Where a tab or tape lies, deployed: the middle of the hinge.
fn place(net: &Net, hinge: HingeId) -> DVec3 {
    let side = net.panels().hinges()[hinge.0].sides[0];
    let panel = net.panels().panel(side.panel);
    let [a, b] = panel.edge(side.edge);
    panel.deployed.transform_point3(a.midpoint(b).extend(0.0))
}

/// From the middle of the nearest panel of an opening to a tab.
fn distance_mm(joined: &Joined, opening: &Opening, tab: DVec3) -> f64 {
    let middle = |&id: &PanelId| {
        let panel = joined.set().panel(id);
        let middle: DVec2 = polygon::centroid(&panel.outline);
        panel.deployed.transform_point3(middle.extend(0.0))
    };
    opening.panels.iter().map(|p| middle(p).distance(tab)).fold(f64::INFINITY, f64::min)
}
