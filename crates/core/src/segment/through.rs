//! Parts that pass through others, as the one wing of a plane does through its fuselage.

use super::edit::Cut;
use super::surface::Surface;
use super::{Parts, SegmentId, Segmentation};
use crate::geom::{Hull, Mirror, Plane, bounds, eigen};
use glam::DVec3;
use std::sync::Arc;

/// A part that passes through another one sticks out of it on both sides by this share of its length or more.
const STICKS_OUT: f64 = 0.15;
/// Least share of it that is inside the other one, between the two sides. A part that only leans on the other has half.
const INSIDE: f64 = 0.8;
/// The mirror plane is where such a part is cut, if its direction is that of the plane's normal up to this.
const ALONG: f64 = 1e-3;

impl Parts {
    /// The same with each part that passes through another one cut in two within it: by one plane no more than one side of
    /// it would be kept, or half of the other part. If any is, all get other names.
    #[must_use]
    pub fn cut_where_they_pass_through(self) -> Self {
        let cuts = cuts(&self);
        if cuts.is_empty() {
            return self;
        }
        let mirror = self.segmentation().mirror().copied();
        let mut mesh = self.mesh().clone();
        let mut labels = self.segmentation().labels();
        let mut count = self.names().len() as u32;
        for (part, plane) in cuts {
            let cut = Cut::new(&mesh, &labels, part as u32, &plane);
            let front = |(label, side)| if side == Some(true) { count } else { label };
            labels = cut.labels.into_iter().zip(cut.is_in_front).map(front).collect();
            count += 1;
            mesh = Arc::new(cut.mesh);
        }
        let segmentation = Segmentation::of_labels(&mesh, &labels, count as usize, mirror);
        Self::new(mesh, segmentation)
    }
}

/// Parts that pass through another one, each with a plane within that.
fn cuts(parts: &Parts) -> Vec<(usize, Plane)> {
    let (mesh, segmentation) = (parts.mesh(), parts.segmentation());
    let surface = Surface::of_faces(mesh.positions(), mesh.faces());
    if surface.components(|_| 0).1 < 2 {
        return Vec::new();
    }
    let mut points: Vec<Vec<DVec3>> = vec![Vec::new(); parts.names().len()];
    for (face, id) in segmentation.face_segments().iter().enumerate() {
        points[id.0 as usize].extend(mesh.corners(face));
    }
    let hulls: Vec<Option<Hull>> = points.iter().map(|points| Hull::of_points(points).ok()).collect();
    let borders = segmentation.interfaces(mesh);
    let is_joined = |a: usize, b: usize| {
        let [a, b] = [a.min(b), a.max(b)].map(|part| SegmentId(part as u32));
        borders.contains_key(&(a, b))
    };
    let mirror = segmentation.mirror().map(|plane| plane.mirror);
    let way = |a: usize, b: usize| {
        let [one, other] = [hulls[a].as_ref()?, hulls[b].as_ref()?];
        if a == b || is_joined(a, b) { None } else { way_through(one, other, mirror.as_ref()) }
    };
    let volume = |part: usize| hulls[part].as_ref().map_or(0.0, Hull::volume);
    let through = |part: usize| {
        let others = (0..hulls.len()).filter_map(|other| Some((other, way(part, other)?)));
        // Of two that pass through each other the smaller one is cut.
        let mut through = others.filter(|&(other, _)| {
            way(other, part).is_none() || (volume(part), other) < (volume(other), part)
        });
        Some((part, through.next()?.1))
    };
    (0..hulls.len()).filter_map(through).collect()
}

/// A plane across a hull, where it is within another one that it passes through.
fn way_through(hull: &Hull, other: &Hull, mirror: Option<&Mirror>) -> Option<Plane> {
    let [own, others] = [hull, other].map(|hull| bounds(hull.vertices().iter().copied()));
    if own.0.cmpgt(others.1).any() || others.0.cmpgt(own.1).any() {
        return None;
    }
    let facets = other.facets().iter();
    let inside = facets.map(|facet| facet.plane()).try_fold(hull.clone(), |left, plane| left.clip(plane))?;
    let along = eigen::symmetric(eigen::covariance(hull.vertices())).1[2];
    let [all, within] = [hull, &inside].map(|hull| [-hull.support(-along), hull.support(along)]);
    let least = STICKS_OUT * (all[1] - all[0]);
    if within[0] - all[0] < least || all[1] - within[1] < least {
        return None;
    }
    let [low, high] = [within[0], within[1]].map(|at| Plane::through(along * at, along));
    let between = hull.clip(&low?.flipped())?.clip(&high?)?;
    if inside.volume() < INSIDE * between.volume() {
        return None;
    }
    let is_across = |plane: &&Plane| {
        let cosine = plane.normal().dot(along);
        let at = plane.offset() * cosine.signum();
        cosine.abs() > 1.0 - ALONG && (within[0]..within[1]).contains(&at)
    };
    let middle = mirror.map(Mirror::plane).filter(is_across).copied();
    middle.or_else(|| Plane::through(along * f64::midpoint(within[0], within[1]), along))
}

