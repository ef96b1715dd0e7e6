//! What a journal of a job says: all that it takes to go on after a stop. The first line is the job,
//! each further one says how far it is; a line that was not finished does not count.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};

/// The job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Text of the cutter's profile.
    pub cutter: String,
    /// The port.
    pub port: String,
    /// Its speed, where the user chose it.
    pub baud: Option<u32>,
    /// The handshake, where the user chose it.
    pub handshake: Option<String>,
    /// Number of copies.
    pub copies: u16,
    /// The sheets.
    pub sheets: Vec<SheetEntry>,
}

/// A sheet of a job.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SheetEntry {
    /// Its name.
    pub name: String,
    /// Its strokes that only turn a drag knife.
    pub turns: Vec<usize>,
    /// Its bytes, base64.
    bytes: String,
}

impl SheetEntry {
    /// A sheet with its bytes.
    pub fn new(name: &str, bytes: &[u8], turns: &[usize]) -> Self {
        Self { name: name.to_owned(), turns: turns.to_vec(), bytes: STANDARD.encode(bytes) }
    }

    /// The bytes; none where the file is damaged.
    pub fn bytes(&self) -> Option<Vec<u8>> {
        STANDARD.decode(&self.bytes).ok()
    }
}

/// How far a job is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Position {
    /// Copies that are finished.
    pub copy: u16,
    /// Sheets of this copy that are finished.
    pub sheet: usize,
    /// Strokes of this sheet that are certainly finished.
    pub strokes: usize,
}

/// Reads a journal; `None` where the first line is no job.
pub fn parse(bytes: &[u8]) -> Option<(Header, Position)> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines();
    let header = serde_json::from_str(lines.next()?).ok()?;
    let position = lines.filter_map(|line| serde_json::from_str(line).ok()).next_back();
    Some((header, position.unwrap_or_default()))
}
