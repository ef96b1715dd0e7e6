//! Contact planes between neighbouring segments, and the tree of joints (§4.2.1).

use super::contact::{Contact, Interface};
use super::ground::Ground;
use super::{PartId, Symmetry, plane, section};
use crate::geom::{Hull, Mirror, Plane, polygon};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A joint of the tree: `child` sits on `parent`.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// The part that carries the other.
    pub parent: PartId,
    /// The part that sits on it.
    pub child: PartId,
    /// The plane between them, normal from parent to child.
    pub plane: Plane,
}

impl Link {
    /// Whether a part is one of the two.
    pub(super) fn joins(&self, part: PartId) -> bool {
        self.parent == part || self.child == part
    }

    /// The plane, normal out of one of the two parts.
    pub(super) fn plane_out_of(&self, part: PartId) -> Plane {
        if self.child == part { self.plane.flipped() } else { self.plane }
    }
}

/// Spanning trees of the interface graph, largest interfaces first (Kruskal), each rooted at its
/// smallest id. Links are ordered so that a parent's own link comes before its children's.
///
/// With a symmetry the trees are their own mirror images, and so are the planes: mirrored contacts
/// are taken together; twins are joined to each other only where nothing across the mirror plane
/// joins them. Roots, but for the first part, then are parts across the plane where there are some.
pub fn link_tree(part_hulls: &[&Hull], contacts: &[Contact], symmetry: Option<&Symmetry>) -> Vec<Link> {
    let mirrored = symmetry.map(|symmetry| mirrored_contacts(contacts, symmetry));
    let contacts = mirrored.as_deref().unwrap_or(contacts);
    let mut neighbours: BTreeMap<PartId, Vec<PartId>> = BTreeMap::new();
    let sizes = sizes_mm2(part_hulls, contacts, symmetry);
    let joints = joined(contacts, &sizes, part_hulls.len(), symmetry);
    for &(a, b) in &joints {
        neighbours.entry(a).or_default().push(b);
        neighbours.entry(b).or_default().push(a);
    }
    let between = Between::new(part_hulls, contacts, &joints, symmetry);
    let mut roots: Vec<PartId> = (0..part_hulls.len()).map(PartId).collect();
    roots.sort_by_key(|&p| p != PartId(0) && symmetry.is_some_and(|s| !s.is_across(p)));
    let mut seen = vec![false; part_hulls.len()];
    let mut links = Vec::new();
    for root in roots {
        if seen[root.0] {
            continue;
        }
        seen[root.0] = true;
        let mut queue = std::collections::VecDeque::from([root]);
        while let Some(parent) = queue.pop_front() {
            for &child in neighbours.get(&parent).map_or(&[][..], Vec::as_slice) {
                if !seen[child.0]
                    && let Some((plane, _)) = between.plane(parent, child)
                {
                    seen[child.0] = true;
                    links.push(Link { parent, child, plane });
                    queue.push_back(child);
                }
            }
        }
    }
    links
}

/// Where one of two parts lies across a mirror plane that the other does not, their joint does if that turns it by less:
/// the neck of a snowman whose head has a nose.
const TILT_RAD: f64 = 10.0_f64.to_radians();

/// A section counts at least as one of this share of the border's length.
const LEAST_SECTION: f64 = 0.01;

/// How large interfaces are: the border's length times the width of the section in which the two hulls meet
/// there. A thumb's border with a finger may be longer than that with the palm, but their hulls hardly meet there.
fn sizes_mm2(part_hulls: &[&Hull], contacts: &[Contact], symmetry: Option<&Symmetry>) -> Vec<f64> {
    let between = Between::new(part_hulls, contacts, &[], symmetry);
    let size_mm2 = |contact: &Contact| {
        let (a, b) = contact.parts;
        let area_mm2 = between.plane(a, b).map_or(0.0, |(plane, _)| {
            let [first, second] = [a, b].map(|part| section::flat_section(&plane, part_hulls[part.0]));
            // Hulls that only touch have a face on the plane, and no section.
            if first.is_empty() || second.is_empty() {
                let flat: Vec<DVec2> = contact.points.iter().map(|p| plane.flat(*p)).collect();
                return polygon::area(&polygon::convex_hull(&flat));
            }
            polygon::area(&polygon::intersect_convex(&first, &second))
        });
        let width_mm = area_mm2.max(0.0).sqrt();
        contact.length_mm * width_mm.max(LEAST_SECTION * contact.length_mm)
    };
    contacts.par_iter().map(size_mm2).collect()
}

