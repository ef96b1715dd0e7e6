//! Flat sides of surfaces.

use super::{Facet, Hull, Plane, bounds};
use glam::DVec3;
use std::collections::BTreeMap;

/// A side is flat where this share of a surface lies in one plane: the tops of tables have 0.42, the seats of chairs 0.36
/// to 0.4. With 0.3 a wing and a goblet have some, and their models share 0.02 less of the volume with the mesh.
const LEAST_SHARE: f64 = 0.35;
/// One of two opposite sides may have as little as this, if both together have [`LEAST_OPPOSITES`]: the underside of a thick
/// table with fillets has 0.29. Not bounded from below by a case.
const LEAST_OPPOSITE: f64 = 0.2;
/// The top and the bottom of a brick half as thick as it is wide have 0.5, those of a thick table 0.64.
const LEAST_OPPOSITES: f64 = 0.6;
/// Its normals differ from their mean by at most this: scans and remeshed surfaces are rough.
const ROUGH_RAD: f64 = 20.0_f64.to_radians();
/// And its points from the plane by at most this share of the surface's extent.
const ROUGH: f64 = 0.01;
/// A facet of a box has at least this share of it: a wall of a house has a sixth.
const LEAST_FACET: f64 = 0.08;
/// And these have at least this share together: the eyes of a fish are no plates on its cheeks, and were lost with any share.
/// Not bounded from above by a case.
const LEAST_FACETS: f64 = 0.75;
/// Directions that are looked at, those that most of a surface has first. Not bounded by a case.
const LOOKS: usize = 6;
/// Times that the mean of normals is taken again around the last one. Not bounded by a case.
const ROUNDS: usize = 3;
/// Normals are counted on a grid of this many steps to 1.
const STEPS: f64 = 4.0;

/// A piece of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Its middle.
    pub centre: DVec3,
    /// Unit normal, outwards; 0 where it has none.
    pub normal: DVec3,
    /// Its area.
    pub area: f64,
}

/// A plane in which a large share of a surface lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatSide {
    /// Normal outwards.
    pub plane: Plane,
    /// How far the surface is from it on either side, at most.
    pub roughness: f64,
}

impl FlatSide {
    /// Those of a surface, which are three at most.
    pub(crate) fn of_patches(mut left: Vec<Patch>) -> Vec<Self> {
        let whole = area(&left);
        let (low, high) = bounds(left.iter().map(|patch| patch.centre));
        let roughness = ROUGH * low.distance(high);
        let mut sides: Vec<(Self, f64)> = Vec::new();
        for _ in 0..LOOKS {
            if area(&left) < LEAST_OPPOSITE * whole {
                break;
            }
            let Some(normal) = commonest_normal(&left) else { break };
            let (facing, others): (Vec<Patch>, Vec<Patch>) =
                left.into_iter().partition(|patch| looks_along(patch, normal));
            left = others;
            if area(&facing) < LEAST_OPPOSITE * whole {
                continue;
            }
            let layer = fullest_layer(facing, normal, 2.0 * roughness);
            let share = area(&layer) / whole;
            if share >= LEAST_OPPOSITE {
                let centre =
                    layer.iter().map(|patch| patch.centre * patch.area).sum::<DVec3>() / area(&layer);
                let plane = Plane::through(centre, normal);
                sides.extend(plane.map(|plane| (Self { plane, roughness }, share)));
            }
        }
        let is_of_plate = |(side, share): &(Self, f64)| {
            *share >= LEAST_SHARE
                || sides
                    .iter()
                    .any(|(other, of_other)| other.is_opposite(side) && share + of_other >= LEAST_OPPOSITES)
        };
        sides.iter().filter(|side| is_of_plate(side)).map(|(side, _)| *side).collect()
    }

    /// Whether two sides look in opposite directions, more or less.
    pub(crate) fn is_opposite(&self, other: &Self) -> bool {
        self.plane.normal().dot(other.plane.normal()) < -libm::cos(ROUGH_RAD)
    }

