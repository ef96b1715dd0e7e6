//! Reading files: from the disk, or from the standard input.

use super::error::{AppError, reason};
use std::fs::File;
use std::io::{Error, ErrorKind, Read, Take};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Largest input, bytes: a mesh of twenty million triangles in text has fewer.
const MOST_BYTES: u64 = 2 << 30;

/// Gives the content of a file.
pub type Fetch<'a> = &'a dyn Fn(&Path) -> std::io::Result<Vec<u8>>;

/// Stands for the standard input.
pub const STANDARD_INPUT: &str = "-";

/// The content of a file, or of the standard input.
pub fn read_file(path: &Path) -> Result<Vec<u8>, AppError> {
    whole(&fetch, path)
}

/// The content of a text file; `kind` is what messages call it.
pub fn read_text(path: &Path, kind: &str) -> Result<String, AppError> {
    String::from_utf8(read_file(path)?).map_err(|_| AppError::Input {
        path: path.to_owned(),
        reason: format!("a {kind} must be UTF-8 text"),
    })
}

pub(super) fn whole(fetch: Fetch<'_>, path: &Path) -> Result<Vec<u8>, AppError> {
    fetch(path).map_err(|error| AppError::Input { path: path.to_owned(), reason: reason(&error) })
}

/// From the disk, or from the standard input.
pub fn fetch(path: &Path) -> std::io::Result<Vec<u8>> {
    if path == Path::new(STANDARD_INPUT) { standard_input() } else { at_most(open(path)?, MOST_BYTES) }
}

/// The first bytes of a file.
pub(super) fn beginning(path: &Path, bytes: u64) -> std::io::Result<Vec<u8>> {
    let mut head = Vec::new();
    open(path)?.take(bytes).read_to_end(&mut head)?;
    Ok(head)
}

/// Opens a file, and nothing else: a pipe may wait for its writer for ever, and a device has no end.
fn open(path: &Path) -> std::io::Result<Take<File>> {
    let metadata = std::fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(ErrorKind::IsADirectory.into());
    }
    if !metadata.is_file() {
        return Err(Error::other("it is a pipe or a device; use a file, or - for the standard input"));
    }
    if metadata.len() > MOST_BYTES {
        return Err(too_large(MOST_BYTES));
    }
    // A file of /proc says that it has no bytes, and /proc/kmsg waits for the next message for ever.
    let most = if metadata.len() == 0 { 0 } else { MOST_BYTES + 1 };
    Ok(File::open(path)?.take(most))
}

/// All that a source has, unless it is more than this many bytes.
fn at_most(source: impl Read, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large(most)) } else { Ok(bytes) }
}

fn too_large(most: u64) -> Error {
    Error::other(format!("it has more than {} GB; reduce the mesh first", most >> 30))
}

/// The standard input, which is kept: a mesh is read once for its shape and once for its colours.
fn standard_input() -> std::io::Result<Vec<u8>> {
    static READ: Mutex<Option<Vec<u8>>> = Mutex::new(None);
    let mut read = READ.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(bytes) = &*read {
        return Ok(bytes.clone());
    }
    let bytes = at_most(std::io::stdin().lock(), MOST_BYTES)?;
    Ok(read.insert(bytes).clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_without_end_is_left() {
        assert_eq!(at_most(&b"12345"[..], 5).unwrap(), b"12345");
        assert!(at_most(&b"123456"[..], 5).is_err());
        assert!(at_most(std::io::repeat(0), 1 << 20).is_err());
    }
}
