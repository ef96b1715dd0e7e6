//! Samples of two hulls that a joint's plane is to part: what a plane takes off them, and what it leaves for glue.

use super::section::{common_outline, flat_section};
use crate::geom::{Facet, FlatSide, Hull, Plane, bounds, polygon};
use glam::DVec3;
use std::ops::RangeInclusive;

/// Samples along the longest side of the box round both hulls. With 8 a thin limb has too few to
/// count; 16 takes eight times as long as 8 and gives the same planes as 12 on the cat and the bunny.
const SAMPLES: usize = 12;
/// Price of the share of another joint's interface that is cut off, against the share of volume: a part whose
/// joint is lost falls off. Each joint counts for itself: as a share of all of them together, the tail of a
/// scorpion was cut off its body for the sake of one of eight legs.
const JOINT_PRICE: f64 = 2.0;
/// The share that a plane takes off the larger hull counts by this power of how many times it is larger: with 0 the wheels of a
/// car cost its body both sides and the sails of a windmill become one, since that is a small share of a large part, but as
/// much as the small ones. Not bounded from above by a case.
const LARGER: f64 = 0.5;
/// A cut less deep than this share of the interface's radius takes nothing: the feet of a table all stand on one
/// plane, more or less, and turned planes would make a roof of it. With 0.12 the same happens to an octopus; with 0.25
/// one joint of a lion has less than 40 mm².
const SHALLOW: f64 = 0.25;
/// Price of a joint whose two sections have nothing in common; one with [`ENOUGH_GLUE`] costs nothing.
const GLUE_PRICE: f64 = 1.0;
/// A joint has enough glue with this share of the smaller section that it can have there. As a share of what a cube of the
/// part's size has, thin plates and limbs never had enough, and planes leaned to get more: the fins of a plane were cut down to
/// stubs; of 129 meshes three clashed that fold freely now, and one that folded freely clashes.
const ENOUGH_GLUE: f64 = 0.5;

/// The volume that the plane takes off two hulls and neither has on its other side, and the volume that one hull
/// round both has more than the two; `None` where there is no such hull.
pub(super) fn lost_and_added_mm3(plane: &Plane, parent: &Hull, child: &Hull) -> Option<[f64; 2]> {
    let vertices: Vec<DVec3> = [parent, child].iter().flat_map(|hull| hull.vertices()).copied().collect();
    let around = Hull::of_points(&vertices).ok()?.volume();
    let ground = Ground::new(parent, child, [&[], &[]]);
    let [parent_mm3, child_mm3] = [parent, child].map(Hull::volume);
    let lost = ground.lost(plane);
    let shared_mm3 = child_mm3 * (1.0 - ground.alone[1].len() as f64 / ground.counts[1].max(1.0));
    let both_mm3 = parent_mm3 + child_mm3 - shared_mm3;
    Some([lost[0] * parent_mm3 + lost[1] * child_mm3, around - both_mm3])
}

pub(super) fn middle(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len().max(1) as f64
}

/// Distance of the point that is farthest from the centre.
pub(super) fn radius_mm(points: &[DVec3], centre: DVec3) -> f64 {
    points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max)
}

/// Where a part is joined to another, and how deep a plane may cut into that.
struct Kept<'a> {
    points: &'a [DVec3],
    spared_mm: f64,
}

impl<'a> Kept<'a> {
    fn new(points: &'a [DVec3]) -> Self {
        Self { points, spared_mm: SHALLOW * radius_mm(points, middle(points)) }
    }

    /// The share that a plane cuts off.
    fn lost(&self, side: &Plane, spared_mm: f64) -> f64 {
        let spared_mm = spared_mm.max(self.spared_mm);
        let off = self.points.iter().filter(|p| side.distance(**p) > spared_mm).count();
        off as f64 / self.points.len().max(1) as f64
    }
}

