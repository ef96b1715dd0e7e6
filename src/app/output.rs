//! Writing files: all of them, or none.

use super::error::{AppError, reason};
use super::sources::Sources;
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use tatamu::drawing::Pages;
use tatamu::export::{
    ExportError, ExportFile, FORMATS, Format, FormatOptions, Source, format_among, format_of,
};
use tempfile::NamedTempFile;

/// The name before the extension that stands for the standard output, as in `-.pdf`.
const STANDARD_OUTPUT: &str = "-";

/// Whether a name stands for the standard output; `./-.pdf` is a file of that name.
pub fn is_standard_output(path: &Path) -> bool {
    let has_folder = path.parent().is_some_and(|folder| !folder.as_os_str().is_empty());
    !has_folder && path.extension().is_some() && path.file_stem() == Some(STANDARD_OUTPUT.as_ref())
}

/// A file name that the user gave, with its format.
pub struct Target {
    /// The name.
    pub path: PathBuf,
    /// The format that its extension stands for.
    pub format: &'static Format,
}

/// The extensions of some formats, for messages: `.pdf, .svg`.
pub fn known_extensions(formats: &[Format]) -> String {
    let extensions = formats.iter().flat_map(|format| format.extensions);
    let dotted: Vec<String> = extensions.map(|e| format!(".{e}")).collect();
    dotted.join(", ")
}

/// Finds the format of each name, in the first of some lists that has it.
pub fn targets_among(paths: &[PathBuf], lists: &[&'static [Format]]) -> Result<Vec<Target>, AppError> {
    let target = |path: &PathBuf| -> Result<Target, AppError> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let format = lists.iter().find_map(|formats| format_among(formats, &extension));
        let known = || known_extensions(lists.last().copied().unwrap_or(FORMATS));
        let format = format.ok_or_else(|| AppError::Extension { path: path.clone(), known: known() })?;
        Ok(Target { path: path.clone(), format })
    };
    paths.iter().map(target).collect()
}

/// How pages become the files of a format.
pub type WritePages = fn(&Pages, &FormatOptions) -> Result<Vec<ExportFile>, ExportError>;

/// The format of a picture, by the extension of its file, and its writer.
pub fn picture(path: &Path) -> Result<(&'static Format, WritePages), AppError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    let format = format_of(&extension).filter(|format| format.is_picture());
    if let Some((format, Source::Pages(write))) = format.map(|format| (format, format.source)) {
        return Ok((format, write));
    }
    let pictures = FORMATS.iter().filter(|format| format.is_picture());
    let known: Vec<String> = pictures.map(|format| format!(".{}", format.extensions[0])).collect();
    Err(AppError::Extension { path: path.to_owned(), known: known.join(", ") })
}

/// Checks that files can be written under these names, that no name comes twice, and that none
/// of the sources would be lost.
pub fn check_places(paths: &[PathBuf], sources: &Sources) -> Result<(), AppError> {
    let mut seen: BTreeSet<PathBuf> = BTreeSet::new();
    if paths.iter().filter(|path| is_standard_output(path)).count() > 1 {
        return Err(AppError::Output { path: STANDARD_OUTPUT.into(), reason: ONE_FILE.to_owned() });
    }
    for path in paths.iter().filter(|path| !is_standard_output(path)) {
        let refuse = |reason: &str| AppError::Output { path: path.clone(), reason: reason.to_owned() };
        if path.is_dir() {
            return Err(refuse("it is a folder; add a file name"));
        }
        sources.spare(path)?;
        let folder = folder(path);
        if !folder.is_dir() {
            return Err(refuse(&format!("there is no folder {}; create it first", folder.display())));
        }
        if !seen.insert(place(path)) {
            return Err(refuse(TWICE));
        }
        if !is_stream(path) {
            temporary(path)?;
        }
    }
    Ok(())
}

