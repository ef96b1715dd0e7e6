//! The plane of a joint between two parts (§4.2.1): least squares through the interface, moved or
//! turned where that takes less off the two.

use super::contact::{Contact, Interface};
use crate::geom::{Facet, FlatSide, Hull, Mirror, Plane, bounds, polygon};
use glam::{DVec2, DVec3};
use std::ops::RangeInclusive;

/// A fitted plane's normal has at least this share along the mirror plane, else it is one between two
/// sides and not between two parts across.
const UPRIGHT: f64 = 0.5;
/// Samples along the longest side of the box round both hulls. With 8 a thin limb has too few to
/// count; 16 takes eight times as long as 8 and gives the same planes as 12 on the cat and the bunny.
const SAMPLES: usize = 12;
/// Places tried along each normal.
const SLIDES: usize = 17;
/// Planes are looked for this far beyond the interface, as a share of its size.
const BEYOND: f64 = 0.5;
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
/// Where planes that are nearly fitted take more than this of another joint, planes are turned farther.
const SPARED: f64 = 0.1;
/// The angles by which planes are turned, each towards [`TURNED`] sides.
const TURNS_RAD: [f64; 3] = [20.0_f64.to_radians(), 40.0_f64.to_radians(), 60.0_f64.to_radians()];
/// The number of sides.
const TURNED: usize = 8;
/// A plane along a facet may cost this much more than the best of the others. Through samples of where bodies touch, the roof
/// of a house leans by two degrees, and with 0.02 a cornice by sixteen; the seat of a chair grew by 18 mm where planes for its
/// back were above it for 0.02. Not bounded from above by a case.
const AS_GOOD: f64 = 0.05;
/// Planes along a flat side are tried within this angle of the fitted plane.
const LEANING_RAD: f64 = 60.0_f64.to_radians();
/// Between bodies the planes of the facets of boxes are tried, too, within this angle.
const MOST_TURN_RAD: f64 = 30.0_f64.to_radians();
/// Price of a joint whose two sections have nothing in common; one with [`ENOUGH_GLUE`] costs nothing.
const GLUE_PRICE: f64 = 1.0;
/// A joint has enough glue with this share of the smaller section that it can have there. As a share of what a cube of the
/// part's size has, thin plates and limbs never had enough, and planes leaned to get more: the fins of a plane were cut down to
/// stubs; of 129 meshes three clashed that fold freely now, and one that folded freely clashes.
const ENOUGH_GLUE: f64 = 0.5;
/// Price of a move by the size of the interface, or of a turn by a right angle: among equals the
/// fitted plane wins.
const MOVE_PRICE: f64 = 0.05;

