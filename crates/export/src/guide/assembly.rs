//! Where the panels of a component are while it is built.

use super::joined::Joined;
use glam::{DAffine2, DAffine3, DMat3, DVec2, DVec3};
use tatamu_core::component::{Hinge, HingeId, PanelId, PanelSet};
use tatamu_net::net::layout;

/// Panels at their places, in the component's axes.
#[derive(Debug, Clone)]
pub struct Pose {
    places: Vec<DAffine3>,
}

impl Pose {
    /// Panels that hang together are folded along joined hinges by a share of their deployed angle,
    /// and begin at the least panel of their body, or at `anchor`, where that panel is when
    /// deployed.
    pub fn folded(joined: &Joined, anchor: PanelId, share: impl Fn(HingeId) -> f64) -> Self {
        let set = joined.set();
        let bodies = joined.bodies();
        let mut places: Vec<Option<DAffine3>> = vec![None; set.panels().len()];
        for start in std::iter::once(anchor).chain(bodies.iter().copied()) {
            let is_placed = (0..places.len()).any(|p| bodies[p] == bodies[start.0] && places[p].is_some());
            if !is_placed {
                places[start.0] = Some(set.panel(start).deployed);
                spread(joined, &share, &mut places);
            }
        }
        let placed = places.into_iter().zip(set.panels());
        Self { places: placed.map(|(place, panel)| place.unwrap_or(panel.deployed)).collect() }
    }

    /// Where a panel is.
    pub fn panel(&self, panel: PanelId) -> DAffine3 {
        self.places[panel.0]
    }

    /// Moves some panels.
    pub fn shift(&mut self, by: DVec3, is_moved: impl Fn(PanelId) -> bool) {
        for (_, place) in self.places.iter_mut().enumerate().filter(|(k, _)| is_moved(PanelId(*k))) {
            place.translation += by;
        }
    }
}

/// Places what hangs on what is placed.
fn spread(joined: &Joined, share: impl Fn(HingeId) -> f64, places: &mut [Option<DAffine3>]) {
    let set = joined.set();
    let mut has_grown = true;
    while has_grown {
        has_grown = false;
        for h in (0..set.hinges().len()).map(HingeId).filter(|&h| joined.is_joined(h)) {
            for side in [0, 1] {
                let [here, there] = [side, 1 - side].map(|s| set.hinges()[h.0].sides[s].panel);
                if let (Some(place), None) = (places[here.0], places[there.0]) {
                    places[there.0] = Some(place * across(set, h, side, share(h)));
                    has_grown = true;
                }
            }
        }
    }
}

/// From the coordinates of the panel on the other side of a hinge to those of the panel on `side`,
/// folded by a share of the deployed angle.
fn across(set: &PanelSet, hinge: HingeId, side: usize, share: f64) -> DAffine3 {
    let Hinge { sides, deployed_rad, lift_mm, .. } = set.hinges()[hinge.0];
    let [down, up] = [-lift_mm, lift_mm].map(|mm| DAffine3::from_translation(DVec3::Z * mm));
    up * bend(layout::edge(set, sides[side]), deployed_rad * share)
        * down
        * in_space(layout::across(set, hinge, side))
}

/// A motion of the plane as one of space.
pub fn in_space(motion: DAffine2) -> DAffine3 {
    let [x, y] = [motion.matrix2.x_axis, motion.matrix2.y_axis].map(|axis| axis.extend(0.0));
    DAffine3::from_cols(x, y, DVec3::Z, motion.translation.extend(0.0))
}

/// A turn about an edge of a panel: what lies outside goes down, away from the viewer.
pub fn bend([a, b]: [DVec2; 2], angle_rad: f64) -> DAffine3 {
    let axis = (b - a).extend(0.0).normalize_or(DVec3::X);
    let start = a.extend(0.0);
    DAffine3::from_translation(start)
        * DAffine3::from_mat3(DMat3::from_axis_angle(axis, angle_rad))
        * DAffine3::from_translation(-start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guide::tests::sample;

    #[test]
    fn creases_folded_by_their_whole_angles_give_the_deployed_component() {
        for net in sample().nets() {
            let joined = Joined::cut_out(net);
            let bodies = joined.bodies();
            let pose = Pose::folded(&joined, PanelId(0), |_| 1.0);
            for (k, panel) in net.panels().panels().iter().enumerate() {
                let start = bodies[k];
                // Each body begins where its least panel is when deployed.
                assert!(start.0 <= k);
                let wanted = panel.deployed_outline();
                let found =
                    panel.outline.iter().map(|p| pose.panel(PanelId(k)).transform_point3(p.extend(0.0)));
                for (a, b) in wanted.iter().zip(found) {
                    assert!(a.distance(b) < 1e-6, "{a} {b}");
                }
            }
        }
    }
}