/// One name for each place, however the user wrote it.
pub fn place(path: &Path) -> PathBuf {
    let path = &behind_links(path);
    match (folder(path).canonicalize(), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// Why the standard output is no place for several files.
pub const ONE_FILE: &str = "the standard output takes one file; write others under names of their own";
const TWICE: &str = "two options write it; choose another name";

/// Whether there is a device or a pipe of this name, such as `/dev/null`. It is written to, not replaced.
fn is_stream(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir())
}

/// The file that a link leads to; other names as they are.
fn behind_links(path: &Path) -> PathBuf {
    let target = if path.is_symlink() { path.canonicalize().ok() } else { None };
    target.unwrap_or_else(|| path.to_owned())
}

/// Writes all files to temporary files beside their places, then puts them into place, what goes to devices, pipes
/// and the standard output last. An error up to the last step leaves everything as it was. The sources are spared:
/// the name of a sheet or a piece is known only now.
pub fn write(files: &[(PathBuf, Vec<u8>)], sources: &Sources) -> Result<(), AppError> {
    let (mut ready, mut streams) = (Vec::with_capacity(files.len()), Vec::new());
    let mut seen: BTreeSet<&Path> = BTreeSet::new();
    let (printed, named): (Vec<_>, Vec<_>) = files.iter().partition(|(path, _)| is_standard_output(path));
    for (path, bytes) in named {
        // The sheets of a.svg may be called as another file that the user asked for.
        if !seen.insert(path) {
            return Err(AppError::Output { path: path.clone(), reason: TWICE.to_owned() });
        }
        sources.spare(path)?;
        if is_stream(path) {
            let stream = File::options().write(true).open(path).map_err(|error| failed(path, &error))?;
            streams.push((path, stream, bytes));
            continue;
        }
        let mut file = temporary(path)?;
        let written = file.write_all(bytes).and_then(|()| file.flush());
        written.map_err(|error| failed(path, &error))?;
        ready.push((path, file));
    }
    for (path, file) in ready {
        file.persist(behind_links(path)).map_err(|error| failed(path, &error.error))?;
    }
    for (path, mut stream, bytes) in streams {
        stream.write_all(bytes).map_err(|error| failed(path, &error))?;
    }
    for (path, bytes) in printed {
        let mut out = std::io::stdout().lock();
        out.write_all(bytes).and_then(|()| out.flush()).map_err(|error| failed(path, &error))?;
    }
    Ok(())
}

/// The folder that a file of this name is in.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// A temporary file in the folder of `path`, or of the file that it links to; it vanishes unless it is put into place.
fn temporary(path: &Path) -> Result<NamedTempFile, AppError> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tatamu-");
    #[cfg(unix)]
    {
        // The permissions of any new file, less what the user's umask takes away.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder(&behind_links(path))).map_err(|error| failed(path, &error))
}

fn failed(path: &Path, error: &std::io::Error) -> AppError {
    let advice = match error.kind() {
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "; choose a folder that you may write to"
        }
        _ => "",
    };
    AppError::Output { path: path.to_owned(), reason: format!("{}{advice}", reason(error)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_may_not_be_written_to_says_what_to_do() {
        let message = failed(Path::new("a.pdf"), &ErrorKind::PermissionDenied.into()).to_string();
        assert_eq!(message, "cannot write a.pdf: permission denied; choose a folder that you may write to");
        let full = failed(Path::new("a.pdf"), &ErrorKind::StorageFull.into()).to_string();
        assert_eq!(full, "cannot write a.pdf: the disk is full");
    }

    #[test]
    fn all_files_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let good = folder.path().join("good.txt");
        std::fs::write(&good, "old").unwrap();
        let bad = folder.path().join("missing").join("bad.txt");
        let files = [(good.clone(), b"new".to_vec()), (bad, Vec::new())];
        assert!(write(&files, &Sources::none()).is_err());
        assert_eq!(std::fs::read(&good).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        write(&files[..1], &Sources::none()).unwrap();
        assert_eq!(std::fs::read(&good).unwrap(), b"new");
    }

    /// `--report /dev/null`, by root, put a file in the place of the device, and all other programs wrote to it.
    #[cfg(unix)]
    #[test]
    fn a_pipe_is_written_to_and_stays_a_pipe() {
        use std::os::unix::fs::FileTypeExt;
        let folder = tempfile::tempdir().unwrap();
        let (pipe, beside) = (folder.path().join("pipe.txt"), folder.path().join("a.txt"));
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        check_places(std::slice::from_ref(&pipe), &Sources::none()).unwrap();
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || std::fs::read(pipe).unwrap()
        });
        let files = [(pipe.clone(), b"through".to_vec()), (beside.clone(), b"beside".to_vec())];
        write(&files, &Sources::none()).unwrap();
        assert_eq!(reader.join().unwrap(), b"through");
        assert!(pipe.metadata().unwrap().file_type().is_fifo());
        assert_eq!(std::fs::read(&beside).unwrap(), b"beside");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("sub")).unwrap();
        let (file, link) = (folder.path().join("sub").join("file.txt"), folder.path().join("link.txt"));
        std::fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        check_places(std::slice::from_ref(&link), &Sources::none()).unwrap();
        write(&[(link.clone(), b"new".to_vec())], &Sources::none()).unwrap();
        assert!(link.is_symlink());
        assert!(check_places(&[link, file.clone()], &Sources::none()).is_err(), "both are one file");
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
    }
}