/// The plane between two parts, its normal from `parent` to `child`, and the larger share of either that
/// it takes off and the other does not have. Between parts that lie `across` mirror planes it is its own image in them.
pub(super) fn between(contact: &Contact, ground: &Ground<'_>, across: &[Mirror]) -> (Plane, f64) {
    let points = &contact.points;
    let [parent, child] = ground.hulls;
    let along = |direction: DVec3| across.iter().fold(direction, |d, mirror| mirror.along(d));
    let towards = along(child.centroid() - parent.centroid());
    let centre = middle(points);
    let centre = across.iter().fold(centre, |c, mirror| mirror.plane().project(c));
    let facing = |plane: Plane| if plane.normal().dot(towards) < 0.0 { plane.flipped() } else { plane };
    let is_upright = |normal: &DVec3| normal.length() >= UPRIGHT;
    let is_image = |plane: &Plane| along(plane.normal()).length() > 1.0 - 1e-9;
    let fitted = Plane::fit(points).map(|(plane, _)| along(plane.normal())).filter(is_upright);
    let fitted = fitted.and_then(|normal| Plane::through(centre, normal)).map(facing);
    let straight = Plane::through(centre, towards);
    let Some(first) = fitted.or(straight) else { return (Plane::horizontal(centre.z), 0.0) };
    let size = radius_mm(points, centre).max(f64::MIN_POSITIVE);
    let halfway = straight.and_then(|s| Plane::through(centre, first.normal() + s.normal()));
    let slid = |plane: Plane| {
        let heights = points.iter().map(|p| plane.normal().dot(*p - centre));
        let (low, high) = heights.fold((0.0f64, 0.0f64), |(l, h), d| (l.min(d), h.max(d)));
        let (low, high) = (low - BEYOND * size, high + BEYOND * size);
        let slide = move |k: usize| low + (high - low) * k as f64 / (SLIDES - 1) as f64;
        let shifts = std::iter::once(0.0).chain((0..SLIDES).map(slide));
        shifts.filter_map(move |shift| {
            let moved = Plane::through(centre + plane.normal() * shift, plane.normal())?;
            let turn = libm::acos(plane.normal().dot(first.normal()).clamp(-1.0, 1.0));
            Some((moved, MOVE_PRICE * (shift.abs() / size + turn / std::f64::consts::FRAC_PI_2)))
        })
    };
    let enough_mm2 = ground.enough_mm2(slid(first).map(|(plane, _)| plane));
    let priced = |plane: Plane| {
        slid(plane).map(|(plane, price)| (price + ground.price(&plane, 0.0, enough_mm2), plane))
    };
    let cheapest = |planes: &mut dyn Iterator<Item = Plane>| {
        planes.flat_map(priced).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, first))
    };
    let mut best = cheapest(&mut [Some(first), halfway, straight].into_iter().flatten());
    if ground.lost_joints(&best.1, 0.0) > SPARED {
        let turned = turned(first.normal()).map(along).filter(is_upright);
        let other = cheapest(&mut turned.filter_map(|normal| Plane::through(centre, normal)));
        best = if other.0 < best.0 { other } else { best };
    }
    // What hangs under a plate is along its top: the underside may be rough.
    let along_plate = |side: FlatSide| {
        let normal = side.plane.normal();
        let towards = normal * normal.dot(first.normal()).signum();
        let across = Plane::through(centre, towards)
            .filter(|plane| plane.normal().dot(first.normal()) > libm::cos(LEANING_RAD) && is_image(plane));
        let own = across.filter(|_| towards == normal).map(|_| (side.plane, 0.0));
        let priced = |(plane, price)| (price + ground.price(&plane, side.roughness, enough_mm2), plane);
        let level = across.into_iter().flat_map(&slid).map(priced).min_by(|a, b| a.0.total_cmp(&b.0));
        let is_as_good = |own: &(f64, Plane)| level.is_none_or(|level| own.0 < level.0 + AS_GOOD);
        own.map(priced).filter(is_as_good).or(level)
    };
    let on_plate = ground.sides(FlatSide::of_hull).filter_map(along_plate);
    // A box stays one: its sides are exact where samples of them are not.
    let sides = (contact.interface == Interface::Bodies)
        .then(|| ground.sides(FlatSide::of_box))
        .into_iter()
        .flatten();
    let on_facet = sides.filter_map(|side| {
        let turn_rad = |other: &Plane| libm::acos(side.plane.normal().dot(other.normal()).clamp(-1.0, 1.0));
        let turn_rad = straight.iter().map(turn_rad).fold(turn_rad(&first), f64::min);
        let price = MOVE_PRICE * turn_rad / std::f64::consts::FRAC_PI_2;
        (turn_rad < MOST_TURN_RAD && is_image(&side.plane))
            .then(|| (price + ground.price(&side.plane, side.roughness, enough_mm2), side.plane))
    });
    let best =
        on_plate.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|on_plate| on_plate.0 < best.0).unwrap_or(best);
    let on_facet = on_facet.min_by(|a, b| a.0.total_cmp(&b.0));
    let best = on_facet.filter(|on_facet| on_facet.0 < best.0 + AS_GOOD).unwrap_or(best).1;
    let lost = ground.lost(&best);
    (best, lost[0].max(lost[1]))
}

fn middle(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len().max(1) as f64
}

