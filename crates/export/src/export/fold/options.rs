//! What the user may choose about FOLD files.

/// A number of poses between deployed and flat.
///
/// # Guarantees
/// It is at most 1000.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PoseCount(pub(super) usize);

impl PoseCount {
    /// Most poses between deployed and flat.
    pub const MOST: usize = 1000;

    /// The number.
    pub fn get(self) -> usize {
        self.0
    }

    /// Takes the number.
    ///
    /// # Errors
    /// A message for too many.
    pub fn new(poses: usize) -> Result<Self, String> {
        let message = || format!("the number of poses must be at most {}", Self::MOST);
        (poses <= Self::MOST).then_some(Self(poses)).ok_or_else(message)
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
