//! What the user may choose about FOLD files.

/// Most poses between deployed and flat.
const MOST_POSES: usize = 1000;

/// A number of poses between deployed and flat.
///
/// # Guarantees
/// It is at most 1000.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PoseCount(pub(super) usize);

impl PoseCount {
    /// Takes the number.
    ///
    /// # Errors
    /// A message for too many.
    pub fn new(poses: usize) -> Result<Self, String> {
        let message = || format!("the number of poses must be at most {MOST_POSES}");
        (poses <= MOST_POSES).then_some(Self(poses)).ok_or_else(message)
    }
}

/// Choices for FOLD files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FoldOptions {
    /// Whether each piece is written to a file of its own, besides the master.
    pub pieces: bool,
    /// Poses in the master between deployed and flat.
    pub poses: PoseCount,
}
