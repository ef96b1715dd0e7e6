//! What things cost in the score of a way to fold.

/// What things cost in a score; lengths are shares of the chain's length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weights {
    /// Each fold by 180°.
    pub(super) fold: f64,
    /// A crease that was not drawn.
    pub(super) crease: f64,
    /// The farthest that a vertex is moved to close the gap.
    pub(super) moved: f64,
    /// How far the flat chain reaches beyond the deployed one.
    pub(super) spread: f64,
    /// The mean angle that the segments turn by, in radians.
    pub(super) turn: f64,
    /// How far a vertex comes inwards while the top comes down: it has to be pulled by hand.
    pub(super) inward: f64,
    /// How far the top has to rise before it comes down.
    pub(super) rise: f64,
}

/// The weights of the score. They prefer a shape as it was drawn over all else; a zigzag folds as a
/// bellows (many folds, small turns), a straight wall in the middle.
pub(super) const WEIGHTS: Weights =
    Weights { fold: 0.03, crease: 0.02, moved: 10.0, spread: 0.3, turn: 0.3, inward: 1.0, rise: 10.0 };
