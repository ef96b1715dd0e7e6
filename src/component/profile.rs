//! Profiles and their exact flat-foldability.
//!
//! Walking down a convex profile, (length above) − (length below) grows continuously from −L to
//! +L, and |u_last − u_0| <= L: at the point where it equals u_last − u_0 a crease makes the chain
//! flat-foldable with gap 0 (Eq. (2)) and no change of shape.

use glam::DVec2;

/// A cross-section polyline (u, v), from top to bottom, with its fold vertex.
///
/// # Guarantees
/// At least three points, v strictly falling (Eq. (11)), no reflex turn, and
/// `1 <= fold_vertex <= len − 2`.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    points: Vec<DVec2>,
    fold_vertex: usize,
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
    /// A profile from its vertices and the index of the one that folds by 180°.
    pub fn new(points: Vec<DVec2>, fold_vertex: usize) -> Result<Self, ProfileError> {
        if points.len() < 3 || fold_vertex == 0 || fold_vertex + 1 >= points.len() {
            return Err(ProfileError::TooShort);
        }
        if let Some(i) = (1..points.len()).find(|&i| points[i].y >= points[i - 1].y) {
            return Err(ProfileError::NotFalling(i));
        }
        let is_reflex = |&i: &usize| {
            let (a, b) = (points[i] - points[i - 1], points[i + 1] - points[i]);
            a.perp_dot(b) > STRAIGHT * a.length() * b.length()
        };
        match (1..points.len() - 1).find(is_reflex) {
            Some(i) => Err(ProfileError::Reflex(i)),
            None => Ok(Self { points, fold_vertex }),
        }
    }

    /// Vertices (u, v), mm.
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// Index of the vertex that folds by 180° (the paper's convex fold vertex).
    pub fn fold_vertex(&self) -> usize {
        self.fold_vertex
    }

    /// Lengths l_i of the segments.
    pub fn lengths(&self) -> impl Iterator<Item = f64> + '_ {
        self.points.windows(2).map(|w| w[0].distance(w[1]))
    }

    /// Eq. (2) with mountain at the fold vertex alone: how far the chain misses the bottom hinge
    /// when flat, in mm.
    pub fn gap_mm(&self) -> f64 {
        let last = self.points[self.points.len() - 1];
        let signed = |(i, l): (usize, f64)| if i < self.fold_vertex { l } else { -l };
        (last.x - self.points[0].x) - self.lengths().enumerate().map(signed).sum::<f64>()
    }

    /// Mean length of the segments.
    pub fn mean_segment_mm(&self) -> f64 {
        self.lengths().sum::<f64>() / (self.points.len() - 1) as f64
    }

    /// u of the flat fold hinge: the farthest that the chain reaches when folded.
    pub fn flat_reach_mm(&self) -> f64 {
        self.points[0].x + self.lengths().take(self.fold_vertex).sum::<f64>()
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
                at += DVec2::new(slope.sin(), -slope.cos()) * length;
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
        assert!((profile.flat_reach_mm() - (10.0 + 200f64.sqrt())).abs() < 1e-12);
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
