//! Hulls of parts that are not joined, apart from each other.

use super::contact::Contact;
use super::link::{Between, Link, image_of, mirror_plane_between, mirrored_contacts};
use super::{Bump, PartId, Symmetry, plane, section};
use crate::geom::{Hull, Plane, polygon};
use std::collections::{BTreeMap, BTreeSet};

/// Hulls that leave each other room.
#[derive(Debug, Clone, PartialEq)]
pub struct Parted {
    /// The hulls.
    pub hulls: Vec<Hull>,
    /// Of each the planes beyond which others are, normals outwards.
    pub borders: Vec<Vec<Plane>>,
}

/// Cuts hulls so that their components do not overlap: neighbours without a joint at the plane between
/// them, others in the middle of their overlap. If such a plane would take much of either, both stay whole.
/// Mirror images stay mirror images.
pub fn parted(
    part_hulls: &[&Hull],
    contacts: &[Contact],
    links: &[Link],
    symmetry: Option<&Symmetry>,
) -> Parted {
    let mirrored = symmetry.map(|symmetry| mirrored_contacts(contacts, symmetry));
    let contacts = mirrored.as_deref().unwrap_or(contacts);
    let joints: Vec<(PartId, PartId)> =
        links.iter().map(|l| (l.parent.min(l.child), l.parent.max(l.child))).collect();
    let between = Between::new(part_hulls, contacts, &joints, symmetry);
    let mut hulls: Vec<Hull> = part_hulls.iter().map(|&hull| hull.clone()).collect();
    let mut borders: Vec<Vec<Plane>> = vec![Vec::new(); hulls.len()];
    let is_first = |pair: &(PartId, PartId)| image_of(*pair, symmetry) >= *pair && !joints.contains(pair);
    let touching = contacts.iter().map(|contact| (contact.parts, true));
    let all = (0..hulls.len()).flat_map(|b| (0..b).map(move |a| ((PartId(a), PartId(b)), false)));
    for ((a, b), is_touching) in touching.chain(all).filter(|(pair, _)| is_first(pair)) {
        let image = image_of((a, b), symmetry);
        let plane = match is_touching {
            true => between.plane(a, b),
            false => overlap(&hulls, links, (a, b), symmetry),
        };
        let Some((plane, _)) = plane.filter(|(_, cut_off)| *cut_off <= CLIP_SHARE) else {
            continue;
        };
        let gap_mm = GAP * libm::cbrt(hulls[a.0].volume().min(hulls[b.0].volume()));
        let mut clips = vec![(a, plane), (b, plane.flipped())];
        if let Some(symmetry) = symmetry
            && image != (a, b)
        {
            let twins = clips.clone().into_iter();
            clips.extend(twins.map(|(part, plane)| (symmetry.twin(part), symmetry.mirror().image(&plane))));
        }
        let smaller_mm3 = hulls[a.0].volume().min(hulls[b.0].volume());
        let is_little = |(part, left): (&PartId, &Hull)| {
            hulls[part.0].volume() - left.volume() <= MOST_TAKEN * smaller_mm3
        };
        let keeps = |clipped: &BTreeMap<PartId, Hull>| {
            clipped.iter().all(is_little) && keeps_joints(&hulls, clipped, links, JOINT_SHARE)
        };
        if let Some(clipped) = clipped(&hulls, &clips, gap_mm).filter(keeps) {
            clipped.into_iter().for_each(|(part, hull)| hulls[part.0] = hull);
            clips.into_iter().for_each(|(part, plane)| borders[part.0].push(plane));
        }
    }
    if let Some(symmetry) = symmetry {
        let changed = (0..hulls.len()).map(PartId).filter(|part| !borders[part.0].is_empty()).collect();
        symmetry.make_alike(&mut hulls, &changed);
    }
    Parted { hulls, borders }
}

/// What is left of hulls at least `gap_mm` behind the planes of their parts; `None` where nothing is left of one.
fn clipped(hulls: &[Hull], clips: &[(PartId, Plane)], gap_mm: f64) -> Option<BTreeMap<PartId, Hull>> {
    let mut clipped: BTreeMap<PartId, Hull> = BTreeMap::new();
    for (part, plane) in clips {
        let hull = clipped.get(part).unwrap_or(&hulls[part.0]).clip(&plane.shifted(-gap_mm))?;
        clipped.insert(*part, hull);
    }
    Some(clipped)
}

/// Whether what is left of hulls has room for their joints: a share of each one's section.
fn keeps_joints(hulls: &[Hull], clipped: &BTreeMap<PartId, Hull>, links: &[Link], share: f64) -> bool {
    let touched = links.iter().filter(|l| clipped.contains_key(&l.parent) || clipped.contains_key(&l.child));
    let mut areas = touched.map(|link| {
        let left = |part: PartId| clipped.get(&part).unwrap_or(&hulls[part.0]);
        let area =
            |parent, child| polygon::area(&section::shared_section(&link.plane, parent, child)).max(0.0);
        (area(&hulls[link.parent.0], &hulls[link.child.0]), area(left(link.parent), left(link.child)))
    });
    areas.all(|(before, after)| after >= share * before)
}