    /// Those of a hull.
    pub fn of_hull(hull: &Hull) -> Vec<Self> {
        let patch = |facet| {
            let outline: Vec<DVec3> = hull.facet_points(facet).collect();
            let centre = outline.iter().sum::<DVec3>() / outline.len() as f64;
            Patch { centre, normal: facet.plane().normal(), area: hull.facet_area(facet) }
        };
        Self::of_patches(hull.facets().iter().map(patch).collect())
    }

    /// The large facets of a hull that consists of them, as a box does; none of others.
    pub(crate) fn of_box(hull: &Hull) -> Vec<Self> {
        let (low, high) = bounds(hull.vertices().iter().copied());
        let roughness = ROUGH * low.distance(high);
        let whole = hull.area();
        let areas = hull.facets().iter().map(|facet| (facet, hull.facet_area(facet)));
        let large: Vec<(&Facet, f64)> = areas.filter(|(_, area)| *area >= LEAST_FACET * whole).collect();
        if large.iter().map(|(_, area)| area).sum::<f64>() < LEAST_FACETS * whole {
            return Vec::new();
        }
        large.into_iter().map(|(facet, _)| Self { plane: *facet.plane(), roughness }).collect()
    }
}

fn area(patches: &[Patch]) -> f64 {
    patches.iter().map(|patch| patch.area).sum()
}

fn looks_along(patch: &Patch, normal: DVec3) -> bool {
    patch.normal.dot(normal) > libm::cos(ROUGH_RAD)
}

/// The mean of the normals that most of a surface has, more or less.
fn commonest_normal(patches: &[Patch]) -> Option<DVec3> {
    let mut by_direction: BTreeMap<[i8; 3], (f64, DVec3)> = BTreeMap::new();
    for patch in patches {
        let direction = (patch.normal * STEPS).round().to_array().map(|steps| steps as i8);
        let sum = by_direction.entry(direction).or_default();
        *sum = (sum.0 + patch.area, sum.1 + patch.normal * patch.area);
    }
    let fullest = by_direction.into_values().max_by(|a, b| a.0.total_cmp(&b.0))?;
    let mut normal = fullest.1.try_normalize()?;
    for _ in 0..ROUNDS {
        let near = patches.iter().filter(|patch| looks_along(patch, normal));
        normal = near.map(|p| p.normal * p.area).sum::<DVec3>().try_normalize().unwrap_or(normal);
    }
    Some(normal)
}

/// The patches between two planes across a normal that have the largest area.
fn fullest_layer(mut patches: Vec<Patch>, normal: DVec3, thickness: f64) -> Vec<Patch> {
    let height = |patch: &Patch| normal.dot(patch.centre);
    patches.sort_by(|a, b| height(a).total_cmp(&height(b)));
    let (mut first, mut area, mut fullest) = (0, 0.0, (0.0, 0..0));
    for (k, patch) in patches.iter().enumerate() {
        area += patch.area;
        while height(patch) - height(&patches[first]) > thickness {
            area -= patches[first].area;
            first += 1;
        }
        if area > fullest.0 {
            fullest = (area, first..k + 1);
        }
    }
    patches[fullest.1].to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    fn cuboid(size: DVec3) -> Hull {
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -0.9, 1.7);
        let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
        Hull::of_points(&(0..8).map(|k| turn * (size * corner(k))).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_plate_has_two_flat_sides_and_a_cube_none() {
        let sides = FlatSide::of_hull(&cuboid(DVec3::new(100.0, 60.0, 5.0)));
        let [above, below] = &sides[..] else { panic!("{sides:?}") };
        assert!((above.plane.normal() + below.plane.normal()).length() < 1e-9);
        // They are as far apart as the plate is thick.
        assert!((above.plane.offset() + below.plane.offset() - 5.0).abs() < 1e-9);
        assert_eq!(FlatSide::of_hull(&cuboid(DVec3::splat(60.0))), []);
    }
}
