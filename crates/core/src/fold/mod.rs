//! Folding: how components move between unfolded and flat, whether they clash, and in which order they fold.

mod cache;
mod chain;
mod clashes;
pub mod contact;
mod encounter;
mod ground;
mod interleave;
mod moment;
mod motion;
mod order;
mod overlap;
mod plan;
mod pose;
mod pull;
mod sequence;
mod stack;
mod step;
mod sweep;
mod track;
mod warning;
mod way;

pub use cache::SweepCache;
pub use chain::{ChainMotion, Course, Shares};
pub use clashes::Clash;
pub use encounter::Encounter;
pub use moment::Moment;
pub use motion::{ComponentMotion, ComponentPose};
pub use overlap::Overlap;
pub use plan::{Detection, FoldPlan};
pub use pose::{ModelMotion, ModelPose, PartPose, ancestors, root_of};
pub use sequence::{Motion, Sequence};
pub use stack::Stack;
pub use step::{Pull, Step};
pub use warning::{FoldWarning, Place, Side, When};

#[cfg(test)]
mod tests;
