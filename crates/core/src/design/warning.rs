//! What the maker of a drawn model should know.

use super::FoldAssignment;
use crate::codes;
use crate::remedy::Remedy;
use std::fmt;

/// Something that the maker of a drawn model, or of one of boards, should know.
#[derive(Debug, Clone, PartialEq)]
pub enum DesignWarning {
    /// Vertices were moved so that a profile folds flat exactly.
    MovedForWay {
        /// The component.
        component: String,
        /// The profile, from 1.
        profile: usize,
        /// The way in which it folds.
        way: FoldAssignment,
        /// How far at most.
        by_mm: f64,
    },
    /// Vertices were moved so that boards fold flat.
    MovedForBoards {
        /// The component.
        component: String,
        /// Thickness of the boards.
        thickness_mm: f64,
        /// How far at most.
        by_mm: f64,
    },
    /// Chains must rise before they can fold.
    RisesFirst {
        /// The component.
        component: String,
        /// The profile, from 1.
        profile: usize,
        /// How far.
        by_mm: f64,
        /// Number of the component's chains.
        chains: usize,
    },
    /// Hinges come inwards on their way down.
    PullByHand {
        /// The component.
        component: String,
        /// The profile, from 1.
        profile: usize,
        /// How far.
        by_mm: f64,
    },
}

codes!(DesignWarning {
    MovedForWay => "moved_vertices",
    MovedForBoards => "moved_vertices",
    RisesFirst => "rises_first",
    PullByHand => "pull_by_hand",
});

impl DesignWarning {
    /// What can be done.
    pub fn remedies(&self) -> Vec<Remedy> {
        match *self {
            Self::MovedForWay { .. } => vec![Remedy::OtherWay],
            Self::MovedForBoards { .. } => Vec::new(),
            Self::RisesFirst { chains, .. } => vec![Remedy::LiftTop { chains }, Remedy::OtherWay],
            Self::PullByHand { .. } => vec![Remedy::PullOutwards],
        }
    }
}

impl fmt::Display for DesignWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MovedForWay { component, profile, way, by_mm } => write!(
                f,
                "{component}: to fold flat as \"{way}\", vertices of profile {profile} were moved by up to {by_mm:.1} mm"
            ),
            Self::MovedForBoards { component, thickness_mm, by_mm } => write!(
                f,
                "{component}: so that boards of {thickness_mm} mm fold flat, vertices were moved by up to {by_mm:.1} mm"
            ),
            Self::RisesFirst { component, profile, by_mm, .. } => write!(
                f,
                "{component}: the chains of profile {profile} have to rise by {by_mm:.1} mm before they can fold"
            ),
            Self::PullByHand { component, profile, by_mm } => write!(
                f,
                "{component}: hinges of profile {profile} come {by_mm:.1} mm inwards while the top is pushed down"
            ),
        }
    }
}
