//! The hinges of a chain of boards.
//!
//! A board needs its hinge on the side to which it is folded, where the two boards meet when they come
//! to lie on one another: a mountain between the inner faces, at the corner of the shape that is
//! offset inwards by the thickness t, so that both boards are shorter by t·tan(θ/2) where they stand
//! at an angle θ; a valley between the outer faces, at the drawn corner itself. A hinge that only
//! bends, and lies in one plane when flat, is on the side to which it is bent. A crease within a
//! straight wall has one of the two sides, too.
//!
//! The top and the bottom panel are shorter by their hinges' t·tan(θ/2) as well, so that the chain of
//! boards leads outwards by an excess over that of the outside; its creases are computed for that excess.

use super::assignment::{FoldAssignment, Segment};
use super::closing::{Closed, close};
use super::facet::{STRAIGHT, facets, turn};
use super::ranking::rank;
use crate::component::{Fold, Profile};
use crate::fold::ChainMotion;
use glam::DVec2;

/// What a chain of boards has to keep.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BoardChain {
    /// Corners of the outside, from top to bottom.
    pub(super) corners: Vec<DVec2>,
    /// Which walls are joint panels and must stay whole, where they are.
    pub(super) whole: Vec<bool>,
    pub(super) thickness_mm: f64,
    pub(super) min_panel_mm: f64,
}

/// A chain of boards that folds flat exactly.
#[derive(Debug, Clone)]
pub(super) struct Hinged {
    /// Of the inner faces.
    pub(super) profile: Profile,
    /// Of the outer faces.
    pub(super) outside: Profile,
    /// The wall that each board is, or is a part of.
    pub(super) source: Vec<usize>,
    /// How far a corner of the outside was moved.
    pub(super) moved_mm: f64,
}

impl Hinged {
    /// Layers that lie between the top and the bottom panel's.
    pub(super) fn layers(&self) -> usize {
        self.profile.fold_vertices().count()
    }
}

/// Why a chain of boards has no way to fold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Unhinged {
    /// All ways fold some bend against itself.
    Against,
    /// No way leaves all boards their least height, or comes down.
    NoRoom,
}

impl BoardChain {
    /// The ways to fold it, best first: that of the chain of paper, if it moves nothing, then as they
    /// are ranked for paper, those that move nothing first.
    pub(super) fn hinged(&self, paper: &Profile) -> Result<Vec<Hinged>, Unhinged> {
        let own = own_way(paper);
        let ranked = rank(&self.corners, &self.whole, self.min_panel_mm).ranked.into_iter();
        let others = ranked.map(|ranked| ranked.way).filter(|way| Some(way) != own.as_ref());
        let ways: Vec<FoldAssignment> = own.iter().cloned().chain(others).collect();
        let tried: Vec<Result<Hinged, Unhinged>> = ways.iter().map(|way| self.folded(way)).collect();
        let is_against = tried.iter().any(|tried| tried.as_ref().err() == Some(&Unhinged::Against));
        let mut hinged: Vec<Hinged> = tried.into_iter().flatten().collect();
        hinged.sort_by_key(|h| h.moved_mm > 0.0);
        match hinged.is_empty() {
            false => Ok(hinged),
            true if is_against => Err(Unhinged::Against),
            true => Err(Unhinged::NoRoom),
        }
    }

    fn folded(&self, way: &FoldAssignment) -> Result<Hinged, Unhinged> {
        let segments = way.segments();
        let is_against = |(w, s): (&[DVec2], &[Segment])| {
            let turn = turn(w[0], w[1], w[2]);
            match (s[0].ends_up(), s[1].begins_up()) {
                (true, false) => turn > STRAIGHT,
                (false, true) => turn < -STRAIGHT,
                _ => false,
            }
        };
        if self.corners.windows(3).zip(segments.windows(2)).any(is_against) {
            return Err(Unhinged::Against);
        }
        let closed = self.closed(way).ok_or(Unhinged::NoRoom)?;
        let is_moved = closed.moved_mm > 0.0;
        if is_moved && self.whole.contains(&true) || closed.moved_mm > MOST_MOVED * self.thickness_mm {
            return Err(Unhinged::NoRoom);
        }
        let profile = self.boards(&closed.profile).ok_or(Unhinged::NoRoom)?;
        let is_low = profile.lengths().zip(&closed.source).any(|(mm, &wall)| {
            let drawn_mm = self.corners[wall].distance(self.corners[wall + 1]);
            // A wall may be drawn lower than panels should be; a crease need not make more such.
            mm < if way.creased() == Some(wall) {
                self.min_panel_mm
            } else {
                self.min_panel_mm.min(0.5 * drawn_mm)
            }
        });
        let is_closed = profile.gap_mm().abs() <= EXACT * profile.mean_segment_mm();
        let course = ChainMotion::new(&profile).course();
        if is_low || !is_closed || !course.comes_straight_down || course.rise_mm > 0.0 {
            return Err(Unhinged::NoRoom);
        }
        let Closed { profile: outside, source, moved_mm } = closed;
        Ok(Hinged { profile, outside, source, moved_mm })
    }

