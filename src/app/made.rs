//! What `make` made of one input.

use super::text::counted;
use std::path::{Path, PathBuf};
use tatamu::fold::{Motion, Stack};
use tatamu::guide::Estimate;
use tatamu::listing;
use tatamu::pipeline::Output;
use tatamu::product;

/// The files of a model, not yet written, with its summary.
pub struct Made {
    /// Names and contents.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// Some lines about the model.
    pub summary: Vec<String>,
    /// The same in one line.
    pub line: String,
}

impl Made {
    /// Sums up a model, and names the mesh that a project led to.
    pub fn new(result: &Output, mesh: Option<&Path>, files: Vec<(PathBuf, Vec<u8>)>) -> Self {
        let names: Vec<&str> = result.model().parts().iter().map(|p| p.name.as_str()).collect();
        let pieces: usize = result.nets().iter().map(|net| net.pieces().len()).sum();
        let layout = result.layout();
        let (sheets, paper) = (layout.sheet_count(), layout.options().paper.name());
        let paths: Vec<String> = files.iter().map(|(path, _)| path.display().to_string()).collect();
        let written = paths.join(", ");
        let line = format!(
            "{}, {}, {} of {paper}; written {written}",
            counted(names.len(), "component"),
            counted(pieces, "piece"),
            counted(sheets, "sheet")
        );
        let cards = product::card_note(result, product::ANY_COLOUR)
            .map(|cards| format!(" ({cards})"))
            .unwrap_or_default();
        let mesh = mesh.map(|path| format!("mesh        {}", path.display()));
        let mut summary: Vec<String> = mesh.into_iter().collect();
        summary.extend([
            format!("size        {}", product::size_note(result)),
            format!("components  {}: {}", names.len(), names.join(", ")),
            format!("folds       {}", folding(result)),
        ]);
        summary.extend(result.remarks().iter().map(|remark| format!("note        {remark}")));
        summary.extend([
            format!("work        {}", Estimate::new(result).sentence()),
            format!("pieces      {pieces}"),
            format!("sheets      {sheets} of {paper}{cards}, {:.0}% used", 100.0 * layout.utilisation()),
            format!("written     {written}"),
        ]);
        Self { files, summary, line }
    }

    /// The same with what to do in the program that the files are for.
    #[must_use]
    pub fn with_advice(mut self, advice: Option<&str>) -> Self {
        self.summary.extend(advice.map(|advice| format!("next        {advice}")));
        self
    }

    /// Names of the files.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|(path, _)| path.as_path())
    }
}

/// The flat model, and the order of folding.
fn folding(result: &Output) -> String {
    let plan = result.fold_plan();
    let model = result.model();
    let told = |motion: &Motion| product::motion_words(motion, &model.part(motion.part()).name);
    let order: Vec<String> = plan.motions().iter().map(told).collect();
    let flat =
        |s: &Stack| format!("{:.0} × {:.0} mm, {}", s.size_mm.x, s.size_mm.y, counted(s.layers, "layer"));
    let sizes: Vec<String> = plan.stacks().iter().map(flat).collect();
    format!("to {}, in the order {}", listing::with_and(&sizes), order.join(", "))
}
