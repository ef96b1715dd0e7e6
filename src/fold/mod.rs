//! Folding: how components move between deployed and flat, whether they bump into one another, and
//! in which order they fold.

mod advice;
mod chain;
mod check;
pub mod contact;
mod ground;
mod motion;
mod order;
mod pose;
mod sequence;
mod stack;
mod sweep;
mod track;

pub use advice::Advice;
pub use chain::{ChainMotion, Course, Shares};
pub use check::{Clash, Overlap};
pub use motion::{ComponentMotion, ComponentPose};
pub use order::FoldPlan;
pub use pose::{ModelMotion, ModelPose, PartPose, ancestors, root_of};
pub use sequence::Sequence;
pub use stack::Stack;

#[cfg(test)]
mod tests;
