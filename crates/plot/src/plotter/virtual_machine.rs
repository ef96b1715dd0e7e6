//! What all simulated machines have.

use super::Motion;
use std::time::Duration;

/// A machine that is not there.
pub trait VirtualMachine: Send {
    /// A byte arrives.
    fn receive(&mut self, byte: u8, now: Duration);

    /// Time passes.
    fn run_until(&mut self, now: Duration);

    /// What it says by now.
    fn take_answers(&mut self, now: Duration) -> Vec<u8>;

    /// Whether it has nothing left to do.
    fn is_idle(&self) -> bool;

    /// Whether its tool is down, or its beam on.
    fn is_pen_down(&self) -> bool;

    /// Bytes that arrived.
    fn received(&self) -> u64;

    /// Bytes that arrived when the buffer was full.
    fn lost(&self) -> u64;

    /// Commands that could not be read.
    fn broken(&self) -> u64;

    /// What it did.
    fn motions(&self) -> &[Motion];
}
