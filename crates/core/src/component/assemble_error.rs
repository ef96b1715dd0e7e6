//! Why a solid makes no panels.

use super::panel::ChainId;
use super::profile::ProfileError;

/// Why a solid makes no panels.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum AssembleError {
    /// A profile is not valid.
    #[error("chain {}: {error}", chain.number())]
    Profile {
        /// The chain.
        chain: ChainId,
        /// What is wrong.
        error: ProfileError,
    },
    /// The fold hinge would cut through a joint panel.
    #[error("the fold hinge of chain {} lies in a joint panel", .0.number())]
    CreasedJoint(ChainId),
    /// A chain does not close when folded.
    #[error("chain {} cannot be made to fold flat at one of its bends", .0.number())]
    OutOfBalance(ChainId),
    /// Some panel has no width or height at some place.
    #[error("not all of its panels have room")]
    NoRoom,
    /// Neighbouring walls meet in front of a wall.
    #[error(
        "edge {} has no width left at height {height_mm:.1} mm: the walls beside it meet there ({width_mm:.1} mm); draw \
         profiles that differ less, or a longer edge", chain.number()
    )]
    Pinched {
        /// The chain.
        chain: ChainId,
        /// Where it is narrowest.
        height_mm: f64,
        /// Its width there, negative where the walls have crossed.
        width_mm: f64,
    },
    /// Nothing of a panel is left.
    #[error("a panel of chain {} vanished", .0.number())]
    Vanished(ChainId),
}
