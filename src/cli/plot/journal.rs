//! The journal of a job: all that it takes to go on after a stop. The first line is the job, each
//! further one says how far it is; a line that was not finished does not count.

use crate::cli::error::{CliError, reason};
use crate::cli::{input, output};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

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

/// A journal that is being written.
pub struct Journal {
    path: PathBuf,
    file: File,
    last: Position,
}

impl Journal {
    /// Begins a journal, in the place of another only when it is complete.
    pub fn create(path: &Path, header: &Header, at: Position) -> Result<Self, CliError> {
        let failed =
            |error: std::io::Error| CliError::Output { path: path.to_owned(), reason: reason(&error) };
        let header = serde_json::to_string(header).map_err(|error| failed(error.into()))?;
        let position = serde_json::to_string(&at).map_err(|error| failed(error.into()))?;
        let whole = format!("{header}\n{position}\n");
        output::write(&[(path.to_owned(), whole.into_bytes())])?;
        let file = File::options().append(true).open(path).map_err(failed)?;
        Ok(Self { path: path.to_owned(), file, last: at })
    }

    /// Notes how far the job is, where that is news.
    pub fn note(&mut self, at: Position) -> Result<(), CliError> {
        if at == self.last {
            return Ok(());
        }
        self.last = at;
        let failed =
            |error: std::io::Error| CliError::Output { path: self.path.clone(), reason: reason(&error) };
        let line = serde_json::to_string(&at).map_err(|error| failed(error.into()))?;
        writeln!(self.file, "{line}").map_err(failed)
    }

    /// How far the job is.
    pub fn position(&self) -> Position {
        self.last
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The job is finished: nothing is left to go on with.
    pub fn remove(self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

/// Reads a journal.
pub fn read(path: &Path) -> Result<(Header, Position), CliError> {
    let bytes = input::read_file(path)?;
    let text = String::from_utf8_lossy(&bytes);
    let mut lines = text.lines();
    let header = lines.next().and_then(|line| serde_json::from_str(line).ok());
    let header = header.ok_or_else(|| CliError::Input {
        path: path.to_owned(),
        reason: "it is no journal of a job (.tatamu-job)".to_owned(),
    })?;
    let position = lines.filter_map(|line| serde_json::from_str(line).ok()).next_back();
    Ok((header, position.unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_noted_last_is_where_it_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tatamu-job");
        let header = Header {
            cutter: "x = 1\n".to_owned(),
            port: "COM3".to_owned(),
            baud: None,
            handshake: Some("paced".to_owned()),
            copies: 2,
            sheets: vec![SheetEntry::new("one", b"M0,0\x03", &[0, 9])],
        };
        let mut journal = Journal::create(&path, &header, Position::default()).unwrap();
        let at = Position { copy: 1, sheet: 0, strokes: 17 };
        journal.note(at).unwrap();
        // The power fails in the middle of a line.
        journal.file.write_all(b"{\"copy\":1,\"sh").unwrap();
        assert_eq!(read(&path).unwrap(), (header.clone(), at));
        assert_eq!(header.sheets[0].bytes().as_deref(), Some(&b"M0,0\x03"[..]));
        std::fs::write(&path, "IN;PU;").unwrap();
        assert!(read(&path).is_err());
    }
}
