//! Folding: how components move between deployed and flat, whether they bump into one another, and
//! in which order they fold.

mod chain;
mod motion;

pub use chain::{ChainMotion, Shares};
pub use motion::{ComponentMotion, ComponentPose};

#[cfg(test)]
mod tests;
