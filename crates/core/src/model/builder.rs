//! Makes the candidates of a part.
//!
//! Joint planes are known in advance, from where the parts touch. So the candidates of one part do not
//! depend on those of another part; [`super::pair`] gives a cost to each two of them.

use super::candidate::{Candidate, IN_PLANE, Search};
use super::demand::Demand;
use super::link::Link;
use super::seat::{Seating, level_axis, seat_plane, seats};
use super::square::square_axes;
use super::turned::TurningAxis;
use super::{ModelError, Part, PartId, Symmetry};
use crate::component::{
    self, Crossing, Finished, JointTarget, PrincipalAxis, Target, Turning, choose, fewest, finished,
};
use crate::geom::{Hull, Mirror, Plane, polygon};
use glam::{DAffine3, DVec2, DVec3};
use rayon::prelude::*;
use std::sync::Arc;

/// Directions tried about the principal axis, evenly over a half turn. All are finished: with the six alone that promise
/// most after a few steps, outlines of 24 meshes are 0.921 instead of 0.925; with 18, they are 0.924.
const DIRECTIONS: usize = 12;
/// Directions nearer to each other than this are one.
const SAME_RAD: f64 = std::f64::consts::PI / 180.0;
/// Price of a mm by which joint planes are moved off their interfaces.
const PLANE_PRICE: f64 = 0.3;
/// Price of a component that is not its own image in a second plane in which its hull is, as a share of its size.
/// With 0.03 a bottle leans by 0.28 % of its size, with 0.05 by 0.01. Not bounded from above by a case yet.
const LOPSIDED_PRICE: f64 = 0.05;
/// The same of a component that is not regular though its hull is turned. With 0.1 five mugs of ten lean and look dented,
/// for outlines that are alike by 0.97 instead of 0.96. Not bounded from above by a case yet.
const DENTED_PRICE: f64 = 0.3;
/// Price of a component across a mirror plane whose fold axis is halfway between upright and level, as a share of its size:
/// a teapot that leans to one side looks wrong, though its outlines are no worse. With 0.1 it still leans; not bounded from
/// above by a case yet.
const LEANING_PRICE: f64 = 0.2;
/// Joint planes whose normals are within this of the axis of a turned part are at its ends.
const END_RAD: f64 = 0.2;
/// Directions whose part in the mirror plane is shorter are across it.
const LEAST_ALONG: f64 = 1e-3;
/// A joint plane that leaves less than this share of a hull is not used to clip it.
const LEAST_SHARE: f64 = 0.15;

/// What the candidates of one part are made from.
#[derive(Clone, Copy)]
pub(super) struct Builder<'a> {
    pub(super) parts: &'a [Part],
    /// All joints.
    pub(super) links: &'a [Link],
    pub(super) part: PartId,
    /// Of parts whose component is to be its own mirror image.
    pub(super) symmetry: Option<&'a Symmetry>,
    /// Another plane that it should be its own image in.
    pub(super) crossing: Option<&'a Mirror>,
    pub(super) search: Search,
    pub(super) min_panel_mm: f64,
}

/// A fold direction with what follows from it.
struct Direction<'e> {
    frame: DAffine3,
    hull: Hull,
    joints: Vec<(PartId, JointTarget)>,
    plane_shift_mm: f64,
    /// How the component is to be even about its fold axis, if it is.
    even: Option<&'e Even>,
}

/// A fold axis about which a component is even.
struct Even {
    axis: DVec3,
    /// A mirror plane through it, across the other one.
    across: Plane,
    turning: Turning,
    /// What the component is to match, where that is not the part's own hull.
    hull: Option<Hull>,
}

impl<'a> Builder<'a> {
    /// The part's joints.
    pub(super) fn own_links(&self) -> impl Iterator<Item = &'a Link> + use<'a> {
        let part = self.part;
        self.links.iter().filter(move |link| link.joins(part))
    }

