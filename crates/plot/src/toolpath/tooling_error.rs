//! What no tool can do.

/// Most passes over a line.
pub(super) const MOST_PASSES: u32 = 20;
/// Largest offset of a blade, mm: no drag knife has more.
pub(super) const LARGEST_OFFSET_MM: f64 = 3.0;
/// Longest overcut, mm.
pub(super) const LONGEST_OVERCUT_MM: f64 = 10.0;

/// A tool that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ToolingError {
    /// Offset of the blade out of range.
    #[error("a blade offset of {0} mm is not possible; give 0 to {LARGEST_OFFSET_MM} mm, such as 0.25")]
    BladeOffset(f64),
    /// Overcut out of range.
    #[error("an overcut of {0} mm is not possible; give 0 to {LONGEST_OVERCUT_MM} mm, such as 0.5")]
    Overcut(f64),
    /// Number of passes out of range.
    #[error("{0} passes are not possible; give 1 to {MOST_PASSES}")]
    Passes(u32),
    /// Lengths of a perforation out of range.
    #[error(
        "a perforation of {dash_mm} mm dashes and {gap_mm} mm gaps is not possible; give 0.1 to 100 mm for both"
    )]
    Perforation {
        /// Length of dashes.
        dash_mm: f64,
        /// Length of gaps.
        gap_mm: f64,
    },
}
