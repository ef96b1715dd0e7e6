//! Hulls of the parts of a mesh before they leave each other room, and where they touch.

use glam::{DAffine3, DVec3};
use rayon::prelude::*;
use std::collections::BTreeMap;
use tatamu_core::geom::{Hull, HullError, Plane};
use tatamu_core::mesh::MirrorPlane;
use tatamu_core::model::{self, Contact, Interface, Link, PartId, Parted, Symmetry};
use tatamu_core::segment::{Details, Parts, SegmentId, Solids};

/// The same parts, but made one where the plane of a joint would take more off two than one hull adds; with their hulls.
pub(super) fn without_needless_joints(mut divided: Parts) -> (Parts, Touching) {
    loop {
        let touching = Touching::of(&divided);
        let solid = &touching.solid;
        let pairs = touching.needless();
        if pairs.is_empty() {
            return (divided, touching);
        }
        let segment = |part| solid.part_of_segment.iter().position(|p| *p == Some(part));
        let pairs: Vec<(usize, usize)> =
            pairs.into_iter().filter_map(|(a, b)| Some((segment(a)?, segment(b)?))).collect();
        divided = divided.fused(&pairs);
    }
}

/// Hulls of all parts, before they leave each other room, and where they touch.
#[derive(Debug, Clone)]
pub(super) struct Touching {
    /// The hulls.
    pub(super) solid: SegmentHulls,
    /// Which of them are mirror images of each other, if they all are.
    pub(super) symmetry: Option<Symmetry>,
    /// The tree of joints between them.
    pub(super) links: Vec<Link>,
    contacts: Vec<Contact>,
}

impl Touching {
    /// Those of these parts.
    pub(super) fn of(divided: &Parts) -> Self {
        let Solids { hulls, near, feet, details } = divided.solids();
        let mut solid = SegmentHulls { details, ..segment_hulls(divided, hulls) };
        let segmentation = divided.segmentation();
        let symmetry = segmentation.mirror().and_then(|plane| solid.mirrored(divided, plane));
        let contacts = contacts(divided, &solid.part_of_segment, near, &feet);
        let links = model::link_tree(&solid.hulls.iter().collect::<Vec<_>>(), &contacts, symmetry.as_ref());
        Self { solid, symmetry, links, contacts }
    }

    /// Those of the same parts with all lengths times `factor`.
    #[must_use]
    pub(super) fn resized(&self, factor: f64) -> Self {
        let scale = DAffine3::from_scale(DVec3::splat(factor));
        let contact = |contact: &Contact| Contact {
            points: contact.points.iter().map(|&point| factor * point).collect(),
            length_mm: factor * contact.length_mm,
            ..*contact
        };
        let link = |link: &Link| Link { plane: link.plane.moved(&scale), ..*link };
        let hulls = self.solid.hulls.iter().map(|hull| hull.moved(&scale)).collect();
        Self {
            solid: self.solid.with(hulls),
            symmetry: self.symmetry.as_ref().map(|symmetry| symmetry.moved(&scale)),
            links: self.links.iter().map(link).collect(),
            contacts: self.contacts.iter().map(contact).collect(),
        }
    }

    /// The hulls when they leave each other room, thick enough for their joints, and the planes beyond which others are.
    pub(super) fn parted(&self) -> (Vec<Hull>, Vec<Vec<Plane>>) {
        let (hulls, symmetry) = (self.hulls(), self.symmetry.as_ref());
        let Parted { hulls, borders } = model::parted(&hulls, &self.contacts, &self.links, symmetry);
        (model::sturdy(hulls, &self.links, symmetry), borders)
    }

    fn hulls(&self) -> Vec<&Hull> {
        self.solid.hulls.iter().collect()
    }

    /// Pairs that are better one: see [`model::needless`].
    pub(super) fn needless(&self) -> Vec<(PartId, PartId)> {
        model::needless(&self.hulls(), &self.links)
    }

    /// The same without a joint between two parts, and between their images; `None` where a part would be left alone.
    pub(super) fn without(&self, gone: &Link) -> Option<Self> {
        let image = |part: PartId| self.symmetry.as_ref().map_or(part, |symmetry| symmetry.twin(part));
        let pair = [gone.parent, gone.child];
        let is_gone = |contact: &Contact| {
            let (a, b) = contact.parts;
            [pair, pair.map(image)].iter().any(|pair| *pair == [a, b] || *pair == [b, a])
        };
        // What touches keeps its room, but joins nothing.
        let contacts: Vec<Contact> =
            self.contacts.iter().filter(|contact| !is_gone(contact)).cloned().collect();
        let links = model::link_tree(&self.hulls(), &contacts, self.symmetry.as_ref());
        (links.len() == self.links.len()).then(|| Self { links, ..self.clone() })
    }
}

