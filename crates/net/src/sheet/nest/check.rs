//! Whether a layout keeps its promises, recomputed from the outlines alone: nothing here is shared
//! with the search.

use super::{NestOptions, NestPiece, Placement};
use geo::{Area, BooleanOps, Distance, Euclidean};
use glam::DVec2;

/// What is wrong with a layout.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NestFault {
    /// Not one placement for each piece.
    #[error("{found} placements for {expected} pieces")]
    Count {
        /// Pieces.
        expected: usize,
        /// Placements.
        found: usize,
    },
    /// A piece leaves the sheet.
    #[error("piece {index} is {by_mm} mm outside of its sheet")]
    Outside {
        /// Index of the piece.
        index: usize,
        /// How far.
        by_mm: f64,
    },
    /// Two pieces are too near each other, or overlap.
    #[error("pieces {first} and {second} are {distance_mm} mm apart")]
    TooNear {
        /// Index of the one piece.
        first: usize,
        /// Index of the other.
        second: usize,
        /// Their distance; 0 where they overlap.
        distance_mm: f64,
    },
}

/// Recomputes from the outlines that every piece is inside its sheet and that any two on one
/// sheet are apart by the spacing, both within `tolerance_mm`.
pub fn check(
    pieces: &[NestPiece],
    placements: &[Placement],
    options: &NestOptions,
    tolerance_mm: f64,
) -> Result<(), NestFault> {
    if pieces.len() != placements.len() {
        return Err(NestFault::Count { expected: pieces.len(), found: placements.len() });
    }
    let placed: Vec<geo::Polygon> =
        pieces.iter().zip(placements).map(|(piece, placement)| placed_polygon(piece, placement)).collect();
    let sheet = DVec2::new(options.width_mm, options.height_mm);
    for (index, polygon) in placed.iter().enumerate() {
        let over = polygon.exterior().coords().map(|c| {
            let p = DVec2::new(c.x, c.y);
            (-p).max(p - sheet).max_element()
        });
        let by_mm = over.fold(f64::NEG_INFINITY, f64::max);
        if by_mm > tolerance_mm {
            return Err(NestFault::Outside { index, by_mm });
        }
    }
    for first in 0..placed.len() {
        for second in first + 1..placed.len() {
            if placements[first].sheet != placements[second].sheet {
                continue;
            }
            let pair = [&placed[first], &placed[second]];
            if let Some(distance_mm) = nearness(pair, options.spacing_mm, tolerance_mm) {
                return Err(NestFault::TooNear { first, second, distance_mm });
            }
        }
    }
    Ok(())
}

fn placed_polygon(piece: &NestPiece, placement: &Placement) -> geo::Polygon {
    let motion = placement.motion();
    let corners = piece.outline().iter().map(|&p| motion.transform_point2(p));
    let ring = corners.map(|p| geo::Coord { x: p.x, y: p.y }).collect();
    geo::Polygon::new(ring, Vec::new())
}

/// The distance of two polygons where it is too small. With no spacing pieces may touch, and
/// what counts is the area that they share, against a strip of the tolerance round one of them.
fn nearness(pair: [&geo::Polygon; 2], spacing_mm: f64, tolerance_mm: f64) -> Option<f64> {
    let distance = Euclidean.distance(pair[0], pair[1]);
    if distance >= spacing_mm - tolerance_mm {
        if distance > 0.0 {
            return None;
        }
        let shared = pair[0].intersection(pair[1]).unsigned_area();
        let around: f64 =
            pair[0].exterior().lines().map(|l| libm::hypot((l.end - l.start).x, (l.end - l.start).y)).sum();
        return (shared > tolerance_mm * around).then_some(distance);
    }
    Some(distance)
}
