//! Fits a solid to a hull: a prox-linear method over every free parameter.
//!
//! The paper optimises eight parameters of the top panel, then each profile alone, by gradient
//! descent (§4.2.2, §4.3.1). Here all directions, heights and planes move together, to minimise
//! what is seen: the volume that solid and hull do not share, how far corners stand out on average,
//! and with a small weight the exact Hausdorff distance. Around the present solid every measure is
//! linear in the parameters, so each step is a small quadratic programme: the rate of the volume,
//! the largest of the linear measures, plus the square of the step (Drusvyatskiy and Lewis, "Error
//! bounds, quadratic growth, and linear convergence of proximal methods", 2018). While directions are
//! compared, only distances count.

use super::distance::{Polytope, Position};
use super::gradient::ProfileLength;
use super::likeness::{cones_mm3, faces, shared_mm3};
use super::panel::ChainId;
use super::profile::imbalance;
use super::seated::miss_mm;
use super::shape::{SolidShape, profile};
use super::solid::{Chain, Solid};
use super::target::{FoldSpot, Target};
use glam::DVec3;

// Costs and work below are measured as in `search/schedule.rs`.

/// First length of steps, as a share of the hull's radius. With 0.05: cost −0.9, work 0.99; with 0.2: cost +1.0, work 1.12.
const FIRST_STEP: f64 = 0.1;
/// Longest steps. Not bounded by a case.
const LONGEST_STEP: f64 = 0.4;
/// Length of steps at which the fit ends. With 0.005: cost +1.5, four +0.7, work 0.93.
const LAST_STEP: f64 = 0.002;
/// Factor of the length of steps after one that gains. With 2.2: cost +2.7, four +1.7, work 1.05.
const LONGER: f64 = 1.6;
/// The same after one that does not. With 0.2: cost +2.9, four +1.3, work 0.94; with 0.5: cost −0.4, four −0.3, work 1.10.
const SHORTER: f64 = 0.35;
/// Steps that gain less than this share of the merit are slow. With 0.02: cost +2.2, four +1.7, work 0.93.
const SLOW_GAIN: f64 = 0.01;
/// Slow steps in a row after which the fit ends. With 2: cost +4.2, four +2.1, work 0.94; with 5: cost +0.1, four −0.8, work
/// 1.12.
const SLOW_STEPS: usize = 3;
/// Price of a millimetre by which a panel is too small, or the balance point out of its place,
/// against a millimetre of error.
pub(super) const SIZE_PRICE: f64 = 20.0;
/// Price of a millimetre by which a solid overlaps another part, against a millimetre of error. Without
/// it, the legs of a human overlap by 4.5 mm.
pub(super) const BORDER_PRICE: f64 = 2.0;

/// What a fit minimises: weights of lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Aim {
    /// Of the mean distance from solid to hull where it stands out: volume over the hull's area.
    pub(super) out: f64,
    /// Of that where it falls short.
    pub(super) short: f64,
    /// Of the largest distance.
    pub(super) worst: f64,
    /// Of the mean of squared distances of corners.
    pub(super) mean: f64,
    /// Of a step's square over its length.
    pub(super) step: f64,
}

