//! One part gets its fold direction, its joint planes, its component, and its place on its parent.

use super::link::Link;
use super::seat::{Seating, level_axis, seat_plane, seats, turn_onto};
use super::{Joint, ModelPart};
use crate::component::{
    Component, ConvertError, JointTarget, PanelId, PrincipalAxis, Target, choose, fewest,
};
use crate::geom::{Hull, Plane};
use crate::progress::Cancelled;
use glam::{DAffine3, DVec3};
use rayon::prelude::*;

/// What the user may set for one part.
#[derive(Debug, Clone, PartialEq)]
pub struct PartOptions {
    /// Name.
    pub name: String,
    /// Angle of the fold axis about the hull's first principal axis; found when not given.
    pub direction_rad: Option<f64>,
    /// Number of top edges.
    pub top_edges: usize,
    /// Most vertices of a profile.
    pub profile_vertices: usize,
    /// Distance from the hull that is close enough; then the two numbers above are the most that
    /// is used, and as few are used as will do.
    pub tolerance_mm: Option<f64>,
    /// Size below which panels are made fewer rather than smaller, mm.
    pub comfortable_mm: f64,
}

/// One segment to become a component.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Convex hull of the segment, in the mesh's scaled axes.
    pub hull: Hull,
    /// The user's wishes.
    pub options: PartOptions,
}

/// Why no model could be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// A component failed.
    #[error("component \"{name}\": {error}")]
    Component {
        /// Its name.
        name: String,
        /// What went wrong.
        error: ConvertError,
    },
    /// A joint panel got lost in the conversion.
    #[error("component \"{0}\" has no panel for its joint; give it another direction or more top edges")]
    NoJointPanel(String),
    /// The user stopped the work.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Directions tried about the principal axis.
const DIRECTIONS: usize = 12;
/// Price of a mm by which joint planes are moved off their interfaces.
const PLANE_PRICE: f64 = 0.3;
/// Price of a mm by which a joint panel misses its partner.
const JOINT_PRICE: f64 = 0.3;
/// A joint plane that leaves less than this share of a hull is not used to clip it.
const LEAST_SHARE: f64 = 0.15;

/// A part's component before it is placed.
#[derive(Debug, Clone)]
pub(super) struct Made {
    component: Component,
    frame: DAffine3,
    direction_rad: f64,
    /// Joint planes in the mesh's axes, outwards, and the panels on them: by the other part.
    joints: Vec<(usize, Plane, PanelId)>,
}

impl Made {
    pub(super) fn joint(&self, other: usize) -> Option<(Plane, PanelId)> {
        self.joints.iter().find(|j| j.0 == other).map(|j| (j.1, j.2))
    }

    /// The part before it is placed.
    pub(super) fn unplaced(&self, part: &Part) -> ModelPart {
        ModelPart {
            name: part.options.name.clone(),
            component: self.component.clone(),
            frame: self.frame,
            placement: DAffine3::IDENTITY,
            flat: DAffine3::from_translation(DVec3::Z * -self.component.bottom_mm()),
            direction_rad: self.direction_rad,
            joint: None,
        }
    }

    pub(super) fn panel_outline(&self, panel: PanelId) -> Vec<DVec3> {
        let panel = self.component.panels().panel(panel);
        panel.deployed_outline().into_iter().map(|p| self.frame.transform_point3(p)).collect()
    }
}

/// What one component is made from.
#[derive(Clone, Copy)]
pub(super) struct Builder<'a> {
    pub(super) parts: &'a [Part],
    pub(super) links: &'a [Link],
    pub(super) part: usize,
    /// The parent, where it has one.
    pub(super) carrier: Option<&'a Made>,
    pub(super) min_panel_mm: f64,
}

/// A fold direction with what follows from it.
struct Candidate {
    frame: DAffine3,
    hull: Hull,
    joints: Vec<(usize, JointTarget)>,
    plane_shift_mm: f64,
}

