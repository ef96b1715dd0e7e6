//! What is refused: one message, a failure, and nothing written.

use super::*;

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
        ("--hide-below", "90"),
        ("--side", "back"),
        ("--spacing", "-1"),
        ("--effort", "many"),
        ("--marks", "crosses"),
        ("--calibrate", "97.3"),
        ("--calibrate", "X:973"),
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
        &["cannot write a.json", "two options write it"],
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
fn names_cannot_steer_the_terminal() {
    let result = run(tempfile::tempdir().unwrap().path(), &["make", "a\x1b[31m.obj"]);
    assert!(!result.err.contains('\x1b'), "{:?}", result.err);
}

#[test]
fn what_does_not_fit_the_paper_is_refused_with_a_size_that_fits() {
    let files: [(&str, &[u8]); 2] = [("cube.off", cube::OFF.as_bytes()), ("cube.pdf", b"old")];
    assert_refused(&files, &["make", "cube.off", "--size", "1m", "--no-split"], &["does not fit", "--size"]);
    let folder = folder_with(&files);
    let message = run(folder.path(), &["make", "cube.off", "--size", "1m", "--no-split"]).err;
    assert!(message.contains("do without --no-split"), "{message}");
    assert_eq!(std::fs::read(folder.path().join("cube.pdf")).unwrap(), b"old");
    let size = message.split("--size ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    let whole = run(folder.path(), &["make", "cube.off", "--size", size, "--no-split"]);
    assert_eq!(whole.code, Some(0), "--size {size}: {}", whole.err);
    assert!(std::fs::read(folder.path().join("cube.pdf")).unwrap().starts_with(b"%PDF"), "--size {size}");
}

/// The message named an option that was not given.
#[test]
fn paper_too_small_for_parts_of_panels_is_refused_without_a_word_of_no_split() {
    let files: [(&str, &[u8]); 1] = [("cube.off", cube::OFF.as_bytes())];
    assert_refused(&files, &["make", "cube.off", "--paper", "40x40"], &["does not fit", "--size", "--paper"]);
    let message = run(folder_with(&files).path(), &["make", "cube.off", "--paper", "40x40"]).err;
    assert!(!message.contains("--no-split"), "{message}");
}
