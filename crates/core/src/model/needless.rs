//! Joints that cost more than they give.

use super::link::Link;
use super::{PartId, ground};
use crate::geom::Hull;

/// A joint may take this many times as much as one hull adds, since parts show what they are. Below it are the ears of a bust
/// (1.19), the eyes of a monkey, the flippers of a penguin and the head of a bird, above it the coat of another bust
/// (1.64), which is two wedges by itself, and the fins of fish (1.8).
const MOST_TAKEN: f64 = 1.4;

/// Pairs of parts that should be merged: the plane of their joint cuts much more off the two than one hull
/// round both adds to them. The fin of a fish that lies along its body costs it the belly.
pub fn needless(part_hulls: &[&Hull], links: &[Link]) -> Vec<(PartId, PartId)> {
    let is_needless = |plane, [parent, child]: [PartId; 2]| {
        let volumes = ground::lost_and_added_mm3(plane, part_hulls[parent.0], part_hulls[child.0]);
        volumes.is_some_and(|[lost, added]| lost > MOST_TAKEN * added)
    };
    let pairs = links.iter().filter(|link| is_needless(&link.plane, [link.parent, link.child]));
    pairs.map(|link| (link.parent, link.child)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::contact::Contact;
    use super::super::link::link_tree;
    use super::*;
    use crate::geom::Plane;
    use glam::DVec3;

    /// From -30 to 30 mm where its size is 1.
    fn bar(size: DVec3) -> Hull {
        let sign = |k: usize, bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let corner = |k: usize| 30.0 * size * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2));
        Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    /// A bar across the middle of another one, both twice as long as wide: a plane at its side takes one end of the other, as
    /// much as one hull adds; farther up it takes more.
    #[test]
    fn a_joint_may_take_more_than_one_hull_adds() {
        let bars = [bar(DVec3::new(1.0, 0.8, 0.5)), bar(DVec3::new(0.5, 0.8, 1.0))];
        for (above_mm, is_needless) in [(0.0, false), (3.0, false), (9.0, true)] {
            let plane = Plane::horizontal(15.0 + above_mm);
            let link = Link { parent: PartId(0), child: PartId(1), plane };
            let found = needless(&[&bars[0], &bars[1]], &[link]);
            assert_eq!(!found.is_empty(), is_needless, "{above_mm}");
        }
    }

    /// Two bars that cross. Any plane takes at least one of the four ends, of 2·w·(1 − w) in
    /// area; one hull fills four corners, of (1 − w)²/2 each.
    #[test]
    fn a_joint_is_needless_where_its_plane_takes_more_than_one_hull_adds() {
        for (width, expected) in [(0.2, false), (0.3, false), (0.7, true), (0.85, true)] {
            let bars = [bar(DVec3::new(1.0, 0.8, width)), bar(DVec3::new(width, 0.8, 1.0))];
            let sides = [-1.0, 1.0].map(|y| [DVec3::new(-1.0, y, 1.0), DVec3::new(1.0, y, 1.0)]);
            let points =
                sides.concat().into_iter().map(|p| 30.0 * p * DVec3::new(width, 0.8, width)).collect();
            let contact = Contact::border([0, 1], points, 90.0);
            let hulls = [&bars[0], &bars[1]];
            let found = needless(&hulls, &link_tree(&hulls, std::slice::from_ref(&contact), None));
            assert_eq!(found, if expected { vec![(PartId(0), PartId(1))] } else { vec![] }, "{width}");
        }
    }
}
