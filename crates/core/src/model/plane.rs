//! The plane of a joint between two parts (§4.2.1): least squares through the interface, moved or
//! turned where that takes less off the two.

use super::contact::{Contact, Interface};
use super::ground::{Ground, middle, radius_mm};
use crate::geom::{FlatSide, Hull, Mirror, Plane};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// A fitted plane's normal has at least this share along the mirror plane, else it is one between two
/// sides and not between two parts across.
const UPRIGHT: f64 = 0.5;
/// Places tried along each normal.
const SLIDES: usize = 17;
/// Planes are looked for this far beyond the interface, as a share of its size.
const BEYOND: f64 = 0.5;
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
/// Price of a move by the size of the interface, or of a turn by a right angle: among equals the
/// fitted plane wins.
const MOVE_PRICE: f64 = 0.05;

/// The plane between two parts, its normal from `parent` to `child`, and the larger share of either that
/// it takes off and the other does not have. Between parts that lie `across` mirror planes it is its own image in them.
pub(super) fn between(contact: &Contact, ground: &Ground<'_>, across: &[Mirror]) -> (Plane, f64) {
    let search = match Search::new(contact, ground, across) {
        Ok(search) => search,
        Err(plane) => return (plane, 0.0),
    };
    let best = search.near_the_fitted();
    let on_plate = search.along_plates().filter(|on_plate| on_plate.0 < best.0);
    let best = on_plate.unwrap_or(best);
    let on_facet = search.along_facets().filter(|on_facet| on_facet.0 < best.0 + AS_GOOD);
    let best = on_facet.unwrap_or(best).1;
    let lost = ground.lost(&best);
    (best, lost[0].max(lost[1]))
}

/// A plane and its price.
type Priced = (f64, Plane);

fn cheapest(planes: impl Iterator<Item = Priced>) -> Option<Priced> {
    planes.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Where planes are looked for.
struct Search<'a> {
    contact: &'a Contact,
    ground: &'a Ground<'a>,
    across: &'a [Mirror],
    centre: DVec3,
    /// The fitted plane; [`Self::straight`] where that stands in the way of a mirror plane.
    first: Plane,
    /// The plane at a right angle to the way between both parts.
    straight: Option<Plane>,
    /// Radius of the interface.
    size_mm: f64,
    enough_mm2: f64,
}

impl<'a> Search<'a> {
    /// A level plane where nothing tells how it should lie.
    fn new(contact: &'a Contact, ground: &'a Ground<'a>, across: &'a [Mirror]) -> Result<Self, Plane> {
        let points = &contact.points;
        let [from, to] = ground.hulls().map(Hull::centroid);
        let towards = along(across, to - from);
        let centre = across.iter().fold(middle(points), |c, mirror| mirror.plane().project(c));
        let facing = |plane: Plane| if plane.normal().dot(towards) < 0.0 { plane.flipped() } else { plane };
        let fitted = Plane::fit(points).map(|(plane, _)| along(across, plane.normal())).filter(is_upright);
        let fitted = fitted.and_then(|normal| Plane::through(centre, normal)).map(facing);
        let straight = Plane::through(centre, towards);
        let first = fitted.or(straight).ok_or_else(|| Plane::horizontal(centre.z))?;
        let size_mm = radius_mm(points, centre).max(f64::MIN_POSITIVE);
        let search =
            Self { contact, ground, across, centre, first, straight, size_mm, enough_mm2: f64::INFINITY };
        let enough_mm2 = ground.enough_mm2(search.slid(first).map(|(plane, _)| plane));
        Ok(Self { enough_mm2, ..search })
    }

    /// A plane at many places along its normal, with the prices of the moves.
    fn slid(&self, plane: Plane) -> impl Iterator<Item = (Plane, f64)> + Clone {
        let Self { centre, first, size_mm, .. } = *self;
        let heights = self.contact.points.iter().map(|p| plane.normal().dot(*p - centre));
        let (low, high) = heights.fold((0.0f64, 0.0f64), |(l, h), d| (l.min(d), h.max(d)));
        let (low, high) = (low - BEYOND * size_mm, high + BEYOND * size_mm);
        let slide = move |k: usize| low + (high - low) * k as f64 / (SLIDES - 1) as f64;
        let shifts = std::iter::once(0.0).chain((0..SLIDES).map(slide));
        shifts.filter_map(move |shift| {
            let moved = Plane::through(centre + plane.normal() * shift, plane.normal())?;
            let turn = angle_rad(&plane, &first);
            Some((moved, MOVE_PRICE * (shift.abs() / size_mm + turn / FRAC_PI_2)))
        })
    }

