//! Targets moved so that their mirror plane is y = 0, and one across it x = 0, or z = 0; and solids moved back.

use super::angles::turn;
use super::solid::{Solid, side_normal};
use super::symmetry::{Crossing, Image, Symmetry, images, settled, wrapped};
use super::target::{JointTarget, Seat, Target};
use crate::geom::Hull;
use glam::{DAffine3, DMat3, DVec3};
use std::f64::consts::FRAC_PI_2;

/// Joints nearer to one another than this, in mm and radians, are the same.
const SAME: f64 = 1e-6;

impl Symmetry {
    /// The same plane through the origin: y = 0, with one across it as x = 0, or z = 0.
    fn straight(self) -> Self {
        match self {
            Symmetry::Upright { crossing, .. } => Symmetry::Upright {
                angle_rad: FRAC_PI_2,
                offset_mm: 0.0,
                crossing: crossing.map(|crossing| Crossing { offset_mm: 0.0, ..crossing }),
            },
            Symmetry::Level { .. } => Symmetry::Level { height_mm: 0.0 },
        }
    }

    /// The turn about z, and the shift after it, that make the plane straight.
    fn motion(self) -> (f64, DVec3) {
        match self {
            Symmetry::Upright { angle_rad, offset_mm, crossing } => {
                let across_mm = crossing.map_or(0.0, |crossing| crossing.offset_mm);
                (FRAC_PI_2 - angle_rad, DVec3::new(across_mm, -offset_mm, 0.0))
            }
            Symmetry::Level { height_mm } => (0.0, -DVec3::Z * height_mm),
        }
    }

    /// A seat moved with the plane.
    fn moved(self, seat: Seat) -> Seat {
        let (turn_rad, shift) = self.motion();
        match seat {
            Seat::Top { height_mm } => Seat::Top { height_mm: height_mm + shift.z },
            Seat::Bottom { height_mm } => Seat::Bottom { height_mm: height_mm + shift.z },
            Seat::Side { angle_rad, slope_rad, offset_mm } => {
                let angle_rad = wrapped(angle_rad + turn_rad);
                let offset_mm = offset_mm + side_normal(angle_rad, slope_rad).dot(shift);
                Seat::Side { angle_rad, slope_rad, offset_mm }
            }
        }
    }

    /// The motions of seats that take the straight solid to itself, but rest.
    fn seat_images(self) -> Vec<SeatImage> {
        match self {
            Symmetry::Upright { .. } => self.joint_images().iter().copied().map(SeatImage::About).collect(),
            Symmetry::Level { .. } => vec![SeatImage::Level],
        }
    }
}

/// How seats become their images; that of an image is the seat itself.
#[derive(Debug, Clone, Copy)]
enum SeatImage {
    /// Directions do.
    About(Image),
    /// In z = 0.
    Level,
}

impl SeatImage {
    fn of(self, seat: Seat) -> Seat {
        match (self, seat) {
            (Self::About(image), Seat::Side { angle_rad, slope_rad, offset_mm }) => {
                Seat::Side { angle_rad: image.angle(angle_rad), slope_rad, offset_mm }
            }
            (Self::About(_), end) => end,
            (Self::Level, Seat::Top { height_mm }) => Seat::Bottom { height_mm: -height_mm },
            (Self::Level, Seat::Bottom { height_mm }) => Seat::Top { height_mm: -height_mm },
            (Self::Level, Seat::Side { angle_rad, slope_rad, offset_mm }) => {
                Seat::Side { angle_rad, slope_rad: -slope_rad, offset_mm }
            }
        }
    }
}

fn is_same(a: Seat, b: Seat) -> bool {
    match (a, b) {
        (Seat::Top { height_mm: a }, Seat::Top { height_mm: b })
        | (Seat::Bottom { height_mm: a }, Seat::Bottom { height_mm: b }) => (a - b).abs() < SAME,
        (
            Seat::Side { angle_rad: a, slope_rad: s, offset_mm: o },
            Seat::Side { angle_rad: b, slope_rad: t, offset_mm: p },
        ) => turn(a, b).abs() < SAME && (s - t).abs() < SAME && (o - p).abs() < SAME,
        _ => false,
    }
}

/// A target's hull, joints and borders, moved so that its mirror plane is straight.
pub(super) struct Straight {
    symmetry: Symmetry,
    /// From the target's axes.
    motion: DAffine3,
    hull: Hull,
    joints: Vec<JointTarget>,
    borders: Vec<(DVec3, f64)>,
}

