//! What is done at a time: one component is folded on, all others rest.

use crate::model::PartId;
use smallvec::SmallVec;

/// One component is folded on while all others rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The component.
    pub part: PartId,
    /// How far it is folded before: 0 deployed, 1 flat.
    pub from: f64,
    /// How far it is folded afterwards.
    pub to: f64,
}

impl Step {
    /// From deployed to flat.
    pub fn whole(part: PartId) -> Self {
        Self { part, from: 0.0, to: 1.0 }
    }

    /// Whether the component is flat afterwards.
    pub fn ends_flat(&self) -> bool {
        self.to >= 1.0
    }
}

/// A component that is unplugged before all steps, and plugged in again after them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The component; what hangs on it comes with it.
    pub part: PartId,
    /// How far it is pulled off along the normal of its parent's joint panel, mm: farther than
    /// anything on either side of that panel reaches while it folds.
    pub way_mm: f64,
}

/// A share of the way from deployed to flat at which components may rest, in parts of [`FLAT`].
pub(super) type Level = u8;
/// The levels of some components.
pub(super) type Levels = SmallVec<[Level; 16]>;

/// The level of a flat component. Two that must fold at the same time then go by steps of 3 to 10 mm.
pub(super) const FLAT: Level = 8;

/// A step between two levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Move {
    pub(super) part: PartId,
    pub(super) from: Level,
    pub(super) to: Level,
}

impl Move {
    pub(super) fn whole(part: PartId) -> Self {
        Self { part, from: 0, to: FLAT }
    }

    pub(super) fn step(&self) -> Step {
        Step { part: self.part, from: share(self.from), to: share(self.to) }
    }
}

/// The share that a level stands for.
pub(super) fn share(level: Level) -> f64 {
    f64::from(level) / f64::from(FLAT)
}
