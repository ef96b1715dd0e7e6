//! First guess of a component's half-spaces: tangent planes of the hull in well-chosen directions.

use super::angles::{MAX_SLOPE_RAD, MAX_TURN_RAD, MIN_BEND_RAD, MIN_TURN_RAD, STEP_RAD, turn};
use super::even::{
    choose_fours, choose_pairs, drop_pair, levelled, middle, pair_bulge, regular, thin_out_level,
};
use super::fit::{Fitted, rooms};
use super::panel::ChainId;
use super::profile::{Balance, balance, imbalance};
use super::shape::{ProfileLine, SolidShape};
use super::solid::{Chain, SideFacet, Solid};
use super::symmetry::{Symmetry, Turning, evened, orbit};
use super::target::{FoldSpot, Seat, Target};
use super::worth::{Edge, WORTH_MM, WORTH_SHARE, bulge, meet};
use crate::geom::polygon;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Circumscribes the hull of `target` with `edges` chains, each with as many planes as the limit
/// on profile vertices allows.
pub(super) fn circumscribe(target: &Target, edges: usize) -> Solid {
    let chains = chains(target, edges, |angle_rad| tangents(target, angle_rad));
    let mut solid = evened(with_ends(target, chains), target.symmetry);
    lower_ends(&mut solid, target.min_panel_mm);
    solid = evened(solid, target.symmetry);
    for j in solid.chain_ids() {
        thin_out(&mut solid, j, target);
    }
    solid
}

/// Panels of a lens are at most this share of its width; the rest is for the top panel.
const LENS_SHARE: f64 = 0.3;

/// Hulls are flat where half of their height is less than this share of a comfortable panel: less than any panel may be.
const FLAT: f64 = 2.0 / 3.0;

/// A lens with the outline of a hull that is too flat for panels one above the other: two at each edge that meet in
/// the middle, as wide as is comfortable. `None` for hulls that are not flat. Without it, a blade of 2 mm becomes 6 mm thick.
pub(super) fn lens(target: &Target, edges: usize) -> Option<Solid> {
    let ends = with_ends(target, Vec::new());
    let half_mm = (ends.top_mm - ends.bottom_mm) / 2.0;
    let reach = |angle_rad: f64| target.hull.support(DVec2::from_angle(angle_rad).extend(0.0));
    let width_mm = (0..36)
        .map(|k| PI / 36.0 * f64::from(k))
        .map(|angle_rad| reach(angle_rad) + reach(angle_rad + PI))
        .fold(f64::INFINITY, f64::min);
    let long_mm = target.comfortable_mm.min(LENS_SHARE * width_mm);
    if half_mm >= FLAT * target.comfortable_mm || half_mm >= long_mm {
        return None;
    }
    let in_mm = (long_mm * long_mm - half_mm * half_mm).sqrt();
    let slope_rad = libm::atan2(in_mm, half_mm).min(MAX_SLOPE_RAD);
    let middle_mm = (ends.top_mm + ends.bottom_mm) / 2.0;
    let facets = |angle_rad: f64| -> Vec<SideFacet> {
        if target.side_joints(angle_rad).next().is_some() {
            return tangents(target, angle_rad);
        }
        let rim = DVec2::new(reach(angle_rad), middle_mm);
        [slope_rad, -slope_rad]
            .map(|slope_rad| SideFacet {
                slope_rad,
                offset_mm: DVec2::from_angle(slope_rad).dot(rim),
                is_joint: false,
            })
            .to_vec()
    };
    let chains = chains(target, edges, facets);
    let mut solid = evened(with_ends(target, chains), target.symmetry);
    for j in solid.chain_ids() {
        thin_out(&mut solid, j, target);
    }
    Some(solid)
}