impl Aim {
    /// The largest distance, for a first choice of directions: it takes little time.
    pub(super) const REACH: Self = Self { out: 0.0, short: 0.0, worst: 1.0, mean: 0.3, step: 1.0 };
    /// What is seen: mostly volume.
    ///
    /// Hulls are larger than what they stand for, so that what stands out of them costs more than what
    /// is missing: with 2 for both the silhouettes of snowman, teapot, bunny, penguin and cat are 0.916,
    /// with 4 for `out` 0.922; with 16 those of bunny, snowman and spot are worse than with 8. With 0.15
    /// for `worst` and 1.5 for `mean` the bunny at (5, 6) of Table 2 is 0.021 of the diagonal off instead
    /// of 0.017; with 0.6 and 1 the silhouette of the armadillo is 0.871 instead of 0.908; with 1 and 0.5
    /// three pairs more of 21 meshes bump. A face has a small share of the volume: with 1 for `step` the
    /// fit stops long before it is there (silhouettes of snowman, bunny, koala and fish 0.894 against
    /// 0.914).
    pub(super) const LIKENESS: Self = Self { out: 6.0, short: 2.0, worst: 0.6, mean: 0.8, step: 0.05 };
    /// The same where it is known what of the hull is solid. Both sides count alike: with 6 for `out`, or with 0.3 for
    /// `worst` and 0.5 for `mean`, outlines of 24 meshes are as much alike within 0.001.
    const FILLED: Self = Self { out: 4.0, short: 4.0, ..Self::LIKENESS };

    /// Whether volumes count.
    pub(super) fn has_volume(&self) -> bool {
        self.out + self.short > 0.0
    }
}

/// The mean is of squares; errors of this share of the radius count as in a mean of errors.
const MEAN_SCALE: f64 = 0.03;
/// Aim a little above the limits, so that rounding does not fall below them.
pub(super) const MARGIN: f64 = 1.02;

/// A solid with its measures.
#[derive(Debug, Clone)]
pub(super) struct Fitted {
    pub(super) shape: SolidShape,
    pub(super) spots: Vec<FoldSpot>,
    /// Hausdorff distance to the hull (to its simplification during the fit), mm.
    pub(super) error_mm: f64,
    /// Sum of what the solid lacks to be valid, mm; 0 when valid.
    pub(super) lack_mm: f64,
    /// How far joint panels miss their partners, and the solid its borders, weighted.
    pub(super) miss_mm: f64,
    /// What is seen of the error: the volumes by which the solid stands out of the hull and falls short
    /// of it, and the largest distance, as the aim weighs them.
    pub(super) unlike_mm: f64,
    /// The mean of squared distances, as a length, as the aim weighs it.
    spread_mm: f64,
    /// Where the solid's corners stand to the hull, and the hull's to the solid.
    pub(super) own: Vec<Position>,
    pub(super) hulls: Vec<Position>,
}

impl Fitted {
    /// What the fit minimises.
    pub(super) fn merit(&self) -> f64 {
        self.unlike_mm + self.spread_mm + SIZE_PRICE * self.lack_mm + self.miss_mm
    }
}

/// A fit that can be gone on with.
#[derive(Debug, Clone)]
pub(super) struct Fit<'a> {
    task: Task<'a>,
    best: Fitted,
    step_mm: f64,
    slow: usize,
}

impl<'a> Fit<'a> {
    /// A fit that starts from `solid`.
    pub(super) fn new(target: Target<'a>, aim: Aim, solid: Solid, spots: Vec<FoldSpot>) -> Self {
        let hull = Polytope::of_hull(target.hull);
        let centre = target.hull.centroid();
        let radius_mm = target.hull.vertices().iter().map(|v| v.distance(centre)).fold(0.0, f64::max);
        let aim = if aim == Aim::LIKENESS && target.filling.is_some() { Aim::FILLED } else { aim };
        let sides = faces(&hull);
        let hull_mm3 = cones_mm3(&hull, &sides);
        let hull_mm2 = sides.iter().map(|f| f.area_mm2).sum();
        let task = Task { target, aim, hull, hull_mm3, hull_mm2, radius_mm };
        let best = task.measure(restored(solid, &spots), spots);
        Self { task, best, step_mm: FIRST_STEP * radius_mm, slow: 0 }
    }

    /// The best solid so far.
    pub(super) fn best(&self) -> &Fitted {
        &self.best
    }

