//! Formats, styles and other choices about files.

use super::*;

const OBJ: (&str, &[u8]) = ("cube.obj", cube::OBJ.as_bytes());

#[test]
fn formats_are_listed_with_extensions_and_styles() {
    let folder = folder_with(&[]);
    let result = run(folder.path(), &["formats"]);
    assert_eq!((result.code, result.err.as_str()), (Some(0), ""));
    for words in [".pdf", ".svg", ".dxf", ".png", ".fold", ".glb", ".obj", ".json", "standard, laser, bw"] {
        assert!(result.out.contains(words), "no {words:?} in {}", result.out);
    }
    let help = run(folder.path(), &["make", "--help"]).out;
    for line in result.out.lines().filter(|line| line.starts_with("  .")) {
        assert!(help.contains(line), "the help lacks {line:?}");
    }
}

#[test]
fn choices_about_files_are_checked_before_the_work() {
    for (arguments, words) in [
        (["--style", "none"], ["no style file none", "standard, laser, bw"]),
        (["--tile", "30x30mm"], ["30x30mm is too small", "60 mm"]),
    ] {
        assert_refused(&[OBJ], &[&["make", "cube.obj"][..], &arguments].concat(), &words);
    }
    let plain = cube::OFF.replace(" 255 0 0", "");
    assert_refused(
        &[("cube.off", plain.as_bytes())],
        &["make", "cube.off", "--color"],
        &["cube.off", "no colours", "--color"],
    );
    assert_refused(&[OBJ], &["make", "cube.obj", "--color"], &["missing.mtl", "no such file", "--color"]);
}

#[test]
fn a_mistake_in_a_style_file_is_shown_with_its_line() {
    let folder = folder_with(&[OBJ, ("bad.toml", b"[cut]\nwidth_mm = -1\n")]);
    let result = run(folder.path(), &["make", "cube.obj", "--style", "bad.toml"]);
    assert_eq!(result.code, Some(1), "{}", result.err);
    for words in ["style file bad.toml", "line 2", "width_mm = -1"] {
        assert!(result.err.contains(words), "no {words:?} in: {}", result.err);
    }
    assert_eq!(names(&folder), ["bad.toml", "cube.obj"]);
}

#[test]
fn values_that_are_not_known_are_named() {
    for (flag, value, words) in [
        ("--text", "letters", "outlines, strokes, text"),
        ("--stroke", "thin", "styled, hairline"),
        ("--dxf-version", "r9", "r12, r2000"),
        ("--dxf-sheets", "pile", "files, row"),
        ("--dpi", "3", "from 10 to 2400"),
        ("--tile", "a9", "paper size"),
    ] {
        let folder = folder_with(&[OBJ]);
        let result = run(folder.path(), &["make", "cube.obj", flag, value]);
        assert_eq!(result.code, Some(2), "{flag}");
        assert!(result.err.contains(words), "{flag}: {}", result.err);
    }
}

#[test]
fn a_project_chooses_style_and_files() {
    let project: (&str, &[u8]) = (
        "cube.toml",
        b"mesh = 'cube.obj'\nsize = 60\n[export]\nstyle = 'own.toml'\ntext = 'strokes'\nstroke = 'hairline'\n",
    );
    let style: (&str, &[u8]) = ("own.toml", b"[cut]\ncolour = \"#123456\"\nlayer = \"KNIFE\"\n");
    let folder = folder_with(&[OBJ, project, style]);
    let result = run(folder.path(), &["make", "cube.toml", "-o", "a.svg"]);
    assert_eq!(result.code, Some(0), "{}", result.err);
    let text = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    for words in ["id=\"knife\"", "inkscape:label=\"KNIFE\"", "stroke=\"#123456\"", "stroke-width=\"0.0945\""]
    {
        assert!(text.contains(words), "no {words:?}");
    }
    assert!(!text.contains("stroke-width=\"0.9449\""));
}

#[test]
fn the_date_of_a_pdf_comes_from_the_environment() {
    for (value, is_good) in [("1000000000", true), ("yesterday", false)] {
        let folder = folder_with(&[OBJ]);
        let mut command = assert_cmd::cargo::cargo_bin_cmd!("tatamu");
        command.env("SOURCE_DATE_EPOCH", value).current_dir(folder.path());
        let result = command.args(["make", "cube.obj", "--size", "60", "-o", "a.pdf"]).output().unwrap();
        assert_eq!(result.status.success(), is_good);
        assert_eq!(folder.path().join("a.pdf").exists(), is_good);
        let message = String::from_utf8_lossy(&result.stderr).into_owned();
        assert!(is_good || message.contains("SOURCE_DATE_EPOCH"), "{message}");
    }
}