/// Pairs that are joined, largest interfaces first.
fn joined(
    contacts: &[Contact],
    sizes_mm2: &[f64],
    parts: usize,
    symmetry: Option<&Symmetry>,
) -> Vec<(PartId, PartId)> {
    let mut order: Vec<(&Contact, &f64)> = contacts.iter().zip(sizes_mm2).collect();
    order.sort_by(|a, b| b.1.total_cmp(a.1).then(a.0.parts.cmp(&b.0.parts)));
    let order: Vec<&Contact> = order.into_iter().map(|(contact, _)| contact).collect();
    let twin = |p: PartId| symmetry.map_or(p, |s| s.twin(p));
    // A part and its twin count as one at first.
    let mut group: Vec<PartId> = (0..parts).map(|p| PartId(p).min(twin(PartId(p)))).collect();
    let mut pairs = Vec::new();
    for contact in &order {
        let image = image_of(contact.parts, symmetry);
        if contact.parts <= image && join(&mut group, contact.parts) {
            pairs.push(contact.parts);
            if image != contact.parts {
                pairs.push(image);
            }
        }
    }
    let mut group: Vec<PartId> = (0..parts).map(PartId).collect();
    for &pair in &pairs {
        join(&mut group, pair);
    }
    let (twins, others): (Vec<&Contact>, Vec<&Contact>) =
        order.into_iter().partition(|c| twin(c.parts.0) == c.parts.1);
    let rest = twins.into_iter().chain(others).map(|c| c.parts);
    pairs.extend(rest.filter(|&pair| join(&mut group, pair)));
    pairs
}

/// Makes one group of those of two parts; `false` where it was one.
fn join(group: &mut [PartId], (a, b): (PartId, PartId)) -> bool {
    let (ga, gb) = (group[a.0], group[b.0]);
    group.iter_mut().filter(|g| **g == gb).for_each(|g| *g = ga);
    ga != gb
}

/// The mirror image of a pair, smaller id first.
pub(super) fn image_of((a, b): (PartId, PartId), symmetry: Option<&Symmetry>) -> (PartId, PartId) {
    let (a, b) = symmetry.map_or((a, b), |s| (s.twin(a), s.twin(b)));
    (a.min(b), a.max(b))
}

/// The contacts so that each one's image is one too, of the same length and with the images of its
/// points.
pub(super) fn mirrored_contacts(contacts: &[Contact], symmetry: &Symmetry) -> Vec<Contact> {
    /// Points, the sum of lengths and their number, and how they touch.
    type Orbit = (Vec<DVec3>, f64, usize, Interface);
    let mirror = symmetry.mirror();
    // Of a pair and its image, the smaller.
    let mut orbits: BTreeMap<(PartId, PartId), Orbit> = BTreeMap::new();
    for contact in contacts {
        let image = image_of(contact.parts, Some(symmetry));
        let (points, length_mm, count, interface) = orbits.entry(contact.parts.min(image)).or_default();
        *interface = contact.interface.max(*interface);
        *length_mm += contact.length_mm;
        *count += 1;
        if contact.parts <= image {
            points.extend(&contact.points);
        }
        if contact.parts >= image {
            points.extend(contact.points.iter().map(|&p| mirror.point(p)));
        }
    }
    let both = orbits.into_iter().flat_map(|(parts, (points, sum_mm, count, interface))| {
        let (image, length_mm) = (image_of(parts, Some(symmetry)), sum_mm / count as f64);
        let other = (image != parts).then(|| {
            let points = points.iter().map(|&p| mirror.point(p)).collect();
            Contact { parts: image, points, interface, length_mm }
        });
        [Some(Contact { parts, points, interface, length_mm }), other].into_iter().flatten()
    });
    both.collect()
}

