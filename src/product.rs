//! A finished run as documents: pages, FOLD and report, ready for every format.

use crate::drawing::LineStyles;
use crate::export::fold::{self, FoldComponent, FoldModel, PiecePlace};
use crate::export::{ExportError, ExportInput};
use crate::pipeline::Output;
use crate::report::{self, Run};
use glam::DVec2;

/// Distance between sheets in the crease pattern, mm.
const SHEET_GAP_MM: f64 = 20.0;

/// Why a run cannot be turned into documents.
#[derive(Debug, thiserror::Error)]
pub enum ProductError {
    /// A drawing is not fit to be exported.
    #[error(transparent)]
    Export(#[from] ExportError),
    /// JSON could not be written.
    #[error("a document could not be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

/// All that the formats may write of a run.
///
/// # Errors
/// See [`ProductError`]; no run is known that brings one about.
pub fn export_input(output: &Output, title: &str, run: &Run<'_>) -> Result<ExportInput, ProductError> {
    let styles = LineStyles::standard();
    let note = size_note(output);
    let pages = output.layout().pages(output.nets(), title, &note, &styles);
    Ok(ExportInput::new(title, pages)?
        .with_document("fold", fold_master(output, title)?)
        .with_document("json", report::to_json(output, run)?))
}

/// Width, depth and height of the model in words.
pub fn size_note(output: &Output) -> String {
    let (low, high) = output.mesh().bounds();
    let size = high - low;
    format!("{:.0} × {:.0} × {:.0} mm", size.x, size.y, size.z)
}

/// The FOLD master: crease pattern with the sheets side by side, deployed and flat model.
///
/// # Errors
/// Only what `serde_json` reports.
pub fn fold_master(output: &Output, title: &str) -> Result<Vec<u8>, serde_json::Error> {
    let layout = output.layout();
    let parts = output.model().parts();
    let places: Vec<Vec<PiecePlace>> = (0..parts.len())
        .map(|n| {
            let places = layout.places(n).iter();
            places.map(|at| PiecePlace { sheet: at.sheet, place: at.place }).collect()
        })
        .collect();
    let components: Vec<FoldComponent> = parts
        .iter()
        .zip(output.nets())
        .zip(&places)
        .map(|((part, net), pieces)| FoldComponent {
            name: &part.name,
            set: part.component.panels(),
            net,
            pieces,
            deployed: part.deployed(),
            flat: part.flat,
        })
        .collect();
    let step_mm = layout.options().paper.width_mm() + SHEET_GAP_MM;
    let sheet_offsets: Vec<DVec2> =
        (0..layout.sheet_count()).map(|k| DVec2::X * (step_mm * k as f64)).collect();
    fold::write(&FoldModel { title, components: &components, sheet_offsets: &sheet_offsets })
}