    /// The outside with its crease, for which the boards, not the outside, have gap 0.
    fn closed(&self, way: &FoldAssignment) -> Option<Closed> {
        let length: f64 = self.corners.windows(2).map(|w| w[0].distance(w[1])).sum();
        let mut excess_mm = self.excess_mm(&self.corners, way);
        for _ in 0..MOST_STEPS {
            let closed = close(&self.corners, way, excess_mm)?;
            if way.creased().is_some() {
                return Some(closed);
            }
            let next_mm = self.excess_mm(closed.profile.points(), way);
            if (next_mm - excess_mm).abs() <= ROUNDING * length {
                return Some(closed);
            }
            excess_mm = next_mm;
        }
        None
    }

    /// By how much more the boards lead outwards than the outside, against where they end.
    fn excess_mm(&self, corners: &[DVec2], way: &FoldAssignment) -> f64 {
        let sign = |is_up: bool| if is_up { 1.0 } else { -1.0 };
        let (segments, last) = (way.segments(), corners.len() - 1);
        let directions = directions(corners);
        let of_corner = |k: usize| {
            let [before, after] = [directions[k], directions[k + 1]];
            // t·tan(θ/2)
            let shorter_mm = -self.thickness_mm * before.perp_dot(after) / (1.0 + before.dot(after));
            match k {
                0 => -2.0 * shorter_mm,
                k if k == last => 2.0 * shorter_mm,
                k => -(sign(segments[k - 1].ends_up()) + sign(segments[k].begins_up())) * shorter_mm.max(0.0),
            }
        };
        (0..=last).map(of_corner).sum()
    }

    /// The inner faces with their hinges.
    fn boards(&self, outside: &Profile) -> Option<Profile> {
        let points = outside.points();
        let directions = directions(points);
        let hinge = |k: usize| {
            let [before, after] = [directions[k], directions[k + 1]];
            let turn = before.perp_dot(after);
            let is_inner_vertex = k > 0 && k + 1 < points.len();
            let is_creased_valley = || is_inner_vertex && outside.fold_at(k) == Some(Fold::Valley);
            if turn > STRAIGHT || turn >= -STRAIGHT && is_creased_valley() {
                return (points[k], self.thickness_mm);
            }
            let outward = (before.perp() + after.perp()) / (1.0 + before.dot(after));
            (points[k] - outward * self.thickness_mm, 0.0)
        };
        let (axes, lifts) = (0..points.len()).map(hinge).unzip();
        let profile =
            Profile::boards(axes, (0..points.len() - 1).map(|i| outside.faces_up(i)).collect(), lifts);
        // What was shortened away altogether runs backwards.
        profile.ok().filter(|p| (0..points.len() - 1).all(|i| p.face(i)[1].y < p.face(i)[0].y))
    }
}

/// Corners move by at most this many thicknesses.
const MOST_MOVED: f64 = 2.0;
/// A gap of a smaller share of the mean board is none.
const EXACT: f64 = 1e-9;
/// The excess is known within this share of the chain's length.
const ROUNDING: f64 = 1e-13;
const MOST_STEPS: usize = 40;

/// Directions along a chain: of the top panel outwards, of its walls, of the bottom panel inwards.
fn directions(points: &[DVec2]) -> Vec<DVec2> {
    let walls = points.windows(2).map(|w| (w[1] - w[0]).normalize_or_zero());
    std::iter::once(DVec2::X).chain(walls).chain([-DVec2::X]).collect()
}

/// The way in which a profile of paper folds, by its walls.
fn own_way(paper: &Profile) -> Option<FoldAssignment> {
    let facets = facets(paper);
    let walls = facets.last().map_or(0, |last| last + 1);
    let of_wall = |wall: usize| {
        let faces: Vec<bool> =
            (0..facets.len()).filter(|&i| facets[i] == wall).map(|i| paper.faces_up(i)).collect();
        match faces.as_slice() {
            [true] => Some(Segment::Up),
            [false] => Some(Segment::Down),
            [true, false] => Some(Segment::UpDown),
            [false, true] => Some(Segment::DownUp),
            _ => None,
        }
    };
    FoldAssignment::new((0..walls).map(of_wall).collect::<Option<_>>()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A waist that stands bent inwards and folds outwards would need its hinge on both sides.
    #[test]
    fn boards_do_not_fold_against_their_bend() {
        let chain = |waist: f64| BoardChain {
            corners: vec![DVec2::new(0.0, 60.0), DVec2::new(waist, 30.0), DVec2::ZERO],
            whole: vec![false; 2],
            thickness_mm: 1.0,
            min_panel_mm: 3.0,
        };
        let way: FoldAssignment = "ud".parse().unwrap();
        assert_eq!(chain(-10.0).folded(&way).err(), Some(Unhinged::Against));
        assert!(chain(10.0).folded(&way).is_ok_and(|hinged| hinged.layers() == 1 && hinged.moved_mm == 0.0));
    }
}