/// Chains in the directions that suit a hull's outline, with these planes.
fn chains(target: &Target, edges: usize, facets: impl Fn(f64) -> Vec<SideFacet>) -> Vec<Chain> {
    let flat: Vec<DVec2> = target.hull.vertices().iter().map(|p| p.truncate()).collect();
    let locked: Vec<f64> = target.locked_angles();
    let outline = polygon::convex_hull(&flat);
    let angles = match target.symmetry {
        Some(Symmetry::Upright { crossing: None, .. }) => choose_pairs(&outline, &locked, edges),
        Some(Symmetry::Upright { crossing: Some(crossing), .. }) => match crossing.turning {
            Turning::Half => choose_fours(&outline, &locked, edges),
            turning => regular(turning.sectors()),
        },
        _ => choose_angles(&outline, &locked, edges),
    };
    let chain = |&angle_rad: &f64| Chain {
        angle_rad,
        is_locked: locked.contains(&angle_rad),
        facets: facets(angle_rad),
    };
    angles.iter().map(chain).collect()
}

/// The box round a hull; `None` for joints at its sides, and where four edges are too many.
pub(super) fn boxed(target: &Target) -> Option<Solid> {
    if !target.locked_angles().is_empty() || target.top_edges < 4 {
        return None;
    }
    let chain = |k: usize| {
        let angle_rad = PI / 2.0 * k as f64;
        let normal = DVec2::from_angle(angle_rad).extend(0.0);
        let side = SideFacet { slope_rad: 0.0, offset_mm: target.hull.support(normal), is_joint: false };
        Chain { angle_rad, is_locked: false, facets: vec![side] }
    };
    Some(evened(with_ends(target, (0..4).map(chain).collect()), target.symmetry))
}

/// A solid with these chains, as high as the hull or up to the joints at its ends.
fn with_ends(target: &Target, chains: Vec<Chain>) -> Solid {
    let (mut top_mm, mut bottom_mm) = (target.hull.support(DVec3::Z), -target.hull.support(-DVec3::Z));
    let (mut is_top_joint, mut is_bottom_joint) = (false, false);
    for joint in &target.joints {
        match joint.seat {
            Seat::Top { height_mm } => (top_mm, is_top_joint) = (height_mm, true),
            Seat::Bottom { height_mm } => (bottom_mm, is_bottom_joint) = (height_mm, true),
            Seat::Side { .. } => {}
        }
    }
    Solid { chains, top_mm, bottom_mm, is_top_joint, is_bottom_joint }
}

/// Directions of the top edges: all candidates, thinned out where that adds the least area to
/// the circumscribed polygon (in the spirit of Dyken et al. 2009, §4.2).
fn choose_angles(outline: &[DVec2], locked: &[f64], edges: usize) -> Vec<f64> {
    let mut candidates: Vec<f64> = (0..72).map(|k| f64::from(k) * STEP_RAD).collect();
    let perimeter: f64 = polygon::edges(outline).map(|(a, b)| a.distance(b)).sum();
    candidates.extend(
        polygon::edges(outline)
            .filter(|(a, b)| a.distance(*b) > 0.05 * perimeter)
            .map(|(a, b)| (-(b - a).perp()).to_angle().rem_euclid(TAU)),
    );
    candidates.retain(|&a| locked.iter().all(|&l| turn(a, l).abs() >= MIN_TURN_RAD));
    candidates.extend_from_slice(locked);
    candidates.sort_by(f64::total_cmp);
    candidates.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    let whole = polygon::area(outline);
    let support = |a: f64| {
        let n = DVec2::from_angle(a);
        outline.iter().map(|p| n.dot(*p)).fold(f64::NEG_INFINITY, f64::max)
    };
    let mut set: Vec<Edge> = candidates
        .into_iter()
        .map(|angle_rad| Edge {
            angle_rad,
            normal: DVec2::from_angle(angle_rad),
            support: support(angle_rad),
            is_locked: locked.contains(&angle_rad),
        })
        .collect();
    let mut costs: Vec<f64> = (0..set.len()).map(|k| area_added(&set, k)).collect();
    loop {
        let n = set.len();
        let removable = (0..n).filter(|&k| !set[k].is_locked).filter_map(|k| {
            let (before, after) = (set[(k + n - 1) % n].angle_rad, set[(k + 1) % n].angle_rad);
            let gap = (after - before).rem_euclid(TAU);
            let own = set[k].angle_rad;
            let near = (own - before).rem_euclid(TAU).min((after - own).rem_euclid(TAU));
            (gap <= MAX_TURN_RAD && n > 3).then_some((near >= MIN_TURN_RAD, costs[k], k))
        });
        let best = removable.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        match best {
            Some((is_spread, area, k)) if n > edges || !is_spread || area < WORTH_SHARE * whole => {
                set.remove(k);
                costs.remove(k);
                for changed in [(k + n - 2) % (n - 1), k % (n - 1)] {
                    costs[changed] = area_added(&set, changed);
                }
            }
            _ => return set.into_iter().map(|s| s.angle_rad).collect(),
        };
    }
}