/// The same hulls, moved apart by the depth of the bumps that are left. `None` where that moves none, because the parts
/// that bump are joined.
pub fn farther(
    parted: Parted,
    links: &[Link],
    bumps: &[Bump],
    symmetry: Option<&Symmetry>,
) -> Option<Parted> {
    let Parted { mut hulls, mut borders } = parted;
    let mut changed = BTreeSet::new();
    let is_joint =
        |[a, b]: [PartId; 2]| links.iter().any(|l| [[a, b], [b, a]].contains(&[l.parent, l.child]));
    for &([a, b], depth_mm) in bumps.iter().filter(|bump| bump.0[0] != bump.0[1] && !is_joint(bump.0)) {
        let [first, second] = [a, b].map(|part| without_neighbours(&hulls, links, part));
        let Some((plane, overlap_mm)) = plane::between_faces(&first, &second) else { continue };
        // Half of what they bump by goes off each, from where they end now.
        let off_mm = (depth_mm - overlap_mm) / 2.0 + FARTHER_MM;
        let mut clips = vec![(a, plane.shifted(-off_mm)), (b, plane.flipped().shifted(-off_mm))];
        if let Some(symmetry) = symmetry {
            let twins = clips.clone().into_iter();
            clips.extend(twins.map(|(part, plane)| (symmetry.twin(part), symmetry.mirror().image(&plane))));
        }
        let share = |(part, plane): &(PartId, Plane)| {
            hulls[part.0].clip(plane).map_or(1.0, |left| 1.0 - left.volume() / hulls[part.0].volume())
        };
        if clips.iter().any(|clip| share(clip) > CLIP_SHARE) {
            continue;
        }
        let clipped = clipped(&hulls, &clips, 0.0);
        if let Some(clipped) = clipped.filter(|clipped| keeps_joints(&hulls, clipped, links, SMALLER_JOINT)) {
            changed.extend(clipped.keys().copied());
            clipped.into_iter().for_each(|(part, hull)| hulls[part.0] = hull);
            clips.into_iter().for_each(|(part, plane)| borders[part.0].push(plane));
        }
    }
    if let Some(symmetry) = symmetry {
        symmetry.make_alike(&mut hulls, &changed);
    }
    (!changed.is_empty()).then_some(Parted { hulls, borders })
}

/// What the joints of a part leave of its hull.
fn without_neighbours(hulls: &[Hull], links: &[Link], part: PartId) -> Hull {
    let own = links.iter().filter(|link| link.joins(part)).map(|link| link.plane_out_of(part));
    own.fold(hulls[part.0].clone(), |hull, plane| hull.clip(&plane).unwrap_or(hull))
}

/// The plane between two hulls that overlap where their joints leave them, normal from the first to the
/// second, and the larger share that it cuts off either; `None` where they do not overlap by much.
fn overlap(
    hulls: &[Hull],
    links: &[Link],
    (a, b): (PartId, PartId),
    symmetry: Option<&Symmetry>,
) -> Option<(Plane, f64)> {
    let [first, second] = [a, b].map(|part| without_neighbours(hulls, links, part));
    let (plane, depth_mm) = plane::apart(&first, &second)?;
    let twins = symmetry.filter(|symmetry| symmetry.twin(a) == b);
    let plane = twins.map_or(plane, |symmetry| mirror_plane_between(symmetry, &first, &second));
    (depth_mm > LEAST_OVERLAP_MM).then(|| (plane, plane::cut_off(&plane, &first, &second)))
}

/// So far from that plane either ends, as a share of the smaller one's size: components stand out of hulls.
/// Without it the bunny's feet stand 1.6 mm in its body.
const GAP: f64 = 0.02;

/// Parts that bumped end this much farther from each other, mm: a fit comes out a little different.
const FARTHER_MM: f64 = 0.3;

/// Hulls that overlap by less are left: components follow them no more exactly.
const LEAST_OVERLAP_MM: f64 = 0.3;

/// A plane between neighbours without a joint may cut off at most this share of either.
const CLIP_SHARE: f64 = 0.2;

/// And at most this much of the volume of the smaller one: the box of a van lost its lower end to the wheels beside it. Not bounded
/// from below by a case.
const MOST_TAKEN: f64 = 1.0;

/// And it leaves at least this share of what the sections of two joined hulls have in common: else a
/// finger's joint with a hand is cut off for the sake of the thumb.
const JOINT_SHARE: f64 = 0.8;
/// This much where parts bump: the model that comes of it is compared with the one before. With 0.8 none of the parts of
/// a chair, pliers and glasses move.
const SMALLER_JOINT: f64 = 0.4;

#[cfg(test)]
mod tests {
    use super::super::link::{link_tree, tests::cube};
    use super::*;
    use glam::DVec3;

