//! Choices for nets.

use super::hand::NetHand;
use glam::DVec2;

/// How nets are made.
#[derive(Debug, Clone, PartialEq)]
pub struct NetOptions {
    /// Width of tabs, mm; less on short edges.
    pub tab_width_mm: f64,
    /// Room for pieces on a sheet: width and height within the margins, mm.
    pub sheet_mm: DVec2,
    /// What else is chosen.
    pub choices: NetChoices,
    /// What is chosen about the component by hand.
    pub hand: NetHand,
}

/// What the user may choose about nets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NetChoices {
    /// Whether a panel larger than the sheet may be split.
    pub may_split: bool,
    /// Whether the place of each tab behind its mate is drawn.
    pub glue_marks: bool,
    /// Whether the angle of each crease is written beside it.
    pub angles: bool,
    /// Whether the name of each edge is written beside it.
    pub edge_names: bool,
    /// Creases that are folded by less, when deployed, are not drawn; fold hinges always are.
    pub hide_below_rad: f64,
    /// Whether every panel is a piece of its own, with places for tape along its hinges: board
    /// cannot be creased.
    pub is_separate: bool,
}

impl Default for NetChoices {
    /// Panels may be split, and nothing is drawn but what must be.
    fn default() -> Self {
        Self {
            may_split: true,
            glue_marks: false,
            angles: false,
            edge_names: false,
            hide_below_rad: 0.0,
            is_separate: false,
        }
    }
}

impl NetOptions {
    /// The standard choices.
    pub fn new(tab_width_mm: f64, sheet_mm: DVec2) -> Self {
        Self { tab_width_mm, sheet_mm, choices: NetChoices::default(), hand: NetHand::default() }
    }
}

/// Names that appear on the pieces of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Naming<'a> {
    /// The component's name.
    pub name: &'a str,
    /// Beginning of its labels: `A` gives `A1`, `A2`, …
    pub prefix: &'a str,
}