#[cfg(test)]
mod tests {
    use super::super::shapes::{cuboid, mesh, together};
    use super::*;
    use crate::mesh::MirrorPlane;

    /// Boxes, each a part, given by their lower corners and sizes.
    fn boxes(all: &[([f64; 3], [f64; 3])], mirror: Option<Plane>) -> Parts {
        let shape = |&(low, size): &([f64; 3], [f64; 3])| {
            let low = DVec3::from_array(low);
            cuboid(low, low + DVec3::from_array(size))
        };
        let shapes: Vec<_> = all.iter().map(shape).collect();
        let face_segment = (0..12 * all.len()).map(|face| SegmentId(face as u32 / 12)).collect();
        let plane = |plane| MirrorPlane { mirror: Mirror::new(plane), error_percent: 0.0, crossing: None };
        let segmentation = Segmentation { face_segment, count: all.len(), mirror: mirror.map(plane) };
        Parts::new(Arc::new(mesh(&together(&shapes))), segmentation)
    }

    const FUSELAGE: ([f64; 3], [f64; 3]) = ([-8.0, -50.0, -8.0], [16.0, 100.0, 16.0]);
    const WING: ([f64; 3], [f64; 3]) = ([-60.0, -10.0, -2.0], [120.0, 20.0, 4.0]);

    /// The fuselage lost all that was above the wing.
    #[test]
    fn a_wing_through_a_fuselage_becomes_two() {
        let parts = boxes(&[FUSELAGE, WING], Plane::through(DVec3::ZERO, DVec3::X));
        let cut = parts.cut_where_they_pass_through();
        assert_eq!(cut.names(), ["body", "right-1", "left-1"]);
        for (face, id) in cut.segmentation().face_segments().iter().enumerate() {
            let [least, most] = [[-8.0, 8.0], [0.0, 60.0], [-60.0, 0.0]][id.0 as usize];
            assert!(cut.mesh().corners(face).iter().all(|at| (least..=most).contains(&at.x)), "{face}");
        }
    }

    #[test]
    fn of_two_that_cross_the_smaller_one_is_cut() {
        let [long, short] = [100.0, 80.0].map(|half| ([-half, -5.0, -5.0], [2.0 * half, 10.0, 10.0]));
        let across = |(low, size): ([f64; 3], [f64; 3])| {
            let turned = |[x, y, z]: [f64; 3]| [y, x, z];
            (turned(low), turned(size))
        };
        for all in [[long, across(short)], [across(short), long]] {
            let cut = boxes(&all, None).cut_where_they_pass_through();
            let (low, high) = cut.mesh().bounds();
            assert_eq!((cut.names().len(), low.x, high.x), (3, -100.0, 100.0));
            let is_whole = |id: u32| {
                let own = cut.segmentation().face_segments().iter().enumerate().filter(|(_, of)| of.0 == id);
                let (low, high) = bounds(own.flat_map(|(face, _)| cut.mesh().corners(face)));
                high.x - low.x == 200.0
            };
            assert!((0..3).any(is_whole), "the longer one is one part");
        }
    }

    #[test]
    fn what_ends_within_another_or_leans_on_it_is_whole() {
        let ([x, y, z], size) = WING;
        let to_the_middle = ([x, y, z], [60.0, size[1], size[2]]);
        let half_above = ([x, y, 6.5], size);
        let hardly_out = ([-60.0, y, z], [72.0, size[1], size[2]]);
        for other in [to_the_middle, half_above, hardly_out] {
            let parts = boxes(&[FUSELAGE, other], None);
            assert_eq!(parts.clone().cut_where_they_pass_through(), parts, "{other:?}");
        }
    }
}
