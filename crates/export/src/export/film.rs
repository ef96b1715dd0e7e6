//! Films of the folding as files.

use super::{ExportError, ExportFile, Format, FormatOptions};
use crate::product::Product;
use crate::show::Film;

/// The film of a model, in the format that `encode` writes.
pub(super) fn write<E: ToString>(
    format: &Format,
    product: &Product<'_>,
    options: &FormatOptions,
    encode: impl Fn(&Film) -> Result<Vec<u8>, E>,
) -> Result<Vec<ExportFile>, ExportError> {
    let (model, plan) = (product.output().model(), product.output().fold_plan());
    let film = Film::shoot(model, plan, &options.film).map_err(|e| ExportError::writer(format, e))?;
    let bytes = encode(&film).map_err(|e| ExportError::writer(format, e))?;
    Ok(vec![ExportFile::single(bytes)])
}
