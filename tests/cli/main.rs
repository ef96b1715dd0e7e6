//! The program as its users meet it.

mod bad_meshes;
mod batch;
mod check;
#[path = "../cube/mod.rs"]
mod cube;
mod design;
mod exports;
mod faults;
mod film;
mod guide;
mod hostile;
#[path = "../listed/mod.rs"]
mod listed;
mod make;
mod measures;
mod mistakes;
mod presets;
mod profiles;
mod project;
mod refusals;
mod segment;
mod shell;
mod texts;
mod trust;

use std::path::Path;
use tempfile::TempDir;

struct Run {
    code: Option<i32>,
    out: String,
    err: String,
}

fn run(folder: &Path, arguments: &[&str]) -> Run {
    run_in("C", folder, arguments)
}

/// The same where the user's locale is another one.
fn run_in(locale: &str, folder: &Path, arguments: &[&str]) -> Run {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("tatamu");
    let result = command.current_dir(folder).env("LC_ALL", locale).args(arguments).output().unwrap();
    Run {
        code: result.status.code(),
        out: String::from_utf8(result.stdout).unwrap(),
        err: String::from_utf8(result.stderr).unwrap(),
    }
}

fn folder_with(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

fn names(folder: &TempDir) -> Vec<String> {
    let entries = std::fs::read_dir(folder.path()).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// One message of one line with these words, a failure, and no file written.
fn assert_refused(files: &[(&str, &[u8])], arguments: &[&str], words: &[&str]) {
    let folder = folder_with(files);
    let before = names(&folder);
    let result = run(folder.path(), arguments);
    assert_eq!(result.code, Some(1), "{arguments:?}: {}", result.err);
    assert_eq!(result.out, "");
    assert!(result.err.starts_with("error: "), "{}", result.err);
    assert_eq!(result.err.trim_end().lines().count(), 1, "{}", result.err);
    for word in words {
        assert!(result.err.contains(word), "no {word:?} in: {}", result.err);
    }
    assert_eq!(names(&folder), before);
}

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

fn report(folder: &TempDir, name: &str) -> serde_json::Value {
    let bytes = std::fs::read(folder.path().join(name)).unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

fn assert_near(found: Option<f64>, expected: f64) {
    assert!(found.is_some_and(|x| (x - expected).abs() < 1e-9), "{found:?}, not {expected}");
}
