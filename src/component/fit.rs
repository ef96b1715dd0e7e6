//! Fits a solid to a hull: sequential linear programming over every free parameter.
//!
//! The paper optimises eight parameters of the top panel, then each profile alone, by gradient
//! descent (§4.2.2, §4.3.1). Here all directions, heights and planes move together, to minimise
//! the exact Hausdorff distance. Around the present solid every measure is linear in the
//! parameters, so each step is a small linear programme within a trust region.

use super::distance::Polytope;
use super::gradient::{Freedom, Terms};
use super::lp::Programme;
use super::profile::imbalance;
use super::solid::{FaceId, Solid};
use super::start::{MAX_SLOPE_RAD, MAX_TURN_RAD, MIN_BEND_RAD, MIN_TURN_RAD};
use super::target::{FoldSpot, Target};
use glam::{DMat3, DVec3};

/// Steps of the fit at most.
const STEPS: usize = 25;
/// First size of the trust region, as a share of the hull's radius.
const FIRST_REGION: f64 = 0.12;
/// Size of the trust region at which the fit ends.
const LAST_REGION: f64 = 0.0015;
/// Steps that gain less than this share of the merit are slow; the fit ends after a few in a row.
const SLOW_GAIN: f64 = 0.01;
/// So many slow steps.
const SLOW_STEPS: usize = 3;
/// Price of a millimetre by which a panel is too small, or the balance point out of its place,
/// against a millimetre of error.
const SIZE_PRICE: f64 = 20.0;
/// Weight of the mean error beside the largest one: without it all but the worst place are free.
const MEAN_WEIGHT: f64 = 0.3;
/// Weight of the mean distance by which joint panels miss their partners.
const JOINT_WEIGHT: f64 = 0.15;
/// Aim a little above the limits, so that rounding does not fall below them.
const MARGIN: f64 = 1.02;

/// A fitted solid with where each chain folds.
#[derive(Debug, Clone)]
pub(super) struct Fitted {
    pub(super) solid: Solid,
    pub(super) spots: Vec<FoldSpot>,
    /// Hausdorff distance to the hull (to its simplification during the fit), mm.
    pub(super) error_mm: f64,
    /// Sum of what the solid lacks to be valid, mm; 0 when valid.
    pub(super) lack_mm: f64,
}

/// Improves `solid` until the trust region has shrunk.
pub(super) fn fit(target: &Target, solid: Solid, spots: Vec<FoldSpot>, steps: usize) -> Fitted {
    let hull = Polytope::of_hull(target.hull);
    let centre = target.hull.centroid();
    let radius_mm = target.hull.vertices().iter().map(|v| v.distance(centre)).fold(0.0, f64::max);
    let task = Task { target, hull, spots, radius_mm };
    let mut best = task.measure(task.restore(solid));
    let mut region = FIRST_REGION * radius_mm;
    let mut slow = 0;
    for _ in 0..steps.min(STEPS) {
        if region < LAST_REGION * radius_mm || slow == SLOW_STEPS {
            break;
        }
        let next = task.step(&best.solid, region).map(|s| task.measure(task.restore(s)));
        let gain = |next: &Fitted| task.merit(&best) - task.merit(next);
        match next {
            Some(next) if gain(&next) > 1e-6 * radius_mm => {
                slow = if gain(&next) < SLOW_GAIN * task.merit(&best) { slow + 1 } else { 0 };
                best = next;
                region = (region * 1.5).min(FIRST_REGION * radius_mm);
            }
            _ => region *= 0.4,
        }
    }
    best
}

struct Task<'a> {
    target: &'a Target<'a>,
    hull: Polytope,
    spots: Vec<FoldSpot>,
    radius_mm: f64,
}

