//! Why there is no net.

use super::hand::HandFault;
use glam::DVec2;
use tatamu_core::component::PanelId;

/// Why a component has no net.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NetError {
    /// A single panel is larger than the sheet.
    #[error(
        "a panel of {name} measures {:.0} × {:.0} mm and does not fit the sheet of \
         {:.0} × {:.0} mm; make the model smaller by a factor of {scale:.3}, or the paper larger",
        size_mm.x, size_mm.y, sheet_mm.x, sheet_mm.y
    )]
    PanelTooLarge {
        /// The component.
        name: String,
        /// The panel.
        panel: PanelId,
        /// Its bounding box in the best position, mm.
        size_mm: DVec2,
        /// Room on the sheet, mm.
        sheet_mm: DVec2,
        /// Factor, below 1, by which the model must shrink for this panel to fit.
        scale: f64,
        /// Whether it would have been split where the sheet has room for that.
        may_split: bool,
    },
    /// What was chosen by hand cannot be done.
    #[error("the net of {name}: {fault}")]
    Hand {
        /// The component.
        name: String,
        /// Why.
        fault: HandFault,
    },
    /// The panels are not a top panel, chains and a bottom panel.
    #[error("the panels do not make chains from top to bottom: {what} is missing")]
    NotChains {
        /// What is missing.
        what: String,
    },
}