    fn priced(&self, plane: Plane, move_price: f64, rough_mm: f64) -> Priced {
        (move_price + self.ground.price(&plane, rough_mm, self.enough_mm2), plane)
    }

    fn slid_and_priced(&self, plane: Plane, rough_mm: f64) -> impl Iterator<Item = Priced> {
        self.slid(plane).map(move |(plane, price)| self.priced(plane, price, rough_mm))
    }

    /// The best between the fitted plane and the straight one; where that takes other joints, of planes that are turned, too.
    fn near_the_fitted(&self) -> Priced {
        let Self { centre, first, straight, .. } = *self;
        let cheapest_of = |planes: &mut dyn Iterator<Item = Plane>| {
            let priced = planes.flat_map(|plane| self.slid_and_priced(plane, 0.0));
            cheapest(priced).unwrap_or((f64::INFINITY, first))
        };
        let halfway = straight.and_then(|s| Plane::through(centre, first.normal() + s.normal()));
        let best = cheapest_of(&mut [Some(first), halfway, straight].into_iter().flatten());
        if self.ground.lost_joints(&best.1, 0.0) <= SPARED {
            return best;
        }
        let turned = turned(first.normal()).map(|normal| along(self.across, normal)).filter(is_upright);
        let other = cheapest_of(&mut turned.filter_map(|normal| Plane::through(centre, normal)));
        if other.0 < best.0 { other } else { best }
    }

    /// The best along the flat sides of both hulls. What hangs under a plate is along its top: the underside may be rough.
    fn along_plates(&self) -> Option<Priced> {
        let along_plate = |side: FlatSide| {
            let normal = side.plane.normal();
            let towards = normal * normal.dot(self.first.normal()).signum();
            let across = Plane::through(self.centre, towards)
                .filter(|p| p.normal().dot(self.first.normal()) > libm::cos(LEANING_RAD) && self.is_image(p));
            let own = across.filter(|_| towards == normal);
            let own = own.map(|_| self.priced(side.plane, 0.0, side.roughness));
            let level = across.into_iter().flat_map(|plane| self.slid_and_priced(plane, side.roughness));
            let level = cheapest(level);
            let is_as_good = |own: &Priced| level.is_none_or(|level| own.0 < level.0 + AS_GOOD);
            own.filter(is_as_good).or(level)
        };
        cheapest(self.ground.sides(FlatSide::of_hull).filter_map(along_plate))
    }

    /// The best of the sides of boxes between bodies: a box stays one, and its sides are exact where samples of them are not.
    fn along_facets(&self) -> Option<Priced> {
        let sides =
            (self.contact.interface == Interface::Bodies).then(|| self.ground.sides(FlatSide::of_box));
        let priced = |side: FlatSide| {
            let turn = |other: &Plane| angle_rad(&side.plane, other);
            let turn = self.straight.iter().map(turn).fold(turn(&self.first), f64::min);
            (turn < MOST_TURN_RAD && self.is_image(&side.plane))
                .then(|| self.priced(side.plane, MOVE_PRICE * turn / FRAC_PI_2, side.roughness))
        };
        cheapest(sides.into_iter().flatten().filter_map(priced))
    }

    /// Whether a plane is its own image in the mirror planes.
    fn is_image(&self, plane: &Plane) -> bool {
        along(self.across, plane.normal()).length() > 1.0 - 1e-9
    }
}

/// The share of a direction along mirror planes.
fn along(across: &[Mirror], direction: DVec3) -> DVec3 {
    across.iter().fold(direction, |d, mirror| mirror.along(d))
}

fn is_upright(normal: &DVec3) -> bool {
    normal.length() >= UPRIGHT
}

fn angle_rad(a: &Plane, b: &Plane) -> f64 {
    libm::acos(a.normal().dot(b.normal()).clamp(-1.0, 1.0))
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
            Ground::new(&body, &large, [std::slice::from_ref(&tail), &[]]).lost_joints(&plane, 0.0)
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