impl Task<'_> {
    fn merit(&self, fitted: &Fitted) -> f64 {
        fitted.error_mm + SIZE_PRICE * fitted.lack_mm
    }

    /// Error and lack of a solid.
    fn measure(&self, solid: Solid) -> Fitted {
        let own = polytope(&solid);
        let error_mm = super::distance::hausdorff(&own, &self.hull);
        let least = self.target.min_panel_mm;
        let heights = solid.heights();
        let lack_of = |j: usize| {
            let narrow = heights.iter().map(|&v| least - solid.width_at(j, v)).fold(0.0, f64::max);
            let rooms =
                self.rooms(&solid, j).map(|room| (least - room.measure(&solid, j)).max(0.0)).sum::<f64>();
            let miss = match self.spots[j] {
                FoldSpot::Bend(i) => imbalance(&solid.profile(j), i + 1).abs(),
                FoldSpot::Inside(_) => 0.0,
            };
            narrow + rooms + miss
        };
        let lack_mm = (0..solid.chains.len()).map(lack_of).sum();
        Fitted { solid, spots: self.spots.clone(), error_mm, lack_mm }
    }

    /// One step: the best solid within the trust region, by the linear model.
    fn step(&self, solid: &Solid, region: f64) -> Option<Solid> {
        let freedom = Freedom::of(solid, self.radius_mm);
        let mut lp = Programme::new();
        for _ in 0..freedom.count() {
            let k = lp.variable(0.0, 1e-3 / self.radius_mm);
            lp.between(k, -region, region);
        }
        let worst = lp.variable(1.0, 0.0);
        lp.at_most([(worst, -1.0)], 0.0);
        self.error_rows(solid, &freedom, &mut lp, worst, region);
        self.size_rows(solid, &freedom, &mut lp, region);
        self.order_rows(solid, &freedom, &mut lp);
        self.joint_rows(solid, &freedom, &mut lp);
        let change = lp.solve()?;
        Some(freedom.apply(solid, &change[..freedom.count()]))
    }

    /// Distances of corners from the hull, and of the hull's corners from the solid.
    fn error_rows(&self, solid: &Solid, freedom: &Freedom, lp: &mut Programme, worst: usize, region: f64) {
        let faces = solid.faces();
        let corners: Vec<_> = (0..solid.chains.len()).flat_map(|j| solid.corners(j)).collect();
        let weight = MEAN_WEIGHT / (corners.len() + faces.len()) as f64;
        let reach = 2.0 * region;
        for corner in &corners {
            let (depth, plane) = self.hull.deepest_plane(corner.point);
            if depth < -reach {
                continue;
            }
            let nearest = self.hull.nearest(corner.point);
            let away = corner.point - nearest;
            let (d, direction) = if away.length() > 1e-6 * self.radius_mm {
                (away.length(), away.normalize())
            } else {
                (depth, self.hull.normal(plane))
            };
            let e = error_variable(lp, worst, weight);
            let mut terms = freedom.corner(solid, corner, direction);
            terms.push((e, -1.0));
            lp.at_most(terms, -d);
        }
        let own = polytope(solid);
        let errors: Vec<usize> = faces.iter().map(|_| error_variable(lp, worst, weight)).collect();
        for &vertex in self.target.hull.vertices() {
            let (depth, face) = own.deepest_plane(vertex);
            if depth < -reach {
                continue;
            }
            let nearest = own.nearest(vertex);
            let away = vertex - nearest;
            let mut terms = if away.length() > 1e-6 * self.radius_mm {
                self.support_terms(solid, freedom, nearest, away.normalize(), faces[face])
            } else {
                freedom.plane(solid, faces[face], vertex)
            };
            terms.iter_mut().for_each(|t| t.1 = -t.1);
            terms.push((errors[face], -1.0));
            lp.at_most(terms, -depth.max(away.length()));
        }
    }

    /// Change of the solid's support function in `direction`, whose supporting point is `at`:
    /// the direction is a combination of the normals of the faces that meet there.
    fn support_terms(
        &self,
        solid: &Solid,
        freedom: &Freedom,
        at: DVec3,
        direction: DVec3,
        fallback: FaceId,
    ) -> Terms {
        let touching: Vec<FaceId> = solid
            .faces()
            .into_iter()
            .filter(|&f| {
                let (n, c) = solid.plane(f);
                (n.dot(at) - c).abs() < 1e-7 * self.radius_mm
            })
            .collect();
        for (a, &f) in touching.iter().enumerate() {
            for (b, &g) in touching.iter().enumerate().skip(a) {
                for &h in touching.iter().skip(b) {
                    if let Some(weights) = cone_weights([f, g, h].map(|f| solid.plane(f).0), direction) {
                        let planes = [f, g, h].map(|f| freedom.plane(solid, f, at));
                        return super::gradient::sum((0..3).map(|k| (weights[k], &planes[k])));
                    }
                }
            }
        }
        freedom.plane(solid, fallback, at)
    }

    /// Panels stay wide and long enough, balance points in their places.
    fn size_rows(&self, solid: &Solid, freedom: &Freedom, lp: &mut Programme, region: f64) {
        let least = self.target.min_panel_mm * MARGIN;
        let heights = solid.heights();
        for j in 0..solid.chains.len() {
            let lack = lack_variable(lp);
            for &v in &heights {
                let width = solid.width_at(j, v);
                if width < least + 12.0 * region {
                    let mut terms: Terms =
                        freedom.width(solid, j, v).into_iter().map(|(k, a)| (k, -a)).collect();
                    terms.push((lack, -1.0));
                    lp.at_most(terms, width - least);
                }
            }
            for room in self.rooms(solid, j) {
                let now = room.measure(solid, j);
                if now < least + 6.0 * region {
                    let mut terms = freedom.of_profile(solid, j, |s| -room.measure(s, j));
                    terms.push((lack_variable(lp), -1.0));
                    lp.at_most(terms, now - least);
                }
            }
            self.fold_rows(solid, freedom, j, lp);
        }
    }

    /// Lengths of chain j that must not be too small: of its panels, and about its fold vertex.
    fn rooms(&self, solid: &Solid, j: usize) -> impl Iterator<Item = Room> + use<> {
        let about_fold = match self.spots[j] {
            FoldSpot::Inside(i) => vec![Room::Above(i), Room::Below(i)],
            FoldSpot::Bend(_) => Vec::new(),
        };
        (0..solid.chains[j].facets.len()).map(Room::Length).chain(about_fold)
    }

    /// A fold vertex at a bend stays the balance point.
    fn fold_rows(&self, solid: &Solid, freedom: &Freedom, j: usize, lp: &mut Programme) {
        let FoldSpot::Bend(i) = self.spots[j] else { return };
        let measure = |s: &Solid| imbalance(&s.profile(j), i + 1);
        let terms = freedom.of_profile(solid, j, measure);
        let now = measure(solid);
        let lack = lack_variable(lp);
        lp.at_most(terms.iter().copied().chain([(lack, -1.0)]), -now);
        lp.at_most(terms.iter().map(|&(k, a)| (k, -a)).chain([(lack, -1.0)]), now);
    }

    /// Slopes fall from top to bottom, directions turn counter-clockwise.
    fn order_rows(&self, solid: &Solid, freedom: &Freedom, lp: &mut Programme) {
        let r = freedom.radius_mm();
        for (j, chain) in solid.chains.iter().enumerate() {
            for (i, w) in chain.facets.windows(2).enumerate() {
                let bend = (w[0].slope_rad - w[1].slope_rad - MIN_BEND_RAD).max(0.0) * r;
                let terms = [(freedom.slope(j, i), -1.0), (freedom.slope(j, i + 1), 1.0)];
                lp.at_most(terms.into_iter().filter_map(|(k, a)| Some((k?, a))), bend);
            }
            for (i, facet) in chain.facets.iter().enumerate() {
                if let Some(k) = freedom.slope(j, i) {
                    lp.at_most([(k, 1.0)], (MAX_SLOPE_RAD - facet.slope_rad).max(0.0) * r);
                    lp.at_most([(k, -1.0)], (MAX_SLOPE_RAD + facet.slope_rad).max(0.0) * r);
                }
            }
            let next = solid.next(j);
            let gap = (solid.chains[next].angle_rad - chain.angle_rad).rem_euclid(std::f64::consts::TAU);
            let turn = |sign: f64| {
                [(freedom.angle(j), sign), (freedom.angle(next), -sign)]
                    .into_iter()
                    .filter_map(|(k, a)| Some((k?, a)))
            };
            lp.at_most(turn(1.0), (gap - MIN_TURN_RAD).max(0.0) * r);
            lp.at_most(turn(-1.0), (MAX_TURN_RAD - gap).max(0.0) * r);
        }
    }

    /// Joint panels should cover what is glued on them, or stay within what they are glued on.
    fn joint_rows(&self, solid: &Solid, freedom: &Freedom, lp: &mut Programme) {
        for joint in &self.target.joints {
            let Some(face) = self.target.joint_face(solid, joint) else { continue };
            let neighbours: Vec<FaceId> = solid.faces().into_iter().filter(|&f| f != face).collect();
            let weight = JOINT_WEIGHT / (joint.cover.len() + joint.within.len()).max(1) as f64;
            for &point in &joint.cover {
                let miss = lp.variable(weight, 0.0);
                lp.at_most([(miss, -1.0)], 0.0);
                for &f in &neighbours {
                    let (n, c) = solid.plane(f);
                    let inside = c - n.dot(point);
                    if inside < 0.3 * self.radius_mm {
                        let mut terms: Terms =
                            freedom.plane(solid, f, point).into_iter().map(|(k, a)| (k, -a)).collect();
                        terms.push((miss, -1.0));
                        lp.at_most(terms, inside);
                    }
                }
            }
            let corners: Vec<_> = (0..solid.chains.len())
                .flat_map(|j| solid.corners(j))
                .filter(|c| c.faces.contains(&face))
                .collect();
            for &(n, c) in &joint.within {
                let miss = lp.variable(weight, 0.0);
                lp.at_most([(miss, -1.0)], 0.0);
                for corner in &corners {
                    let mut terms = freedom.corner(solid, corner, n);
                    terms.push((miss, -1.0));
                    lp.at_most(terms, c - n.dot(corner.point));
                }
            }
        }
    }

    /// Makes fold vertices at bends exact again after a linear step, by moving one plane beside
    /// each (Newton's method on its offset), where that is a small change.
    fn restore(&self, mut solid: Solid) -> Solid {
        for j in 0..solid.chains.len() {
            if let FoldSpot::Bend(i) = self.spots[j] {
                let free = if solid.chains[j].facets[i].is_joint { i + 1 } else { i };
                if let Some(exact) = exact_bend(&solid, j, i, free) {
                    solid = exact;
                }
            }
        }
        solid
    }
}

