//! A net before its pieces are made.

use super::layout::Layout;
use super::tabs::Placed;
use tatamu_core::component::HingeId;

/// Cuts, layouts and tabs, before texts.
pub(super) struct Draft {
    pub(super) layouts: Vec<Layout>,
    pub(super) cut: Vec<HingeId>,
    pub(super) tabs: Vec<Placed>,
    /// Halves of strips of tape over cut hinges without a tab.
    pub(super) tapes: Vec<Placed>,
}
