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
    let result = command.current_dir(folder).args(arguments).output().unwrap();
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

#[test]
fn a_missing_file() {
    assert_refused(&[], &["make", "gone.obj"], &["cannot read gone.obj", "no such file"]);
}

#[test]
fn an_empty_file() {
    assert_refused(&[("a.obj", b"")], &["make", "a.obj"], &["a.obj", "is empty"]);
}

#[test]
fn a_folder_as_input() {
    assert_refused(&[], &["make", "."], &["cannot read .", "folder"]);
}

#[test]
fn text_named_stl() {
    let text = b"Dear reader, this is no mesh at all.";
    assert_refused(&[("a.stl", text)], &["make", "a.stl"], &["a.stl", "Dear reader", "STL"]);
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
    assert_refused(&files, &["make", "a.obj"], &["line 7", "vertex 5", "4 vertices, 1 to 4"]);
}

#[test]
fn a_planar_mesh() {
    let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
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
    assert_refused(&[], &["make", "gone.obj", "-o", "a.json", "-o", "json"], &["json by its"]);
}

#[test]
fn places_that_cannot_be_written() {
    let files: [(&str, &[u8]); 1] = [("a.obj", TETRAHEDRON.as_bytes())];
    let make = |output: &str, word: &str| {
        assert_refused(&files, &["make", "a.obj", "-o", output], &["cannot write", word]);
    };
    make("gone/a.json", "there is no folder gone");
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
    assert!(result.err.starts_with("error: project file a.toml: "), "{}", result.err);
    for words in ["line 4, column 1", "sise = 'a4'", "`size`", "`margin_mm`"] {
        assert!(result.err.contains(words), "no {words:?} in: {}", result.err);
    }
    assert_eq!(result.err.matches("error").count(), 2, "{}", result.err);
    assert_eq!(names(&folder), ["a.obj", "a.toml"]);
}

#[test]
fn a_project_whose_mesh_is_missing() {
    let files: [(&str, &[u8]); 1] = [("a.toml", b"mesh = 'gone.obj'")];
    assert_refused(&files, &["make", "a.toml", "-o", "a.json"], &["gone.obj", "no such file"]);
}

#[test]
fn names_cannot_steer_the_terminal() {
    let result = run(tempfile::tempdir().unwrap().path(), &["make", "a\x1b[31m.obj"]);
    assert!(!result.err.contains('\x1b'), "{:?}", result.err);
}

#[test]
fn every_cube_is_made_and_segments_have_a_line_for_each_face() {
    for (name, bytes) in cube::all() {
        let folder = folder_with(&[("cube.data", &bytes)]);
        let outputs = ["-o", "a.json", "--segments", "a.seg"];
        let arguments = [&["make", "cube.data", "--size", "60"][..], &outputs].concat();
        let result = run(folder.path(), &arguments);
        assert_eq!(result.code, Some(0), "{name}: {}", result.err);
        assert!(!result.err.contains("the mesh has"), "{name}: {}", result.err);
        assert_eq!(names(&folder), ["a.json", "a.seg", "cube.data"]);
        let segments = std::fs::read_to_string(folder.path().join("a.seg")).unwrap();
        assert_eq!(segments, "0\n".repeat(12));
        let report = report(&folder, "a.json");
        assert_eq!(report["input"]["path"], "cube.data");
        assert_near(report["input"]["diagonal_mm"].as_f64(), 60.0 * 3f64.sqrt());
    }
}