/// A distance that must not fall below the least panel size.
#[derive(Debug, Clone, Copy)]
enum Room {
    /// Length of facet i of the profile.
    Length(usize),
    /// From the upper end of facet i down to the balance point in it.
    Above(usize),
    /// From the balance point down to the lower end of facet i.
    Below(usize),
}

impl Room {
    fn measure(self, solid: &Solid, j: usize) -> f64 {
        let profile = solid.profile(j);
        match self {
            Room::Length(i) => profile[i].distance(profile[i + 1]).copysign(profile[i].y - profile[i + 1].y),
            Room::Above(i) => -imbalance(&profile, i) / 2.0,
            Room::Below(i) => imbalance(&profile, i + 1) / 2.0,
        }
    }
}

/// The solid with facet `free` of chain j moved until the bend below facet `i` is the balance
/// point. `None` where that takes more than a small move.
fn exact_bend(solid: &Solid, j: usize, i: usize, free: usize) -> Option<Solid> {
    let mut solid = solid.clone();
    let miss = |s: &Solid| imbalance(&s.profile(j), i + 1);
    let size = (solid.top_mm - solid.bottom_mm).abs();
    let start = solid.chains[j].facets[free].offset_mm;
    let step = 1e-6 * size;
    for _ in 0..20 {
        let now = miss(&solid);
        if now.abs() <= 1e-13 * size {
            return Some(solid);
        }
        let base = solid.chains[j].facets[free].offset_mm;
        solid.chains[j].facets[free].offset_mm = base + step;
        let next = base - now * step / (miss(&solid) - now);
        if !next.is_finite() || (next - start).abs() > 0.2 * size {
            return None;
        }
        solid.chains[j].facets[free].offset_mm = next;
    }
    (miss(&solid).abs() <= 1e-11 * size).then_some(solid)
}