/// Samples of two hulls, for the price of many planes between them.
pub(super) struct Ground<'a> {
    hulls: [&'a Hull; 2],
    /// Points in one hull only: what the plane takes off the other's inside is not lost.
    alone: [Vec<DVec3>; 2],
    counts: [f64; 2],
    /// What the share that is lost of either counts.
    weights: [f64; 2],
    kept: [Vec<Kept<'a>>; 2],
}

impl<'a> Ground<'a> {
    /// `kept` is where each hull meets each of the others.
    pub(super) fn new(parent: &'a Hull, child: &'a Hull, kept: [&'a [Vec<DVec3>]; 2]) -> Self {
        let hulls = [parent, child];
        let mut alone = [Vec::new(), Vec::new()];
        let mut counts = [0.0; 2];
        for own in 0..2 {
            for column in columns(hulls[own]) {
                let inside = column.inside(hulls[own]);
                let shared = column.inside(hulls[1 - own]);
                for point in column.points().filter(|p| inside.contains(&p.z)) {
                    counts[own] += 1.0;
                    if !shared.contains(&point.z) {
                        alone[own].push(point);
                    }
                }
            }
        }
        let kept = kept.map(|kept| kept.iter().map(|points| Kept::new(points)).collect());
        let least_mm3 = parent.volume().min(child.volume());
        let weights = hulls.map(|hull| libm::pow(hull.volume() / least_mm3, LARGER));
        Self { hulls, alone, counts, weights, kept }
    }

    pub(super) fn hulls(&self) -> [&'a Hull; 2] {
        self.hulls
    }

    /// Flat sides of both hulls, as planes between them.
    pub(super) fn sides(&self, of_hull: fn(&Hull) -> Vec<FlatSide>) -> impl Iterator<Item = FlatSide> {
        let [parent, child] = self.hulls.map(of_hull);
        let child = child.into_iter().map(|side| FlatSide { plane: side.plane.flipped(), ..side });
        parent.into_iter().chain(child)
    }

    /// What sections have to share to have enough glue, mm², where the hulls meet near these planes: a share of the smaller
    /// section that is to be had there, or that a cube of the hull's size has.
    pub(super) fn enough_mm2(&self, planes: impl Iterator<Item = Plane> + Clone) -> f64 {
        let area = |hull: &Hull, plane: &Plane| polygon::area(&flat_section(plane, hull));
        let largest = |hull: &Hull| planes.clone().map(|plane| area(hull, &plane)).fold(0.0, f64::max);
        let smaller = |of: [f64; 2]| of[0].min(of[1]);
        let of_cube = smaller(self.hulls.map(|hull| libm::cbrt(hull.volume()).powi(2)));
        let there = smaller(self.hulls.map(largest));
        ENOUGH_GLUE * if there > 0.0 { there.min(of_cube) } else { of_cube }
    }

    /// The price of a plane where both hulls end within `rough_mm` of it.
    pub(super) fn price(&self, plane: &Plane, rough_mm: f64, enough_mm2: f64) -> f64 {
        let lack = (1.0 - self.common(plane, rough_mm) / enough_mm2.max(f64::MIN_POSITIVE)).max(0.0);
        let lost_joints = self.lost_joints(plane, 2.0 * rough_mm);
        let lost: f64 = self.lost(plane).iter().zip(self.weights).map(|(share, weight)| share * weight).sum();
        lost + JOINT_PRICE * lost_joints + GLUE_PRICE * lack
    }

    /// The shares of the interfaces of other joints that a plane cuts off, together, where it cuts deeper than this.
    pub(super) fn lost_joints(&self, plane: &Plane, spared_mm: f64) -> f64 {
        let sides = [*plane, plane.flipped()];
        self.kept
            .iter()
            .zip(&sides)
            .flat_map(|(kept, side)| kept.iter().map(|joint| joint.lost(side, spared_mm)))
            .sum()
    }

    /// The share of each hull that a plane takes off and the other does not have.
    pub(super) fn lost(&self, plane: &Plane) -> [f64; 2] {
        let sides = [*plane, plane.flipped()];
        [0, 1].map(|own| {
            let lost = self.alone[own].iter().filter(|p| sides[own].distance(**p) > 0.0).count();
            lost as f64 / self.counts[own].max(1.0)
        })
    }

    /// Area that the sections of both hulls share, each `inset_mm` within its hull.
    fn common(&self, plane: &Plane, inset_mm: f64) -> f64 {
        let [parent, child] = self.hulls;
        let before = flat_section(&plane.shifted(-inset_mm), parent);
        let behind = flat_section(&plane.shifted(inset_mm), child);
        polygon::area(&common_outline(&before, &behind))
    }
}

/// Points above one another.
struct Column {
    lowest: DVec3,
    step_mm: f64,
    count: u64,
}

impl Column {
    fn points(&self) -> impl Iterator<Item = DVec3> {
        (0..self.count).map(|k| self.lowest + DVec3::Z * (self.step_mm * k as f64))
    }

    /// The heights at which it is in a hull.
    fn inside(&self, hull: &Hull) -> RangeInclusive<f64> {
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for plane in hull.facets().iter().map(Facet::plane) {
            let normal = plane.normal();
            let room = plane.offset() - normal.truncate().dot(self.lowest.truncate());
            if normal.z > 0.0 {
                high = high.min(room / normal.z);
            } else if normal.z < 0.0 {
                low = low.max(room / normal.z);
            } else if room < 0.0 {
                high = f64::NEG_INFINITY;
            }
        }
        low..=high
    }
}

/// An even grid in the box of a hull.
fn columns(hull: &Hull) -> impl Iterator<Item = Column> {
    let (low, high) = bounds(hull.vertices().iter().copied());
    let step = (high - low).max_element() / SAMPLES as f64;
    let count = ((high - low) / step).ceil().max(DVec3::ONE).as_u64vec3();
    let cell = (high - low) / count.as_dvec3();
    let at = move |x: u64, y: u64| low + (DVec3::new(x as f64, y as f64, 0.0) + 0.5) * cell;
    let column = move |x, y| Column { lowest: at(x, y), step_mm: cell.z, count: count.z };
    (0..count.x).flat_map(move |x| (0..count.y).map(move |y| column(x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cuboid(low: DVec3, high: DVec3) -> Hull {
        let corner = |k: usize| {
            DVec3::new([low.x, high.x][k & 1], [low.y, high.y][k >> 1 & 1], [low.z, high.z][k >> 2])
        };
        Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    /// A section of a fin is smaller than that of a cube of its size. Planes leaned to get as much glue as such a cube has, and
    /// cut fins down to stubs.
    #[test]
    fn a_thin_fin_has_enough_glue_along_its_root() {
        let body = cuboid(DVec3::ZERO, DVec3::new(24.0, 24.0, 150.0));
        let fin = cuboid(DVec3::new(22.0, 11.0, 0.0), DVec3::new(60.0, 13.0, 18.0));
        let ground = Ground::new(&body, &fin, [&[], &[]]);
        let beside = |x: f64| Plane::through(DVec3::X * x, DVec3::X).unwrap();
        let enough_mm2 = ground.enough_mm2([20.0, 23.0, 30.0].into_iter().map(beside));
        assert_eq!(enough_mm2, ENOUGH_GLUE * 36.0);
        assert_eq!(ground.price(&beside(23.9), 0.0, enough_mm2), 0.0);
    }
}
