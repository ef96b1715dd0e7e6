//! What shapes are compared by: while they are fitted, and finished.

use super::super::assemble::Assembled;
use super::super::fit::Fitted;
use super::super::profile::balance;
use super::super::seated::support;
use super::super::target::Target;
use crate::geom::{Hull, polygon};
use glam::DVec3;

/// Joints that carry this share are well supported.
const GOOD_SUPPORT: f64 = 0.85;
/// In the choice between finished shapes, what a joint lacks of that costs this share of the hull's
/// height. With 0.2, and a higher price on such joints in another fit, it outweighs likeness: silhouettes
/// of the cat 0.870 against 0.886; not bounded from below by a case yet.
const SUPPORT_PRICE: f64 = 0.02;
/// Price of a mm of spread when flat, against a mm of error: directions that fold smaller win
/// where the error is alike (Figure 8).
const SPREAD_PRICE: f64 = 0.03;
/// Price of an opening in a finished shape, against a mm of error, for each mm that a square of its
/// area measures.
const TRIM_PRICE: f64 = 0.5;
/// Openings of more than this look like holes. Each mm² above it costs this many mm, so that any other shape
/// is better, even one that bumps: with 0.5 a slice of pizza folds freely with a hole of 296 mm², with 5 a human with one of
/// 17 mm². Not bounded from above by a case yet.
const MOST_TRIMMED_MM2: f64 = 10.0;
/// So do smaller ones in small shapes, of more than this share of the surface: without it, a leg of an animal has one
/// of 0.3 %.
const MOST_TRIMMED: f64 = 0.002;
const OVER_PRICE: f64 = 10.0;
/// Price of a mm that a shape lacks to be valid, while directions are compared.
const LACK_PRICE: f64 = 2.0;

/// What directions are compared by, while they are fitted.
pub(super) fn cost(fitted: &Fitted) -> f64 {
    fitted.unlike_mm + LACK_PRICE * fitted.lack_mm + fitted.miss_mm + SPREAD_PRICE * spread_mm(fitted)
}

/// What finished shapes are compared by: the error first, then good joints, a small spread, and small
/// openings where slits were widened so that the flat layers do not overlap.
pub(super) fn finished_cost(fitted: &Fitted, made: &Assembled, (target, own_mm): &(Target, f64)) -> f64 {
    fitted.unlike_mm
        + LACK_PRICE * fitted.lack_mm
        + SPREAD_PRICE * spread_mm(fitted)
        + SUPPORT_PRICE * height_mm(target.hull) * short_of_support(fitted, target)
        + own_mm
        + opening_cost(made)
}

/// What the openings of a finished shape cost, mm.
pub(super) fn opening_cost(made: &Assembled) -> f64 {
    TRIM_PRICE * made.trimmed_mm2.sqrt() + OVER_PRICE * over_mm2(made)
}

/// By how much the openings of a finished shape are larger than what is hardly seen, mm².
pub(super) fn over_mm2(made: &Assembled) -> f64 {
    let surface_mm2: f64 = made.panels.panels().iter().map(|p| polygon::area(&p.outline).abs()).sum();
    (made.trimmed_mm2 - MOST_TRIMMED_MM2.min(MOST_TRIMMED * surface_mm2)).max(0.0)
}

/// What a panel less may cost, mm.
pub(super) fn panel_worth_mm(target: &Target) -> f64 {
    target.panel_worth * libm::cbrt(target.hull.volume())
}

/// How far the longest chain reaches from the axis when flat.
fn spread_mm(fitted: &Fitted) -> f64 {
    let reach = fitted.shape.chains.iter().map(|chain| {
        let profile = &chain.profile;
        let at = balance(profile);
        profile[0].x + profile.windows(2).take(at.segment).map(|w| w[0].distance(w[1])).sum::<f64>()
    });
    reach.fold(0.0, f64::max)
}

/// What all joints together lack of being well supported.
fn short_of_support(fitted: &Fitted, target: &Target) -> f64 {
    let supports = target.joints.iter().map(|joint| support(&fitted.shape, target, joint));
    supports.map(|s| (GOOD_SUPPORT - s).max(0.0)).sum()
}

/// Height of a hull along the fold axis.
pub(super) fn height_mm(hull: &Hull) -> f64 {
    hull.support(DVec3::Z) + hull.support(-DVec3::Z)
}