/// Area between an edge and the corner that its neighbours would make without it.
fn area_added(set: &[Edge], k: usize) -> f64 {
    let n = set.len();
    let (before, line, after) = (&set[(k + n - 1) % n], &set[k], &set[(k + 1) % n]);
    polygon::cross3(meet(before, line), meet(before, after), meet(line, after)).abs() / 2.0
}

/// Tangent planes of the hull's silhouette in one direction, from steep-up to steep-down, with
/// the joint panels of that direction among them.
pub(super) fn tangents(target: &Target, angle_rad: f64) -> Vec<SideFacet> {
    let n = DVec2::from_angle(angle_rad);
    let silhouette: Vec<DVec2> =
        target.hull.vertices().iter().map(|p| DVec2::new(n.dot(p.truncate()), p.z)).collect();
    let silhouette = polygon::convex_hull(&silhouette);
    let mut facets: Vec<SideFacet> = target.side_joints(angle_rad).collect();
    let length: f64 = polygon::edges(&silhouette).map(|(a, b)| a.distance(b)).sum();
    let own = polygon::edges(&silhouette)
        .filter(|(a, b)| a.distance(*b) > 0.04 * length)
        .map(|(a, b)| (-(b - a).perp()).to_angle());
    let slopes: Vec<f64> = (-15..=15).map(|k| f64::from(k) * STEP_RAD).chain(own).collect();
    for slope_rad in slopes {
        let clear = facets.iter().all(|f| (f.slope_rad - slope_rad).abs() >= MIN_BEND_RAD * 1.2);
        if clear && slope_rad.abs() < MAX_SLOPE_RAD {
            let d = DVec2::from_angle(slope_rad);
            let offset_mm = silhouette.iter().map(|p| d.dot(*p)).fold(f64::NEG_INFINITY, f64::max);
            facets.push(SideFacet { slope_rad, offset_mm, is_joint: false });
        }
    }
    facets.sort_by(|a, b| b.slope_rad.total_cmp(&a.slope_rad));
    if target.symmetry.is_some_and(Symmetry::is_level) { levelled(facets) } else { facets }
}

/// Moves free ends inwards until all side panels there have a useful width.
fn lower_ends(solid: &mut Solid, min_panel_mm: f64) {
    let (high, low) = (solid.top_mm, solid.bottom_mm);
    let height = high - low;
    let widest = super::shape::SolidShape::of(solid.clone());
    let narrowest =
        |v: f64| widest.solid.chain_ids().map(|j| widest.width_at(j, v)).fold(f64::INFINITY, f64::min);
    let useful = narrowest((high + low) / 2.0).min(8.0 * min_panel_mm) * 0.4;
    for share in [0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.25, 0.3] {
        if !solid.is_top_joint && narrowest(solid.top_mm) < useful {
            solid.top_mm = high - share * height;
        }
        if !solid.is_bottom_joint && narrowest(solid.bottom_mm) < useful {
            solid.bottom_mm = low + share * height;
        }
    }
}