/// The planes between parts that touch.
pub(super) struct Between<'a> {
    part_hulls: &'a [&'a Hull],
    contacts: BTreeMap<(PartId, PartId), &'a Contact>,
    /// Pairs that are joined, smaller id first.
    joints: &'a [(PartId, PartId)],
    symmetry: Option<&'a Symmetry>,
}

impl<'a> Between<'a> {
    pub(super) fn new(
        part_hulls: &'a [&'a Hull],
        contacts: &'a [Contact],
        joints: &'a [(PartId, PartId)],
        symmetry: Option<&'a Symmetry>,
    ) -> Self {
        let contacts = contacts.iter().map(|c| (c.parts, c)).collect();
        Self { part_hulls, contacts, joints, symmetry }
    }

    /// Where a part is joined to each other than one.
    fn kept(&self, part: PartId, other: PartId) -> Vec<Vec<DVec3>> {
        let is_other = |pair: &&(PartId, PartId)| **pair != (part.min(other), part.max(other));
        let own = self.joints.iter().filter(is_other).filter(|p| p.0 == part || p.1 == part);
        own.filter_map(|pair| self.contacts.get(pair)).map(|contact| contact.points.clone()).collect()
    }

    /// The plane between two parts, normal from the first to the second, and the larger share that
    /// it cuts off either hull; `None` where they do not touch.
    pub(super) fn plane(&self, from: PartId, to: PartId) -> Option<(Plane, f64)> {
        let contact = self.contacts.get(&(from.min(to), from.max(to)))?;
        let [first, second] = [from, to].map(|p| self.part_hulls[p.0]);
        let kept = [self.kept(from, to), self.kept(to, from)];
        let ground = || Ground::new(first, second, [&kept[0], &kept[1]]);
        let Some(symmetry) = self.symmetry else {
            return Some(plane::between(contact, &ground(), &[]));
        };
        let image = (symmetry.twin(from), symmetry.twin(to));
        if image == (to, from) {
            let plane = mirror_plane_between(symmetry, first, second);
            return Some((plane, plane::cut_off(&plane, first, second)));
        }
        if image < (from, to) {
            let (plane, cut_off) = self.plane(image.0, image.1)?;
            return Some((symmetry.mirror().image(&plane), cut_off));
        }
        let across = symmetry.mirrors_across(&[from, to]);
        let ground = ground();
        let fitted = |across: &[Mirror]| plane::between(contact, &ground, across);
        let own = fitted(&across);
        let crossing = symmetry.crossing(from).or(symmetry.crossing(to)).filter(|m| !across.contains(m));
        let upright = crossing.map(|mirror| fitted(&[&across[..], &[*mirror]].concat()));
        let is_near = |(plane, _): &(Plane, f64)| plane.normal().dot(own.0.normal()) > libm::cos(TILT_RAD);
        Some(upright.filter(is_near).unwrap_or(own))
    }
}

