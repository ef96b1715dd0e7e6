//! The program as its users meet it.

mod cube;

use std::path::Path;
use tempfile::TempDir;

struct Run {
    code: Option<i32>,
    out: String,
    err: String,
}

fn run(folder: &Path, arguments: &[&str]) -> Run {
    let mut command = assert_cmd::cargo::cargo_bin_cmd!("tatamu");
    let result = command
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
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
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
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

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

#[test]
fn a_missing_file() {
    assert_refused(
        &[],
        &["make", "gone.obj"],
        &["cannot read gone.obj", "no such file"],
    );
}

#[test]
fn an_empty_file() {
    assert_refused(
        &[("a.obj", b"")],
        &["make", "a.obj"],
        &["a.obj", "is empty"],
    );
}

#[test]
fn a_folder_as_input() {
    assert_refused(&[], &["make", "."], &["cannot read .", "folder"]);
}

#[test]
fn text_named_stl() {
    let text = b"Dear reader, this is no mesh at all.";
    assert_refused(
        &[("a.stl", text)],
        &["make", "a.stl"],
        &["a.stl", "Dear reader", "STL"],
    );
}

#[test]
fn one_triangle() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    assert_refused(
        &[("a.obj", text)],
        &["make", "a.obj"],
        &["usable triangles in the mesh: 1", "at least 4"],
    );
}

#[test]
fn coordinates_that_are_no_numbers() {
    let text = TETRAHEDRON.replace("v 0 1 0", "v 0 nan 0");
    let files: [(&str, &[u8]); 1] = [("a.obj", text.as_bytes())];
    assert_refused(&files, &["make", "a.obj"], &["line 3", "finite"]);
}

#[test]
fn indices_out_of_range() {
    let text = TETRAHEDRON.replace("f 2 3 4", "f 2 3 5");
    let files: [(&str, &[u8]); 1] = [("a.obj", text.as_bytes())];
    assert_refused(
        &files,
        &["make", "a.obj"],
        &["line 7", "vertex 5", "4 vertices, 1 to 4"],
    );
}

#[test]
fn a_planar_mesh() {
    let text =
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    assert_refused(&[("a.obj", text)], &["make", "a.obj"], &["a.obj", "flat"]);
}

#[test]
fn a_size_of_zero() {
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes())]);
    for (flag, value) in [
        ("--size", "0"),
        ("--size", "-3mm"),
        ("--size", "big"),
        ("--top-edges", "2"),
        ("--profile-vertices", "2"),
        ("--parts", "0"),
        ("--up", "w"),
        ("--paper", "a99"),
        ("--margin", "-1"),
        ("--direction", "head"),
    ] {
        let flag_and_value = format!("{flag}={value}");
        let result = run(folder.path(), &["make", "a.obj", &flag_and_value]);
        assert_eq!(result.code, Some(2), "{flag_and_value}");
        assert_eq!(result.err.matches("error:").count(), 1, "{}", result.err);
        assert!(result.err.contains(flag), "{}", result.err);
        assert_eq!(names(&folder), ["a.obj"]);
    }
}

#[test]
fn an_unknown_extension_is_refused_before_any_work() {
    let words = ["a.doc", ".json"];
    assert_refused(&[], &["make", "gone.obj", "-o", "a.doc"], &words);
    assert_refused(
        &[],
        &["make", "gone.obj", "-o", "a.json", "-o", "json"],
        &["json by its"],
    );
}

#[test]
fn places_that_cannot_be_written() {
    let files: [(&str, &[u8]); 1] = [("a.obj", TETRAHEDRON.as_bytes())];
    let make = |output: &str, word: &str| {
        assert_refused(
            &files,
            &["make", "a.obj", "-o", output],
            &["cannot write", word],
        );
    };
    make("gone/a.json", "no such file or folder");
    assert_refused(
        &files,
        &["make", "a.obj", "-o", "a.json", "-o", "a.json"],
        &["cannot write a.json", "twice"],
    );
    assert_refused(
        &files,
        &["make", "a.obj", "-o", "a.json", "--segments", "a.obj"],
        &["cannot write a.obj", "the input"],
    );
}

#[test]
fn a_margin_that_leaves_no_room() {
    let files: [(&str, &[u8]); 1] = [("a.obj", TETRAHEDRON.as_bytes())];
    let arguments = ["make", "a.obj", "-o", "a.json", "--margin", "105"];
    assert_refused(&files, &arguments, &["105 mm", "a4"]);
}

#[test]
fn an_unknown_component() {
    let files: [(&str, &[u8]); 1] = [("a.obj", TETRAHEDRON.as_bytes())];
    let arguments = ["make", "a.obj", "-o", "a.json", "--direction", "tail=3"];
    assert_refused(&files, &arguments, &["tail"]);
}