    /// The candidates, the cheapest first, but those in directions that `before` has; their ids are for the
    /// caller to give.
    pub(super) fn make(&self, before: &[Candidate]) -> Result<Vec<Candidate>, ModelError> {
        let part = &self.parts[self.part.0];
        let principal = PrincipalAxis::of_hull(&part.hull);
        let firmness = self.search.firmness();
        let demands: Vec<Demand> =
            self.own_links().map(|link| Demand::new(self.parts, self.part, link, firmness)).collect();
        let axes = self.axes(&principal);
        let even: Vec<Even> = self.crossed().into_iter().chain(self.turned(&principal)).collect();
        let most = even.iter().map(|even| even.turning).max();
        let even = even.into_iter().map(|even| (even.axis, Some(even)));
        let tried: Vec<(DVec3, Option<Even>)> =
            even.chain(axes.into_iter().map(|axis| (axis, None))).collect();
        let directions = tried
            .par_iter()
            .map(|(axis, even)| self.direction(principal.frame(*axis), even.as_ref(), &demands));
        let directions: Vec<Direction> = directions.collect();
        let mut targets: Vec<(Target, f64)> =
            directions.iter().map(|d| (self.target(d), self.own_mm(d, most))).collect();
        let lost = || ModelError::NoJointPanel(part.options.name.clone());
        let fail = |error| ModelError::Component { name: part.options.name.clone(), error };
        if let Some(tolerance_mm) = part.options.tolerance_mm {
            let (top_edges, profile_vertices) = fewest(&targets, tolerance_mm).map_err(fail)?;
            for (target, _) in &mut targets {
                (target.top_edges, target.profile_vertices) = (top_edges, profile_vertices);
            }
        }
        let is_new = |direction: &Direction| {
            let axis = direction.frame.matrix3.z_axis;
            // Firm joints make another component in the same direction.
            self.search == Search::Firm
                || before.iter().all(|made| axis.dot(made.frame.matrix3.z_axis).abs() < libm::cos(SAME_RAD))
        };
        let (directions, mut targets): (Vec<&Direction>, Vec<(Target, f64)>) =
            directions.iter().zip(targets).filter(|(direction, _)| is_new(direction)).unzip();
        let mut found = finished(&targets);
        if !before.is_empty() && found.is_empty() {
            return Ok(Vec::new());
        }
        if found.is_empty() && self.mirror().is_some() {
            targets.iter_mut().for_each(|(target, _)| target.symmetry = None);
            found = finished(&targets);
        }
        if found.is_empty() {
            return Err(choose(&targets).map_or_else(fail, |_| lost()));
        }
        let made = |finished: Finished| {
            let (direction, target) = (directions[finished.target], &targets[finished.target].0);
            self.candidate(&principal, direction, target, finished)
        };
        let candidates: Vec<Candidate> = found.into_iter().filter_map(made).collect();
        if candidates.is_empty() && before.is_empty() { Err(lost()) } else { Ok(candidates) }
    }

    /// The candidate of a component; `None` where a joint has no panel.
    fn candidate(
        &self,
        principal: &PrincipalAxis,
        direction: &Direction<'_>,
        target: &Target<'_>,
        finished: Finished,
    ) -> Option<Candidate> {
        let seated = |(other, joint): &(PartId, JointTarget)| {
            let panel = finished.component.joint_panel(target, joint)?;
            Some((*other, seat_plane(&joint.seat).moved(&direction.frame), panel))
        };
        let joints = direction.joints.iter().map(seated).collect::<Option<Vec<_>>>()?;
        let axis = direction.frame.transform_vector3(DVec3::Z);
        let own = self.parts[self.part.0].options.direction_rad;
        Some(Candidate {
            id: 0,
            component: Arc::new(finished.component),
            frame: direction.frame,
            direction_rad: own.unwrap_or_else(|| principal.angle_rad(axis)),
            is_own_image: self.symmetry.is_some() && target.symmetry.is_some(),
            cost_mm: finished.cost_mm,
            joints,
        })
    }