/// Drops planes of chain j until its profile has no more vertices than `target` allows and all are
/// worth having: first those outside the heights, then those whose loss adds the least area to the
/// profile. Joint panels stay.
pub(super) fn thin_out(solid: &mut Solid, j: ChainId, target: &Target) {
    if target.symmetry.is_some_and(Symmetry::is_level) {
        return thin_out_level(solid, j, target.profile_vertices);
    }
    let count = target.profile_vertices - 1;
    let ends = (solid.top_mm, solid.bottom_mm);
    let mut lines = super::shape::lines(&solid.chains[j.0]);
    let facets = &mut solid.chains[j.0].facets;
    let mut bulges: Vec<(f64, f64)> = (0..lines.len()).map(|k| bulge(&lines, k, ends)).collect();
    loop {
        let best = (0..facets.len())
            .filter(|&k| !facets[k].is_joint)
            .min_by(|&a, &b| bulges[a].0.total_cmp(&bulges[b].0).then(a.cmp(&b)));
        match best {
            Some(k) if facets.len() > 1 && (facets.len() > count || bulges[k].1 < WORTH_MM) => {
                facets.remove(k);
                lines.remove(k);
                bulges.remove(k);
                let beside = [k.checked_sub(1), Some(k).filter(|&k| k < lines.len())];
                for changed in beside.into_iter().flatten() {
                    bulges[changed] = bulge(&lines, changed, ends);
                }
            }
            _ => return,
        }
    }
}

/// Where each chain's fold vertex should be. With fewer planes than `vertices` allows it is in the
/// plane where the balance point lies; else, or where that is a joint panel, which must stay
/// uncreased, it is at the nearest bend. A chain that is nothing but a joint panel gets a second
/// plane, at whose meeting it can fold. Level chains fold in their middle.
pub(super) fn fold_spots(solid: &mut Solid, target: &Target) -> Vec<FoldSpot> {
    if target.symmetry.is_some_and(Symmetry::is_level) {
        return solid.chains.iter().map(|chain| middle(chain.facets.len())).collect();
    }
    let vertices = target.profile_vertices;
    solid
        .chain_ids()
        .map(|j| {
            let profile = solid.profile(j);
            let at = balance(&profile);
            let facets = &solid.chains[j.0].facets;
            let is_full = facets.len() + 2 > vertices;
            if !is_full && !facets[at.segment].is_joint {
                return FoldSpot::Inside(at.segment);
            }
            let can_fold = |i: &usize| !(facets[*i].is_joint && facets[i + 1].is_joint);
            let distance = |i: usize| imbalance(&profile, i + 1).abs();
            let nearest =
                (0..facets.len() - 1).filter(can_fold).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            nearest.map_or_else(|| add_plane(solid, j, at), FoldSpot::Bend)
        })
        .collect()
}

/// Bend of a plane added beside a joint panel, on the side where the balance point is nearer.
const ADDED_BEND_RAD: f64 = PI / 12.0;

fn add_plane(solid: &mut Solid, j: ChainId, at: Balance) -> FoldSpot {
    let share = if at.share < 0.5 { 0.3 } else { 0.7 };
    let v = solid.top_mm + (solid.bottom_mm - solid.top_mm) * share;
    let facets = &mut solid.chains[j.0].facets;
    let joint = facets[at.segment];
    let slope_rad = joint.slope_rad + if share < 0.5 { ADDED_BEND_RAD } else { -ADDED_BEND_RAD };
    let offset_mm = DVec2::from_angle(slope_rad).dot(DVec2::new(ProfileLine::of(&joint).u_at(v), v));
    let place = if share < 0.5 { at.segment } else { at.segment + 1 };
    facets.insert(place, SideFacet { slope_rad, offset_mm, is_joint: false });
    FoldSpot::Bend(at.segment)
}

