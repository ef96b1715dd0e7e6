//! What is known of the tool for an operation.

use super::tooling_error::{LARGEST_OFFSET_MM, LONGEST_OVERCUT_MM, MOST_PASSES, ToolingError};
use super::{ARC_TOLERANCE_MM, Operation, Perforation};

/// How an operation follows a line.
///
/// # Guarantees
/// Lengths are finite and within what tools can do; at least one pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tooling {
    blade_offset_mm: f64,
    overcut_mm: f64,
    passes: u32,
    perforation: Option<Perforation>,
}

impl Tooling {
    /// A pen: one pass, right along the line.
    pub fn pen() -> Self {
        Self { blade_offset_mm: 0.0, overcut_mm: 0.0, passes: 1, perforation: None }
    }

    /// A tool whose tip trails its shaft by `blade_offset_mm`, and that goes on past the start of
    /// closed lines by `overcut_mm`.
    ///
    /// # Errors
    /// Lengths or passes out of range.
    pub fn new(blade_offset_mm: f64, overcut_mm: f64, passes: u32) -> Result<Self, ToolingError> {
        if !(0.0..=LARGEST_OFFSET_MM).contains(&blade_offset_mm) {
            return Err(ToolingError::BladeOffset(blade_offset_mm));
        }
        if !(0.0..=LONGEST_OVERCUT_MM).contains(&overcut_mm) {
            return Err(ToolingError::Overcut(overcut_mm));
        }
        if !(1..=MOST_PASSES).contains(&passes) {
            return Err(ToolingError::Passes(passes));
        }
        Ok(Self { blade_offset_mm, overcut_mm, passes, perforation: None })
    }

    /// The same tool, which perforates instead of following the line.
    #[must_use]
    pub(crate) fn perforating(mut self, perforation: Perforation) -> Self {
        self.perforation = Some(perforation);
        self
    }

    /// Distance from the shaft's axis to the tip, mm.
    pub fn blade_offset_mm(&self) -> f64 {
        self.blade_offset_mm
    }

    /// How far closed lines are followed past their start, mm.
    pub(crate) fn overcut_mm(&self) -> f64 {
        self.overcut_mm
    }

    /// Times that each line is followed.
    pub fn passes(&self) -> u32 {
        self.passes
    }

    /// How the line is perforated, if it is.
    pub(crate) fn perforation(&self) -> Option<Perforation> {
        self.perforation
    }
}

/// The tool for each operation; none where the machine leaves it out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Toolset {
    tools: [Option<Tooling>; Operation::ALL.len()],
    /// For each operation whether its tool is that of the one before in the order of work.
    goes_on: [bool; Operation::ALL.len()],
    arc_tolerance_mm: f64,
}

impl Default for Toolset {
    fn default() -> Self {
        const COUNT: usize = Operation::ALL.len();
        Self { tools: [None; COUNT], goes_on: [false; COUNT], arc_tolerance_mm: ARC_TOLERANCE_MM }
    }
}

impl Toolset {
    /// The same set with a tool for an operation.
    #[must_use]
    pub fn with(mut self, operation: Operation, tooling: Tooling) -> Self {
        self.tools[operation as usize] = Some(tooling);
        self
    }

    /// The same set where an operation goes on with the very tool of the one done before it: a
    /// drag knife then points as that left it.
    #[must_use]
    pub(crate) fn going_on(mut self, operation: Operation) -> Self {
        self.goes_on[operation as usize] = true;
        self
    }

    /// The same set with other chords for the swings of drag knives: how far they may be from
    /// their arcs, mm.
    #[must_use]
    pub(crate) fn with_arcs(mut self, tolerance_mm: f64) -> Self {
        self.arc_tolerance_mm = tolerance_mm;
        self
    }

    /// How far the chords of a drag knife's swing may be from its arc, mm.
    pub(crate) fn arc_tolerance_mm(&self) -> f64 {
        self.arc_tolerance_mm
    }

    /// Whether an operation goes on with the tool of the one done before it.
    pub fn goes_on(&self, operation: Operation) -> bool {
        self.goes_on[operation as usize]
    }

    /// The tool for an operation.
    pub fn of(&self, operation: Operation) -> Option<&Tooling> {
        self.tools[operation as usize].as_ref()
    }

    /// The operations that are done, in their order.
    pub fn operations(&self) -> Vec<Operation> {
        Operation::ALL.into_iter().filter(|&o| self.of(o).is_some()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_tools_are_refused() {
        assert!(matches!(Tooling::new(f64::NAN, 0.0, 1), Err(ToolingError::BladeOffset(_))));
        assert!(matches!(Tooling::new(-0.1, 0.0, 1), Err(ToolingError::BladeOffset(_))));
        assert!(matches!(Tooling::new(0.25, 11.0, 1), Err(ToolingError::Overcut(_))));
        assert!(matches!(Tooling::new(0.25, 0.5, 0), Err(ToolingError::Passes(0))));
        let set = Toolset::default().with(Operation::Cut, Tooling::pen());
        assert_eq!(set.operations(), [Operation::Cut]);
    }
}
