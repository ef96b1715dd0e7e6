//! Profiles, how they lie when flat, and their exact flat-foldability.
//!
//! Walking down a convex profile, (length above) − (length below) grows continuously from −L to
//! +L, and |u_last − u_0| <= L: at the point where it equals u_last − u_0 a crease makes the chain
//! flat-foldable with gap 0 (Eq. (2)) and no change of shape. Profiles that are not convex fold in
//! other ways, too: each segment faces up or down when flat.

use glam::DVec2;

/// A cross-section polyline (u, v), from top to bottom, with the side that each segment shows
/// upwards when flat: δ of Eq. (2).
///
/// # Guarantees
/// At least three points, v strictly falling (Eq. (11)); the first segment faces up and the last
/// one down when flat, so that the top and the bottom panel lie flat with them.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Axes of the hinges.
    points: Vec<DVec2>,
    faces_up: Vec<bool>,
    /// How far each axis lies over the inner faces of the panels that it joins: 0 but for boards.
    lifts_mm: Vec<f64>,
}

/// A fold by 180°.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fold {
    /// The outside stays outside.
    Mountain,
    /// The outsides of both panels end face to face.
    Valley,
}

/// Why points are no profile.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// Fewer than three points or the fold vertex at an end.
    #[error("a profile needs an inner vertex to fold at")]
    TooShort,
    /// v does not fall.
    #[error("profile vertex {0} is not below the one before it")]
    NotFalling(usize),
    /// A turn inwards.
    #[error("profile vertex {0} bends inwards")]
    Reflex(usize),
}

/// Turns inwards below this share of the adjacent lengths' product count as straight: they come
/// from rounding (1e-16 of the size, amplified by the shallowest bends of a few degrees).
const STRAIGHT: f64 = 1e-9;

impl Profile {
    /// A convex profile from its vertices and the index of the one that folds by 180°.
    pub fn new(points: Vec<DVec2>, fold_vertex: usize) -> Result<Self, ProfileError> {
        let faces_up = (1..points.len()).map(|i| i <= fold_vertex).collect();
        let profile = Self::folded(points, faces_up)?;
        let reflex = profile.turns().find(|&(_, turn)| turn > STRAIGHT);
        match reflex {
            Some((i, _)) => Err(ProfileError::Reflex(i)),
            None => Ok(profile),
        }
    }

    /// A profile of any shape, from its vertices and whether each segment faces up when flat.
    pub fn folded(points: Vec<DVec2>, faces_up: Vec<bool>) -> Result<Self, ProfileError> {
        let has_ends = faces_up.first() == Some(&true) && faces_up.last() == Some(&false);
        if points.len() < 3 || faces_up.len() + 1 != points.len() || !has_ends {
            return Err(ProfileError::TooShort);
        }
        match (1..points.len()).find(|&i| points[i].y >= points[i - 1].y) {
            Some(i) => Err(ProfileError::NotFalling(i)),
            None => Ok(Self { lifts_mm: vec![0.0; points.len()], points, faces_up }),
        }
    }

    /// A profile of boards: the axis of each hinge lies over the inner faces of the two boards that
    /// it joins, by as much as `lifts_mm` says: 0, or their thickness. The ends have 0.
    pub fn boards(points: Vec<DVec2>, faces_up: Vec<bool>, lifts_mm: Vec<f64>) -> Result<Self, ProfileError> {
        let is_short = |(w, lifts): (&[DVec2], &[f64])| w[0].distance(w[1]) <= (lifts[1] - lifts[0]).abs();
        let is_open = lifts_mm.first() == Some(&0.0) && lifts_mm.last() == Some(&0.0);
        if lifts_mm.len() != points.len() || !is_open {
            return Err(ProfileError::TooShort);
        }
        if let Some(i) = points.windows(2).zip(lifts_mm.windows(2)).position(is_short) {
            return Err(ProfileError::NotFalling(i + 1));
        }
        Ok(Self { lifts_mm, ..Self::folded(points, faces_up)? })
    }

    /// The same with all lengths times `factor`.
    pub(super) fn resized(&self, factor: f64) -> Self {
        Self {
            points: self.points.iter().map(|&point| factor * point).collect(),
            faces_up: self.faces_up.clone(),
            lifts_mm: self.lifts_mm.iter().map(|lift_mm| factor * lift_mm).collect(),
        }
    }

    /// Axes of the hinges (u, v), mm: the vertices, where panels have no thickness.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Whether segment i faces up when flat.
    pub fn faces_up(&self, i: usize) -> bool {
        self.faces_up[i]
    }