/// Distance of the point that is farthest from the centre.
fn radius_mm(points: &[DVec3], centre: DVec3) -> f64 {
    points.iter().map(|p| p.distance(centre)).fold(0.0, f64::max)
}

/// Normals turned away from one.
fn turned(normal: DVec3) -> impl Iterator<Item = DVec3> {
    let (x, y) = normal.any_orthonormal_pair();
    let ways = (0..TURNED).map(|k| std::f64::consts::TAU * k as f64 / TURNED as f64);
    ways.flat_map(move |way| {
        let aside = x * libm::cos(way) + y * libm::sin(way);
        TURNS_RAD.map(|turn| normal * libm::cos(turn) + aside * libm::sin(turn))
    })
}

/// The larger share of volume that the plane cuts off either hull.
pub(super) fn cut_off(plane: &Plane, parent: &Hull, child: &Hull) -> f64 {
    let lost =
        |hull: &Hull, plane: &Plane| 1.0 - hull.clip(plane).map_or(0.0, |h| h.volume()) / hull.volume();
    lost(parent, plane).max(lost(child, &plane.flipped()))
}

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

/// The plane in the middle of where two hulls overlap least, normal from the first to the second, and how
/// deep they do; `None` where they do not. Only the directions of their faces are tried.
pub(super) fn apart(first: &Hull, second: &Hull) -> Option<(Plane, f64)> {
    let [own, other] = [first, second].map(|hull| hull.facets().iter().map(|f| f.plane().normal()));
    let mut least: Option<(Plane, f64)> = None;
    for normal in own.chain(other.map(|n| -n)) {
        let (end, start) = (first.support(normal), -second.support(-normal));
        if end <= start {
            return None;
        }
        if least.as_ref().is_none_or(|least| end - start < least.1) {
            least = Some((Plane::through(normal * ((start + end) / 2.0), normal)?, end - start));
        }
    }
    least
}

