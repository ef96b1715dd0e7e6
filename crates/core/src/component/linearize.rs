//! One step of the fit: the measures, linearized about the present solid, as a quadratic programme.

use super::angles::{MAX_SLOPE_RAD, MAX_TURN_RAD, MIN_BEND_RAD, MIN_TURN_RAD};
use super::distance::{Feature, Position};
use super::filling::Filled;
use super::fit::{BORDER_PRICE, Fitted, MARGIN, SIZE_PRICE, Task, rooms};
use super::gradient::{Freedom, Parameter, ProfileLength, Terms, sum};
use super::likeness::{Figure, faces, faces_inside};
use super::qp::Programme;
use super::seated;
use super::shape::SolidShape;
use super::solid::Solid;
use super::symmetry::Symmetry;
use super::target::FoldSpot;
use glam::DVec3;
use std::f64::consts::TAU;

// Costs and work below are measured as in `search/schedule.rs`.

/// Places that are less far out than the worst place by more than this many steps cannot become the worst
/// within a step. With 3: cost +2.8, four +1.7, work 0.95.
const REACH: f64 = 6.0;
/// Places farther than this share of the radius inside a joint panel or a border cannot leave it within a
/// step. With 0.15: cost −0.3, four −0.6, the same work. Not bounded from below by a case yet.
const NEAR_JOINT: f64 = 0.3;
/// Curvature of the variables that bound others, over the radius: the programme needs some.
const BOUND_CURVATURE: f64 = 0.02;
/// The mass of a face is as far from its middle as points at this share of the way to its corners. With 0.4:
/// cost +0.9, four −0.7: the difference is chance.
const SPREAD: f64 = 0.6;
/// No parameter changes by more than this many times the length of the step. With 2: cost −0.9, the same four, work 1.04.
const LONGEST: f64 = 3.0;

/// A programme about to be filled, with the variables beside the solid's parameters.
struct Linearization<'a> {
    task: &'a Task<'a>,
    at: &'a Fitted,
    freedom: Freedom,
    programme: Programme,
    /// The largest distance.
    worst: usize,
    /// The share of what is lacking that may go on lacking: with 1 nothing need change, so that
    /// there is always a solution.
    lack: usize,
    /// For each joint, how far its panel misses its partner.
    first_miss: usize,
    /// How far the solid reaches beyond its borders.
    beyond: usize,
}

impl Task<'_> {
    /// The best solid near the present one, by the linear linearized.
    pub(super) fn step(&self, at: &Fitted, step_mm: f64) -> Option<Solid> {
        let freedom = Freedom::of(&at.shape.solid, self.radius_mm, self.target.symmetry);
        let count = freedom.count();
        let beyond = count + 2 + self.target.joints.len();
        let mut linearized = Linearization {
            task: self,
            at,
            freedom,
            programme: Programme::new(beyond + usize::from(!self.target.borders.is_empty())),
            worst: count,
            lack: count + 1,
            first_miss: count + 2,
            beyond,
        };
        linearized.prices(step_mm);
        linearized.error_rows(step_mm);
        if self.aim.has_volume() {
            linearized.likeness(step_mm);
        }
        linearized.size_rows(step_mm);
        linearized.order_rows();
        linearized.border_rows();
        for (k, joint) in self.target.joints.iter().enumerate() {
            let shape = (&at.shape, &linearized.freedom);
            let near_mm = NEAR_JOINT * self.radius_mm;
            seated::rows(shape, (&self.target, joint), near_mm, count + 2 + k, &mut linearized.programme);
        }
        let change = linearized.programme.solve()?;
        Some(linearized.freedom.apply(&at.shape.solid, &change[..count]))
    }
}