impl Builder<'_> {
    pub(super) fn make(&self) -> Result<Made, ModelError> {
        let part = &self.parts[self.part];
        let principal = PrincipalAxis::of_hull(&part.hull);
        let axes: Vec<DVec3> = match part.options.direction_rad {
            Some(angle) => vec![principal.fold_axis(angle)],
            None => {
                let angle = |k: usize| std::f64::consts::PI * k as f64 / DIRECTIONS as f64;
                (0..DIRECTIONS).map(|k| self.settle(principal.fold_axis(angle(k)))).collect()
            }
        };
        let candidates: Vec<Candidate> =
            axes.par_iter().map(|&a| self.candidate(principal.frame(a))).collect();
        let targets: Vec<(Target, f64)> =
            candidates.iter().map(|c| (self.target(c), PLANE_PRICE * c.plane_shift_mm)).collect();
        let fail = |error| ModelError::Component { name: part.options.name.clone(), error };
        let found = match part.options.tolerance_mm {
            Some(tolerance_mm) => fewest(&targets, tolerance_mm),
            None => choose(&targets),
        };
        let (best, component) = found.map_err(fail)?;
        let (chosen, target) = (&candidates[best], &targets[best].0);
        let joints = chosen
            .joints
            .iter()
            .map(|(other, joint)| {
                let panel = component.joint_panel(target, joint)?;
                Some((*other, seat_plane(&joint.seat).moved(&chosen.frame), panel))
            })
            .collect::<Option<Vec<_>>>()
            .ok_or_else(|| ModelError::NoJointPanel(part.options.name.clone()))?;
        let found = || principal.angle_rad(chosen.frame.transform_vector3(DVec3::Z));
        let direction_rad = part.options.direction_rad.unwrap_or_else(found);
        Ok(Made { component, frame: chosen.frame, direction_rad, joints })
    }

    /// The joint with the parent and the parent's component.
    pub(super) fn carrier(&self) -> Option<(&Link, &Made)> {
        let link = self.links.iter().find(|l| l.child == self.part)?;
        Some((link, self.carrier?))
    }

    /// Turns a fold axis that is almost across the parent's joint plane to be exactly across it.
    fn settle(&self, axis: DVec3) -> DVec3 {
        match self.parent_plane() {
            Some(plane) => level_axis(axis, plane.normal()),
            None => axis,
        }
    }

    /// The plane towards the parent, outwards, as the parent's component has it.
    pub(super) fn parent_plane(&self) -> Option<Plane> {
        self.carrier().and_then(|(_, made)| made.joint(self.part)).map(|(plane, _)| plane.flipped())
    }

    fn target<'h>(&self, candidate: &'h Candidate) -> Target<'h> {
        let options = &self.parts[self.part].options;
        Target {
            hull: &candidate.hull,
            joints: candidate.joints.iter().map(|j| j.1.clone()).collect(),
            symmetry: None,
            top_edges: options.top_edges,
            profile_vertices: options.profile_vertices,
            min_panel_mm: self.min_panel_mm,
            comfortable_mm: options.comfortable_mm,
        }
    }

    /// Seats of all joints in the axes of `frame`, and the hull clipped by them.
    fn candidate(&self, frame: DAffine3) -> Candidate {
        let to_local = frame.inverse();
        let mut others = Vec::new();
        let mut seatings = Vec::new();
        if let (Some((link, made)), Some(plane)) = (self.carrier(), self.parent_plane()) {
            let panel = made.joint(self.part).map(|j| made.panel_outline(j.1)).unwrap_or_default();
            let centre = panel.iter().sum::<DVec3>() / panel.len().max(1) as f64;
            others.push(link.parent);
            seatings.push(seating(&plane, self.centre(link, centre), &to_local, true));
        }
        for link in self.links.iter().filter(|l| l.parent == self.part) {
            others.push(link.child);
            let centre = self.centre(link, link.plane.normal() * link.plane.offset());
            seatings.push(seating(&link.plane, centre, &to_local, false));
        }
        let seats = seats(&seatings);
        let mut hull = self.parts[self.part].hull.moved(&to_local);
        let whole = hull.volume();
        let mut plane_shift_mm = 0.0;
        let mut joints = Vec::new();
        for ((&other, seating), &seat) in others.iter().zip(&seatings).zip(&seats) {
            let plane = seat_plane(&seat);
            if let Some(clipped) = hull.clip(&plane).filter(|h| h.volume() > LEAST_SHARE * whole) {
                hull = clipped;
            }
            let (cover, within) = self.partner(other, &plane, &frame, &to_local);
            plane_shift_mm += shift_mm(&cover, seating);
            joints.push((other, JointTarget { seat, cover, within, price: JOINT_PRICE }));
        }
        Candidate { frame, hull, joints, plane_shift_mm }
    }

    /// Middle of the place where two parts meet: of the sections of their hulls by the plane.
    fn centre(&self, link: &Link, fallback: DVec3) -> DVec3 {
        let sections = [link.parent, link.child].map(|p| self.parts[p].hull.section(&link.plane));
        let smaller =
            sections.into_iter().filter(|s| s.len() >= 3).min_by(|a, b| radius(a).total_cmp(&radius(b)));
        smaller.map_or(fallback, |s| s.iter().sum::<DVec3>() / s.len() as f64)
    }

    /// What a joint panel should cover (the section of a child's hull) or stay within (the edges
    /// of the parent's panel), in local axes.
    fn partner(
        &self,
        other: usize,
        plane: &Plane,
        frame: &DAffine3,
        to_local: &DAffine3,
    ) -> (Vec<DVec3>, Vec<(DVec3, f64)>) {
        let section = |p: usize| few_corners(self.parts[p].hull.section(&plane.moved(frame)));
        match self.carrier() {
            Some((link, made)) if link.parent == other => {
                let Some((_, panel)) = made.joint(self.part) else { return Default::default() };
                let outline: Vec<DVec3> =
                    made.panel_outline(panel).into_iter().map(|p| to_local.transform_point3(p)).collect();
                let edges = (0..outline.len()).filter_map(|k| {
                    let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
                    let outward = plane.normal().cross(b - a).try_normalize()?;
                    Some((outward, outward.dot(a)))
                });
                (Vec::new(), edges.collect())
            }
            _ => (section(other).into_iter().map(|p| to_local.transform_point3(p)).collect(), Vec::new()),
        }
    }
}