/// The same for hulls that need not overlap: then the depth is less than 0, and the plane in the widest gap between
/// their faces.
pub(super) fn between_faces(first: &Hull, second: &Hull) -> Option<(Plane, f64)> {
    let (normal, [start, end]) = first.widest_gap(second)?;
    Some((Plane::through(normal * ((start + end) / 2.0), normal)?, end - start))
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

    /// Flat sides of both hulls, as planes between them.
    fn sides(&self, of_hull: fn(&Hull) -> Vec<FlatSide>) -> impl Iterator<Item = FlatSide> {
        let [parent, child] = self.hulls.map(of_hull);
        let child = child.into_iter().map(|side| FlatSide { plane: side.plane.flipped(), ..side });
        parent.into_iter().chain(child)
    }

    /// What sections have to share to have enough glue, mm², where the hulls meet near these planes: a share of the smaller
    /// section that is to be had there, or that a cube of the hull's size has.
    fn enough_mm2(&self, planes: impl Iterator<Item = Plane> + Clone) -> f64 {
        let area = |hull: &Hull, plane: &Plane| polygon::area(&flat_section(plane, hull));
        let largest = |hull: &Hull| planes.clone().map(|plane| area(hull, &plane)).fold(0.0, f64::max);
        let smaller = |of: [f64; 2]| of[0].min(of[1]);
        let of_cube = smaller(self.hulls.map(|hull| libm::cbrt(hull.volume()).powi(2)));
        let there = smaller(self.hulls.map(largest));
        ENOUGH_GLUE * if there > 0.0 { there.min(of_cube) } else { of_cube }
    }

    /// The price of a plane where both hulls end within `rough_mm` of it.
    fn price(&self, plane: &Plane, rough_mm: f64, enough_mm2: f64) -> f64 {
        let lack = (1.0 - self.common(plane, rough_mm) / enough_mm2.max(f64::MIN_POSITIVE)).max(0.0);
        let lost_joints = self.lost_joints(plane, 2.0 * rough_mm);
        let lost: f64 = self.lost(plane).iter().zip(self.weights).map(|(share, weight)| share * weight).sum();
        lost + JOINT_PRICE * lost_joints + GLUE_PRICE * lack
    }

    /// The shares of the interfaces of other joints that a plane cuts off, together, where it cuts deeper than this.
    fn lost_joints(&self, plane: &Plane, spared_mm: f64) -> f64 {
        let sides = [*plane, plane.flipped()];
        self.kept
            .iter()
            .zip(&sides)
            .flat_map(|(kept, side)| kept.iter().map(|joint| joint.lost(side, spared_mm)))
            .sum()
    }

    /// The share of each hull that a plane takes off and the other does not have.
    fn lost(&self, plane: &Plane) -> [f64; 2] {
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

/// What the sections of two hulls share, in the plane's [`Plane::basis`]; empty where that is nothing.
pub(super) fn shared_section(plane: &Plane, first: &Hull, second: &Hull) -> Vec<DVec2> {
    common_outline(&flat_section(plane, first), &flat_section(plane, second))
}

/// What two convex polygons share; either may be nothing.
pub(super) fn common_outline(first: &[DVec2], second: &[DVec2]) -> Vec<DVec2> {
    let is_nothing = first.is_empty() || second.is_empty();
    if is_nothing { Vec::new() } else { polygon::intersect_convex(first, second) }
}

/// The section of a hull; empty where it has no area.
pub(super) fn section(plane: &Plane, hull: &Hull) -> Vec<DVec3> {
    Some(hull.section(plane)).filter(|section| section.len() >= 3).unwrap_or_default()
}

/// The section of a hull, in the plane's [`Plane::basis`], counter-clockwise; empty where it has no area.
pub(super) fn flat_section(plane: &Plane, hull: &Hull) -> Vec<DVec2> {
    flattened(plane, section(plane, hull))
}

/// A convex polygon in the plane's [`Plane::basis`], counter-clockwise.
pub(super) fn flattened(plane: &Plane, outline: impl IntoIterator<Item = DVec3>) -> Vec<DVec2> {
    let mut flat: Vec<DVec2> = outline.into_iter().map(|p| plane.flat(p)).collect();
    if polygon::area(&flat) < 0.0 {
        flat.reverse();
    }
    flat
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
    use super::super::PartId;
    use super::*;

    fn contact(points: Vec<DVec3>, interface: Interface) -> Contact {
        Contact { parts: (PartId(0), PartId(1)), points, interface, length_mm: 40.0 }
    }

    fn cuboid(low: DVec3, high: DVec3) -> Hull {
        let corner = |k: usize| {
            DVec3::new([low.x, high.x][k & 1], [low.y, high.y][k >> 1 & 1], [low.z, high.z][k >> 2])
        };
        Hull::of_points(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
    }

    /// A body with a large part that overlaps its end, on which a tail sits, and with many legs.
    #[test]
    fn a_plane_spares_one_joint_of_many() {
        let body = cuboid(DVec3::ZERO, DVec3::new(50.0, 40.0, 40.0));
        let large = cuboid(DVec3::new(38.0, 0.0, -100.0), DVec3::new(60.0, 30.0, 140.0));
        let square = |at: DVec3, u: DVec3, v: DVec3| vec![at + u + v, at + u - v, at - u - v, at - u + v];
        let points = square(DVec3::new(38.0, 15.0, 20.0), DVec3::Y * 15.0, DVec3::Z * 20.0);
        let tail = square(DVec3::new(50.0, 35.0, 20.0), DVec3::Y * 3.0, DVec3::Z * 5.0);
        let leg = |k: u32| DVec3::new(2.0 * f64::from(k), 20.0, 0.0);
        let legs = (0..18).map(|k| square(leg(k), DVec3::X, DVec3::Y));
        let kept: Vec<Vec<DVec3>> = std::iter::once(tail.clone()).chain(legs).collect();
        let lost = |kept: &[Vec<DVec3>]| {
            let (plane, _) = between(
                &contact(points.clone(), Interface::Border),
                &Ground::new(&body, &large, [kept, &[]]),
                &[],
            );
            Kept::new(&tail).lost(&plane, 0.0)
        };
        assert_eq!(lost(&kept), 0.0);
        assert_eq!(lost(&[kept.concat()]), 1.0, "as a share of all, one joint is not worth the part");
    }

    /// A wheel is half inside of the body of a car, and reaches out of its side and its bottom. Planes leaned between the two,
    /// and took the lower edge off the whole body.
    #[test]
    fn a_small_part_does_not_cost_a_large_one_more_than_it_is() {
        let body = cuboid(DVec3::ZERO, DVec3::new(100.0, 44.0, 40.0));
        let wheel = cuboid(DVec3::new(11.0, -2.0, -11.0), DVec3::new(33.0, 6.0, 12.0));
        let across = [[0.0, 12.0], [0.0, 6.0], [0.0, 0.0], [3.0, 0.0], [6.0, 0.0]];
        let points = [11.0, 22.0, 33.0].map(|x| across.map(|[y, z]| DVec3::new(x, y, z))).concat();
        let ground = Ground::new(&body, &wheel, [&[], &[]]);
        let (plane, _) = between(&contact(points, Interface::Bodies), &ground, &[]);
        let lost_mm3 = body.volume() - body.clip(&plane).unwrap().volume();
        assert!(lost_mm3 < wheel.volume(), "{plane:?} takes {lost_mm3} mm³");
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

    /// The borders of four legs with the top of a table are at slightly different heights, and one leans. Planes were turned to
    /// spare the other joints, and made a roof of the top.
    #[test]
    fn legs_stand_on_the_flat_side_of_a_table() {
        let top = cuboid(DVec3::new(-60.0, -40.0, 0.0), DVec3::new(60.0, 40.0, 6.0));
        let leg =
            |x: f64, y: f64| cuboid(DVec3::new(x - 4.0, y - 4.0, -60.0), DVec3::new(x + 4.0, y + 4.0, 0.8));
        let border = |x: f64, y: f64, z: f64, lean: f64| {
            let corners = [(4.0, 4.0), (-4.0, 4.0), (-4.0, -4.0), (4.0, -4.0)];
            corners.map(|(u, v)| DVec3::new(x + u, y + v, z + lean * (u + v))).to_vec()
        };
        let places = [(48.0, 28.0), (-48.0, 28.0), (-48.0, -28.0)];
        let others: Vec<Vec<DVec3>> = places.iter().map(|&(x, y)| border(x, y, -2.2, 0.0)).collect();
        let own = border(48.0, -28.0, 0.2, 0.15);
        let (plane, lost) = between(
            &contact(own, Interface::Border),
            &Ground::new(&top, &leg(48.0, -28.0), [&others, &[]]),
            &[],
        );
        assert!(plane.normal().z < -1.0 + 1e-9, "{plane:?}");
        assert!(plane.offset().abs() < 1e-9 && lost == 0.0, "{plane:?} {lost}");
    }

    /// A cornice that runs into the wall of a house: points between the two surfaces are farther out at its upper edge.
    #[test]
    fn between_bodies_a_wall_stays_upright() {
        let house = cuboid(DVec3::ZERO, DVec3::new(80.0, 80.0, 100.0));
        let cornice = cuboid(DVec3::new(-2.0, -5.0, 40.0), DVec3::new(82.0, 5.0, 50.0));
        let points: Vec<DVec3> = (0..40)
            .map(|k| {
                let t = f64::from(k) / 39.0;
                let height = if k % 2 == 0 { 40.0 } else { 50.0 };
                DVec3::new(80.0 * t, if k % 2 == 0 { 0.0 } else { 1.5 }, height)
            })
            .collect();
        let leans = |interface: Interface| {
            let (plane, _) =
                between(&contact(points.clone(), interface), &Ground::new(&house, &cornice, [&[], &[]]), &[]);
            plane.normal().y.abs() < 1.0 - 1e-9
        };
        assert!(leans(Interface::Border), "else the next line says nothing");
        assert!(!leans(Interface::Bodies));
    }
}
