//! Where tabs and tape lie behind panels.

use super::GlueArea;
use super::layout::{Layout, across, edge};
use super::tabs::{Placed, Shapes};
use glam::DAffine2;
use tatamu_core::component::{HingeId, PanelSet};

/// The two halves of a strip of tape over a hinge without a tab, each as if it were the tab of the
/// other side; nothing for a side where not even the narrowest would fit.
pub(super) fn tapes(cut: &[HingeId], tabs: &[Placed], shapes: &[Shapes]) -> Vec<Placed> {
    let untabbed = cut.iter().filter(|h| tabs.iter().all(|t| t.hinge != **h));
    untabbed
        .flat_map(|&hinge| {
            [0, 1].into_iter().filter_map(move |side| {
                let shape = *shapes[hinge.0][side].first()?;
                Some(Placed { hinge, side, shape })
            })
        })
        .collect()
}

/// The places of tabs or tapes behind the panels of one piece, in the piece's coordinates.
pub(super) fn areas(set: &PanelSet, layout: &Layout, glued: &[Placed]) -> Vec<GlueArea> {
    let area = |glued: &Placed| {
        let sides = set.hinges()[glued.hinge.0].sides;
        let mate: DAffine2 = layout.place(sides[1 - glued.side].panel)?;
        let to_piece = mate * across(set, glued.hinge, glued.side).inverse();
        let outline = glued.shape.outline(edge(set, sides[glued.side]));
        let is_outside = set.hinges()[glued.hinge.0].lift_mm > 0.0;
        let outline = outline.map(|p| to_piece.transform_point2(p));
        Some(GlueArea { hinge: glued.hinge, outline, is_outside })
    };
    glued.iter().filter_map(area).collect()
}
