//! The ways to fold a profile, best first.

use super::assignment::FoldAssignment;
use super::closing::close;
use super::search::{Limits, ROUNDING_MM, promising};
use super::weights::WEIGHTS;
use crate::component::Profile;
use crate::fold::ChainMotion;
use glam::DVec2;
use std::cmp::Ordering;

/// What speaks against a way to fold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// Length of the chain, mm.
    pub length_mm: f64,
    /// Folds by 180°.
    pub folds: usize,
    /// Whether a crease was added.
    pub is_creased: bool,
    /// How far a vertex was moved at most, mm.
    pub moved_mm: f64,
    /// How far the flat chain reaches beyond the deployed one, mm.
    pub spread_mm: f64,
    /// Mean angle that the segments turn by, weighted by length, radians.
    pub turn_rad: f64,
    /// How far a vertex comes inwards of where it stands, mm.
    pub inward_mm: f64,
    /// How far the top has to rise before it comes down, mm.
    pub rise_mm: f64,
}

impl Score {
    /// The weighted sum; less is better.
    pub fn total(&self) -> f64 {
        let share = |mm: f64| mm / self.length_mm;
        WEIGHTS.fold * self.folds as f64
            + WEIGHTS.crease * f64::from(u8::from(self.is_creased))
            + WEIGHTS.moved * share(self.moved_mm)
            + WEIGHTS.spread * share(self.spread_mm)
            + WEIGHTS.turn * self.turn_rad
            + WEIGHTS.inward * share(self.inward_mm)
            + WEIGHTS.rise * share(self.rise_mm)
    }
}

/// A way to fold with the profile that it needs.
#[derive(Debug, Clone)]
pub struct Ranked {
    /// The way.
    pub way: FoldAssignment,
    /// What speaks against it.
    pub score: Score,
    /// The drawn profile, with a crease or moved to have gap 0.
    pub profile: Profile,
    /// The drawn segment that each segment of `profile` is, or is a part of.
    pub source: Vec<usize>,
}

impl Ranked {
    /// The lower score first, then the way that reads first.
    fn order(&self, other: &Self) -> Ordering {
        self.score.total().total_cmp(&other.score.total()).then_with(|| self.way.cmp(&other.way))
    }
}

/// Why a way to fold is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, thiserror::Error)]
pub enum Refusal {
    /// The gap cannot be closed by the crease that it has, or by a small movement.
    #[error("the gap cannot be closed")]
    Gap,
    /// Eq. (1) is broken.
    #[error("a hinge would be farther inside when flat than when unfolded (Eq. 1)")]
    Inward,
    /// A panel would be too low.
    #[error("a panel would be too low to fold")]
    Low,
    /// The top would have to rise on its way.
    #[error("the top would have to rise on its way down")]
    Rise,
    /// The top would have to rise first, and other chains hold it.
    #[error("the top would have to rise before it comes down, but chains with other profiles hold it")]
    Held,
    /// It names another number of segments than the profile has.
    #[error("the number of its letters is not the number of segments of the profile")]
    Count,
}

/// The ways to fold one profile.
#[derive(Debug, Clone)]
pub struct Ranking {
    /// Those that work, best first.
    pub ranked: Vec<Ranked>,
    /// Those that looked promising and do not.
    pub refused: Vec<(FoldAssignment, Refusal)>,
}

/// Vertices are moved by at most this share of the chain's length.
const MOST_MOVED: f64 = 0.1;

/// Ranks the ways to fold a drawn profile: `whole` tells which segments may not be creased.
pub fn rank(points: &[DVec2], whole: &[bool], min_panel_mm: f64) -> Ranking {
    let mut ranking = Ranking { ranked: Vec::new(), refused: Vec::new() };
    for way in promising(points, Limits { whole, min_panel_mm }) {
        match judge(points, &way, min_panel_mm) {
            Ok(ranked) => ranking.ranked.push(ranked),
            Err(refusal) => ranking.refused.push((way, refusal)),
        }
    }
    ranking.ranked.sort_by(Ranked::order);
    ranking
}

