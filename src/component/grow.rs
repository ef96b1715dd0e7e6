//! One plane more where a component stands out farthest from its hull.

use super::fit::Fitted;
use super::solid::{Chain, SideFacet, Solid};
use super::start::{MAX_SLOPE_RAD, MIN_BEND_RAD, MIN_TURN_RAD, fold_spots, tangents, thin_out, turn};
use super::target::{FoldSpot, Target};
use glam::{DVec2, DVec3};

/// A solid with a chain more, or a plane more in a chain, that cuts off the corner farthest from
/// the hull; `None` where the limits of `target` leave no place for one.
pub(super) fn grown(fitted: &Fitted, target: &Target) -> Option<(Solid, Vec<FoldSpot>)> {
    let shape = &fitted.shape;
    let away =
        fitted.own.iter().zip(&shape.corners).map(|(position, corner)| {
            position.nearest.map_or(DVec3::ZERO, |nearest| corner.point - nearest.0)
        });
    let out = away.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
    let aside = out.truncate();
    if out.z.abs() > aside.length() * MAX_SLOPE_RAD.tan() || aside.length() == 0.0 {
        return None;
    }
    let mut solid = shape.solid.clone();
    let turned = |chain: &Chain| turn(chain.angle_rad, aside.to_angle()).abs();
    let nearest = (0..solid.chains.len())
        .min_by(|&a, &b| turned(&solid.chains[a]).total_cmp(&turned(&solid.chains[b])))?;
    let has_turn = turned(&solid.chains[nearest]) >= MIN_TURN_RAD;
    if has_turn && solid.chains.len() < target.top_edges {
        add_chain(&mut solid, aside.to_angle(), target);
    } else {
        add_facet(&mut solid.chains[nearest], out, target)?;
    }
    let spots = fold_spots(&mut solid, target.profile_vertices);
    Some((solid, spots))
}

fn add_chain(solid: &mut Solid, angle_rad: f64, target: &Target) {
    let angle_rad = angle_rad.rem_euclid(std::f64::consts::TAU);
    let place = solid.chains.partition_point(|c| c.angle_rad.rem_euclid(std::f64::consts::TAU) < angle_rad);
    let chain = Chain { angle_rad, is_locked: false, facets: tangents(target, angle_rad) };
    solid.chains.insert(place, chain);
    thin_out(solid, place, target.profile_vertices - 1);
}

fn add_facet(chain: &mut Chain, out: DVec3, target: &Target) -> Option<()> {
    let normal = DVec2::from_angle(chain.angle_rad);
    let slope_rad = out.z.atan2(normal.dot(out.truncate()));
    let is_apart = |f: &SideFacet| (f.slope_rad - slope_rad).abs() >= 1.2 * MIN_BEND_RAD;
    if chain.facets.len() + 1 >= target.profile_vertices || !chain.facets.iter().all(is_apart) {
        return None;
    }
    let (sin, cos) = slope_rad.sin_cos();
    let offset_mm = target.hull.support((normal * cos).extend(sin));
    let place = chain.facets.partition_point(|f| f.slope_rad > slope_rad);
    chain.facets.insert(place, SideFacet { slope_rad, offset_mm, is_joint: false });
    Some(())
}