    /// How inner vertex i folds by 180°, if it does.
    pub fn fold_at(&self, i: usize) -> Option<Fold> {
        match (self.faces_up[i - 1], self.faces_up[i]) {
            (true, false) => Some(Fold::Mountain),
            (false, true) => Some(Fold::Valley),
            _ => None,
        }
    }

    /// The vertices that fold by 180°; a convex profile has one (the paper's convex fold vertex).
    pub fn fold_vertices(&self) -> impl Iterator<Item = usize> + '_ {
        (1..self.points.len() - 1).filter(|&i| self.fold_at(i).is_some())
    }

    /// Number of the layer of the flat stack that segment i lies in, counted from the top panel's:
    /// how often the chain has turned back above it.
    pub fn layer(&self, i: usize) -> usize {
        (1..=i).filter(|&k| self.fold_at(k).is_some()).count()
    }

    /// Lengths l_i of the segments; of boards, between their hinges along the board.
    pub fn lengths(&self) -> impl Iterator<Item = f64> + '_ {
        self.points.windows(2).zip(self.lifts_mm.windows(2)).map(|(w, lifts)| {
            let (between, rise) = (w[0].distance(w[1]), lifts[1] - lifts[0]);
            if rise == 0.0 { between } else { (between * between - rise * rise).sqrt() }
        })
    }

    /// How far the axis of each hinge lies over the inner faces of the panels that it joins, mm.
    pub fn lifts_mm(&self) -> &[f64] {
        &self.lifts_mm
    }

    /// The inner face of segment i, from its upper to its lower end.
    pub fn face(&self, i: usize) -> [DVec2; 2] {
        let ends = [self.points[i], self.points[i + 1]];
        let lifts = [self.lifts_mm[i], self.lifts_mm[i + 1]];
        if lifts == [0.0; 2] {
            return ends;
        }
        // The line between the axes is turned from the board towards its outside.
        let length = self.lengths().nth(i).unwrap_or(0.0);
        let turn = DVec2::new(length, lifts[0] - lifts[1]).normalize_or(DVec2::X);
        let outward = turn.rotate((ends[1] - ends[0]).normalize_or_zero()).perp();
        [ends[0] - outward * lifts[0], ends[1] - outward * lifts[1]]
    }

    /// How high the inner face of each segment lies over the bottom panel's when flat, and how high
    /// the top panel's: boards lie on one another.
    pub fn flat_heights_mm(&self) -> (Vec<f64>, f64) {
        let mut axis_mm = 0.0;
        let mut heights = vec![0.0; self.faces_up.len()];
        for i in (0..heights.len()).rev() {
            // The outside is up, or down.
            let sign = if self.faces_up[i] { 1.0 } else { -1.0 };
            heights[i] = axis_mm - sign * self.lifts_mm[i + 1];
            axis_mm = heights[i] + sign * self.lifts_mm[i];
        }
        (heights, axis_mm)
    }

    /// δ_i l_i of each segment: how far it leads outwards when flat.
    fn advances(&self) -> impl Iterator<Item = f64> + '_ {
        self.lengths().zip(&self.faces_up).map(|(l, &up)| if up { l } else { -l })
    }

    /// Eq. (2): how far the chain misses the bottom hinge when flat, in mm.
    pub fn gap_mm(&self) -> f64 {
        let last = self.points[self.points.len() - 1];
        (last.x - self.points[0].x) - self.advances().sum::<f64>()
    }

    /// Mean length of the segments.
    pub fn mean_segment_mm(&self) -> f64 {
        self.lengths().sum::<f64>() / (self.points.len() - 1) as f64
    }

    /// u' of each vertex: where it lies when flat, counted from the nearer end of the chain, the
    /// top panel's for what lies in its layer.
    pub fn flat_mm(&self) -> Vec<f64> {
        let advances: Vec<f64> = self.advances().collect();
        let last = self.points.len() - 1;
        let first_fold = self.fold_vertices().next().unwrap_or(last);
        let from_top = |i: usize| self.points[0].x + advances[..i].iter().sum::<f64>();
        let from_bottom = |i: usize| self.points[last].x - advances[i..].iter().sum::<f64>();
        (0..=last).map(|i| if i <= first_fold { from_top(i) } else { from_bottom(i) }).collect()
    }

    /// Heights at which it bends, from top to bottom.
    pub(super) fn bends(&self) -> impl Iterator<Item = f64> + '_ {
        self.turns().filter(|(_, turn)| turn.abs() > STRAIGHT).map(|(i, _)| self.points[i].y)
    }

    /// u at height v within its ends.
    pub(super) fn u_at(&self, v_mm: f64) -> f64 {
        let last = self.points.len() - 2;
        let i = (0..last).find(|&i| self.points[i + 1].y <= v_mm).unwrap_or(last);
        let (upper, lower) = (self.points[i], self.points[i + 1]);
        if v_mm == lower.y {
            return lower.x;
        }
        upper.x + (lower.x - upper.x) * ((upper.y - v_mm) / (upper.y - lower.y))
    }

    /// Sine of the turn at each inner vertex; positive where it is inwards.
    fn turns(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.points.windows(3).enumerate().map(|(k, w)| {
            let (a, b) = (w[1] - w[0], w[2] - w[1]);
            (k + 1, a.perp_dot(b) / (a.length() * b.length()))
        })
    }
}

