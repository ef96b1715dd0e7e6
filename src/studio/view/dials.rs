//! The settings of the whole model, and of paper and pieces.

use super::super::state::Studio;
use super::values::Dialled;
use eframe::egui::Ui;
use tatamu::front::dials;
use tatamu::project::options::{Entry, PARTS, SIZE, Settings};

/// The settings of the whole model, as rows of a grid.
pub fn model(studio: &mut Studio, ui: &mut Ui) {
    let Some(settings) = studio.document().map(|d| d.settings().clone()) else { return };
    if studio.is_drawn() {
        let size_mm = settings.model.size_mm;
        let size_mm = studio.shown().shaped().map_or(size_mm, |shaped| shaped.options().size_mm);
        return Dialled::new(&SIZE).number_row(studio, ui, size_mm);
    }
    for option in dials::model(&settings, false) {
        if *option == PARTS {
            let found = studio.shown().names().len().max(1) as f64;
            let parts = settings.model.segmentation.parts;
            Dialled::new(&PARTS).optional_row(studio, ui, parts.map(|n| n as f64), found);
        } else {
            row(studio, ui, option, &settings);
        }
    }
}

/// The settings of paper and pieces, as rows of a grid.
pub fn paper(studio: &mut Studio, ui: &mut Ui) {
    let Some(settings) = studio.document().map(|d| d.settings().clone()) else { return };
    dials::PAPER_AND_PIECES.iter().for_each(|option| row(studio, ui, option, &settings));
}

/// The settings that few need, as rows of a grid.
pub fn rare(studio: &mut Studio, ui: &mut Ui) {
    let Some(settings) = studio.document().map(|d| d.settings().clone()) else { return };
    dials::RARE.iter().for_each(|option| row(studio, ui, option, &settings));
}

fn row(studio: &mut Studio, ui: &mut Ui, option: &'static Entry, settings: &Settings) {
    Dialled::new(option).row(studio, ui, settings);
}