/// Hulls of the segments that have one.
#[derive(Debug, Clone)]
pub(super) struct SegmentHulls {
    /// The hulls, by the ids of their parts.
    pub(super) hulls: Vec<Hull>,
    /// The part of each segment; none of those that are flat.
    pub(super) part_of_segment: Vec<Option<PartId>>,
    /// Number of faces of each segment that is flat.
    pub(super) flat: Vec<usize>,
    /// What the hulls do without.
    pub(super) details: Details,
}

impl SegmentHulls {
    /// The same segments with other hulls.
    pub(super) fn with(&self, hulls: Vec<Hull>) -> Self {
        let (part_of_segment, flat) = (self.part_of_segment.clone(), self.flat.clone());
        Self { hulls, part_of_segment, flat, details: self.details }
    }

    /// The names of the segments that have a hull.
    pub(super) fn names(&self, of_segment: &[String]) -> Vec<String> {
        let has_hull = self.part_of_segment.iter().zip(of_segment);
        has_hull.filter(|(part, _)| part.is_some()).map(|(_, name)| name.clone()).collect()
    }

    /// Makes the hulls of twins images of each other, each round its own points and the images of
    /// its twin's, and the others their own images; `None`, and all as they were, where not every
    /// hull has a twin.
    fn mirrored(&mut self, divided: &Parts, plane: &MirrorPlane) -> Option<Symmetry> {
        let mirror = &plane.mirror;
        let twins = divided.segmentation().twins(divided.mesh())?;
        let of_segment = self.part_of_segment.iter().zip(twins);
        let twin = of_segment.filter_map(|(part, twin)| part.map(|_| self.part_of_segment[twin.0 as usize]));
        let symmetry = Symmetry::new(*mirror, twin.collect::<Option<Vec<PartId>>>()?)?;
        let alike = |part: PartId| {
            let (hull, twin) = (&self.hulls[part.0], symmetry.twin(part));
            if twin == part {
                return Some((part, mirror.symmetrized(hull).ok()?));
            }
            let images = self.hulls[twin.0].vertices().iter().map(|&p| mirror.point(p));
            let points: Vec<DVec3> = hull.vertices().iter().copied().chain(images).collect();
            Some((part, Hull::of_points(&points).ok()?))
        };
        let alike: Vec<(PartId, Hull)> =
            symmetry.representatives().into_par_iter().map(alike).collect::<Option<_>>()?;
        alike.into_iter().for_each(|(part, hull)| symmetry.set(&mut self.hulls, part, hull));
        Some(match plane.crossing {
            Some(crossing) => symmetry.crossed(crossing, &mut self.hulls),
            None => symmetry,
        })
    }
}

fn segment_hulls(parts: &Parts, hulls: Vec<Result<Hull, HullError>>) -> SegmentHulls {
    let mut solid = SegmentHulls {
        hulls: Vec::new(),
        part_of_segment: Vec::new(),
        flat: Vec::new(),
        details: Details::default(),
    };
    for (hull, faces) in hulls.into_iter().zip(parts.face_counts()) {
        match hull {
            Ok(hull) => {
                solid.part_of_segment.push(Some(PartId(solid.hulls.len())));
                solid.hulls.push(hull);
            }
            Err(_) => {
                solid.part_of_segment.push(None);
                solid.flat.push(faces);
            }
        }
    }
    solid
}

fn contacts(
    divided: &Parts,
    part_of_segment: &[Option<PartId>],
    near: BTreeMap<(SegmentId, SegmentId), Vec<DVec3>>,
    feet: &BTreeMap<(SegmentId, SegmentId), Vec<DVec3>>,
) -> Vec<Contact> {
    let mesh = divided.mesh();
    let part = |s: SegmentId| part_of_segment[s.0 as usize];
    let borders = divided.segmentation().borders(mesh);
    let touching = near.into_iter().filter(|(pair, _)| !borders.contains_key(pair)).map(|(pair, points)| {
        let length_mm = rim_mm(&points);
        (pair, points, Interface::Bodies, length_mm)
    });
    let bordering = borders.iter().map(|(&pair, interface)| {
        let border = || interface.vertices().iter().map(|&v| mesh.positions()[v as usize]).collect();
        let points = feet.get(&pair).cloned().unwrap_or_else(border);
        (pair, points, Interface::Border, interface.length())
    });
    bordering
        .chain(touching)
        .filter_map(|((a, b), points, interface, length_mm)| {
            Some(Contact { parts: (part(a)?, part(b)?), points, interface, length_mm })
        })
        .collect()
}

/// Length of the circle whose points are as far from their centre as these, on the whole.
fn rim_mm(points: &[DVec3]) -> f64 {
    let n = points.len().max(1) as f64;
    let centre = points.iter().sum::<DVec3>() / n;
    let square = points.iter().map(|p| p.distance_squared(centre)).sum::<f64>() / n;
    std::f64::consts::TAU * square.sqrt()
}
