//! Reports as text.

use serde::Serialize;
use tatamu_draw::drawing::text::with_escapes;

/// A report as JSON for people, without characters that steer what shows it.
pub(crate) fn pretty(report: &impl Serialize) -> Result<Vec<u8>, serde_json::Error> {
    let text = with_escapes(&serde_json::to_string_pretty(report)?);
    Ok(format!("{text}\n").into_bytes())
}
