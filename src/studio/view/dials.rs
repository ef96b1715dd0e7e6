//! The settings of the whole model, and of paper and pieces.

use super::super::state::Studio;
use super::values::Dialled;
use eframe::egui::Ui;
use tatamu::project::options::{
    ANGLES, CLUSTERS, DETAIL, Entry, GLUE_MARKS, GRAIN, LEVEL, MARGIN, MARKS, METHOD, MIN_PANEL_WIDTH, PAPER,
    PARTS, PROFILE_VERTICES, SIDE, SIZE, SMOOTHING, SPACING, SYMMETRY, TAB_WIDTH, THICKNESS, TOLERANCE,
    TOP_EDGES, UP,
};
use tatamu::segment::Method;

/// The settings of the whole model, as rows of a grid.
pub fn model(studio: &mut Studio, ui: &mut Ui) {
    let Some(options) = studio.document().map(|d| d.options().clone()) else { return };
    if studio.is_drawn() {
        let size_mm = studio.shown().shaped().map_or(options.size_mm, |shaped| shaped.options().size_mm);
        return Dialled::new(&SIZE).number_row(studio, ui, size_mm);
    }
    rows(studio, ui, &[&SIZE, &UP, &METHOD]);
    match (options.segmentation.method, options.segmentation.parts) {
        (Method::Sdf { .. }, _) => rows(studio, ui, &[&CLUSTERS, &SMOOTHING]),
        (Method::Merge, parts) => {
            rows(studio, ui, &[&SYMMETRY]);
            let found = studio.shown().names().len().max(1) as f64;
            Dialled::new(&PARTS).optional_row(studio, ui, parts.map(|n| n as f64), found);
            if parts.is_none() {
                rows(studio, ui, &[&DETAIL]);
            }
        }
    }
    rows(studio, ui, &[&LEVEL, &TOP_EDGES, &PROFILE_VERTICES, &TOLERANCE]);
}

/// The settings of paper and pieces, as rows of a grid.
pub fn paper(studio: &mut Studio, ui: &mut Ui) {
    let widths: [&'static Entry; 6] = [&PAPER, &MARGIN, &THICKNESS, &TAB_WIDTH, &MIN_PANEL_WIDTH, &SPACING];
    rows(studio, ui, &widths);
    rows(studio, ui, &[&SIDE, &MARKS, &GRAIN, &GLUE_MARKS, &ANGLES]);
}

fn rows(studio: &mut Studio, ui: &mut Ui, options: &[&'static Entry]) {
    for option in options {
        let Some(settings) = studio.document().map(|d| d.settings().clone()) else { return };
        Dialled::new(option).row(studio, ui, &settings);
    }
}