#[test]
fn a_wrong_key_in_a_project_file_is_shown_with_its_line() {
    let project = b"mesh = 'a.obj'\n\n[paper]\nsise = 'a4'\n";
    let folder = folder_with(&[("a.obj", TETRAHEDRON.as_bytes()), ("a.toml", project)]);
    let result = run(folder.path(), &["make", "a.toml", "-o", "a.json"]);
    assert_eq!(result.code, Some(1));
    assert!(
        result.err.starts_with("error: project file a.toml: "),
        "{}",
        result.err
    );
    for words in ["line 4, column 1", "sise = 'a4'", "`size`", "`margin_mm`"] {
        assert!(
            result.err.contains(words),
            "no {words:?} in: {}",
            result.err
        );
    }
    assert_eq!(result.err.matches("error").count(), 2, "{}", result.err);
    assert_eq!(names(&folder), ["a.obj", "a.toml"]);
}

#[test]
fn a_project_whose_mesh_is_missing() {
    let files: [(&str, &[u8]); 1] = [("a.toml", b"mesh = 'gone.obj'")];
    assert_refused(
        &files,
        &["make", "a.toml", "-o", "a.json"],
        &["gone.obj", "no such file"],
    );
}

#[test]
fn names_cannot_steer_the_terminal() {
    let result = run(
        tempfile::tempdir().unwrap().path(),
        &["make", "a\x1b[31m.obj"],
    );
    assert!(!result.err.contains('\x1b'), "{:?}", result.err);
}

#[test]
fn every_cube_is_made_and_segments_have_a_line_for_each_face() {
    for (name, bytes) in cube::all() {
        let folder = folder_with(&[("cube.data", &bytes)]);
        let arguments = ["make", "cube.data", "-o", "a.json", "--segments", "a.seg"];
        let result = run(folder.path(), &arguments);
        assert_eq!(result.code, Some(0), "{name}: {}", result.err);
        assert_eq!(result.err, "", "{name}");
        assert_eq!(names(&folder), ["a.json", "a.seg", "cube.data"]);
        let segments = std::fs::read_to_string(folder.path().join("a.seg")).unwrap();
        assert_eq!(segments.lines().count(), 12);
        let report = std::fs::read(folder.path().join("a.json")).unwrap();
        let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
        let diagonal = report["input"]["diagonal_mm"].as_f64().unwrap();
        assert!((diagonal - 200.0 * 3f64.sqrt()).abs() < 1e-9);
    }
}

#[test]
fn quiet_says_nothing() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let result = run(folder.path(), &["make", "cube.off", "-q", "-o", "a.json"]);
    assert_eq!(
        (result.code, result.out.as_str(), result.err.as_str()),
        (Some(0), "", "")
    );
}

#[test]
fn what_is_repaired_is_told_with_its_count() {
    let open = TETRAHEDRON.replace("f 2 3 4\n", "f 1 2 3\nf 1 1 2\n");
    let text = format!("{open}v 9 9 9\nv 8 9 9\nv 9 8 9\nv 9 9 8\nf 5 6 7\nf 5 8 6\n");
    let folder = folder_with(&[("a.obj", text.as_bytes())]);
    let result = run(folder.path(), &["make", "a.obj", "-q", "-o", "a.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    for words in [
        "open edges: 7",
        "separate bodies: 2",
        "repeated faces: 1",
        "without area: 1",
    ] {
        assert!(
            result.err.contains(words),
            "no {words:?} in: {}",
            result.err
        );
    }
}

#[test]
fn init_writes_a_project_that_make_honours() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    std::fs::create_dir(folder.path().join("projects")).unwrap();
    for project in ["cube.toml", "projects/cube.toml"] {
        let arguments = [
            "init", "cube.off", "--size", "100", "--paper", "a3", "-o", project,
        ];
        let result = run(folder.path(), &arguments);
        assert_eq!(result.code, Some(0), "{}", result.err);
        let result = run(folder.path(), &["make", project, "-o", "a.json"]);
        assert_eq!(result.code, Some(0), "{}", result.err);
        let report = std::fs::read(folder.path().join("a.json")).unwrap();
        let report: serde_json::Value = serde_json::from_slice(&report).unwrap();
        let diagonal = report["input"]["diagonal_mm"].as_f64().unwrap();
        assert!((diagonal - 100.0 * 3f64.sqrt()).abs() < 1e-9);
    }
}

#[test]
fn init_keeps_an_existing_file() {
    let files: [(&str, &[u8]); 2] = [("cube.off", cube::OFF.as_bytes()), ("cube.toml", b"mine")];
    assert_refused(&files, &["init", "cube.off"], &["cube.toml", "--force"]);
    let folder = folder_with(&files);
    let result = run(folder.path(), &["init", "cube.off", "--force", "-q"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let text = std::fs::read_to_string(folder.path().join("cube.toml")).unwrap();
    assert!(text.contains("mesh = \"cube.off\""));
}

#[test]
fn help_is_a_document() {
    let folder = tempfile::tempdir().unwrap();
    let result = run(folder.path(), &["make", "--help"]);
    assert_eq!(result.code, Some(0));
    for words in [
        "--up",
        "--size",
        "--tab-width",
        "default: 6mm",
        "Example:",
        ".json",
        "Examples:",
    ] {
        assert!(result.out.contains(words), "no {words:?} in the help");
    }
}