fn seating(plane: &Plane, centre: DVec3, to_local: &DAffine3, is_fixed: bool) -> Seating {
    Seating { plane: plane.moved(to_local), centre: to_local.transform_point3(centre), is_fixed }
}

/// Sections of round hulls are handled by so many of their corners.
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

fn radius(points: &[DVec3]) -> f64 {
    let centre = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max)
}

/// How far a joint's points are off its own plane, at most: turning the plane has moved them.
fn shift_mm(points: &[DVec3], seating: &Seating) -> f64 {
    points.iter().map(|p| seating.plane.distance(*p).abs()).fold(0.0, f64::max)
}

/// Places a child on its parent, deployed and flat; none where a joint panel got lost.
pub(super) fn seat_on(
    link: &Link,
    parent: &ModelPart,
    child: &mut ModelPart,
    made: [&Made; 2],
) -> Option<Joint> {
    let (up_plane, parent_panel) = made[0].joint(link.child)?;
    let (own_plane, child_panel) = made[1].joint(link.parent)?;
    let outline = made[1].panel_outline(child_panel);
    let centre = outline.iter().sum::<DVec3>() / outline.len() as f64;
    child.placement = parent.placement * turn_onto(&own_plane, &up_plane.flipped(), centre);
    let on = |p: &ModelPart, panel: PanelId| p.component.panels().panel(panel).clone();
    let (above, below) = (on(child, child_panel), on(parent, parent_panel));
    let relation = (parent.deployed() * below.deployed).inverse() * child.deployed() * above.deployed;
    child.flat = parent.flat * below.flat * relation * above.flat.inverse();
    Some(Joint { parent: link.parent, parent_panel, child_panel, support_ratio: 0.0 })
}