    /// The fold axes to try: the user's, or some about the principal axis, those square to a box and, in a wide search, the
    /// principal axis: a finger that folds along itself keeps its outline, but spreads wide. All are turned so that joint
    /// planes that they almost cross at a right angle are crossed exactly.
    fn axes(&self, principal: &PrincipalAxis) -> Vec<DVec3> {
        if let Some(angle) = self.parts[self.part.0].options.direction_rad {
            return vec![principal.fold_axis(angle)];
        }
        let angle = |k: usize| std::f64::consts::PI * k as f64 / DIRECTIONS as f64;
        let mirror = self.mirror();
        let tried: Vec<DVec3> = match mirror.map(|mirror| mirror.plane().normal()) {
            None => {
                let about = (0..DIRECTIONS).map(|k| principal.fold_axis(angle(k)));
                let along = (self.search != Search::Promising).then(|| principal.axis());
                about.chain(along).collect()
            }
            Some(across) => {
                let up = mirror.map_or(DVec3::Z, |mirror| mirror.along(DVec3::Z));
                let up =
                    if up.length() > LEAST_ALONG { up.normalize() } else { across.any_orthonormal_vector() };
                let side = across.cross(up);
                let in_plane = (0..DIRECTIONS).map(|k| up * libm::cos(angle(k)) + side * libm::sin(angle(k)));
                std::iter::once(across).chain(in_plane).collect()
            }
        };
        let mut axes: Vec<DVec3> = Vec::with_capacity(tried.len() + 1);
        axes.extend(self.crossed().map(|crossed| crossed.axis));
        let square = square_axes(&self.parts[self.part.0].hull, principal, mirror);
        for axis in tried.into_iter().chain(square) {
            let axis = self.settled(axis);
            if axes.iter().all(|a| a.dot(axis).abs() < libm::cos(SAME_RAD)) {
                axes.push(axis);
            }
        }
        axes
    }

