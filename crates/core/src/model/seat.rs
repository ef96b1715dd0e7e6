//! Seats of joint panels on a component: which panel they are, with planes turned where needed.
//!
//! On each side of a joint one panel must be parallel to the joint plane. Where the plane is
//! almost horizontal for the parent it becomes its top or bottom panel and the plane is turned to
//! be exactly horizontal (the paper does the same, §5.1); else it is a side panel, whose chain has
//! the direction of the plane's normal. Planes in almost the same direction share a chain.

use crate::component::{Seat, side_normal};
use crate::geom::Plane;
use glam::{DVec2, DVec3};

/// Up to which angles planes are turned, so that they are seated on fewer panels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snap {
    /// A joint plane within this angle of horizontal is made the top or bottom panel.
    level_rad: f64,
    /// Chains of joint panels differ by at least this; closer ones are merged.
    chain_rad: f64,
    /// Joint panels of one chain differ in slope by at least this; closer ones are merged.
    panel_rad: f64,
}

impl Snap {
    /// Few panels, none of them narrow.
    pub const WIDE: Self = Self::of_degrees(20.0, 20.0, 12.0);
    /// Each joint where the parts touch, even if panels are narrow: the wing and the tail of a plane, both at the side
    /// of the body, do not fit on one panel.
    pub const NARROW: Self = Self::of_degrees(5.0, 5.0, 3.0);

    const fn of_degrees(level: f64, chain: f64, panel: f64) -> Self {
        Self { level_rad: level.to_radians(), chain_rad: chain.to_radians(), panel_rad: panel.to_radians() }
    }
}

/// A fold axis within this angle of a joint plane's normal is turned onto it.
const LEVEL_RAD: f64 = Snap::WIDE.level_rad;

/// A joint plane to be seated: plane with outward normal in the component's axes, and a point where
/// the joint is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seating {
    /// Plane, normal out of the component.
    pub plane: Plane,
    /// Centre of the interface.
    pub centre: DVec3,
    /// In a component that is its own mirror image, the index of the joint that is the image of this
    /// one, or of this one itself.
    pub image: Option<usize>,
    /// The plane towards the parent keeps its place where others have to be turned to share a panel.
    pub comes_first: bool,
}

impl Seating {
    fn slope_rad(&self) -> f64 {
        libm::asin(self.plane.normal().z.clamp(-1.0, 1.0))
    }

    fn angle_rad(&self) -> f64 {
        self.plane.normal().truncate().to_angle().rem_euclid(std::f64::consts::TAU)
    }

    fn is_level(&self, snap: &Snap) -> bool {
        self.plane.normal().z.abs() > libm::cos(snap.level_rad)
    }
}

/// The seat of every joint of a component, in order. A plane that is almost but not exactly horizontal
/// gets a horizontal seat: the other part is then turned with it.
pub fn seats(joints: &[Seating], snap: &Snap) -> Vec<Seat> {
    let joints = &evened(joints, snap)[..];
    let mut out: Vec<Option<Seat>> = joints.iter().map(|joint| fixed_seat(joint, snap)).collect();
    for up in [true, false] {
        let level = |k: &usize| joints[*k].is_level(snap) && (joints[*k].plane.normal().z > 0.0) == up;
        let members: Vec<usize> = (0..joints.len()).filter(level).collect();
        let fixed = members.iter().find(|&&k| joints[k].comes_first).map(|&k| joints[k].centre.z);
        let mean = members.iter().map(|&k| joints[k].centre.z).sum::<f64>() / members.len().max(1) as f64;
        let height_mm = fixed.unwrap_or(mean);
        for k in members {
            out[k] = Some(if up { Seat::Top { height_mm } } else { Seat::Bottom { height_mm } });
        }
    }
    // Joints that are their own images first, so that others that share with them stay images.
    let mut order: Vec<usize> = (0..joints.len()).collect();
    order.sort_by_key(|&k| joints[k].image != Some(k));
    for k in order {
        if out[k].is_none() {
            out[k] = Some(side_seat(&joints[k], &out, snap));
        }
    }
    out.into_iter().flatten().collect()
}

/// The joints, of which images of each other that would share a chain or a panel are turned halfway to
/// one another.
fn evened(joints: &[Seating], snap: &Snap) -> Vec<Seating> {
    let mut evened = joints.to_vec();
    for k in 0..joints.len() {
        let Some(image) = joints[k].image.filter(|&image| image > k) else { continue };
        let (own, other) = (&joints[k], &joints[image]);
        if own.is_level(snap)
            || other.is_level(snap)
            || !is_near(own.angle_rad(), other.angle_rad(), snap.chain_rad)
        {
            continue;
        }
        let across = own.plane.normal().truncate().normalize_or_zero()
            + other.plane.normal().truncate().normalize_or_zero();
        let (own_slope, other_slope) = (own.slope_rad(), other.slope_rad());
        let slopes = match is_near(own_slope, other_slope, snap.panel_rad) {
            true => [0.5 * (own_slope + other_slope); 2],
            false => [own_slope, other_slope],
        };
        for (joint, slope_rad) in [k, image].into_iter().zip(slopes) {
            let normal = (across.normalize_or(DVec2::X) * libm::cos(slope_rad)).extend(libm::sin(slope_rad));
            let plane = Plane::through(evened[joint].centre, normal);
            evened[joint].plane = plane.unwrap_or(evened[joint].plane);
        }
    }
    evened
}

