//! Panels of boards, which have a thickness. Their outer faces lie on the walls of the component, and
//! no board comes out of them. Through every corner of the section at a height runs a line between
//! the two edges there; each board keeps to its own side of these lines with its whole thickness, so
//! that boards of neighbouring chains, dented ones too, do not meet.

use super::assemble_error::AssembleError;
use super::panel::ChainId;
use super::profile::{Profile, ProfileError};
use super::walls::Walls;
use glam::DVec2;

/// The faces outside, and how thick boards are.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outside {
    walls: Walls,
    thickness_mm: f64,
}

impl Outside {
    /// Takes the profiles of the faces outside.
    pub(super) fn new(normals: Vec<DVec2>, profiles: Vec<Profile>, thickness_mm: f64) -> Self {
        Self { walls: Walls::new(normals, profiles), thickness_mm }
    }

    /// Outline of a board of chain j whose inner face is this segment of its profile, in the board's
    /// plane: x along the edge, y up the slope from the lower end. Nothing where no width is left.
    pub(super) fn outline(&self, j: ChainId, face: [DVec2; 2]) -> Vec<DVec2> {
        let [upper, lower] = face;
        let (length, up) = (upper.distance(lower), (upper - lower).normalize_or_zero());
        let outward = -up.perp();
        let at = |y: f64, depth: f64| lower + up * y + outward * (depth * self.thickness_mm);
        let chains = [self.walls.previous(j), j, self.walls.next(j)];
        let heights = || chains.iter().flat_map(|&c| self.walls.profile(c).points()).map(|p| p.y);
        // Between these the limits are linear, or the least of linear ones, which lies above its chords.
        let mut ys = vec![0.0, length];
        for depth in [0.0, 1.0] {
            ys.extend(heights().map(|v| (v - at(0.0, depth).y) / up.y).filter(|y| *y > 0.0 && *y < length));
        }
        ys.sort_by(f64::total_cmp);
        ys.dedup_by(|b, a| *b - *a < SAME_MM);
        let last = ys.len() - 1;
        ys[last] = length;
        let limits = |y: f64| {
            let inside = heights().map(|v| (v - at(y, 0.0).y) / (at(y, 1.0).y - at(y, 0.0).y));
            let depths = [0.0, 1.0].into_iter().chain(inside.filter(|depth| *depth > 0.0 && *depth < 1.0));
            let of_depth = depths.map(|depth| self.limits(j, at(y, depth)));
            of_depth.fold((f64::NEG_INFINITY, f64::INFINITY), |a, b| (a.0.max(b.0), a.1.min(b.1)))
        };
        let of_y: Vec<(f64, (f64, f64))> = ys.into_iter().map(|y| (y, limits(y))).collect();
        if of_y.iter().any(|(_, x)| x.1 - x.0 < SAME_MM) {
            return Vec::new();
        }
        // Counter-clockwise, from the lower left corner.
        let lower_edge = std::iter::once(DVec2::new(of_y[0].1.0, 0.0));
        let right = of_y.iter().map(|(y, x)| DVec2::new(x.1, *y));
        let left = of_y.iter().skip(1).rev().map(|(y, x)| DVec2::new(x.0, *y));
        lower_edge.chain(right).chain(left).collect()
    }

    /// How far the sector of chain j reaches along its edge, to both sides, at a point of its profile.
    fn limits(&self, j: ChainId, at: DVec2) -> (f64, f64) {
        let (normal, tangent) = (self.walls.normal(j), self.walls.tangent(j));
        let limit = |corner: ChainId, neighbour: ChainId| {
            let corner = self.walls.corner_at(corner, at.y);
            let between = normal + self.walls.normal(neighbour);
            tangent.dot(corner) + (at.x - normal.dot(corner)) * tangent.dot(between) / normal.dot(between)
        };
        let (before, after) = (self.walls.previous(j), self.walls.next(j));
        (limit(before, before), limit(j, after))
    }
}

/// Heights nearer than this give one corner.
const SAME_MM: f64 = 1e-6;

/// The inner faces as walls; between two boards at a valley they run straight.
pub(super) fn inner(walls: &Walls) -> Result<Walls, AssembleError> {
    let of_chain = |(chain, profile): (ChainId, &Profile)| {
        let mut points: Vec<DVec2> = Vec::new();
        for end in (0..profile.points().len() - 1).flat_map(|i| profile.face(i)) {
            if points.last().is_none_or(|last| last.distance(end) > SAME_MM) {
                points.push(end);
            }
        }
        let faces_up = (2..=points.len()).map(|i| i < points.len()).collect();
        Profile::folded(points, faces_up)
            .map_err(|error: ProfileError| AssembleError::Profile { chain, error })
    };
    let profiles = walls.ids().zip(walls.profiles()).map(of_chain).collect::<Result<Vec<_>, _>>()?;
    Ok(Walls::new(walls.ids().map(|j| walls.normal(j)).collect(), profiles))
}
