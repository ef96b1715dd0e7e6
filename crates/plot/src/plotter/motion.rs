//! How the tool moves.

use super::Point;

/// One straight move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// Whether the pen is down.
    pub is_down: bool,
}