fn report(folder: &TempDir, name: &str) -> serde_json::Value {
    let bytes = std::fs::read(folder.path().join(name)).unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

fn assert_near(found: Option<f64>, expected: f64) {
    assert!(found.is_some_and(|x| (x - expected).abs() < 1e-9), "{found:?}, not {expected}");
}

#[test]
fn without_o_a_pdf_stands_in_the_working_directory() {
    let folder = folder_with(&[]);
    std::fs::create_dir(folder.path().join("meshes")).unwrap();
    std::fs::write(folder.path().join("meshes/cube.off"), cube::OFF).unwrap();
    let result = run(folder.path(), &["make", "meshes/cube.off", "--size", "60"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert_eq!(names(&folder), ["cube.pdf", "meshes"]);
    assert!(std::fs::read(folder.path().join("cube.pdf")).unwrap().starts_with(b"%PDF"));
    for words in ["components  1: body", "a4", "written     cube.pdf"] {
        assert!(result.out.contains(words), "no {words:?} in: {}", result.out);
    }
}

#[test]
fn one_svg_a_sheet() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let arguments = ["make", "cube.off", "--size", "60", "-o", "a.svg", "-o", "a.fold"];
    let result = run(folder.path(), &arguments);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert_eq!(names(&folder), ["a-1.svg", "a.fold", "cube.off"]);
}

#[test]
fn what_does_not_fit_the_paper_is_refused_with_a_size_that_fits() {
    let files: [(&str, &[u8]); 2] = [("cube.off", cube::OFF.as_bytes()), ("cube.pdf", b"old")];
    let arguments = ["make", "cube.off", "--size", "1m"];
    assert_refused(&files, &arguments, &["does not fit", "--size"]);
    let folder = folder_with(&files);
    let message = run(folder.path(), &arguments).err;
    let size = message.split("--size ").nth(1).unwrap().split(' ').next().unwrap();
    assert_eq!(std::fs::read(folder.path().join("cube.pdf")).unwrap(), b"old");
    let result = run(folder.path(), &["make", "cube.off", "--size", size]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(std::fs::read(folder.path().join("cube.pdf")).unwrap().starts_with(b"%PDF"));
}

#[test]
#[cfg(unix)]
fn ctrl_c_stops_the_work_and_leaves_nothing() {
    let folder = folder_with(&[]);
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/teddy.obj");
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_tatamu"))
        .current_dir(folder.path())
        .args(["make", mesh, "-o", "a.pdf"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_secs(1));
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let mut message = String::new();
    let mut stderr = child.stderr.take().unwrap();
    std::io::Read::read_to_string(&mut stderr, &mut message).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{message}");
    assert_eq!(message, "tatamu: stopped at your request\n");
    assert!(names(&folder).is_empty());
}

#[test]
fn quiet_says_nothing() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    let arguments = ["make", "cube.off", "-q", "--size", "60", "-o", "a.json"];
    let result = run(folder.path(), &arguments);
    assert_eq!((result.code, result.out.as_str()), (Some(0), ""), "{}", result.err);
}

#[test]
fn what_is_repaired_is_told_with_its_count() {
    let open = TETRAHEDRON.replace("f 2 3 4\n", "f 1 2 3\nf 1 1 2\n");
    let text = format!("{open}v 9 9 9\nv 8 9 9\nv 9 8 9\nv 9 9 8\nf 5 6 7\nf 5 8 6\n");
    let folder = folder_with(&[("a.obj", text.as_bytes())]);
    let result = run(folder.path(), &["make", "a.obj", "-q", "--size", "100", "-o", "a.json"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    for words in ["open edges: 7", "bodies besides the first: 1", "repeated faces: 1", "without area: 1"] {
        assert!(result.err.contains(words), "no {words:?} in: {}", result.err);
    }
}

#[test]
fn init_writes_a_project_that_make_honours() {
    let folder = folder_with(&[("cube.off", cube::OFF.as_bytes())]);
    std::fs::create_dir(folder.path().join("projects")).unwrap();
    for project in ["cube.toml", "projects/cube.toml"] {
        let flags = ["--size", "50", "--top-edges", "5", "--direction", "body=30", "-o", project];
        let result = run(folder.path(), &[&["init", "cube.off"][..], &flags].concat());
        assert_eq!(result.code, Some(0), "{}", result.err);

        let path = folder.path().join(project);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("\ndirection = 30.0\n"), "{text}");
        let text = text.replace("# rename = \"body\"", "rename = \"head\"");
        std::fs::write(&path, text.replace("top_edges = 5", "top_edges = 4")).unwrap();
        let result = run(folder.path(), &["make", project, "-o", "a.json"]);
        assert_eq!(result.code, Some(0), "{}", result.err);
        let report = report(&folder, "a.json");
        assert_near(report["input"]["diagonal_mm"].as_f64(), 50.0 * 3f64.sqrt());
        assert_eq!(report["components"][0]["name"], "head");
        assert_eq!(report["components"][0]["top_edges"], 4);
        assert_near(report["components"][0]["direction_deg"].as_f64(), 30.0);
    }
}

#[test]
fn init_keeps_an_existing_file() {
    let files: [(&str, &[u8]); 2] = [("cube.off", cube::OFF.as_bytes()), ("cube.toml", b"mine")];
    assert_refused(&files, &["init", "cube.off"], &["cube.toml", "--force"]);
    let folder = folder_with(&files);
    let result = run(folder.path(), &["init", "cube.off", "--force", "-q", "--size", "60"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let text = std::fs::read_to_string(folder.path().join("cube.toml")).unwrap();
    assert!(text.contains("mesh = \"cube.off\""));
}

#[test]
fn help_is_a_document() {
    let folder = tempfile::tempdir().unwrap();
    let result = run(folder.path(), &["make", "--help"]);
    assert_eq!(result.code, Some(0));
    for words in ["--up", "--size", "--tab-width", "default: 6mm", "Example:", ".json", "Examples:"] {
        assert!(result.out.contains(words), "no {words:?} in the help");
    }
}