fn is_near(a: f64, b: f64, limit: f64) -> bool {
    DVec2::from_angle(a).angle_to(DVec2::from_angle(b)).abs() < limit
}

/// A fixed sloped plane keeps its direction exactly.
fn fixed_seat(joint: &Seating, snap: &Snap) -> Option<Seat> {
    (joint.comes_first && !joint.is_level(snap)).then(|| Seat::Side {
        angle_rad: joint.angle_rad(),
        slope_rad: joint.slope_rad(),
        offset_mm: joint.plane.offset(),
    })
}

/// The side panel of a free joint: its own direction, or that of a seat close to it.
fn side_seat(joint: &Seating, others: &[Option<Seat>], snap: &Snap) -> Seat {
    let (own_angle, own_slope) = (joint.angle_rad(), joint.slope_rad());
    let sides = || {
        others.iter().flatten().filter_map(|seat| match *seat {
            Seat::Side { angle_rad, slope_rad, .. } => Some((angle_rad, slope_rad, *seat)),
            _ => None,
        })
    };
    let chain = sides().filter(|s| is_near(s.0, own_angle, snap.chain_rad));
    let chain = chain.min_by(|a, b| {
        let off = |s: &(f64, f64, Seat)| DVec2::from_angle(s.0).angle_to(DVec2::from_angle(own_angle)).abs();
        off(a).total_cmp(&off(b))
    });
    let angle_rad = chain.map_or(own_angle, |c| c.0);
    if let Some(same) = sides().find(|s| s.0 == angle_rad && is_near(s.1, own_slope, snap.panel_rad)) {
        return same.2;
    }
    let normal = side_normal(angle_rad, own_slope);
    Seat::Side { angle_rad, slope_rad: own_slope, offset_mm: normal.dot(joint.centre) }
}

/// The plane of a seat, normal out of the component, in the component's axes.
pub fn seat_plane(seat: &Seat) -> Plane {
    match *seat {
        Seat::Top { height_mm } => Plane::horizontal(height_mm),
        Seat::Bottom { height_mm } => Plane::horizontal(height_mm).flipped(),
        Seat::Side { angle_rad, slope_rad, offset_mm } => {
            let normal = side_normal(angle_rad, slope_rad);
            Plane::through(normal * offset_mm, normal).unwrap_or_else(|| Plane::horizontal(offset_mm))
        }
    }
}

/// Nearest fold axis that makes a fixed plane exactly level, where it almost is.
pub fn level_axis(axis: DVec3, plane_normal: DVec3) -> DVec3 {
    if axis.dot(plane_normal).abs() > libm::cos(LEVEL_RAD) {
        plane_normal * axis.dot(plane_normal).signum()
    } else {
        axis
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seating(normal: DVec3, centre: DVec3, comes_first: bool) -> Seating {
        Seating { plane: Plane::through(centre, normal).unwrap(), centre, image: None, comes_first }
    }

    #[test]
    fn a_sloped_plane_gets_a_side_panel_exactly_on_it() {
        let joint = seating(DVec3::new(2.0, 1.0, 0.5), DVec3::new(30.0, 10.0, 5.0), true);
        let plane = seat_plane(&seats(&[joint], &Snap::WIDE)[0]);
        assert!((plane.normal() - joint.plane.normal()).length() < 1e-12);
        assert!((plane.offset() - joint.plane.offset()).abs() < 1e-10);
    }

    #[test]
    fn an_almost_level_plane_becomes_the_top() {
        let joint = seating(DVec3::new(0.2, 0.0, 1.0), DVec3::new(0.0, 0.0, 40.0), false);
        assert_eq!(seats(&[joint], &Snap::WIDE), [Seat::Top { height_mm: 40.0 }]);
    }

    #[test]
    fn two_planes_in_almost_one_direction_share_a_chain() {
        let a = seating(DVec3::new(1.0, 0.0, 0.6), DVec3::new(30.0, 0.0, 20.0), true);
        let b = seating(DVec3::new(1.0, 0.2, -0.4), DVec3::new(30.0, 2.0, -20.0), false);
        let seats = seats(&[b, a], &Snap::WIDE);
        let angle = |s: &Seat| match s {
            Seat::Side { angle_rad, .. } => *angle_rad,
            _ => f64::NAN,
        };
        assert_eq!(angle(&seats[0]), angle(&seats[1]));
        assert!(seat_plane(&seats[0]).distance(b.centre).abs() < 1e-9);
    }

    /// The roots of a wing and of a tail plane at a body that tapers.
    #[test]
    fn planes_that_would_cut_each_other_off_get_panels_of_their_own() {
        let wing = seating(DVec3::new(1.0, 0.0, 0.0), DVec3::new(30.0, 0.0, 0.0), false);
        let tail = seating(DVec3::new(1.0, 0.2, 0.0), DVec3::new(26.0, 40.0, 0.0), false);
        let distance = |snap| seat_plane(&seats(&[wing, tail], &snap)[1]).distance(tail.centre).abs();
        assert!(distance(Snap::WIDE) > 3.9 && distance(Snap::NARROW) < 1e-9);
    }
}
