//! Journals as files.

use crate::app::error::{AppError, reason};
use crate::app::sources::Sources;
use crate::app::{files, output};
use std::fs::{File, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};
use tatamu::plotter::journal::{self, Header, Position};

/// A journal that is being written.
pub struct Journal {
    path: PathBuf,
    file: File,
    last: Position,
    is_synced: bool,
}

impl Journal {
    /// Begins a journal. It replaces another one only when it is complete, and when no running job has
    /// that one.
    pub fn create(path: &Path, header: &Header, at: Position) -> Result<Self, AppError> {
        check_unused(path)?;
        let failed =
            |error: std::io::Error| AppError::Output { path: path.to_owned(), reason: reason(&error) };
        let header = serde_json::to_string(header).map_err(|error| failed(error.into()))?;
        let position = serde_json::to_string(&at).map_err(|error| failed(error.into()))?;
        let whole = format!("{header}\n{position}\n");
        output::write(&[(path.to_owned(), whole.into_bytes())], &Sources::none())?;
        let file = File::options().read(true).append(true).open(path).map_err(failed)?;
        // Some network drives have no locks; two jobs on one journal go unnoticed there.
        let _ = file.try_lock();
        file.sync_all().map_err(failed)?;
        Ok(Self { path: path.to_owned(), file, last: at, is_synced: true })
    }

    /// Notes how far the job is, where that is news.
    pub fn note(&mut self, at: Position) -> Result<(), AppError> {
        if at == self.last {
            return Ok(());
        }
        self.last = at;
        self.is_synced = false;
        let failed =
            |error: std::io::Error| AppError::Output { path: self.path.clone(), reason: reason(&error) };
        let line = serde_json::to_string(&at).map_err(|error| failed(error.into()))?;
        writeln!(self.file, "{line}").map_err(failed)
    }

    /// Waits until the disk has it.
    pub fn sync(&mut self) -> Result<(), AppError> {
        if std::mem::replace(&mut self.is_synced, true) {
            return Ok(());
        }
        let failed = |error| AppError::Output { path: self.path.clone(), reason: reason(&error) };
        self.file.sync_data().map_err(failed)
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

/// Refuses a journal that a running job keeps: at its end, that job would remove the one that took its place.
pub fn check_unused(path: &Path) -> Result<(), AppError> {
    let journal = Some(path).filter(|path| path.is_file()).and_then(|path| File::open(path).ok());
    match journal.map(|file| file.try_lock()) {
        Some(Err(TryLockError::WouldBlock)) => Err(AppError::Output {
            path: path.to_owned(),
            reason: "a running job keeps its journal there; wait for its end, or plot in another folder"
                .to_owned(),
        }),
        _ => Ok(()),
    }
}

/// Reads a journal.
pub fn read(path: &Path) -> Result<(Header, Position), AppError> {
    let wrong = |reason: &str| AppError::Input { path: path.to_owned(), reason: reason.to_owned() };
    let (header, at) = journal::parse(&files::read_file(path)?)
        .ok_or_else(|| wrong("it is not a journal of a job (.tatamu-job)"))?;
    // After the last sheet and the last copy a job is done; beyond them it never was.
    let is_beyond = at.sheet > header.sheets.len() || at.copy > header.copies;
    if header.sheets.is_empty() || header.copies == 0 || is_beyond {
        return Err(wrong("the journal is damaged; start the job again"));
    }
    Ok((header, at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tatamu::plotter::journal::SheetEntry;

    fn header() -> Header {
        Header {
            cutter: "x = 1\n".to_owned(),
            port: "COM3".to_owned(),
            baud: None,
            handshake: Some("paced".to_owned()),
            copies: 2,
            sheets: vec![SheetEntry::new("one", b"M0,0\x03", &[0, 9])],
        }
    }

    /// The job that ended first removed the journal of the other one.
    #[test]
    fn the_journal_of_a_running_job_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tatamu-job");
        let running = Journal::create(&path, &header(), Position::default()).unwrap();
        let second = Journal::create(&path, &header(), Position::default()).err().unwrap();
        assert!(second.to_string().contains("running"), "{second}");
        // A job that was stopped leaves its journal to whoever goes on with it.
        drop(running);
        Journal::create(&path, &header(), Position::default()).unwrap().remove();
        assert!(!path.exists());
    }

    /// Such a journal was removed as done, and nothing was sent.
    #[test]
    fn a_journal_that_is_beyond_its_job_is_damaged() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tatamu-job");
        let written = |header: &Header, at| {
            drop(Journal::create(&path, header, at).unwrap());
            read(&path).err().map(|error| error.to_string())
        };
        let done = Position { copy: 2, ..Position::default() };
        assert_eq!(written(&header(), done), None);
        let sheet = Position { sheet: 2, ..Position::default() };
        let copy = Position { copy: 3, ..Position::default() };
        for (header, at) in [
            (header(), sheet),
            (header(), copy),
            (Header { copies: 0, ..header() }, Position::default()),
            (Header { sheets: Vec::new(), ..header() }, Position::default()),
        ] {
            assert!(written(&header, at).is_some_and(|said| said.contains("damaged")), "{at:?}");
        }
    }

    #[test]
    fn what_was_noted_last_is_where_it_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tatamu-job");
        let header = header();
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