    /// What the solid is fitted to.
    pub(super) fn target(&self) -> &Target<'a> {
        &self.task.target
    }

    /// The best solid.
    pub(super) fn into_best(self) -> Fitted {
        self.best
    }

    /// Improves the solid by at most `steps` steps, fewer where it cannot be improved much.
    pub(super) fn run(mut self, steps: usize) -> Self {
        let radius_mm = self.task.radius_mm;
        for _ in 0..steps {
            if self.step_mm < LAST_STEP * radius_mm || self.slow == SLOW_STEPS {
                break;
            }
            let next = self.task.step(&self.best, self.step_mm);
            let next =
                next.map(|s| self.task.measure(restored(s, &self.best.spots), self.best.spots.clone()));
            match next.map(|n| (self.best.merit() - n.merit(), n)) {
                Some((gain, next)) if gain > 1e-6 * radius_mm => {
                    self.slow = if gain < SLOW_GAIN * self.best.merit() { self.slow + 1 } else { 0 };
                    self.best = next;
                    self.step_mm = (self.step_mm * LONGER).min(LONGEST_STEP * radius_mm);
                }
                _ => self.step_mm *= SHORTER,
            }
        }
        self
    }
}

/// What a solid is fitted to.
#[derive(Debug, Clone)]
pub(super) struct Task<'a> {
    pub(super) target: Target<'a>,
    pub(super) aim: Aim,
    pub(super) hull: Polytope,
    hull_mm3: f64,
    pub(super) hull_mm2: f64,
    pub(super) radius_mm: f64,
}

impl Task<'_> {
    /// Length at which errors count in the mean of squares as in a mean.
    pub(super) fn mean_scale_mm(&self) -> f64 {
        MEAN_SCALE * self.radius_mm
    }

    fn measure(&self, solid: Solid, spots: Vec<FoldSpot>) -> Fitted {
        let shape = SolidShape::of(solid);
        let own: Vec<Position> = shape.corners.iter().map(|c| self.hull.position(c.point)).collect();
        let hulls: Vec<Position> = self.hull.corners().iter().map(|p| shape.polytope.position(*p)).collect();
        let away = |p: &Position, at: DVec3| p.nearest.map_or(0.0, |n| n.0.distance(at));
        let (mut error_mm, mut squares) = (0.0f64, 0.0);
        let mut add = |d: f64| {
            error_mm = error_mm.max(d);
            squares += d * d;
        };
        own.iter().zip(&shape.corners).for_each(|(p, c)| add(away(p, c.point)));
        hulls.iter().zip(self.hull.corners()).for_each(|(p, c)| add(away(p, *c)));
        let count = own.len() + hulls.len();
        let spread_mm = self.aim.mean * squares / (2.0 * count as f64 * self.mean_scale_mm());
        let lack_mm = self.lack_mm(&shape, &spots);
        let joints = self.target.joints.iter();
        let of_joints: f64 = joints.map(|j| j.price * miss_mm(&shape, &self.target, j)).sum();
        let miss_mm = of_joints + BORDER_PRICE * self.beyond_mm(&shape);
        let is_finite = shape.corners.iter().all(|c| c.point.is_finite());
        let error_mm = if is_finite { error_mm } else { f64::INFINITY };
        let unlike_mm = self.aim.worst * error_mm + self.beside_mm(&shape.polytope);
        Fitted { shape, spots, error_mm, lack_mm, miss_mm, unlike_mm, spread_mm, own, hulls }
    }

    /// How far the solid reaches beyond its borders, at most.
    fn beyond_mm(&self, shape: &SolidShape) -> f64 {
        let reach = |n: DVec3| shape.corners.iter().map(|c| n.dot(c.point)).fold(f64::NEG_INFINITY, f64::max);
        self.target.borders.iter().map(|&(n, c)| reach(n) - c).fold(0.0, f64::max)
    }

    /// The volumes in one of the solid and what it should be alone, over the hull's area, as the aim weighs them.
    fn beside_mm(&self, solid: &Polytope) -> f64 {
        if !self.aim.has_volume() {
            return 0.0;
        }
        let (wanted_mm3, shared_mm3) = match &self.target.filling {
            Some((filling, to_filling)) => (filling.volume_mm3(), filling.shared_mm3(solid, to_filling)),
            None => (self.hull_mm3, shared_mm3(solid, &self.hull)),
        };
        let out_mm3 = (cones_mm3(solid, &faces(solid)) - shared_mm3).max(0.0);
        let short_mm3 = (wanted_mm3 - shared_mm3).max(0.0);
        (self.aim.out * out_mm3 + self.aim.short * short_mm3) / self.hull_mm2
    }

    fn lack_mm(&self, shape: &SolidShape, spots: &[FoldSpot]) -> f64 {
        let least = self.target.min_panel_mm;
        let lack_of = |j: ChainId| {
            let widths = shape.heights_about(j).map(|v| least - shape.width_at(j, v));
            let profile = &shape.chains[j.0].profile;
            let rooms = rooms(shape, spots, j).map(|room| (least - room.value(profile)).max(0.0));
            let miss = match spots[j.0] {
                FoldSpot::Bend(i) => imbalance(profile, i + 1).abs() / 2.0,
                FoldSpot::Inside(_) => 0.0,
            };
            widths.fold(0.0, f64::max) + rooms.sum::<f64>() + miss
        };
        shape.solid.chain_ids().map(lack_of).sum()
    }
}

