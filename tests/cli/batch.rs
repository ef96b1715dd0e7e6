//! Several inputs in one run.

use super::*;

/// Quick to make.
const OPTIONS: [&str; 4] = ["--size", "60", "--effort", "0"];

/// Three meshes in three formats, of which the second is none.
const FILES: [(&str, &[u8]); 3] = [
    ("a.obj", TETRAHEDRON.as_bytes()),
    ("b.stl", b"Dear reader, this is no mesh at all."),
    ("c.off", cube::OFF.as_bytes()),
];

fn make(folder: &TempDir, arguments: &[&str]) -> Run {
    run(folder.path(), &[&["make"], arguments, &OPTIONS].concat())
}

#[test]
fn each_is_made_as_it_would_be_alone() {
    let folder = folder_with(&[FILES[0], FILES[2]]);
    std::fs::create_dir(folder.path().join("out")).unwrap();
    let outputs = ["-o", "out/", "-o", "out/{name}-a4.svg", "-o", "out/{name}.fold", "--segments", "out/"];
    let result = make(&folder, &[&["a.obj", "c.off"][..], &outputs].concat());
    assert_eq!((result.code, result.err.as_str()), (Some(0), ""));
    let lines: Vec<&str> = result.out.lines().collect();
    let starts = ["a.obj: 1 component,", "c.off: 1 component,", "2 models made"];
    assert!(lines.len() == 3 && lines.iter().zip(starts).all(|(l, s)| l.starts_with(s)), "{lines:?}");
    for (input, stem) in [("a.obj", "a"), ("c.off", "c")] {
        let alone = folder_with(&FILES);
        let result =
            make(&alone, &[input, "-o", "x.pdf", "-o", "x.svg", "-o", "x.fold", "--segments", "x.seg"]);
        assert_eq!(result.code, Some(0), "{}", result.err);
        for (name, found) in [
            ("x.fold", format!("{stem}.fold")),
            ("x.seg", format!("{stem}.seg")),
            ("x.svg", format!("{stem}-a4.svg")),
            ("x.pdf", format!("{stem}.pdf")),
        ] {
            let [alone, found] = [alone.path().join(name), folder.path().join("out").join(&found)]
                .map(|path| std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display())));
            assert!(alone == found, "{input}: {name} differs");
        }
    }
}

#[test]
fn one_that_fails_does_not_stop_the_others() {
    let folder = folder_with(&FILES);
    let result = make(&folder, &["b.stl", "gone.obj", "a.obj", "c.off"]);
    assert_eq!(result.code, Some(1));
    assert_eq!(names(&folder), ["a.obj", "a.pdf", "b.stl", "c.off", "c.pdf"]);
    let lines: Vec<&str> = result.err.lines().collect();
    assert!(lines[0].starts_with("error: b.stl: ") && lines[0].contains("Dear reader"), "{lines:?}");
    assert!(lines[1].starts_with("error: gone.obj: cannot read gone.obj"), "{lines:?}");
    assert_eq!(lines[2..], ["error: 2 of 4 inputs failed: b.stl, gone.obj"]);
    assert!(result.out.starts_with("a.obj: "), "{}", result.out);
    let quiet = make(&folder, &["-q", "a.obj", "c.off"]);
    assert_eq!((quiet.code, quiet.out.as_str(), quiet.err.as_str()), (Some(0), "", ""));
}

#[test]
fn warnings_name_the_file() {
    let open =
        cube::OFF.trim_end().rsplit_once('\n').map(|(rest, _)| rest.replacen(" 12 ", " 11 ", 1)).unwrap();
    let folder = folder_with(&[FILES[2], ("open.off", open.as_bytes())]);
    let result = make(&folder, &["c.off", "open.off"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(result.err.starts_with("warning: open.off: the mesh has open edges: 3"), "{}", result.err);
}

#[test]
fn no_file_is_written_by_two_inputs() {
    let words = |found: &str| format!("a.obj and {found} would both be written to");
    assert_refused(&FILES, &["make", "a.obj", "c.off", "-o", "x.pdf"], &[&words("c.off"), "{name}"]);
    assert_refused(
        &FILES,
        &["make", "a.obj", "c.off", "-o", "./{name}.pdf", "-o", "x.svg"],
        &[&words("c.off")],
    );
    assert_refused(&FILES, &["make", "a.obj", "c.off", "--segments", "x.seg"], &[&words("c.off")]);
    let same: [(&str, &[u8]); 2] = [("a.obj", FILES[0].1), ("a.off", FILES[2].1)];
    assert_refused(&same, &["make", "a.obj", "a.off"], &[&words("a.off"), "a.pdf"]);
    assert_refused(&same, &["make", "a.obj", "a.obj"], &["a.obj and a.obj"]);
}

#[test]
fn no_input_is_written_over_by_another() {
    let project: (&str, &[u8]) = ("c.toml", b"mesh = 'a.obj'");
    let files = [project, FILES[0], ("a.off", FILES[2].1)];
    assert_refused(
        &files,
        &["make", "c.toml", "a.off", "-o", "{name}.obj"],
        &["cannot write a.obj", "the input"],
    );
}

#[test]
fn sheets_do_not_take_the_name_of_another_inputs_file() {
    let folder = folder_with(&[("a.off", FILES[2].1), ("a-1.obj", FILES[0].1)]);
    let arguments = ["make", "a.off", "a-1.obj", "-o", "{name}.svg", "--size", "150", "--effort", "0"];
    let result = run(folder.path(), &arguments);
    assert_eq!(result.code, Some(1));
    assert!(result.err.contains("error: a.off: a-1.obj and a.off would both be written"), "{}", result.err);
    assert!(names(&folder).iter().all(|name| !name.starts_with("a-2")), "{:?}", names(&folder));
}

#[test]
fn one_input_can_go_into_a_folder() {
    let folder = folder_with(&FILES);
    std::fs::create_dir(folder.path().join("out")).unwrap();
    let result = make(&folder, &["a.obj", "-o", "out"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    assert!(folder.path().join("out/a.pdf").exists());
    let arguments = ["make", "a.obj", "-o", "gone/"];
    assert_refused(&FILES, &arguments, &["gone/a.pdf", "there is no folder gone"]);
}

#[test]
fn an_output_that_is_asked_for_twice_in_other_words() {
    assert_refused(&FILES, &["make", "a.obj", "-o", "x.pdf", "-o", "./x.pdf"], &["two options write it"]);
}