impl Straight {
    /// Moves a target. `None` where a joint has no image, or is its own in a level plane, in which
    /// it would be creased.
    pub(super) fn of(target: &Target, symmetry: Symmetry) -> Option<Self> {
        let (turn_rad, shift) = symmetry.motion();
        let motion = DAffine3::from_mat3_translation(DMat3::from_rotation_z(turn_rad), shift);
        let moved: Vec<Seat> = target.joints.iter().map(|j| symmetry.moved(j.seat)).collect();
        let half_spaces = |own: &[(DVec3, f64)]| -> Vec<(DVec3, f64)> {
            let turned = own.iter().map(|&(n, c)| (motion.transform_vector3(n), c));
            turned.map(|(n, c)| (n, c + n.dot(shift))).collect()
        };
        let joints = target.joints.iter().zip(&moved).map(|(joint, &seat)| {
            Some(JointTarget {
                seat: paired(symmetry, &moved, seat)?,
                cover: joint.cover.iter().map(|&p| motion.transform_point3(p)).collect(),
                within: half_spaces(&joint.within),
                price: joint.price,
            })
        });
        let joints = joints.collect::<Option<Vec<_>>>()?;
        let borders = half_spaces(&target.borders);
        Some(Self { symmetry, motion, hull: target.hull.moved(&motion), joints, borders })
    }

    /// The target moved.
    pub(super) fn target<'t>(&'t self, own: &Target<'t>) -> Target<'t> {
        Target {
            hull: &self.hull,
            filling: own.filling.map(|(filling, to_filling)| (filling, to_filling * self.motion.inverse())),
            joints: self.joints.clone(),
            borders: self.borders.clone(),
            symmetry: Some(self.symmetry.straight()),
            top_edges: own.top_edges,
            profile_vertices: own.profile_vertices,
            min_panel_mm: own.min_panel_mm,
            panel_worth: own.panel_worth,
            comfortable_mm: own.comfortable_mm,
        }
    }

    /// The solid moved back. Its joint panels have exactly the planes of the target's own joints.
    pub(super) fn back(&self, mut solid: Solid, own: &Target) -> Solid {
        let (turn_rad, shift) = self.symmetry.motion();
        let seats: Vec<(Seat, Seat)> =
            self.joints.iter().map(|j| j.seat).zip(own.joints.iter().map(|j| j.seat)).collect();
        let side = |seat: Seat| match seat {
            Seat::Side { angle_rad, slope_rad, offset_mm } => Some((angle_rad, slope_rad, offset_mm)),
            _ => None,
        };
        let sides: Vec<_> = seats.iter().filter_map(|s| Some((side(s.0)?, side(s.1)?))).collect();
        for chain in &mut solid.chains {
            let angle_rad = chain.angle_rad;
            for facet in &mut chain.facets {
                let place = (angle_rad, facet.slope_rad, facet.offset_mm);
                match sides.iter().find(|s| facet.is_joint && s.0 == place) {
                    Some((_, own)) => (facet.slope_rad, facet.offset_mm) = (own.1, own.2),
                    None => facet.offset_mm -= side_normal(angle_rad, facet.slope_rad).dot(shift),
                }
            }
            let locked = sides.iter().find(|s| chain.is_locked && s.0.0 == angle_rad);
            chain.angle_rad = locked.map_or(angle_rad - turn_rad, |s| s.1.0);
        }
        solid.top_mm -= shift.z;
        solid.bottom_mm -= shift.z;
        for (_, own) in &seats {
            match *own {
                Seat::Top { height_mm } => solid.top_mm = height_mm,
                Seat::Bottom { height_mm } => solid.bottom_mm = height_mm,
                Seat::Side { .. } => {}
            }
        }
        solid
    }
}

/// The seat, made exactly the image of its partners among all seats: the first of them counts. A regular shape has no
/// place for two that are images.
fn paired(symmetry: Symmetry, all: &[Seat], seat: Seat) -> Option<Seat> {
    let place = |seat: Seat| all.iter().position(|s| is_same(*s, seat));
    let own = place(seat)?;
    let others = symmetry.seat_images().into_iter().map(|image| Some((place(image.of(seat))?, image)));
    let others = others.collect::<Option<Vec<_>>>()?;
    if symmetry.is_regular() && others.iter().any(|other| other.0 != own) {
        return None;
    }
    let first = match others.iter().min_by_key(|other| other.0) {
        Some((other, image)) if *other < own => image.of(all[*other]),
        _ => all[own],
    };
    let Seat::Side { slope_rad, offset_mm, .. } = first else { return Some(first) };
    if symmetry.is_level() && others.iter().any(|other| other.0 == own) {
        return None;
    }
    // Several seats may have one direction, which must stay one.
    let Seat::Side { angle_rad: own_rad, .. } = seat else { return None };
    let angle_rad = all.iter().find_map(|s| {
        let Seat::Side { angle_rad, .. } = *s else { return None };
        let images = images(Some(symmetry)).iter().map(|image| image.angle(angle_rad));
        std::iter::once(angle_rad).chain(images).find(|a| turn(*a, own_rad).abs() < SAME)
    })?;
    Some(Seat::Side { angle_rad: settled(angle_rad, Some(symmetry), 2.0 * SAME), slope_rad, offset_mm })
}