/// Lengths of chain j that must not be too small: of its panels, and about its fold vertex.
pub(super) fn rooms<'s>(
    shape: &'s SolidShape,
    spots: &[FoldSpot],
    j: ChainId,
) -> impl Iterator<Item = ProfileLength> + use<'s> {
    let chain = &shape.chains[j.0];
    let spot = spots[j.0];
    let about_fold = match spot {
        FoldSpot::Inside(i) => vec![
            ProfileLength::beyond_balance(chain, i).reversed(),
            ProfileLength::beyond_balance(chain, i + 1),
        ],
        FoldSpot::Bend(_) => Vec::new(),
    };
    // The two parts about the fold vertex are shorter than their plane.
    let whole = (0..chain.lines.len()).filter(move |&i| spot != FoldSpot::Inside(i));
    whole.map(|i| ProfileLength::of_segment(chain, i)).chain(about_fold)
}

/// Makes fold vertices at bends exact again after a linear step, by moving one plane beside each
/// (Newton's method on its offset), where that is a small change.
fn restored(mut solid: Solid, spots: &[FoldSpot]) -> Solid {
    let (top, bottom) = (solid.top_mm, solid.bottom_mm);
    for (chain, spot) in solid.chains.iter_mut().zip(spots) {
        if let FoldSpot::Bend(i) = *spot {
            let free = if chain.facets[i].is_joint { i + 1 } else { i };
            if let Some(offset_mm) = exact_bend(chain, top, bottom, i, free) {
                chain.facets[free].offset_mm = offset_mm;
            }
        }
    }
    solid
}

/// The offset of facet `free` at which the bend below facet `i` is the balance point. `None` where
/// that takes more than a small move.
fn exact_bend(chain: &Chain, top: f64, bottom: f64, i: usize, free: usize) -> Option<f64> {
    let mut lines = super::shape::lines(chain);
    let size = (top - bottom).abs();
    let start = lines[free].offset;
    let mut miss = |offset: f64| {
        lines[free].offset = offset;
        imbalance(&profile(&lines, top, bottom), i + 1)
    };
    let step = 1e-6 * size;
    let mut at = start;
    for _ in 0..20 {
        let now = miss(at);
        if now.abs() <= 1e-13 * size {
            return Some(at);
        }
        let next = at - now * step / (miss(at + step) - now);
        if !next.is_finite() || (next - start).abs() > 0.2 * size {
            return None;
        }
        at = next;
    }
    (miss(at).abs() <= 1e-11 * size).then_some(at)
}