/// Closes one way and measures it.
///
/// # Errors
/// [`Refusal`].
pub(super) fn judge(points: &[DVec2], way: &FoldAssignment, min_panel_mm: f64) -> Result<Ranked, Refusal> {
    moving(measured(points, way, min_panel_mm)?)
}

/// The best way to fold that some condition holds for and that lets the top come straight down: the
/// first such of [`rank`], sooner.
pub(super) fn best(
    points: &[DVec2],
    whole: &[bool],
    min_panel_mm: f64,
    is_wanted: impl Fn(&Ranked) -> bool,
) -> Option<Ranked> {
    let ways = promising(points, Limits { whole, min_panel_mm });
    let measured = ways.iter().filter_map(|way| measured(points, way, min_panel_mm).ok());
    let mut wanted: Vec<Ranked> = measured.filter(is_wanted).collect();
    wanted.sort_by(Ranked::order);
    let mut best: Option<Ranked> = None;
    for ranked in wanted {
        // What its motion adds is not less than 0.
        if best.as_ref().is_some_and(|best| best.order(&ranked).is_lt()) {
            break;
        }
        let Some(ranked) = moving(ranked).ok().filter(|ranked| ranked.score.rise_mm == 0.0) else { continue };
        if best.as_ref().is_none_or(|best| ranked.order(best).is_lt()) {
            best = Some(ranked);
        }
    }
    best
}

/// Closes one way, and measures what needs no motion.
fn measured(points: &[DVec2], way: &FoldAssignment, min_panel_mm: f64) -> Result<Ranked, Refusal> {
    if way.segments().len() + 1 != points.len() {
        return Err(Refusal::Count);
    }
    let closed = close(points, way, 0.0).ok_or(Refusal::Gap)?;
    let length_mm: f64 = closed.profile.lengths().sum();
    if closed.moved_mm > MOST_MOVED * length_mm {
        return Err(Refusal::Gap);
    }
    let profile = closed.profile;
    let is_short = |(l, &segment): (f64, &usize)| {
        let drawn_mm = points[segment].distance(points[segment + 1]);
        l < min_panel_mm.min(drawn_mm) - ROUNDING_MM
    };
    if profile.lengths().zip(&closed.source).any(is_short) {
        return Err(Refusal::Low);
    }
    let flat = profile.flat_mm();
    if flat.iter().zip(profile.points()).any(|(flat, p)| *flat < p.x - ROUNDING_MM) {
        return Err(Refusal::Inward);
    }
    let widest = |list: &mut dyn Iterator<Item = f64>| list.fold(f64::NEG_INFINITY, f64::max);
    let stands_mm = widest(&mut profile.points().iter().map(|p| p.x));
    let turned = |(i, w): (usize, &[DVec2])| {
        let step = w[1] - w[0];
        let alpha = libm::atan2(-step.y, step.x);
        step.length() * if profile.faces_up(i) { alpha } else { std::f64::consts::PI - alpha }
    };
    let score = Score {
        length_mm,
        folds: way.folds(),
        is_creased: way.creased().is_some(),
        moved_mm: closed.moved_mm,
        spread_mm: (widest(&mut flat.iter().copied()) - stands_mm).max(0.0),
        turn_rad: profile.points().windows(2).enumerate().map(turned).sum::<f64>() / length_mm,
        inward_mm: 0.0,
        rise_mm: 0.0,
    };
    Ok(Ranked { way: way.clone(), score, profile, source: closed.source })
}

/// Adds what a chain does on its way.
fn moving(mut ranked: Ranked) -> Result<Ranked, Refusal> {
    let course = ChainMotion::new(&ranked.profile).course();
    if !course.comes_straight_down {
        return Err(Refusal::Rise);
    }
    (ranked.score.inward_mm, ranked.score.rise_mm) = (course.inward_mm, course.rise_mm);
    Ok(ranked)
}
