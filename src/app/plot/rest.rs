//! What is left of a job by its journal.

use super::sheets::{self, Sheet};
use crate::app::error::AppError;
use std::path::Path;
use tatamu::plotter::journal::{Header, Position};
use tatamu::plotter::{Cutter, Job};

/// The cutter of a job.
pub fn cutter(path: &Path, header: &Header) -> Result<Cutter, AppError> {
    Cutter::parse(&header.cutter)
        .map_err(|error| AppError::Profile { name: path.display().to_string(), error })
}

/// The whole sheet at a position, and the bytes of what is left of it.
pub fn of_sheet(
    path: &Path,
    header: &Header,
    at: Position,
    cutter: &Cutter,
) -> Result<(Job, Vec<u8>), AppError> {
    let sheet = &header.sheets[at.sheet];
    let bytes = sheet.bytes().ok_or_else(|| AppError::Input {
        path: path.to_owned(),
        reason: "the journal is damaged; start the job again".to_owned(),
    })?;
    let whole = sheets::parse(&sheet.name, &bytes, cutter)?;
    let rest = whole.from_stroke(at.strokes, &sheet.turns, cutter.dialect().as_ref());
    Ok((whole, rest))
}

/// What is left of the copy that a job is at, to look at.
pub fn sheets(path: &Path, header: &Header, at: Position, cutter: &Cutter) -> Result<Vec<Sheet>, AppError> {
    let left = |sheet: usize| {
        let strokes = if sheet == at.sheet { at.strokes } else { 0 };
        let (_, rest) = of_sheet(path, header, Position { sheet, strokes, ..at }, cutter)?;
        Sheet::of_file(header.sheets[sheet].name.clone(), rest, cutter)
    };
    (at.sheet..header.sheets.len()).map(left).collect()
}