/// A shape with one panel or chain less in a place where panels are too small; `None` where nothing
/// can be spared.
pub(super) fn simplify(fitted: &Fitted, target: &Target) -> Option<(Solid, Vec<FoldSpot>)> {
    let shape = &fitted.shape;
    let solid = &shape.solid;
    let least = target.min_panel_mm;
    let tight = |lack: f64| lack > 0.0;
    let narrow =
        |j: ChainId| shape.heights_about(j).map(|v| least - shape.width_at(j, v)).fold(0.0, f64::max);
    let low = |j: ChainId| {
        let rooms =
            rooms(shape, &fitted.spots, j).map(|r| (least - r.value(&shape.chains[j.0].profile)).max(0.0));
        let off = match fitted.spots[j.0] {
            FoldSpot::Bend(i) => imbalance(&shape.chains[j.0].profile, i + 1).abs(),
            FoldSpot::Inside(_) => 0.0,
        };
        rooms.sum::<f64>() + off
    };
    let worst = |measure: &dyn Fn(ChainId) -> f64, may: &dyn Fn(ChainId) -> bool| {
        let chains = solid.chain_ids().filter(|&j| may(j)).map(|j| (measure(j), j));
        chains.filter(|c| tight(c.0)).max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).map(|c| c.1)
    };
    let mut simpler = solid.clone();
    let symmetry = target.symmetry;
    let spare = |j: ChainId| {
        let facets = &solid.chains[j.0].facets;
        // A joint panel needs a plane beside it, for the chain to fold at.
        let others = facets.iter().filter(|f| !f.is_joint).count();
        let is_level = symmetry.is_some_and(Symmetry::is_level);
        let has_other = is_level || others > 1 || others == facets.len();
        let free =
            spare_planes(facets, symmetry).filter(|&k| has_other && facets.len() > pair(facets, symmetry, k));
        let area = |k: usize| bulge_without(shape, symmetry, j, k);
        free.min_by(|&a, &b| area(a).total_cmp(&area(b)))
    };
    let can_go = |j: ChainId| can_go(solid, &orbit(solid, symmetry, j));
    if let Some(j) = worst(&low, &|j| spare(j).is_some()) {
        drop_plane(&mut simpler, symmetry, j, spare(j)?);
    } else if let Some(j) = worst(&narrow, &can_go) {
        drop_chain(&mut simpler, symmetry, j);
    } else if let Some(j) = solid.chain_ids().find(|&j| fitted.lack_mm > 0.0 && spare(j).is_some()) {
        drop_plane(&mut simpler, symmetry, j, spare(j)?);
    } else if let Some(j) = solid.chain_ids().find(|&j| fitted.lack_mm > 0.0 && can_go(j)) {
        drop_chain(&mut simpler, symmetry, j);
    } else {
        return None;
    }
    let spots = fold_spots(&mut simpler, target);
    Some((simpler, spots))
}

/// A shape without the plane that adds least to it; `None` where none can be spared.
pub(super) fn without_plane(fitted: &Fitted, target: &Target) -> Option<(Solid, Vec<FoldSpot>)> {
    let (shape, symmetry) = (&fitted.shape, target.symmetry);
    let mut least: Option<(f64, ChainId, usize)> = None;
    for (j, chain) in shape.solid.chain_ids().zip(&shape.solid.chains) {
        let others = chain.facets.iter().filter(|f| !f.is_joint).count();
        let spare = spare_planes(&chain.facets, symmetry);
        for k in spare.filter(|&k| others > pair(&chain.facets, symmetry, k)) {
            let profile = &shape.chains[j.0].profile;
            let width_mm = shape.width_at(j, (profile[k].y + profile[k + 1].y) / 2.0);
            let volume_mm3 = width_mm * bulge_without(shape, symmetry, j, k);
            if least.is_none_or(|l| volume_mm3 < l.0) {
                least = Some((volume_mm3, j, k));
            }
        }
    }
    let (_, j, k) = least?;
    let mut solid = shape.solid.clone();
    drop_plane(&mut solid, symmetry, j, k);
    let spots = fold_spots(&mut solid, target);
    Some((solid, spots))
}

/// A shape without the chain that has the least area; `None` where none can be spared.
pub(super) fn without_chain(fitted: &Fitted, target: &Target) -> Option<(Solid, Vec<FoldSpot>)> {
    let (shape, symmetry) = (&fitted.shape, target.symmetry);
    let mut solid = shape.solid.clone();
    let area = |j: ChainId| -> f64 {
        let parts = shape.chains[j.0].profile.windows(2);
        parts.map(|w| w[0].distance(w[1]) * shape.width_at(j, (w[0].y + w[1].y) / 2.0)).sum()
    };
    let least = solid
        .chain_ids()
        .filter(|&j| can_go(&solid, &orbit(&solid, symmetry, j)))
        .min_by(|&a, &b| area(a).total_cmp(&area(b)))?;
    drop_chain(&mut solid, symmetry, least);
    let spots = fold_spots(&mut solid, target);
    Some((solid, spots))
}