impl Linearization<'_> {
    fn shape(&self) -> &SolidShape {
        &self.at.shape
    }

    fn prices(&mut self, step_mm: f64) {
        let longest = LONGEST * step_mm;
        for (k, weight) in self.freedom.weights().into_iter().enumerate() {
            self.programme.add_cost(k, 0.0, self.task.aim.step * weight / step_mm);
            self.programme.at_most([(k, 1.0)], longest);
            self.programme.at_most([(k, -1.0)], longest);
        }
        let curvature = BOUND_CURVATURE / self.task.radius_mm;
        self.bound(self.worst, self.task.aim.worst, curvature);
        let lack_price = SIZE_PRICE * self.at.lack_mm.max(1e-3);
        self.bound(self.lack, lack_price, lack_price * 0.1);
        for k in 0..self.task.target.joints.len() {
            let price = self.task.target.joints[k].price.max(1e-6);
            self.bound(self.first_miss + k, price, price * curvature);
        }
    }

    /// A variable that is not negative.
    fn bound(&mut self, variable: usize, price: f64, curvature: f64) {
        self.programme.add_cost(variable, price, curvature);
        self.programme.at_most([(variable, -1.0)], 0.0);
    }

    /// Distances of corners from the hull, and of the hull's corners from the solid.
    #[inline(never)]
    fn error_rows(&mut self, step_mm: f64) {
        let lowest = self.at.error_mm - REACH * step_mm;
        let (at, task) = (self.at, self.task);
        let corners = task.hull.corners();
        let count = (at.own.len() + at.hulls.len()) as f64;
        let weight = task.aim.mean / (count * task.mean_scale_mm());
        for (corner, position) in at.shape.corners.iter().zip(&at.own) {
            if position.signed_mm > lowest {
                let (distance, direction) =
                    self.distance(position, corner.point, |face| task.hull.normal(face));
                let terms = self.freedom.corner(&at.shape, corner, direction);
                self.error_row(&terms, distance, weight);
            }
        }
        for (&corner, position) in corners.iter().zip(&at.hulls) {
            if position.signed_mm > lowest {
                let (distance, direction) =
                    self.distance(position, corner, |face| at.shape.polytope.normal(face));
                let mut terms = self.reach(position, corner, direction);
                terms.iter_mut().for_each(|t| t.1 = -t.1);
                self.error_row(&terms, distance, weight);
            }
        }
    }

    /// The volume that the solid and what it should be do not share. The rate of each face is that of its
    /// area outside less that inside, the mean of what it is up to `step_mm` farther out and farther in;
    /// between the two it changes with the face's place.
    #[inline(never)]
    fn likeness(&mut self, step_mm: f64) {
        let (shape, task) = (&self.at.shape, self.task);
        let out = task.aim.out / task.hull_mm2;
        let both = (task.aim.out + task.aim.short) / task.hull_mm2;
        let whole = faces(&shape.polytope);
        for (k, (whole, filled)) in whole.iter().zip(self.filled(step_mm)).enumerate() {
            let face = shape.face(k);
            for (figure, weight) in [(whole, out), (&filled.inside, -both)] {
                for (variable, rate) in self.freedom.plane(shape, face, figure.centroid()) {
                    self.programme.add_cost(variable, weight * figure.area_mm2 * rate, 0.0);
                }
            }
            let corners = shape.polytope.outline_corners(k);
            let curvature = both * filled.near_mm2 / (2.0 * step_mm * corners.len() as f64);
            let middle = whole.centroid();
            for corner in shape.polytope.outline(k).filter(|_| filled.near_mm2 > 0.0) {
                let terms = self.freedom.plane(shape, face, middle.lerp(corner, SPREAD));
                self.programme.add_square(&terms, 0.0, curvature);
            }
        }
    }

    /// What of each face is inside of what the solid should be.
    fn filled(&self, step_mm: f64) -> Vec<Filled> {
        let (solid, task) = (&self.at.shape.polytope, self.task);
        if let Some((filling, to_filling)) = &task.target.filling {
            return filling.faces(solid, to_filling, step_mm);
        }
        let [larger, smaller] = faces_inside(solid, &task.hull, [step_mm, -step_mm]);
        let between = |(larger, smaller): (&Figure, &Figure)| Filled {
            inside: Figure {
                area_mm2: (larger.area_mm2 + smaller.area_mm2) / 2.0,
                moment: (larger.moment + smaller.moment) / 2.0,
            },
            near_mm2: (larger.area_mm2 - smaller.area_mm2).max(0.0),
        };
        larger.iter().zip(&smaller).map(between).collect()
    }

    /// Signed distance and direction in which it grows.
    fn distance(&self, position: &Position, point: DVec3, normal: impl Fn(usize) -> DVec3) -> (f64, DVec3) {
        match position.nearest {
            Some((nearest, _)) if nearest.distance(point) > 1e-6 * self.task.radius_mm => {
                (nearest.distance(point), (point - nearest).normalize())
            }
            _ => (position.signed_mm, normal(position.face)),
        }
    }

    fn error_row(&mut self, terms: &[(usize, f64)], distance: f64, weight: f64) {
        if distance > 0.0 {
            self.programme.add_square(terms, distance, weight);
        }
        self.programme.at_most(terms.iter().copied().chain([(self.worst, -1.0)]), -distance);
    }

    /// Change of the solid's reach in a direction at the place nearest to a point.
    fn reach(&self, position: &Position, point: DVec3, direction: DVec3) -> Terms {
        let (shape, freedom) = (self.shape(), &self.freedom);
        let by_face =
            |face: usize, at: DVec3| freedom.plane(shape, shape.face(face), at).into_iter().collect();
        match position.nearest {
            Some((_, Feature::Corner(c))) => freedom.corner(shape, &shape.corners[c], direction),
            Some((at, Feature::Edge(a, b))) => {
                let [a, b] = [a, b].map(|c| shape.corners[c].faces);
                let mut shared = a.into_iter().filter(|f| b.contains(f));
                match (shared.next(), shared.next()) {
                    (Some(f), Some(g)) => freedom.edge(shape, [f, g], at, direction),
                    _ => by_face(position.face, point),
                }
            }
            Some((at, Feature::Face(face))) => by_face(face, at),
            None => by_face(position.face, point),
        }
    }

    /// Panels stay wide and long enough, balance points in their places.
    #[inline(never)]
    fn size_rows(&mut self, step_mm: f64) {
        let least = self.task.target.min_panel_mm * MARGIN;
        let at = self.at;
        let shape = &at.shape;
        // A level profile is in balance in its middle, whatever changes.
        let is_level = self.task.target.symmetry.is_some_and(Symmetry::is_level);
        for j in shape.solid.chain_ids() {
            for v in shape.heights_about(j) {
                let width = shape.width_at(j, v);
                if width < least + 12.0 * step_mm {
                    let terms = self.freedom.width(shape, j, v);
                    self.at_least(&terms, width, least);
                }
            }
            for room in rooms(shape, &at.spots, j) {
                let now = room.value(&shape.chains[j.0].profile);
                if now < least + 6.0 * step_mm {
                    let terms = self.freedom.length(shape, j, &room);
                    self.at_least(&terms, now, least);
                }
            }
            if let (FoldSpot::Bend(i), false) = (at.spots[j.0], is_level) {
                let beyond = ProfileLength::beyond_balance(&shape.chains[j.0], i + 1);
                for length in [beyond.clone().reversed(), beyond] {
                    let now = length.value(&shape.chains[j.0].profile);
                    let terms = self.freedom.length(shape, j, &length);
                    self.at_least(&terms, now, 0.0);
                }
            }
        }
    }

    /// A measure does not fall below `least`, or lacks no more of it than now.
    fn at_least(&mut self, terms: &[(usize, f64)], now: f64, least: f64) {
        let lacking = (least - now).max(0.0);
        let terms = terms.iter().map(|&(k, a)| (k, -a)).chain([(self.lack, -lacking)]);
        self.programme.at_most(terms, now - least);
    }

    /// Corners stay within the borders.
    fn border_rows(&mut self) {
        if self.task.target.borders.is_empty() {
            return;
        }
        let curvature = BOUND_CURVATURE / self.task.radius_mm;
        self.bound(self.beyond, BORDER_PRICE, BORDER_PRICE * curvature);
        let (shape, near_mm) = (&self.at.shape, NEAR_JOINT * self.task.radius_mm);
        for &(n, c) in &self.task.target.borders {
            for corner in shape.corners.iter().filter(|corner| c - n.dot(corner.point) < near_mm) {
                let terms = self.freedom.corner(shape, corner, n);
                let terms = terms.iter().copied().chain([(self.beyond, -1.0)]);
                self.programme.at_most(terms, c - n.dot(corner.point));
            }
        }
    }

    /// Slopes fall from top to bottom, directions turn counter-clockwise.
    fn order_rows(&mut self) {
        let r = self.freedom.radius_mm();
        let solid = &self.at.shape.solid;
        let (freedom, programme) = (&self.freedom, &mut self.programme);
        let mut difference = |a: Parameter, b: Parameter, room: f64| {
            let terms = sum([(1.0, a.as_slice()), (-1.0, b.as_slice())]);
            programme.at_most(terms.iter().copied(), room.max(0.0) * r);
        };
        for (j, chain) in solid.chain_ids().zip(&solid.chains) {
            for (i, w) in chain.facets.windows(2).enumerate() {
                let bend = w[0].slope_rad - w[1].slope_rad - MIN_BEND_RAD;
                difference(freedom.slope(j, i + 1), freedom.slope(j, i), bend);
            }
            for (i, facet) in chain.facets.iter().enumerate() {
                difference(freedom.slope(j, i), None, MAX_SLOPE_RAD - facet.slope_rad);
                difference(None, freedom.slope(j, i), MAX_SLOPE_RAD + facet.slope_rad);
            }
            let next = solid.next(j);
            let gap = (solid.chains[next.0].angle_rad - chain.angle_rad).rem_euclid(TAU);
            difference(freedom.angle(j), freedom.angle(next), gap - MIN_TURN_RAD);
            difference(freedom.angle(next), freedom.angle(j), MAX_TURN_RAD - gap);
        }
    }
}