/// The mirror plane, its normal from a hull to its image.
pub(super) fn mirror_plane_between(symmetry: &Symmetry, first: &Hull, second: &Hull) -> Plane {
    let plane = *symmetry.mirror().plane();
    let is_ahead = plane.distance(second.centroid()) > plane.distance(first.centroid());
    if is_ahead { plane } else { plane.flipped() }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::geom::Mirror;

    pub(in crate::model) fn cube(at: DVec3, side: f64) -> Hull {
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
            Contact::border([1, 2], face(20.0), 40.0),
            Contact::border([0, 1], face(10.0), 40.0),
            Contact::border([0, 2], face(15.0), 1.0),
        ];
        let links = link_tree(&hulls.iter().collect::<Vec<_>>(), &contacts, None);
        assert_eq!(links.iter().map(|l| (l.parent.0, l.child.0)).collect::<Vec<_>>(), [(0, 1), (1, 2)]);
        for (link, x) in links.iter().zip([10.0, 20.0]) {
            assert!((link.plane.normal() - DVec3::X).length() < 1e-9);
            assert!((link.plane.offset() - x).abs() < 1e-9);
        }
    }

    /// A thumb with a longer border to a finger, which it meets along an edge only, than to the palm.
    #[test]
    fn a_part_is_joined_where_the_hulls_meet_most() {
        let (palm, finger) = (cube(DVec3::ZERO, 40.0), cube(DVec3::new(0.0, 0.0, 40.0), 10.0));
        let thumb = cube(DVec3::new(10.0, 10.0, 40.0), 10.0);
        let square = |x: f64| -> Vec<DVec3> {
            [(x, x), (x + 10.0, x), (x + 10.0, x + 10.0), (x, x + 10.0)]
                .map(|(u, v)| DVec3::new(u, v, 40.0))
                .to_vec()
        };
        let edge =
            vec![DVec3::new(10.0, 10.0, 40.0), DVec3::new(10.0, 10.0, 50.0), DVec3::new(9.9, 10.1, 45.0)];
        let contacts = [
            Contact::border([0, 1], square(0.0), 40.0),
            Contact::border([0, 2], square(10.0), 40.0),
            Contact::border([1, 2], edge, 45.0),
        ];
        let links = link_tree(&[&palm, &finger, &thumb], &contacts, None);
        assert_eq!(links.iter().map(|l| (l.parent.0, l.child.0)).collect::<Vec<_>>(), [(0, 1), (0, 2)]);
    }

    /// A body across x = 0 with arms and a pair of feet that touch each other.
    #[test]
    fn mirrored_contacts_make_mirrored_joints() {
        let mirror = Mirror::new(Plane::through(DVec3::ZERO, DVec3::X).unwrap());
        let symmetry = Symmetry::new(mirror, [0, 2, 1, 4, 3, 5].map(PartId).to_vec()).unwrap();
        let arm = cube(DVec3::new(5.0, -5.0, 2.0), 10.0);
        let foot = cube(DVec3::new(0.0, -5.0, -10.0), 10.0);
        let body = cube(DVec3::new(-5.0, -5.0, 0.0), 10.0);
        let head = cube(DVec3::new(-5.0, -5.0, 10.0), 10.0);
        let hulls = [body, arm.clone(), arm.reflected(&mirror), foot.clone(), foot.reflected(&mirror), head];
        let square = |at: DVec3, u: DVec3, v: DVec3| vec![at + u + v, at + u - v, at - u - v, at - u + v];
        let contact = |(a, b), points, length_mm| Contact::border([a, b], points, length_mm);
        let contacts = [
            contact((0, 1), square(DVec3::new(5.0, 0.0, 6.0), DVec3::new(0.2, 3.0, 0.0), DVec3::Z), 30.0),
            contact((0, 2), square(DVec3::new(-5.1, 0.0, 6.0), DVec3::Y * 3.0, DVec3::Z), 20.0),
            contact((0, 3), square(DVec3::new(3.0, 0.0, 0.0), DVec3::Y * 3.0, DVec3::X), 9.0),
            contact((3, 4), square(DVec3::new(0.1, 0.0, -5.0), DVec3::Y, DVec3::Z), 50.0),
            contact((0, 5), square(DVec3::new(0.3, 0.0, 10.0), DVec3::new(4.0, 0.0, 0.3), DVec3::Y), 40.0),
        ];
        let hulls: Vec<&Hull> = hulls.iter().collect();
        let links = link_tree(&hulls, &contacts, Some(&symmetry));
        assert_eq!(links.len(), 5);
        for link in &links {
            assert_eq!(link.parent, PartId(0));
            let image = links.iter().find(|l| l.child == symmetry.twin(link.child)).unwrap();
            let plane = mirror.image(&link.plane);
            assert!((image.plane.normal() - plane.normal()).length() < 1e-12);
            assert!((image.plane.offset() - plane.offset()).abs() < 1e-12);
        }
        assert!(links.iter().find(|l| l.child == PartId(5)).unwrap().plane.normal().x.abs() < 1e-12);
        // Nothing else joins the feet.
        let feet = link_tree(&hulls, &contacts[3..4], Some(&symmetry));
        assert_eq!(feet.len(), 1);
        assert!(feet[0].plane.normal() == -DVec3::X && feet[0].plane.offset() == 0.0);
    }
}
