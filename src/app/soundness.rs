//! The last stage of `make`: the model is folded again from its FOLD master, by code that shares nothing
//! with what made it.

use super::error::AppError;
use super::text::printable;
use tatamu::check::{self, Limits};
use tatamu::export::{FormatOptions, format_of};
use tatamu::product::Product;

/// Extension of the master.
const MASTER: &str = "fold";

/// Checks the model of a product.
///
/// # Errors
/// [`AppError::Unsound`] names each measure that fails. Narrow panels do not: a warning names them.
pub fn check(product: &Product<'_>, formats: &FormatOptions) -> Result<(), AppError> {
    let files = format_of(MASTER).map(|format| format.write(product, formats)).transpose()?;
    for master in files.iter().flatten().take(1) {
        judge(&master.bytes)?;
    }
    Ok(())
}

fn judge(master: &[u8]) -> Result<(), AppError> {
    let report = check::fold(master).map_err(|error| AppError::Unsound { found: error.to_string() })?;
    let verdicts = report.verdicts(&Limits { min_panel_mm: 0.0, ..Limits::default() });
    let failed = verdicts.iter().filter(|verdict| !verdict.passes);
    let failed: Vec<String> =
        failed.map(|verdict| format!("{} ({})", verdict.name, printable(&verdict.found))).collect();
    if failed.is_empty() { Ok(()) } else { Err(AppError::Unsound { found: failed.join(", ") }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_is_named() {
        let master = br#"{
            "vertices_coords": [[0, 0], [30, 0], [0, 30]],
            "edges_vertices": [], "edges_tatamu:kind": [], "edges_tatamu:label": [],
            "faces_vertices": [[0, 1, 2]], "faces_tatamu:component": ["triangle"],
            "faces_tatamu:kind": ["top"], "faces_tatamu:chain": [null], "faces_tatamu:panel": [null],
            "file_frames": [
                {"frame_title": "deployed", "vertices_coords": [[0, 0, 5], [30, 0, 5], [0, 30, 5]], "edges_foldAngle": []},
                {"frame_title": "flat", "vertices_coords": [[0, 0], [30, 0], [0, 31]], "edges_foldAngle": []}
            ]
        }"#;
        let error = judge(master).unwrap_err().to_string();
        assert!(error.contains("rigid panels (1.0e0 mm)") && !error.contains("closure"), "{error}");
    }
}