/// Balance point of a polyline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Balance {
    /// Segment that it lies in.
    pub(super) segment: usize,
    /// Its place in that segment, 0 at the upper end to 1.
    pub(super) share: f64,
}

/// (length above) − (length below) − (u_last − u_0) at vertex i: negative above the balance
/// point, zero at it.
pub(super) fn imbalance(points: &[DVec2], i: usize) -> f64 {
    let length = |part: &[DVec2]| part.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
    length(&points[..=i]) - length(&points[i..]) - (points[points.len() - 1].x - points[0].x)
}

/// Where a crease makes the polyline flat-foldable with gap 0.
pub(super) fn balance(points: &[DVec2]) -> Balance {
    let last = points.len() - 2;
    let segment = (0..last).find(|&i| imbalance(points, i + 1) > 0.0).unwrap_or(last);
    let share = -imbalance(points, segment) / 2.0 / points[segment].distance(points[segment + 1]);
    Balance { segment, share: share.clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Convex polylines: slopes fall from steep-up to steep-down.
    fn convex_polyline() -> impl Strategy<Value = Vec<DVec2>> {
        prop::collection::vec((-1.3f64..1.3, 1.0f64..40.0), 2..8).prop_map(|mut parts| {
            parts.sort_by(|a, b| b.0.total_cmp(&a.0));
            let mut at = DVec2::new(30.0, 50.0);
            let mut points = vec![at];
            for (slope, length) in parts {
                at += DVec2::new(libm::sin(slope), -libm::cos(slope)) * length;
                points.push(at);
            }
            points
        })
    }

    proptest! {
        #[test]
        fn a_crease_at_the_balance_point_leaves_no_gap(points in convex_polyline()) {
            let at = balance(&points);
            let mut with_fold = points.clone();
            with_fold.insert(at.segment + 1, points[at.segment].lerp(points[at.segment + 1], at.share));
            let fold = at.segment + 1;
            prop_assume!(with_fold.windows(2).all(|w| w[0].distance(w[1]) > 1e-6));
            let profile = Profile::new(with_fold, fold).unwrap();
            prop_assert!(profile.gap_mm().abs() <= 1e-9 * profile.mean_segment_mm());
        }
    }

    #[test]
    fn a_symmetric_diamond_folds_at_its_waist() {
        let points = vec![DVec2::new(10.0, 10.0), DVec2::new(20.0, 0.0), DVec2::new(10.0, -10.0)];
        assert!(imbalance(&points, 1).abs() < 1e-12);
        let profile = Profile::new(points, 1).unwrap();
        assert!(profile.gap_mm().abs() < 1e-12);
        assert!((profile.flat_mm()[1] - (10.0 + 200f64.sqrt())).abs() < 1e-12);
    }

    #[test]
    fn bad_profiles_are_refused() {
        let p = |list: &[(f64, f64)]| list.iter().map(|&(u, v)| DVec2::new(u, v)).collect::<Vec<_>>();
        assert_eq!(Profile::new(p(&[(0.0, 1.0), (0.0, 0.0)]), 0), Err(ProfileError::TooShort));
        assert_eq!(
            Profile::new(p(&[(0.0, 2.0), (0.0, 2.0), (0.0, 0.0)]), 1),
            Err(ProfileError::NotFalling(1))
        );
        assert_eq!(Profile::new(p(&[(5.0, 2.0), (4.0, 1.0), (5.0, 0.0)]), 1), Err(ProfileError::Reflex(1)));
    }
}