/// What a solid lacks to be valid, at its price.
fn lack_variable(lp: &mut Programme) -> usize {
    let lack = lp.variable(SIZE_PRICE, 0.0);
    lp.at_most([(lack, -1.0)], 0.0);
    lack
}

/// A non-negative error not above `worst`, with a price of its own.
fn error_variable(lp: &mut Programme, worst: usize, weight: f64) -> usize {
    let e = lp.variable(weight, 0.0);
    lp.at_most([(e, 1.0), (worst, -1.0)], 0.0);
    lp.at_most([(e, -1.0)], 0.0);
    e
}

/// Non-negative weights with `Σ w n = direction`, if there are any; repeated normals stand for
/// one or two faces.
fn cone_weights(n: [DVec3; 3], direction: DVec3) -> Option<[f64; 3]> {
    let close = |w: DVec3| {
        let rest = (n[0] * w.x + n[1] * w.y + n[2] * w.z - direction).length();
        (rest < 1e-6 && w.min_element() > -1e-9).then(|| w.to_array())
    };
    if n[0] == n[1] && n[1] == n[2] {
        return close(DVec3::new(direction.dot(n[0]), 0.0, 0.0));
    }
    if n[0] == n[1] || n[1] == n[2] {
        let (a, b) = (n[0], n[2]);
        let (ab, da, db) = (a.dot(b), direction.dot(a), direction.dot(b));
        let det = 1.0 - ab * ab;
        return close(DVec3::new((da - ab * db) / det, 0.0, (db - ab * da) / det));
    }
    let m = DMat3::from_cols(n[0], n[1], n[2]);
    (m.determinant().abs() > 1e-9).then(|| m.inverse() * direction).and_then(close)
}

/// The solid as a polytope, faces in the order of [`Solid::faces`].
pub(super) fn polytope(solid: &Solid) -> Polytope {
    Polytope::new(solid.outlines().into_iter().map(|(face, outline)| {
        let (normal, offset) = solid.plane(face);
        (normal, offset, outline)
    }))
}
