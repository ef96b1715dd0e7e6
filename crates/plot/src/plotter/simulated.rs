//! The simulated machine for a cutter's profile.

use super::{Cutter, VirtualEbb, VirtualGrbl, VirtualMachine, VirtualOptions, VirtualPlotter};

/// A simulated machine like a cutter's profile.
pub fn virtual_machine(cutter: &Cutter, options: VirtualOptions) -> Box<dyn VirtualMachine> {
    match cutter.grbl() {
        Some(_) => Box::new(VirtualGrbl::new(cutter, options)),
        None if cutter.dialect().counts_distances() => Box::new(VirtualEbb::new(cutter, options)),
        None => Box::new(VirtualPlotter::new(cutter, options)),
    }
}