    /// The mirror plane that the component is to be its own image in, if any; the first of two.
    fn mirror(&self) -> Option<&'a Mirror> {
        self.symmetry.map(Symmetry::mirror).or(self.crossing)
    }

    /// The line that lies in both mirror planes, where there are two and edges enough for both.
    fn crossed(&self) -> Option<Even> {
        let own = &self.parts[self.part.0].options;
        if own.top_edges < component::Symmetry::LEAST_CROSSED_EDGES || own.direction_rad.is_some() {
            return None;
        }
        let planes = [self.symmetry?.mirror().plane(), self.crossing?.plane()];
        let axis = planes[0].normal().cross(planes[1].normal()).try_normalize()?;
        Some(Even { axis, across: *planes[1], turning: Turning::Half, hull: None })
    }

    /// The axis about which the part is turned, where its joints are at the ends of it, or at sides in the mirror plane.
    fn turned(&self, principal: &PrincipalAxis) -> Option<Even> {
        let own = &self.parts[self.part.0];
        if own.options.direction_rad.is_some() {
            return None;
        }
        let mirror = self.mirror()?;
        let turning = Turning::of_regular(own.options.top_edges)?;
        let normals: Vec<DVec3> =
            self.own_links().map(|link| link.plane_out_of(self.part).normal()).collect();
        let is_end = |normal: DVec3, axis: DVec3| normal.dot(axis).abs() > libm::cos(END_RAD);
        let is_side = |normal: DVec3| normal.dot(mirror.plane().normal()).abs() < IN_PLANE;
        // Most parts have a joint elsewhere for every axis, which is found sooner than how round they are.
        let with_sides = |axis: DVec3| {
            let (_, sides): (Vec<DVec3>, Vec<DVec3>) = normals.iter().partition(|n| is_end(**n, axis));
            sides.iter().all(|n| is_side(*n)).then_some((axis, sides))
        };
        let crossed = self.crossed().map(|crossed| crossed.axis);
        let long = principal.axis();
        let others = normals.iter().copied().chain([DVec3::Z, long, long.cross(mirror.plane().normal())]);
        // What is left of a direction across the plane is rounding.
        let in_plane = others.map(|axis| mirror.along(axis)).filter(|axis| axis.length() > LEAST_ALONG);
        let axes = crossed.into_iter().chain(in_plane.map(DVec3::normalize));
        let turned = TurningAxis::of_hull(&own.hull, mirror, axes.filter_map(with_sides))?;
        let across = Plane::through(turned.centre, turned.axis.cross(mirror.plane().normal()))?;
        Some(Even { axis: turned.axis, across, turning, hull: turned.round(&own.hull) })
    }

    /// An axis turned onto the normal of the nearest joint plane, where that is almost level for it.
    fn settled(&self, axis: DVec3) -> DVec3 {
        let normals = self.own_links().map(|l| l.plane.normal());
        // The axis of a component that is its own image stays in the mirror plane or at a right angle to it.
        let keeps = |normal: &DVec3| {
            let across = self.mirror().map(|mirror| normal.dot(mirror.plane().normal()).abs());
            across.is_none_or(|across| across < IN_PLANE)
        };
        let normals = normals.filter(keeps);
        let nearest = normals.max_by(|a, b| axis.dot(*a).abs().total_cmp(&axis.dot(*b).abs()));
        nearest.map_or(axis, |normal| level_axis(axis, normal))
    }

    /// What a direction costs by itself, mm of error, where the most even component could be `most`.
    fn own_mm(&self, direction: &Direction<'_>, most: Option<Turning>) -> f64 {
        let size_mm = libm::cbrt(self.parts[self.part.0].hull.volume());
        let of_lopsided = match most {
            _ if direction.even.map(|even| even.turning) >= most => 0.0,
            Some(most) if most.is_regular() => DENTED_PRICE,
            _ => LOPSIDED_PRICE,
        };
        let up = direction.frame.matrix3.z_axis.z.abs().min(1.0);
        let of_leaning =
            if self.mirror().is_some() { LEANING_PRICE * 2.0 * up * (1.0 - up * up).sqrt() } else { 0.0 };
        PLANE_PRICE * direction.plane_shift_mm + (of_lopsided + of_leaning) * size_mm
    }

    fn target<'h>(&self, direction: &'h Direction<'_>) -> Target<'h>
    where
        'a: 'h,
    {
        let options = &self.parts[self.part.0].options;
        let symmetry = self.mirror_plane(direction);
        let is_halved = matches!(symmetry, Some(component::Symmetry::Upright { crossing: None, .. }));
        let is_end = self.own_links().count() == 1;
        Target {
            hull: &direction.hull,
            filling: self.parts[self.part.0].filling.as_deref().map(|filling| (filling, direction.frame)),
            joints: direction.joints.iter().map(|j| j.1.clone()).collect(),
            borders: self.borders(&direction.frame),
            top_edges: options.most_top_edges(is_halved && is_end),
            profile_vertices: options.profile_vertices,
            min_panel_mm: self.min_panel_mm,
            panel_worth: options.panel_worth,
            comfortable_mm: options.comfortable_mm,
            symmetry,
        }
    }

    /// The part's borders in the axes of `frame`.
    fn borders(&self, frame: &DAffine3) -> Vec<(DVec3, f64)> {
        let to_local = frame.inverse();
        let local = self.parts[self.part.0].borders.iter().map(|plane| plane.moved(&to_local));
        local.map(|plane| (plane.normal(), plane.offset())).collect()
    }

    /// The mirror plane of a component in its own axes, with one across it where it is to have two.
    fn mirror_plane(&self, direction: &Direction<'_>) -> Option<component::Symmetry> {
        let to_local = direction.frame.inverse();
        let plane = self.mirror()?.plane().moved(&to_local);
        let (normal, offset_mm) = (plane.normal(), plane.offset());
        if normal.z.abs() > 0.5 {
            return Some(component::Symmetry::Level { height_mm: offset_mm * normal.z.signum() });
        }
        let across = normal.truncate().perp();
        let crossing = direction.even.map(|&Even { across: ref plane, turning, .. }| {
            let other = plane.moved(&to_local);
            let offset_mm = other.offset() * across.dot(other.normal().truncate()).signum();
            Crossing { offset_mm, turning }
        });
        Some(component::Symmetry::Upright { angle_rad: normal.truncate().to_angle(), offset_mm, crossing })
    }

    /// Seats of all joints in the axes of `frame`, and the hull clipped by them. `demands` are those of the
    /// joints in their order.
    fn direction<'e>(&self, frame: DAffine3, even: Option<&'e Even>, demands: &[Demand]) -> Direction<'e> {
        let to_local = frame.inverse();
        let mut others: Vec<PartId> = Vec::new();
        let mut seatings = Vec::new();
        for (link, demand) in self.own_links().zip(demands) {
            let is_child = link.child == self.part;
            let plane = link.plane_out_of(self.part);
            others.push(if is_child { link.parent } else { link.child });
            seatings.push(Seating {
                plane: plane.moved(&to_local),
                centre: to_local.transform_point3(demand.centre),
                image: None,
                comes_first: is_child,
            });
        }
        for (k, seating) in seatings.iter_mut().enumerate() {
            seating.image = match (self.symmetry, self.crossing) {
                (Some(symmetry), _) => others.iter().position(|o| *o == symmetry.twin(others[k])),
                (None, Some(_)) => Some(k),
                (None, None) => None,
            };
        }
        let seats = seats(&seatings, &self.search.snap());
        let own = &self.parts[self.part.0].hull;
        let mut hull = even.and_then(|even| even.hull.as_ref()).unwrap_or(own).moved(&to_local);
        let whole = hull.volume();
        let mut plane_shift_mm = 0.0;
        let mut joints = Vec::new();
        for (((&other, seating), &seat), demand) in others.iter().zip(&seatings).zip(&seats).zip(demands) {
            let plane = seat_plane(&seat);
            if let Some(clipped) = hull.clip(&plane).filter(|h| h.volume() > LEAST_SHARE * whole) {
                hull = clipped;
            }
            let section = self.section(other, &plane.moved(&frame));
            let section: Vec<DVec3> = section.into_iter().map(|p| to_local.transform_point3(p)).collect();
            plane_shift_mm += shift_mm(&section, seating);
            joints.push((other, demand.target(seat, section)));
        }
        Direction { frame, hull, joints, plane_shift_mm, even }
    }

    /// Corners of the section of another part's hull by a joint plane. Those of images are images.
    fn section(&self, other: PartId, plane: &Plane) -> Vec<DVec3> {
        let with_image = |own: Vec<DVec3>, mirror: &Mirror| -> Vec<DVec3> {
            let both = own.iter().copied().chain(own.iter().map(|p| mirror.point(*p)));
            let flat: Vec<DVec2> = both.map(|p| plane.flat(p)).collect();
            polygon::convex_hull(&flat).into_iter().map(|p| plane.lifted(p)).collect()
        };
        let cut = |p: PartId, plane: &Plane| few_corners(self.parts[p.0].hull.section(plane));
        let own = match self.symmetry.map(|symmetry| (symmetry.mirror(), symmetry.twin(other))) {
            Some((mirror, twin)) if twin < other => {
                cut(twin, &mirror.image(plane)).into_iter().map(|p| mirror.point(p)).collect()
            }
            Some((mirror, twin)) if twin == other => with_image(cut(other, plane), mirror),
            _ => cut(other, plane),
        };
        self.crossing.into_iter().fold(own, with_image)
    }
}

/// Corners that stand for the section of a round hull.
const SECTION_CORNERS: usize = 24;

/// Corners of a convex polygon that are about evenly spread along its outline.
fn few_corners(outline: Vec<DVec3>) -> Vec<DVec3> {
    let count = outline.len();
    if count <= SECTION_CORNERS {
        return outline;
    }
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    let mut along = 0.0;
    let lengths: Vec<f64> = ends.map(|(a, b)| (along, along += a.distance(*b)).0).collect();
    let place = |length: f64| (length / along * SECTION_CORNERS as f64) as usize;
    let is_first = |k: &usize| *k == 0 || place(lengths[*k]) != place(lengths[*k - 1]);
    (0..count).filter(is_first).map(|k| outline[k]).collect()
}

/// How far a joint's points are off its own plane, at most: turning the plane has moved them.
fn shift_mm(points: &[DVec3], seating: &Seating) -> f64 {
    points.iter().map(|p| seating.plane.distance(*p).abs()).fold(0.0, f64::max)
}
