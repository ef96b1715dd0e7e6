//! Contact planes between neighbouring segments, and the tree of joints (§4.2.1).

use super::plane;
use crate::geom::{Hull, Plane};
use glam::DVec3;
use std::collections::BTreeMap;

/// A place where two parts touch: candidate for a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// The two parts, smaller index first.
    pub parts: (usize, usize),
    /// Positions of the vertices on the border.
    pub points: Vec<DVec3>,
    /// Length of the border, mm: larger interfaces make better joints.
    pub length_mm: f64,
}

/// A joint of the tree: `child` sits on `parent`.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// The part that carries the other.
    pub parent: usize,
    /// The part that sits on it.
    pub child: usize,
    /// The plane between them, normal from parent to child.
    pub plane: Plane,
}

/// Spanning trees of the interface graph, largest interfaces first (Kruskal), each rooted at its
/// smallest index. Links are ordered so that a parent's own link comes before its children's.
pub fn link_tree(part_hulls: &[&Hull], contacts: &[Contact]) -> Vec<Link> {
    let mut order: Vec<&Contact> = contacts.iter().collect();
    order.sort_by(|a, b| b.length_mm.total_cmp(&a.length_mm).then(a.parts.cmp(&b.parts)));
    let mut group: Vec<usize> = (0..part_hulls.len()).collect();
    let mut neighbours: BTreeMap<usize, Vec<(usize, &Contact)>> = BTreeMap::new();
    let mut joints = Vec::new();
    for contact in order {
        let (a, b) = contact.parts;
        let (ga, gb) = (group[a], group[b]);
        if ga != gb {
            group.iter_mut().filter(|g| **g == gb).for_each(|g| *g = ga);
            joints.push(contact);
            neighbours.entry(a).or_default().push((b, contact));
            neighbours.entry(b).or_default().push((a, contact));
        }
    }
    let mut seen = vec![false; part_hulls.len()];
    let mut links = Vec::new();
    for root in 0..part_hulls.len() {
        if seen[root] {
            continue;
        }
        seen[root] = true;
        let mut queue = std::collections::VecDeque::from([root]);
        while let Some(parent) = queue.pop_front() {
            for &(child, contact) in neighbours.get(&parent).map_or(&[][..], Vec::as_slice) {
                if !seen[child] {
                    seen[child] = true;
                    let (plane, _) = contact_plane(contact, [parent, child], part_hulls, &joints);
                    links.push(Link { parent, child, plane });
                    queue.push_back(child);
                }
            }
        }
    }
    links
}

/// The hulls, of which those of neighbours without a joint end at the plane between them, so that
/// their components do not stand in each other. Where that plane would take much of either, both
/// stay whole.
pub fn parted(part_hulls: &[&Hull], contacts: &[Contact], links: &[Link]) -> Vec<Hull> {
    let mut hulls: Vec<Hull> = part_hulls.iter().map(|&hull| hull.clone()).collect();
    let is_joint = |contact: &&Contact| {
        let (a, b) = contact.parts;
        links.iter().any(|l| (l.parent, l.child) == (a, b) || (l.parent, l.child) == (b, a))
    };
    let (joints, others): (Vec<&Contact>, Vec<&Contact>) = contacts.iter().partition(is_joint);
    for contact in others {
        let (a, b) = contact.parts;
        let (plane, cut_off) = contact_plane(contact, [a, b], part_hulls, &joints);
        if cut_off <= CLIP_SHARE
            && let (Some(first), Some(second)) = (hulls[a].clip(&plane), hulls[b].clip(&plane.flipped()))
        {
            (hulls[a], hulls[b]) = (first, second);
        }
    }
    hulls
}

/// A plane between neighbours without a joint may cut off at most this share of either.
const CLIP_SHARE: f64 = 0.2;

/// The plane of a contact, from the first of two parts to the second, and the share of either that it
/// cuts off. It spares the other places where they are joined, those of `joints` that are not this one.
fn contact_plane(
    contact: &Contact,
    [from, to]: [usize; 2],
    part_hulls: &[&Hull],
    joints: &[&Contact],
) -> (Plane, f64) {
    let kept = |part: usize| -> Vec<DVec3> {
        let others = joints.iter().filter(|c| c.parts != contact.parts);
        let own = others.filter(|c| c.parts.0 == part || c.parts.1 == part);
        own.flat_map(|c| c.points.iter().copied()).collect()
    };
    plane::between(&contact.points, part_hulls[from], part_hulls[to], [&kept(from), &kept(to)])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(at: DVec3, side: f64) -> Hull {
        let points: Vec<DVec3> = (0..8)
            .map(|k| at + DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64) * side)
            .collect();
        Hull::of_points(&points).unwrap()
    }

    #[test]
    fn three_cubes_in_a_row_make_a_chain() {
        let hulls: Vec<Hull> = (0..3).map(|k| cube(DVec3::X * 10.0 * f64::from(k), 10.0)).collect();
        let face = |x: f64| -> Vec<DVec3> {
            [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(|(y, z)| DVec3::new(x, y, z)).to_vec()
        };
        let contacts = [
            Contact { parts: (1, 2), points: face(20.0), length_mm: 40.0 },
            Contact { parts: (0, 1), points: face(10.0), length_mm: 40.0 },
            Contact { parts: (0, 2), points: face(15.0), length_mm: 1.0 },
        ];
        let links = link_tree(&hulls.iter().collect::<Vec<_>>(), &contacts);
        assert_eq!(links.iter().map(|l| (l.parent, l.child)).collect::<Vec<_>>(), [(0, 1), (1, 2)]);
        for (link, x) in links.iter().zip([10.0, 20.0]) {
            assert!((link.plane.normal() - DVec3::X).length() < 1e-9);
            assert!((link.plane.offset() - x).abs() < 1e-9);
        }
    }

    #[test]
    fn neighbours_without_a_joint_end_where_they_meet() {
        let hulls = [cube(DVec3::ZERO, 10.0), cube(DVec3::X * 9.0, 10.0), cube(DVec3::X * 30.0, 10.0)];
        let hulls: Vec<&Hull> = hulls.iter().collect();
        let face = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(|(y, z)| DVec3::new(9.5, y, z));
        let contact = Contact { parts: (0, 1), points: face.to_vec(), length_mm: 40.0 };
        let ends = |hulls: &[Hull]| (hulls[0].support(DVec3::X), -hulls[1].support(-DVec3::X));
        let apart = parted(&hulls, std::slice::from_ref(&contact), &[]);
        assert!((ends(&apart).0 - 9.5).abs() < 1e-9 && (ends(&apart).1 - 9.5).abs() < 1e-9);
        // A joint has its own plane; and a plane that would halve a hull is not heeded.
        let links = link_tree(&hulls, std::slice::from_ref(&contact));
        assert_eq!(ends(&parted(&hulls, std::slice::from_ref(&contact), &links)), (10.0, 9.0));
        let points = face.map(|p| p - DVec3::X * 5.0).to_vec();
        assert_eq!(ends(&parted(&hulls, &[Contact { points, ..contact }], &[])), (10.0, 9.0));
    }
}
