//! The simulated machine for a cutter's profile, and what a rehearsal with it does to a job.

use super::{Cutter, VirtualEbb, VirtualGrbl, VirtualMachine, VirtualOptions, VirtualPlotter};

/// A simulated machine like a cutter's profile.
pub fn virtual_machine(cutter: &Cutter, options: VirtualOptions) -> Box<dyn VirtualMachine> {
    match cutter.grbl() {
        Some(_) => Box::new(VirtualGrbl::new(cutter, options)),
        None if cutter.dialect().counts_distances() => Box::new(VirtualEbb::new(cutter, options)),
        None => Box::new(VirtualPlotter::new(cutter, options)),
    }
}

/// How a rehearsed job ends before its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interruption {
    /// The user stops it.
    Stop,
    /// The host is killed: what the port holds still goes out.
    Kill,
    /// The port is gone, with what it holds.
    Unplug,
}

impl Interruption {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Stop, Self::Kill, Self::Unplug];
}
