//! One plane more where a component stands out far from its hull.

use super::angles::{MAX_SLOPE_RAD, MIN_BEND_RAD, MIN_TURN_RAD, turn};
use super::even;
use super::fit::Fitted;
use super::panel::ChainId;
use super::solid::{Chain, SideFacet, Solid};
use super::start::{fold_spots, tangents, thin_out};
use super::symmetry::{Symmetry, directions, orbit, settled};
use super::target::{FoldSpot, Target};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A solid with a chain more, or a plane more in a chain, that cuts off one of the corners farthest from the hull, by
/// their rank; `None` where the limits of `target` leave no place for one.
pub(super) fn grown(fitted: &Fitted, target: &Target, rank: usize) -> Option<(Solid, Vec<FoldSpot>)> {
    let shape = &fitted.shape;
    let away =
        fitted.own.iter().zip(&shape.corners).map(|(position, corner)| {
            position.nearest.map_or(DVec3::ZERO, |nearest| corner.point - nearest.0)
        });
    let mut away: Vec<DVec3> = away.collect();
    away.sort_by(|a, b| b.length_squared().total_cmp(&a.length_squared()));
    let out = *away.get(rank)?;
    let aside = out.truncate();
    if out.z.abs() > aside.length() * libm::tan(MAX_SLOPE_RAD) || aside.length() == 0.0 {
        return None;
    }
    let mut solid = shape.solid.clone();
    let angle_rad = settled(aside.to_angle(), target.symmetry, MIN_TURN_RAD);
    let turned = |chain: &Chain| turn(chain.angle_rad, angle_rad).abs();
    let nearest = (0..solid.chains.len())
        .min_by(|&a, &b| turned(&solid.chains[a]).total_cmp(&turned(&solid.chains[b])))?;
    let has_turn = turned(&solid.chains[nearest]) >= MIN_TURN_RAD;
    let directions = directions(angle_rad, target.symmetry);
    if has_turn && solid.chains.len() + directions.len() <= target.top_edges {
        let facets = add_chain(&mut solid, angle_rad, tangents(target, angle_rad), target);
        for &image in &directions[1..] {
            add_chain(&mut solid, image, facets.clone(), target);
        }
    } else {
        add_facet(&mut solid.chains[nearest], out, target)?;
        for &image in &orbit(&solid, target.symmetry, ChainId(nearest))[1..] {
            solid.chains[image.0].facets = solid.chains[nearest].facets.clone();
        }
    }
    let spots = fold_spots(&mut solid, target);
    Some((solid, spots))
}

/// Adds a chain with the best of these planes, and returns them.
fn add_chain(solid: &mut Solid, angle_rad: f64, facets: Vec<SideFacet>, target: &Target) -> Vec<SideFacet> {
    // The chains turn counter-clockwise, but the first may have any direction.
    let past = |chain: &Chain| (angle_rad - chain.angle_rad).rem_euclid(TAU);
    let before =
        (0..solid.chains.len()).min_by(|&a, &b| past(&solid.chains[a]).total_cmp(&past(&solid.chains[b])));
    let place = before.map_or(0, |before| before + 1);
    solid.chains.insert(place, Chain { angle_rad, is_locked: false, facets });
    thin_out(solid, ChainId(place), target);
    solid.chains[place].facets.clone()
}

fn add_facet(chain: &mut Chain, out: DVec3, target: &Target) -> Option<()> {
    let normal = DVec2::from_angle(chain.angle_rad);
    let slope_rad = libm::atan2(out.z, normal.dot(out.truncate()));
    let is_level = target.symmetry.is_some_and(Symmetry::is_level);
    // A plane too near to its image in a level one becomes its own.
    let slope_rad = if is_level && 2.0 * slope_rad.abs() < 1.2 * MIN_BEND_RAD { 0.0 } else { slope_rad };
    let slopes = [slope_rad, -slope_rad];
    let slopes = &slopes[..if is_level && slope_rad != 0.0 { 2 } else { 1 }];
    let is_apart = |f: &SideFacet| slopes.iter().all(|s| (f.slope_rad - s).abs() >= 1.2 * MIN_BEND_RAD);
    let count = chain.facets.len() + slopes.len();
    let vertices = if is_level { even::vertices(count) } else { count + 1 };
    if vertices > target.profile_vertices || !chain.facets.iter().all(is_apart) {
        return None;
    }
    let (sin, cos) = libm::sincos(slope_rad);
    let offset_mm = target.hull.support((normal * cos).extend(sin));
    for &slope_rad in slopes {
        let place = chain.facets.partition_point(|f| f.slope_rad > slope_rad);
        chain.facets.insert(place, SideFacet { slope_rad, offset_mm, is_joint: false });
    }
    Some(())
}