/// Planes of a chain that are no joint panels; of a level one, those of its upper half.
fn spare_planes(facets: &[SideFacet], symmetry: Option<Symmetry>) -> impl Iterator<Item = usize> + '_ {
    let is_level = symmetry.is_some_and(Symmetry::is_level);
    let count = if is_level { facets.len().div_ceil(2) } else { facets.len() };
    (0..count).filter(|&k| !facets[k].is_joint)
}

/// Number of planes that go from a chain with its plane k.
fn pair(facets: &[SideFacet], symmetry: Option<Symmetry>, k: usize) -> usize {
    let has_image = symmetry.is_some_and(Symmetry::is_level) && 2 * k + 1 != facets.len();
    if has_image { 2 } else { 1 }
}

/// Area by which the profile of chain j would grow without plane k and its image, mm².
fn bulge_without(shape: &SolidShape, symmetry: Option<Symmetry>, j: ChainId, k: usize) -> f64 {
    let (lines, ends) = (&shape.chains[j.0].lines, (shape.solid.top_mm, shape.solid.bottom_mm));
    if symmetry.is_some_and(Symmetry::is_level) {
        pair_bulge(lines, k, ends).0
    } else {
        bulge(lines, k, ends).0
    }
}

/// Drops a plane and its images.
fn drop_plane(solid: &mut Solid, symmetry: Option<Symmetry>, j: ChainId, k: usize) {
    let all = orbit(solid, symmetry, j);
    let facets = &mut solid.chains[j.0].facets;
    if symmetry.is_some_and(Symmetry::is_level) {
        drop_pair(facets, k);
    } else {
        facets.remove(k);
    }
    for &other in &all[1..] {
        solid.chains[other.0].facets = solid.chains[j.0].facets.clone();
    }
}

/// Drops a chain and its images.
fn drop_chain(solid: &mut Solid, symmetry: Option<Symmetry>, j: ChainId) {
    let mut all = orbit(solid, symmetry, j);
    all.sort_unstable_by(|a, b| b.cmp(a));
    all.into_iter().for_each(|k| drop(solid.chains.remove(k.0)));
}

/// Whether a solid stays closed without these chains, which are images of one another.
fn can_go(solid: &Solid, gone: &[ChainId]) -> bool {
    if solid.chains.len() < gone.len() + 3 || solid.chains[gone[0].0].is_locked {
        return false;
    }
    let gap_without = |k: ChainId| {
        let beside = |mut next: ChainId, step: &dyn Fn(ChainId) -> ChainId| {
            while gone.contains(&next) {
                next = step(next);
            }
            solid.chains[next.0].angle_rad
        };
        let (before, after) = (beside(k, &|c| solid.previous(c)), beside(k, &|c| solid.next(c)));
        (after - before).rem_euclid(TAU)
    };
    gone.iter().all(|&k| gap_without(k) <= MAX_TURN_RAD)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::component::convert;
    use crate::component::convert::tests::target;
    use crate::geom::Hull;

    fn plate(height_mm: f64) -> Hull {
        let corner = |k: usize| {
            DVec3::new([-40.0, 40.0][k & 1], [-20.0, 20.0][k >> 1 & 1], [-0.5, 0.5][k >> 2] * height_mm)
        };
        Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_lens_is_as_thin_as_its_hull_with_panels_that_are_wide_enough() {
        let hull = plate(2.0);
        let lens = lens(&target(&hull, vec![]), 4).unwrap();
        assert_eq!((lens.top_mm, lens.bottom_mm), (1.0, -1.0));
        for j in lens.chain_ids() {
            let profile = lens.profile(j);
            assert_eq!(profile.len(), 3);
            assert!(profile.windows(2).all(|w| w[0].distance(w[1]) >= 3.0), "{profile:?}");
        }
        assert!(super::lens(&target(&plate(20.0), vec![]), 4).is_none());
    }

    /// A blade of 2 mm was one of 6 mm: two panels of 3 mm, one above the other.
    #[test]
    fn a_blade_is_no_thicker_than_it_should_be() {
        let component = convert(&target(&plate(2.0), vec![])).unwrap();
        let thick_mm = component.top_mm() - component.bottom_mm();
        assert!(thick_mm < 3.0, "{thick_mm}");
        assert!(component.lowest_panel().1 >= 2.9, "{:?}", component.lowest_panel());
    }
}