    #[test]
    fn neighbours_without_a_joint_end_where_they_meet() {
        let hulls = [cube(DVec3::ZERO, 10.0), cube(DVec3::X * 9.0, 10.0), cube(DVec3::X * 30.0, 10.0)];
        let hulls: Vec<&Hull> = hulls.iter().collect();
        let face = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(|(y, z)| DVec3::new(9.5, y, z));
        let contact = Contact::border([0, 1], face.to_vec(), 40.0);
        let ends = |hulls: &[Hull]| (hulls[0].support(DVec3::X), -hulls[1].support(-DVec3::X));
        let apart = parted(&hulls, std::slice::from_ref(&contact), &[], None).hulls;
        let gap = 10.0 * GAP;
        assert!((ends(&apart).0 - 9.5 + gap).abs() < 1e-9 && (ends(&apart).1 - 9.5 - gap).abs() < 1e-9);
        // Those that overlap without touching, too.
        let apart = parted(&hulls, &[], &[], None).hulls;
        assert!((ends(&apart).0 - 9.5 + gap).abs() < 1e-9 && (ends(&apart).1 - 9.5 - gap).abs() < 1e-9);
        // A joint has its own plane.
        let links = link_tree(&hulls, std::slice::from_ref(&contact), None);
        assert_eq!(ends(&parted(&hulls, std::slice::from_ref(&contact), &links, None).hulls), (10.0, 9.0));
        // What both have is lost to neither: each gets half of it.
        let hulls = [cube(DVec3::ZERO, 10.0), cube(DVec3::X * 4.0, 10.0)];
        let hulls: Vec<&Hull> = hulls.iter().collect();
        let points: Vec<DVec3> = face.map(|p| p - DVec3::X * 2.5).to_vec();
        let (end, start) = ends(&parted(&hulls, &[Contact { points, ..contact.clone() }], &[], None).hulls);
        assert!((end - 7.0 + gap).abs() < 1e-9 && (start - 7.0 - gap).abs() < 1e-9, "{end} {start}");
        // A bar that goes through a cube stays whole: any plane would take much of it.
        let corner = |k: usize| DVec3::new([-20.0, 30.0][k & 1], [4.0, 6.0][k >> 1 & 1], [4.0, 6.0][k >> 2]);
        let bar = Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap();
        let hulls = [bar, cube(DVec3::ZERO, 10.0)];
        let hulls: Vec<&Hull> = hulls.iter().collect();
        let points = face.map(|p| p - DVec3::X * 4.5).to_vec();
        assert_eq!(ends(&parted(&hulls, &[Contact { points, ..contact }], &[], None).hulls), (30.0, 0.0));
    }

    /// The box of a van lost its lower end to the wheels.
    #[test]
    fn a_large_part_is_not_cut_for_a_small_one() {
        let corner = |k: usize| DVec3::new([0.0, 100.0][k & 1], [0.0, 40.0][k >> 1 & 1], [0.0, 40.0][k >> 2]);
        let van = Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap();
        let tops = [12.0, 36.0].map(|side| {
            let wheel = cube(DVec3::new(5.0, -2.0, 4.0 - side), side);
            let apart = parted(&[&van, &wheel], &[], &[], None).hulls;
            (-apart[0].support(-DVec3::Z), apart[1].support(DVec3::Z))
        });
        assert_eq!(tops[0], (0.0, 4.0));
        assert!(tops[1].0 > 2.0 && tops[1].1 < 2.0, "one of nearly the same size: {:?}", tops[1]);
    }

    #[test]
    fn parts_that_bump_end_farther_apart() {
        let parted = || Parted {
            hulls: vec![cube(DVec3::ZERO, 20.0), cube(DVec3::X * 20.5, 20.0)],
            borders: vec![Vec::new(); 2],
        };
        let gap_mm = |hulls: &[Hull]| -hulls[1].support(-DVec3::X) - hulls[0].support(DVec3::X);
        let moved = farther(parted(), &[], &[([0, 1].map(PartId), 1.5)], None).unwrap();
        // Components bump though hulls do not: by as much they move from where they end.
        assert!((gap_mm(&moved.hulls) - (0.5 + 1.5 + 2.0 * FARTHER_MM)).abs() < 1e-9);
        assert!(moved.borders.iter().all(|borders| borders.len() == 1));
        // Not by more than a part can lose, nor those that are joined.
        assert!(farther(parted(), &[], &[([0, 1].map(PartId), 15.0)], None).is_none());
        let hulls = parted().hulls;
        let face = [(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)].map(|(y, z)| DVec3::new(20.2, y, z));
        let contact = Contact::border([0, 1], face.to_vec(), 80.0);
        let links = link_tree(&hulls.iter().collect::<Vec<_>>(), &[contact], None);
        assert_eq!(links.len(), 1);
        assert!(farther(parted(), &links, &[([0, 1].map(PartId), 1.5)], None).is_none());
    }
}
