//! What the joints of a part ask of its panels: where they lie, and what they cover.

use super::link::Link;
use super::seat::seat_plane;
use super::{Part, PartId, section};
use crate::component::{JointTarget, Seat};
use crate::geom::{Plane, polygon};
use glam::DVec3;

/// Price of a mm by which a joint panel misses its partner. With 0.8 for all joints, the silhouettes of
/// bunny and penguin fall by 0.01.
const JOINT_PRICE: f64 = 0.3;
/// The price rises where two hulls meet in less than this area, mm²: otherwise wrists and ankles of humans,
/// of 70 to 110 mm², are glued over 33 mm²,
const TIGHT_MM2: f64 = 200.0;
/// The price rises up to this many times. With 7, the silhouette of a plane falls from 0.82 to 0.74.
const TIGHTEST: f64 = 3.0;
/// The smaller one of two joint panels is to lie within the larger one. That of a child is taken for the smaller one
/// unless the section of the child is this many times as large. With 1 outlines of 47 meshes are less alike by 0.002, with 2
/// those of a scorpion by 0.031. Not bounded from above by a case yet; without it the back of a chair hangs on one of its
/// two posts by nothing, as its panel is to be as narrow as the post.
const MUCH_LARGER: f64 = 4.0;

/// What a joint asks of the part's panel, whatever the fold direction.
pub(super) struct Demand {
    /// Middle of the place where the two parts meet.
    pub(super) centre: DVec3,
    /// Price of a mm by which the panel misses its partner.
    price: f64,
    /// Whether the panel is to cover its partner, or else to lie within it.
    covers: bool,
}

impl Demand {
    /// What a joint of a part asks, where a mm by which its panel misses its partner costs `firmness` times as much as
    /// it does in other searches.
    pub(super) fn new(parts: &[Part], part: PartId, link: &Link, firmness: f64) -> Self {
        let sections = [link.parent, link.child].map(|p| section::outline(&link.plane, &parts[p.0].hull));
        let flat = sections.each_ref().map(|s| section::flattened(&link.plane, s.iter().copied()));
        let shared_mm2 = polygon::area(&section::common_outline(&flat[0], &flat[1]));
        // Hulls that only touch there have a face on the plane, of no known size.
        let tightness = if shared_mm2 > 0.0 { (TIGHT_MM2 / shared_mm2).clamp(1.0, TIGHTEST) } else { 1.0 };
        let [parent_mm2, child_mm2] = flat.map(|section| polygon::area(&section));
        let is_child_larger = parent_mm2 > 0.0 && child_mm2 > MUCH_LARGER * parent_mm2;
        let smaller =
            sections.into_iter().filter(|s| !s.is_empty()).min_by(|a, b| radius(a).total_cmp(&radius(b)));
        let fallback = link.plane.normal() * link.plane.offset();
        Self {
            centre: smaller.map_or(fallback, |s| s.iter().sum::<DVec3>() / s.len() as f64),
            price: JOINT_PRICE * tightness * firmness,
            covers: (link.child == part) == is_child_larger,
        }
    }

    /// What a component is to do about the joint on a seat, by which the partner has a section.
    pub(super) fn target(&self, seat: Seat, section: Vec<DVec3>) -> JointTarget {
        let (cover, within) = match self.covers {
            true => (section, Vec::new()),
            false => (Vec::new(), borders(&section, &seat_plane(&seat))),
        };
        JointTarget { seat, cover, within, price: self.price }
    }
}

/// Half-spaces in whose intersection a convex polygon lies in its plane.
fn borders(outline: &[DVec3], plane: &Plane) -> Vec<(DVec3, f64)> {
    let centre = outline.iter().sum::<DVec3>() / outline.len().max(1) as f64;
    let edges = (0..outline.len()).filter_map(|k| {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        let across = plane.normal().cross(b - a).try_normalize()?;
        let outward = if across.dot(a - centre) < 0.0 { -across } else { across };
        Some((outward, outward.dot(a)))
    });
    edges.collect()
}

fn radius(points: &[DVec3]) -> f64 {
    let centre = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::part;
    use super::*;
    use glam::DQuat;

    /// The back of a chair was to lie within the section of its post, and became as narrow as that.
    #[test]
    fn the_narrow_panel_lies_within_the_wide_one_whichever_is_the_child() {
        let cuboid = |name: &str, half_mm: f64, z_mm: f64| {
            let low = DVec3::new(-half_mm, -half_mm, z_mm);
            part(name, low, DVec3::new(2.0 * half_mm, 2.0 * half_mm, 30.0), DQuat::IDENTITY)
        };
        let link = Link { parent: PartId(0), child: PartId(1), plane: Plane::horizontal(25.0) };
        let section =
            vec![DVec3::new(0.0, 0.0, 25.0), DVec3::new(4.0, 0.0, 25.0), DVec3::new(0.0, 4.0, 25.0)];
        for (parent_mm, child_mm, is_child_wide) in
            [(20.0, 20.0, false), (20.0, 26.0, false), (40.0, 8.0, false), (8.0, 40.0, true)]
        {
            let parts = [cuboid("parent", parent_mm, 0.0), cuboid("child", child_mm, 20.0)];
            for (own, is_wide) in [(PartId(0), !is_child_wide), (PartId(1), is_child_wide)] {
                let demand = Demand::new(&parts, own, &link, 1.0);
                let joint = demand.target(Seat::Top { height_mm: 25.0 }, section.clone());
                let found = (joint.cover.len(), joint.within.len());
                assert_eq!(found, if is_wide { (3, 0) } else { (0, 3) }, "{parent_mm} {child_mm} {own:?}");
                assert!(demand.centre.distance(DVec3::Z * 25.0) < 1e-9);
            }
        }
    }
}
